//! Branches that eliminations complete.

use super::Univariate;
use crate::generated::acceptance::Acceptance;
use crate::generated::branches::Branches;
use crate::{Pose, Solution, Solutions};

impl<const N: usize, const L: usize> Branches<N, L> {
    /// Whether solutions are sought from a branch: if it exists or reaches the target.
    #[inline(always)]
    fn begins(&self, k: usize, accept: &Acceptance) -> bool {
        (self.invalid[k] <= 0.0) | (self.residual[k] <= accept.nearly)
    }

    /// Whether there may be solutions beside a branch that no other one tells: where it is
    /// singular, or is none but reaches the target, as where an ill-conditioned step misses a
    /// double root.
    #[inline(always)]
    fn is_degenerate(&self, k: usize, accept: &Acceptance) -> bool {
        let exists = self.invalid[k] <= 0.0;
        self.begins(k, accept) & ((self.singular[k] > 0.0) | !exists)
    }

    /// Whether there may be solutions that no branch tells.
    #[inline(always)]
    pub fn degenerate(&self, accept: &Acceptance) -> bool {
        let mut degenerate = false;
        for k in 0..L {
            degenerate |= self.is_degenerate(k, accept);
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

    /// The branches that solutions are sought from, singular where they are degenerate.
    fn begun(&self, accept: &Acceptance) -> impl Iterator<Item = Solution<N>> {
        let begins = (0..L).filter(|&k| self.begins(k, accept));
        begins.map(|k| Solution {
            singular: self.is_degenerate(k, accept),
            ..self.lane(k)
        })
    }
}
