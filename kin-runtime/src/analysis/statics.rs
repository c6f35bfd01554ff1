//! What a singular arm bears without effort.

use super::super::linear::singular_values::SingularValues;
use super::super::scalar::{Real, tolerance};
use super::super::{Basis, Jacobian, Wrench};

/// Singular values of a Jacobian below this part of the largest count as 0, in
/// metres and radians. Joint values that solve inverse kinematics are this
/// accurate.
pub const RANK_TOLERANCE: Real = tolerance::RANK;

impl<const N: usize> Jacobian<N> {
    /// The dimension of the space of velocities that the joints can give the
    /// tip; see [`RANK_TOLERANCE`].
    pub fn rank(&self) -> usize {
        SingularValues::new(&self.rows).rank(RANK_TOLERANCE)
    }

    /// The wrenches that need no joint torque, because the structure bears
    /// them: an orthonormal basis of the null space of Jᵀ (MLS section 3.4.2),
    /// in the coordinates of this Jacobian, N and N m. An arm of N joints has at
    /// least 6 − N, and more where it is singular; see [`RANK_TOLERANCE`].
    ///
    /// ```
    /// use kin_runtime::{Jacobian, Twist};
    /// let z = [0.0, 0.0, 1.0];
    /// // Parallel hinges bear forces along them and moments across them.
    /// let hinges = [0.0, 0.4, 0.7].map(|x| Twist::revolute(z, [x, 0.2 * x * x, 0.0]));
    /// let structural = Jacobian::from_columns(hinges).structural_wrenches();
    /// assert_eq!(structural.len(), 3);
    /// assert!(structural.iter().all(|w| w.force[0].abs() < 1e-15 && w.moment[2].abs() < 1e-15));
    /// ```
    pub fn structural_wrenches(&self) -> Basis<Wrench, 6> {
        let found = SingularValues::new(&self.rows);
        let mut wrenches = found.left.map(Wrench::from_array);
        wrenches.reverse();
        Basis::new(wrenches, 6 - found.rank(RANK_TOLERANCE))
    }
}
