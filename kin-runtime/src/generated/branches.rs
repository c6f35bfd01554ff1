//! What generated inverse kinematics computes, before it is sorted out.

use super::super::scalar::Real;
use super::super::types::nearest::Motion;
use super::super::{Jacobian, Pose, Solution, Solutions, Target, math};
use super::acceptance::{Acceptance, Completion};
use super::refinement::{AtSwivel, Problem, correct_branches};

/// All branches of one target as array lanes: lane k is the branch whose i-th
/// choice is + where bit i of k is clear.
#[derive(Clone, Copy, Debug)]
pub struct Branches<const N: usize, const L: usize> {
    /// By joint, in (−π, π] radians or metres.
    pub q: [[Real; L]; N],
    /// The distance of each branch from the target, metres. Where a root is out
    /// of domain the branch does as well as it can.
    pub residual: [Real; L],
    /// Positive where the branch does not exist or repeats another.
    pub invalid: [Real; L],
    /// Positive where a root is double or an angle is free.
    pub singular: [Real; L],
}

impl<const N: usize, const L: usize> Branches<N, L> {
    #[inline(always)]
    pub(super) fn lane(&self, k: usize) -> Solution<N> {
        Solution {
            q: core::array::from_fn(|i| self.q[i][k]),
            residual: self.residual[k],
            branch: k as u32,
            singular: self.singular[k] > 0.0,
        }
    }

    /// The branches that reach the target.
    #[inline(always)]
    pub fn solutions(&self, accept: &Acceptance) -> Solutions<N> {
        Solutions::build_with_prismatic(accept.prismatic, |solutions| {
            for k in 0..L {
                let reaches = (self.invalid[k] <= 0.0) & (self.residual[k] <= accept.taken);
                solutions.push_if(reaches, self.lane(k));
            }
        })
    }

    /// Of the branches that reach the target, the one that moves the joints
    /// least, chosen side by side: as [`Solutions::nearest_by`] of
    /// [`Self::solutions`], without writing the others down.
    #[inline(always)]
    pub(super) fn choose(
        &self,
        accept: &Acceptance,
        joints: &Motion<'_, N>,
    ) -> Option<Solution<N>> {
        let mut motions = [0.0; L];
        for k in 0..L {
            let mut motion = 0.0;
            let mut allowed = true;
            for i in 0..N {
                let (cost, is_allowed) = joints.cost(i, self.q[i][k]);
                motion += cost;
                allowed &= is_allowed;
            }
            let reaches = (self.invalid[k] <= 0.0) & (self.residual[k] <= accept.taken);
            // What is too much for a number is still a motion.
            let motion = math::min(motion, Real::MAX);
            motions[k] = math::select(reaches & allowed, motion, Real::INFINITY);
        }
        let least = least(motions);
        if least == Real::INFINITY {
            return None;
        }
        let mut best = 0;
        for k in (0..L).rev() {
            best = if motions[k] == least { k } else { best };
        }
        let mut solution = self.lane(best);
        for i in 0..N {
            solution.q[i] = joints.value(i, solution.q[i]);
        }
        Some(solution)
    }

    /// The branches that reach the target, those that rounding or idealization keeps from it
    /// after a correction; of singular ones those that are next to `seed`. See [`correct_branches`].
    /// The arm is given by its pose and spatial Jacobian.
    #[inline(always)]
    pub fn corrected(
        &self,
        fk_jacobian: impl Fn(&[Real; N]) -> (Pose, Jacobian<N>),
        target: &Pose,
        counts: Target,
        seed: &[Real; N],
        accept: &Acceptance,
    ) -> Solutions<N> {
        match self.nearly(accept) | self.are_singular(accept) {
            true => self.correct(fk_jacobian, target, counts, seed, accept),
            false => self.solutions(accept),
        }
    }

    /// Whether a branch may be corrected.
    #[inline(always)]
    pub(super) fn nearly(&self, accept: &Acceptance) -> bool {
        let mut nearly = false;
        for k in 0..L {
            let misses = self.residual[k] > accept.taken;
            let little = self.residual[k] <= accept.nearly;
            nearly |= (self.invalid[k] <= 0.0) & misses & little;
        }
        nearly
    }

    /// Whether of a branch that reaches the target a root is double or an angle free.
    #[inline(always)]
    pub(super) fn are_singular(&self, accept: &Acceptance) -> bool {
        let mut singular = false;
        for k in 0..L {
            let reaches = (self.invalid[k] <= 0.0) & (self.residual[k] <= accept.taken);
            singular |= reaches & (self.singular[k] > 0.0);
        }
        singular
    }

    /// Without those that have led to some of these solutions.
    pub(super) fn without<const K: usize>(mut self, solutions: &Solutions<K>) -> Self {
        for solution in solutions {
            if let Some(invalid) = self.invalid.get_mut(solution.branch as usize) {
                *invalid = 1.0;
            }
        }
        self
    }

    /// How many exist that reach the target or nearly do.
    pub(super) fn begin(&self, accept: &Acceptance) -> usize {
        let begins = |&k: &usize| (self.invalid[k] <= 0.0) & (self.residual[k] <= accept.nearly);
        (0..L).filter(begins).count()
    }

    /// Whether solutions are sought from a branch: if it exists or reaches the target.
    #[inline(always)]
    pub(super) fn begins(&self, k: usize, accept: &Acceptance) -> bool {
        (self.invalid[k] <= 0.0) | (self.residual[k] <= accept.nearly)
    }

    /// Whether there may be solutions beside a branch that no other one tells: where it is
    /// singular, or is none but reaches the target, as where an ill-conditioned step misses a
    /// double root.
    #[inline(always)]
    pub(super) fn is_degenerate(&self, k: usize, accept: &Acceptance) -> bool {
        let exists = self.invalid[k] <= 0.0;
        self.begins(k, accept) & ((self.singular[k] > 0.0) | !exists)
    }

    /// Whether an elimination is asked for solutions that no branch tells.
    #[inline(always)]
    pub fn are_completed(&self, completion: Completion, accept: &Acceptance) -> bool {
        let [mut reached, mut near, mut degenerate] = [false; 3];
        for k in 0..L {
            let exists = self.invalid[k] <= 0.0;
            reached |= exists & (self.residual[k] <= accept.taken);
            near |= self.residual[k] <= accept.nearly;
            degenerate |= self.is_degenerate(k, accept);
        }
        match completion {
            Completion::Never => false,
            Completion::Unanswered => near & !reached,
            Completion::Degenerate => degenerate,
        }
    }

    /// The branches that exist.
    pub(super) fn existing(&self) -> impl Iterator<Item = Solution<N>> + Clone {
        let exist = (0..L).filter(|&k| self.invalid[k] <= 0.0);
        exist.map(|k| self.lane(k))
    }

    #[cold]
    #[inline(never)]
    fn correct(
        &self,
        fk_jacobian: impl Fn(&[Real; N]) -> (Pose, Jacobian<N>),
        target: &Pose,
        counts: Target,
        seed: &[Real; N],
        accept: &Acceptance,
    ) -> Solutions<N> {
        let problem = Problem::new(fk_jacobian, target, counts, accept);
        correct_branches(&problem, self.existing(), seed, accept)
    }

    /// The branch that comes nearest to the target by its own residual; none
    /// if the target is not a number. Of equals the first.
    #[inline]
    pub fn closest(&self, accept: &Acceptance) -> Option<Solution<N>> {
        self.least(|lane| lane.residual, accept)
    }

    /// The branch that comes nearest to the target by forward kinematics: out
    /// of reach, sines and cosines are not those of any angle. None if the
    /// target is not a number; of equals the first.
    #[inline]
    pub fn closest_by(
        &self,
        fk: impl Fn(&[Real; N]) -> Pose,
        target: &Pose,
        counts: Target,
        accept: &Acceptance,
    ) -> Option<Solution<N>> {
        let distance = |lane: &Solution<N>| counts.distance(&fk(&lane.q), target, accept.size);
        self.least(distance, accept)
    }

    /// A branch that repeats another, as one more of its family, is no solution, however near
    /// it comes.
    #[inline(always)]
    fn least(
        &self,
        residual: impl Fn(&Solution<N>) -> Real,
        accept: &Acceptance,
    ) -> Option<Solution<N>> {
        let mut best = None;
        let mut least = Real::INFINITY;
        for k in 0..L {
            let lane = self.lane(k);
            let residual = residual(&lane);
            let counted = match self.invalid[k] > 0.0 {
                true => math::max(accept.tolerance, residual),
                false => residual,
            };
            if counted < least {
                least = counted;
                best = Some(Solution { residual, ..lane });
            }
        }
        best
    }
}

/// The least of numbers, by halves: as many as there are branches, a power of two.
#[inline(always)]
fn least<const L: usize>(mut numbers: [Real; L]) -> Real {
    const { assert!(L.is_power_of_two()) };
    let mut half = L / 2;
    while half > 0 {
        for k in 0..half {
            numbers[k] = math::min(numbers[k + half], numbers[k]);
        }
        half /= 2;
    }
    numbers[0]
}

impl<const L: usize> Branches<7, L> {
    /// The branches at an angle of a swivel that reach the target, the others after a correction; of
    /// singular ones those that are next to `seed`.
    #[inline]
    pub fn at_swivel(
        &self,
        arm: &AtSwivel<
            impl Fn(&[Real; 7]) -> [Pose; 7],
            impl Fn(&[Real; 7]) -> (Pose, Jacobian<7>),
        >,
        target: &Pose,
        seed: &[Real; 7],
        accept: &Acceptance,
    ) -> Solutions<7> {
        match self.nearly(accept) | self.are_singular(accept) {
            true => arm.corrected(target, self.existing(), seed, accept),
            false => self.solutions(accept),
        }
    }
}
