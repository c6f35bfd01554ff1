//! The manipulator Jacobian.

use super::super::scalar::Real;
use super::super::{Pose, Twist, Wrench};

/// A 6×N Jacobian: `rows[0..3]` are the linear part v, `rows[3..6]` the angular
/// part ω, one column per joint (MLS section 3.4).
///
/// ```
/// use kin_runtime::{Jacobian, Twist, Wrench};
/// let shoulder = Twist::revolute([0.0, 0.0, 1.0], [0.0; 3]);
/// let slide = Twist::prismatic([1.0, 0.0, 0.0]);
/// let jacobian = Jacobian::from_columns([shoulder, slide]);
/// assert_eq!(jacobian.velocity(&[0.5, 2.0]).to_array(), [2.0, 0.0, 0.0, 0.0, 0.0, 0.5]);
/// let load = Wrench { force: [3.0, 0.0, 0.0], moment: [0.0, 0.0, 4.0] };
/// assert_eq!(jacobian.torques(&load), [4.0, 3.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Jacobian<const N: usize> {
    /// Rows (v, ω); columns follow the joints.
    #[cfg_attr(feature = "serde", serde(with = "crate::convert::rows"))]
    pub rows: [[Real; N]; 6],
}

impl<const N: usize> Jacobian<N> {
    /// The Jacobian whose columns are the joints' twists.
    #[inline]
    pub fn from_columns(columns: [Twist; N]) -> Self {
        let columns = columns.map(Twist::to_array);
        Jacobian {
            rows: core::array::from_fn(|i| core::array::from_fn(|j| columns[j][i])),
        }
    }

    /// The twist that unit rate of joint `j` (from 0) alone gives the tip.
    ///
    /// # Panics
    /// If there is no such joint.
    #[inline]
    pub fn column(&self, j: usize) -> Twist {
        Twist::from_array(self.rows.map(|row| row[j]))
    }

    /// All columns.
    #[inline]
    pub fn columns(&self) -> [Twist; N] {
        core::array::from_fn(|j| self.column(j))
    }

    /// J q̇: the tip's velocity at the joint rates (rad/s, m/s), in the
    /// coordinates of this Jacobian.
    #[inline]
    pub fn velocity(&self, rates: &[Real; N]) -> Twist {
        Twist::from_array(
            self.rows
                .map(|row| row.iter().zip(rates).map(|(a, b)| a * b).sum()),
        )
    }

    /// Jᵀ F: the joint torques and forces (N m, N) that balance the wrench
    /// applied to the tip, given in the coordinates of this Jacobian.
    #[inline]
    pub fn torques(&self, wrench: &Wrench) -> [Real; N] {
        let wrench = wrench.to_array();
        core::array::from_fn(|j| {
            self.rows
                .iter()
                .zip(wrench)
                .map(|(row, f)| row[j] * f)
                .sum()
        })
    }

    /// From the spatial to the body Jacobian; `pose` is the tip's.
    #[inline]
    pub fn spatial_to_body(&self, pose: &Pose) -> Self {
        Self::from_columns(self.columns().map(|twist| pose.adjoint_inverse(&twist)))
    }

    /// From the body to the spatial Jacobian; `pose` is the tip's.
    #[inline]
    pub fn body_to_spatial(&self, pose: &Pose) -> Self {
        Self::from_columns(self.columns().map(|twist| pose.adjoint(&twist)))
    }

    /// From the spatial to the geometric Jacobian; `pose` is the tip's.
    #[inline]
    pub fn spatial_to_geometric(&self, pose: &Pose) -> Self {
        Self::from_columns(self.columns().map(|twist| twist.spatial_to_geometric(pose)))
    }

    /// From the geometric to the spatial Jacobian; `pose` is the tip's.
    #[inline]
    pub fn geometric_to_spatial(&self, pose: &Pose) -> Self {
        Self::from_columns(self.columns().map(|twist| twist.geometric_to_spatial(pose)))
    }
}

impl<const N: usize> Default for Jacobian<N> {
    /// All zero.
    fn default() -> Self {
        Jacobian {
            rows: [[0.0; N]; 6],
        }
    }
}

impl<const N: usize> core::ops::Mul<[Real; N]> for Jacobian<N> {
    type Output = Twist;
    /// As [`Jacobian::velocity`].
    #[inline]
    fn mul(self, rates: [Real; N]) -> Twist {
        self.velocity(&rates)
    }
}
