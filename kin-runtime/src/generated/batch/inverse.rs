//! Inverse kinematics of many targets.
//!
//! A block of targets at a time, one in each lane; the branches are a loop. What
//! the lanes do not settle, a free angle without a root behind it or a branch that
//! rounding may keep from its target, is left to a call for that target alone: of
//! random targets next to none.

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::generated::dispatch::{Dispatched, dispatch};
use super::super::super::generated::free_angle::FREE_BELOW;
use super::super::super::generated::inverse::{Inverse, Lanes};
use super::super::super::generated::refinement::NEARLY;
use super::super::super::scalar::Real;
use super::super::super::{Pose, Solution, Solutions, math};
use super::LANES;
use core::marker::PhantomData;

/// Fills `solutions` with those of each target. `alone` solves for one of them.
///
/// # Panics
/// If there are not as many places for solutions as targets.
#[inline]
pub fn inverse<R, const N: usize, const L: usize>(
    accept: &Acceptance,
    targets: &[Pose],
    solutions: &mut [Solutions<N>],
    alone: impl Fn(&Pose) -> Solutions<N>,
) where
    R: Inverse<N, L, 0>,
{
    assert_eq!(
        targets.len(),
        solutions.len(),
        "a place for the solutions of each target"
    );
    dispatch::<Blocks<R, L>, _>((accept, targets, solutions, alone));
}

struct Blocks<R, const L: usize>(PhantomData<R>);

type Batch<'a, const N: usize, F> = (&'a Acceptance, &'a [Pose], &'a mut [Solutions<N>], F);

impl<R, F, const N: usize, const L: usize> Dispatched<Batch<'_, N, F>> for Blocks<R, L>
where
    R: Inverse<N, L, 0>,
    F: Fn(&Pose) -> Solutions<N>,
{
    type Output = ();

    #[inline(always)]
    fn run((accept, targets, solutions, alone): Batch<'_, N, F>) {
        let (blocks, rest) = targets.as_chunks::<LANES>();
        let (filled, last) = solutions.as_chunks_mut::<LANES>();
        for (targets, solutions) in blocks.iter().zip(filled) {
            let lanes = R::lanes(targets, &[0.0; N], &[], FREE_BELOW);
            let unsettled = lanes.unsettled(accept);
            for t in 0..LANES {
                if unsettled[t] > 0.0 {
                    solutions[t] = alone(&targets[t]);
                } else {
                    lanes.write(t, accept, &mut solutions[t]);
                }
            }
        }
        Self::run_narrow((accept, rest, last, alone));
    }

    #[inline(always)]
    fn run_narrow((_, targets, solutions, alone): Batch<'_, N, F>) {
        for (target, solutions) in targets.iter().zip(solutions) {
            *solutions = alone(target);
        }
    }
}

impl<const N: usize, const L: usize> Lanes<N, L, LANES> {
    /// Positive for targets that ask for more.
    #[inline(always)]
    fn unsettled(&self, accept: &Acceptance) -> [Real; LANES] {
        let mut unsettled = [0.0; LANES];
        for k in 0..L {
            for t in 0..LANES {
                let misses = self.residual[k][t] > accept.tolerance;
                let little = self.residual[k][t] <= NEARLY * accept.size;
                let nearly = (self.invalid[k][t] <= 0.0) & misses & little;
                let no_root = self.no_root[k][t];
                unsettled[t] = math::max(unsettled[t], math::select(nearly, 1.0, no_root));
            }
        }
        unsettled
    }

    /// Writes down the branches that reach target `t`.
    #[inline(always)]
    fn write(&self, t: usize, accept: &Acceptance, solutions: &mut Solutions<N>) {
        solutions.clear(accept.prismatic);
        for k in 0..L {
            let reaches = (self.invalid[k][t] <= 0.0) & (self.residual[k][t] <= accept.tolerance);
            let solution = Solution {
                q: core::array::from_fn(|i| self.q[i][k][t]),
                residual: self.residual[k][t],
                branch: k as u32,
                singular: self.singular[k][t] > 0.0,
            };
            solutions.push_if(reaches, solution);
        }
    }
}
