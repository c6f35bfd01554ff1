//! Branches that eliminations complete.

use super::Univariate;
use crate::generated::acceptance::Acceptance;
use crate::generated::branches::Branches;
use crate::{Pose, Solution, Solutions};

impl<const N: usize, const L: usize> Branches<N, L> {
    /// The branches of a plan, refined to the solutions of an arm that is off its ideal, or where
    /// they [are completed](Self::are_completed); see [`Univariate::refined`].
    #[inline]
    pub fn refined_onto(
        &self,
        arm: &Univariate,
        target: &Pose,
        seed: &[f64; N],
        accept: &Acceptance,
    ) -> Solutions<N> {
        arm.refined(target, self.begun(accept), seed, L, accept.near_singular)
    }

    /// The branches that solutions are sought from, singular where they are degenerate.
    fn begun(&self, accept: &Acceptance) -> impl Iterator<Item = Solution<N>> {
        let begins = (0..L).filter(|&k| self.begins(k, accept));
        begins.map(|k| Solution {
            singular: self.is_degenerate(k, accept),
            ..self.lane(k)
        })
    }
}
