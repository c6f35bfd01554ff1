//! Resolved-rate control: joint rates for a velocity of the tip.

use super::super::linear::singular_values::SingularValues;
use super::super::linear::vector::dot;
use super::super::scalar::Real;
use super::super::{Jacobian, RANK_TOLERANCE, Twist};

impl<const N: usize> Jacobian<N> {
    /// J⁺ V: the joint rates that give the tip a velocity, in the coordinates
    /// of this Jacobian, or come nearest to it; of several, the least. Metres
    /// and radians count alike. Directions lost to a singularity, see
    /// [`RANK_TOLERANCE`], are left out; close to one, rates grow without
    /// bound, which [`Jacobian::damped_rates`] avoids.
    pub fn least_squares_rates(&self, velocity: &Twist) -> [Real; N] {
        let found = SingularValues::new(&self.rows);
        let least = RANK_TOLERANCE * found.values[0];
        found.rates(
            velocity,
            |value| if value > least { 1.0 / value } else { 0.0 },
        )
    }

    /// The joint rates that minimize |J q̇ − V|² + λ² |q̇|², λ being `damping`
    /// (Y. Nakamura and H. Hanafusa, 1986; C. W. Wampler, 1986). None exceeds
    /// |V| / 2λ, also at a singularity.
    ///
    /// ```
    /// use kin_runtime::{Jacobian, Twist};
    /// let slide = Twist::prismatic([1.0, 0.0, 0.0]);
    /// let jacobian = Jacobian::from_columns([slide]);
    /// assert_eq!(jacobian.least_squares_rates(&(slide * 0.3)), [0.3]);
    /// assert!((jacobian.damped_rates(&(slide * 0.3), 0.1)[0] - 0.3 / 1.01).abs() < 1e-15);
    /// ```
    pub fn damped_rates(&self, velocity: &Twist, damping: Real) -> [Real; N] {
        let found = SingularValues::new(&self.rows);
        found.rates(velocity, |value| {
            value / (value * value + damping * damping)
        })
    }
}

impl<const N: usize> SingularValues<6, N> {
    /// Σ vᵢ gain(σᵢ) uᵢ · V over what is not 0.
    fn rates(&self, velocity: &Twist, gain: impl Fn(Real) -> Real) -> [Real; N] {
        let mut rates = [0.0; N];
        for (i, &value) in self
            .values
            .iter()
            .enumerate()
            .filter(|(_, value)| **value > 0.0)
        {
            let along = dot(self.left[i], velocity.to_array());
            for (rate, v) in rates.iter_mut().zip(self.right(i)) {
                *rate += gain(value) * along * v;
            }
        }
        rates
    }
}
