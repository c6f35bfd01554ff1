//! The polynomial through a function's values at Chebyshev points, on θ in cos θ.

use crate::math;
use core::f64::consts::PI;

/// Chebyshev points of a piece.
pub(super) const POINTS: usize = 16;

/// cos(π i / (2 · POINTS)), of a whole turn.
pub(super) struct Cosines([f64; 4 * POINTS]);

impl Cosines {
    pub fn new() -> Self {
        let at = |i: usize| math::sin_cos(PI * i as f64 / (2 * POINTS) as f64).1;
        Self(core::array::from_fn(at))
    }

    /// cos(k θⱼ) of the Chebyshev point j.
    pub fn at(&self, k: usize, j: usize) -> f64 {
        self.0[k * (2 * j + 1) % (4 * POINTS)]
    }
}

/// A polynomial by its Chebyshev coefficients.
pub(super) struct Polynomial {
    pub coefficients: [f64; POINTS],
    /// Of |d²/dθ²| of f(cos θ).
    pub bend: f64,
}

impl Polynomial {
    /// That with these values at Chebyshev points.
    pub fn through(cosines: &Cosines, values: &[f64; POINTS]) -> Self {
        let mut bend = 0.0;
        let coefficients = core::array::from_fn(|k| {
            let sum: f64 = (0..POINTS).map(|j| values[j] * cosines.at(k, j)).sum();
            let weight = if k == 0 { 1.0 } else { 2.0 } / POINTS as f64;
            bend += (k * k) as f64 * (weight * sum).abs();
            weight * sum
        });
        Self { coefficients, bend }
    }

    /// f(cos θ), by the recurrence of Clenshaw.
    pub fn at(&self, theta: f64) -> f64 {
        let x = math::sin_cos(theta).1;
        let (mut a, mut b) = (0.0, 0.0);
        for c in self.coefficients[1..].iter().rev() {
            (a, b) = (c + 2.0 * x * a - b, a);
        }
        self.coefficients[0] + x * a - b
    }
}
