//! Branches that eliminations complete.

use super::Univariate;
use crate::generated::acceptance::Acceptance;
use crate::generated::branches::Branches;
use crate::{Pose, Solution, Solutions};

impl<const N: usize, const L: usize> Branches<N, L> {
    /// Whether there may be solutions that no branch tells: where one is singular, or is none but
    /// reaches the target, as where an ill-conditioned step misses a double root.
    #[inline(always)]
    pub fn degenerate(&self, accept: &Acceptance) -> bool {
        let mut degenerate = false;
        for k in 0..L {
            let exists = self.invalid[k] <= 0.0;
            let reaches = self.residual[k] <= accept.nearly;
            degenerate |= (exists & (self.singular[k] > 0.0)) | (!exists & reaches);
        }
        degenerate
    }

    /// The branches of a plan, refined to the solutions of an arm that is off its ideal, or where
    /// they are [degenerate](Self::degenerate); see [`Univariate::refined`].
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

    /// The branches that exist or reach the target; the latter are singular.
    fn begun(&self, accept: &Acceptance) -> impl Iterator<Item = Solution<N>> {
        (0..L).filter_map(|k| {
            let exists = self.invalid[k] <= 0.0;
            let lane = self.lane(k);
            let singular = lane.singular | !exists;
            let begun = exists | (self.residual[k] <= accept.nearly);
            begun.then_some(Solution { singular, ..lane })
        })
    }
}
