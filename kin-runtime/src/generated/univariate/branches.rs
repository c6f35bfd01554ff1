//! Branches that an elimination completes.

use super::Univariate;
use crate::generated::acceptance::Acceptance;
use crate::generated::branches::Branches;
use crate::{Jacobian, Pose, Solutions, Target};

impl<const N: usize, const L: usize> Branches<N, L> {
    /// The branches of an idealized arm, refined to the solutions of the arm as given; see
    /// [`Univariate::refined`].
    #[inline]
    pub fn refined_onto(
        &self,
        arm: &Univariate,
        target: &Pose,
        seed: &[f64; N],
        accept: &Acceptance,
    ) -> Solutions<N> {
        arm.refined(target, self.existing(), seed, L, accept.near_singular)
    }

    /// As [`Self::corrected`], and where a step degenerates, [`Univariate::refined`].
    #[inline(always)]
    pub fn completed(
        &self,
        fk_jacobian: impl Fn(&[f64; N]) -> (Pose, Jacobian<N>),
        arm: &Univariate,
        target: &Pose,
        seed: &[f64; N],
        accept: &Acceptance,
    ) -> Solutions<N> {
        let mut degenerates = false;
        for k in 0..L {
            degenerates |= (self.invalid[k] <= 0.0) & (self.singular[k] > 0.0);
        }
        match degenerates {
            true => self.refined_onto(arm, target, seed, accept),
            false => self.corrected(fk_jacobian, target, Target::Pose, accept),
        }
    }
}
