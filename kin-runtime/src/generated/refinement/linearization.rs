//! A configuration as the target sees it: what is missing, and how the joints
//! make it.

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose, Target};

/// A target for an arm.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a, F> {
    /// Gives the pose and the spatial Jacobian of a configuration.
    pub fk_jacobian: F,
    /// Where the tip has to go.
    pub target: &'a Pose,
    /// The arm's size, metres: angles count as lengths at this distance.
    pub size: Real,
    /// What of the target counts.
    pub counts: Target,
}

impl<'a, F> Problem<'a, F> {
    /// The target of an arm whose branches are accepted so.
    pub fn new(fk_jacobian: F, target: &'a Pose, counts: Target, accept: &Acceptance) -> Self {
        Self {
            fk_jacobian,
            target,
            size: accept.size,
            counts,
        }
    }
}

/// A configuration as the target sees it: by the six coordinates of a pose, or with others behind
/// them.
pub(super) struct Linearization<const N: usize, const R: usize> {
    pub q: [Real; N],
    pub residual: Real,
    /// What is missing, and the rows that make it, with lengths in
    /// units of the arm's size; zero where the target does not count.
    pub error: [Real; R],
    pub rows: [[Real; N]; R],
}

impl<const N: usize> Linearization<N, 6> {
    pub fn new(
        q: [Real; N],
        problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    ) -> Self {
        let &Problem {
            ref fk_jacobian,
            target,
            size,
            counts,
        } = problem;
        let (pose, spatial) = fk_jacobian(&q);
        let mut error = counts.missing(&pose, target).to_array();
        let geometric = spatial.spatial_to_geometric(&pose);
        let mut rows = counts.counting_rows(&pose, &geometric).rows;
        for i in 0..3 {
            error[i] /= size;
            rows[i] = rows[i].map(|x| x / size);
        }
        Self {
            q,
            residual: counts.distance(&pose, target, size),
            error,
            rows,
        }
    }
}
