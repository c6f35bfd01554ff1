//! Inverse kinematics of many targets.
//!
//! A block of targets at a time, one in each lane; the branches are a loop. What
//! the lanes do not settle, a free joint without a root behind it or a branch that
//! rounding may keep from its target, is left to a call for that target alone: of
//! random targets next to none.

use super::super::super::generated::arithmetic::Fused;
use super::super::super::generated::dispatch::{Dispatched, dispatch};
use super::super::super::generated::free_joint::FREE_BELOW;
use super::super::super::generated::inverse::Inverse;
use super::super::super::generated::sin_cos::Known;
use super::super::super::{Pose, Solutions};
use super::LANES;
use core::marker::PhantomData;

/// Fills `solutions` with those of each target. `alone` solves for one of them.
///
/// # Panics
/// If there are not as many places for solutions as targets.
#[inline]
pub fn inverse<R, const N: usize, const L: usize, const M: usize, const F: usize>(
    targets: &[Pose],
    solutions: &mut [Solutions<N>],
    alone: impl Fn(&Pose) -> Solutions<N>,
) where
    R: Inverse<N, L, 0, M, F>,
{
    assert_eq!(
        targets.len(),
        solutions.len(),
        "a place for the solutions of each target"
    );
    dispatch::<Blocks<R, L, M, F>, _>((targets, solutions, alone));
}

struct Blocks<R, const L: usize, const M: usize, const F: usize>(PhantomData<R>);

type Batch<'a, const N: usize, A> = (&'a [Pose], &'a mut [Solutions<N>], A);

impl<R, A, const N: usize, const L: usize, const M: usize, const F: usize>
    Dispatched<Batch<'_, N, A>> for Blocks<R, L, M, F>
where
    R: Inverse<N, L, 0, M, F>,
    A: Fn(&Pose) -> Solutions<N>,
{
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>((targets, solutions, alone): Batch<'_, N, A>) {
        let (blocks, rest) = targets.as_chunks::<LANES>();
        let (filled, last) = solutions.as_chunks_mut::<LANES>();
        let seed = [0.0; N];
        let sin_cos = Known::new(R::angles(&seed, &[]));
        for (targets, solutions) in blocks.iter().zip(filled) {
            let lanes = R::lanes::<Fused<FUSED>, LANES>(targets, &seed, &[], sin_cos, FREE_BELOW);
            let unsettled = lanes.unsettled(R::COMPLETION, &R::ACCEPT);
            for t in 0..LANES {
                if unsettled[t] > 0.0 {
                    solutions[t] = alone(&targets[t]);
                } else {
                    lanes.write(t, &R::ACCEPT, &mut solutions[t]);
                }
            }
        }
        Self::run_narrow::<FUSED>((rest, last, alone));
    }

    #[inline(always)]
    fn run_narrow<const FUSED: bool>((targets, solutions, alone): Batch<'_, N, A>) {
        for (target, solutions) in targets.iter().zip(solutions) {
            *solutions = alone(target);
        }
    }
}
