//! Motions of the joints that leave the tip where it is.

use super::super::linear::span::Span;
use super::super::linear::vector::dot;
use super::super::scalar::Real;
use super::super::{Basis, Jacobian, JointLimit, RANK_TOLERANCE};

/// An orthonormal basis of the vectors x with A x = 0, for some rows of a
/// Jacobian: [`Jacobian::translational`] for a task that leaves the tip's
/// orientation open. Rows count as dependent as for [`RANK_TOLERANCE`].
///
/// One column more than independent rows leave one vector. Its sign is that
/// which completes the rows to a matrix of positive determinant, as the signed
/// minors do, and so is continuous wherever the rank is full.
///
/// ```
/// // In space, what a row and another do not see is their cross product.
/// let basis = kin_runtime::null_space(&[[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
/// assert_eq!(basis[..], [[0.0, 0.0, 1.0]]);
/// ```
pub fn null_space<const R: usize, const N: usize>(rows: &[[Real; N]; R]) -> Basis<[Real; N], N> {
    let space = Span::of(R, |i| rows[i], RANK_TOLERANCE);
    let mut vectors = [[0.0; N]; N];
    vectors
        .iter_mut()
        .zip(space.complement())
        .for_each(|(vector, found)| *vector = found);
    if space.rank == R && N == R + 1 {
        let sign = space.orientation();
        vectors[0] = vectors[0].map(|x| 0.0 + sign * x);
    }
    Basis::new(vectors, N - space.rank)
}

impl<const N: usize> Jacobian<N> {
    /// The internal motions J q̇ = 0 (MLS section 3.5.1): an orthonormal basis
    /// of the joint rates that leave the tip at rest, rad/s and m/s. See
    /// [`null_space`], also for the sign of the one of a seven-joint arm.
    pub fn internal_motions(&self) -> Basis<[Real; N], N> {
        null_space(&self.rows)
    }

    /// The internal motion nearest to some joint rates: a secondary task, such
    /// as to stay away from limits or from singularities, that does not disturb
    /// the tip.
    pub fn null_space_projection(&self, rates: &[Real; N]) -> [Real; N] {
        let mut projected = [0.0; N];
        for motion in &self.internal_motions() {
            let along = dot(*motion, *rates);
            for (x, m) in projected.iter_mut().zip(motion) {
                *x += along * m;
            }
        }
        projected
    }
}

/// The gradient of Σ ½ ((q − middle) / (upper − lower))², a measure of how far
/// the joints are from the middle of their travel (A. Liégeois, 1977). A joint
/// without two stops has none.
///
/// ```
/// use kin_runtime::{JointLimit, centering_gradient};
/// let limits = [JointLimit::Revolute { lower: -1.0, upper: 3.0 }, JointLimit::Continuous];
/// assert_eq!(centering_gradient(&limits, &[2.0, 9.0]), [0.0625, 0.0]);
/// ```
pub fn centering_gradient<const N: usize>(limits: &[JointLimit; N], q: &[Real; N]) -> [Real; N] {
    core::array::from_fn(|i| {
        let (lower, upper) = (limits[i].lower(), limits[i].upper());
        let travel = upper - lower;
        if travel.is_finite() && travel > 0.0 {
            (q[i] - 0.5 * (lower + upper)) / (travel * travel)
        } else {
            0.0
        }
    })
}
