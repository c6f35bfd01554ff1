//! Singularities, and the determinant that tells them all.

use super::super::Jacobian;
use super::super::scalar::Real;

/// A singularity of an arm, and how far from it a configuration is. Generated robots with a square Jacobian return an array of these from
/// `singularities(&q)`: the factors of its determinant, by name.
///
/// ```
/// use kin_runtime::Singularity;
/// let seen = [
///     Singularity { name: "elbow", value: -0.3 },
///     Singularity { name: "wrist", value: 0.02 },
/// ];
/// let nearest = seen.iter().min_by(|a, b| a.value.abs().total_cmp(&b.value.abs()));
/// assert_eq!(nearest.unwrap().name, "wrist");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Singularity {
    /// Shoulder, elbow, wrist, or the joints that bring it about.
    pub name: &'static str,
    /// 0 where the arm is at this singularity; the sign changes across it.
    /// The sine of the angle to it where one joint decides, otherwise a length
    /// in metres, or as the documentation of the robot's method says.
    pub value: Real,
}

impl Singularity {
    /// Those of an arm, by name.
    #[inline]
    pub fn by_name<const N: usize>(names: [&'static str; N], values: [Real; N]) -> [Self; N] {
        core::array::from_fn(|i| Singularity {
            name: names[i],
            value: values[i],
        })
    }
}

/// The singularities of any arm, at most [`Singularities::CAPACITY`]; a slice of
/// [`Singularity`] without allocation.
///
/// ```
/// use kin_runtime::{Singularities, Singularity};
/// let of_two = Singularities::from([
///     Singularity { name: "elbow", value: -0.3 },
///     Singularity { name: "wrist", value: 0.02 },
/// ]);
/// assert_eq!(of_two.len(), 2);
/// assert!(of_two.iter().any(|singularity| singularity.value.abs() < 0.1));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Singularities {
    list: [Singularity; Self::CAPACITY],
    len: usize,
}

impl Singularities {
    /// No arm of six joints has more: the factors of the determinant of its
    /// Jacobian.
    pub const CAPACITY: usize = 12;
}

impl<const K: usize> From<[Singularity; K]> for Singularities {
    fn from(found: [Singularity; K]) -> Self {
        const {
            assert!(
                K <= Self::CAPACITY,
                "more singularities than there is room for"
            )
        }
        let mut singularities = Singularities::default();
        singularities.list[..K].copy_from_slice(&found);
        singularities.len = K;
        singularities
    }
}

impl core::ops::Deref for Singularities {
    type Target = [Singularity];
    fn deref(&self) -> &[Singularity] {
        &self.list[..self.len]
    }
}

impl<const N: usize> Jacobian<N> {
    /// The same Jacobian where there are six joints.
    pub(crate) fn square(&self) -> Option<Jacobian<6>> {
        let column = |j: usize| self.column(j);
        (N == 6).then(|| Jacobian::from_columns(core::array::from_fn(column)))
    }
}

impl Jacobian<6> {
    /// The determinant, by elimination with partial pivoting; the same for the
    /// spatial, body and geometric Jacobian of a configuration. Units are those
    /// of the rows: m³ for six revolute joints. To within rounding of the
    /// largest product that it is a sum of.
    ///
    /// ```
    /// use kin_runtime::{Jacobian, Twist};
    /// let unit = |i| Twist::from_array(core::array::from_fn(|j| f64::from(u8::from(i == j))));
    /// let columns = [unit(1), unit(0), unit(2), unit(3), unit(4), unit(5) * 2.0];
    /// assert_eq!(Jacobian::from_columns(columns).determinant(), -2.0);
    /// ```
    pub fn determinant(&self) -> Real {
        let mut rows = self.rows;
        let mut determinant = 1.0;
        for step in 0..6 {
            let mut pivot = step;
            for i in step + 1..6 {
                if rows[i][step].abs() > rows[pivot][step].abs() {
                    pivot = i;
                }
            }
            if rows[pivot][step] == 0.0 {
                return 0.0;
            }
            if pivot != step {
                rows.swap(pivot, step);
                determinant = -determinant;
            }
            determinant *= rows[step][step];
            for i in step + 1..6 {
                let factor = rows[i][step] / rows[step][step];
                for j in step + 1..6 {
                    rows[i][j] -= factor * rows[step][j];
                }
            }
        }
        determinant
    }
}
