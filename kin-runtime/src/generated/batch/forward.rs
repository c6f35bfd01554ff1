//! Forward kinematics of many configurations.
//!
//! The generated straight-line code runs over blocks of as many configurations as
//! there are lanes: once for the sines and cosines of its angles, and once to use
//! them. What comes of it is brought by fours to where it stands in the results.
//! The loops over lanes become packed instructions, and the results are those of
//! single calls to the last bit.

use super::super::super::generated::arithmetic::Fused;
use super::super::super::generated::dispatch::{Dispatched, dispatch};
use super::super::super::generated::forward::Forward;
use super::super::super::generated::lanes;
use super::super::super::generated::sin_cos::{SideBySide, SinCos};
use super::super::super::math;
use super::super::super::scalar::Real;
use super::LANES;
use super::entries::{Columns, Entries, ZERO};
use core::marker::PhantomData;

/// Fills `results` with what a robot computes of each configuration.
///
/// # Panics
/// If there are not as many results as configurations.
#[inline]
pub fn forward<R, Output, const N: usize, const M: usize>(q: &[[Real; N]], results: &mut [Output])
where
    R: Forward<Output, N, M>,
    Output: Entries,
{
    assert_eq!(q.len(), results.len(), "a result for each configuration");
    dispatch::<Blocks<R, M>, _>((q, results));
}

struct Blocks<R, const M: usize>(PhantomData<R>);

impl<R, Output, const N: usize, const M: usize> Dispatched<(&[[Real; N]], &mut [Output])>
    for Blocks<R, M>
where
    R: Forward<Output, N, M>,
    Output: Entries,
{
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>((q, results): (&[[Real; N]], &mut [Output])) {
        let (blocks, rest) = q.as_chunks::<LANES>();
        let (filled, last) = results.as_chunks_mut::<LANES>();
        match M <= Output::FEW {
            true => in_one_loop::<R, Output, N, M, FUSED>(blocks, filled),
            false => one_block_ahead::<R, Output, N, M, FUSED>(blocks, filled),
        }
        Self::run_narrow::<FUSED>((rest, last));
    }

    #[inline(always)]
    fn run_narrow<const FUSED: bool>((q, results): (&[[Real; N]], &mut [Output])) {
        for (q, result) in q.iter().zip(results) {
            *result = R::at::<Fused<FUSED>>(q, SideBySide::<FUSED>);
        }
    }
}

/// With one loop for the sines and what uses them; see [`Entries::FEW`].
#[inline(always)]
fn in_one_loop<R, Output, const N: usize, const M: usize, const FUSED: bool>(
    blocks: &[[[Real; N]; LANES]],
    results: &mut [[Output; LANES]],
) where
    R: Forward<Output, N, M>,
    Output: Entries,
{
    let mut gathered = Output::NONE;
    for (block, results) in blocks.iter().zip(results) {
        for k in 0..LANES {
            R::at::<Fused<FUSED>>(&block[k], OneByOne::<FUSED>).put(&mut gathered, k);
        }
        Output::write(&mut gathered, results);
    }
}

/// With a loop for the sines and one that uses them, which begins with what is there and does not
/// wait for the last of them.
#[inline(always)]
fn one_block_ahead<R, Output, const N: usize, const M: usize, const FUSED: bool>(
    blocks: &[[[Real; N]; LANES]],
    results: &mut [[Output; LANES]],
) where
    R: Forward<Output, N, M>,
    Output: Entries,
{
    // All blocks write to the same places: new ones would be filled with zeros first.
    let (mut turns, mut gathered) = ([Turns::NONE; 2], Output::NONE);
    if let Some(block) = blocks.first() {
        turns[0].find::<R, Output, N, FUSED>(block);
    }
    for (i, (block, results)) in blocks.iter().zip(results).enumerate() {
        if let Some(next) = blocks.get(i + 1) {
            turns[(i + 1) % 2].find::<R, Output, N, FUSED>(next);
        }
        for k in 0..LANES {
            R::at::<Fused<FUSED>>(&block[k], Found(&turns[i % 2], k)).put(&mut gathered, k);
        }
        Output::write(&mut gathered, results);
    }
}

/// The sines and cosines of a lane.
struct OneByOne<const FUSED: bool>;

impl<const M: usize, const FUSED: bool> SinCos<M> for OneByOne<FUSED> {
    #[inline(always)]
    fn of(self, angles: [Real; M]) -> ([Real; M], [Real; M]) {
        lanes::side_by_side::<FUSED, M>(angles)
    }
}

/// A loop over so many angles is unrolled, and the one over lanes around it becomes packed
/// instructions, which takes a fifth less than a loop over lanes for each angle.
const UNROLLED: usize = 6;

/// The sines and cosines of the angles of all lanes.
#[derive(Clone, Copy)]
struct Turns<const M: usize> {
    sines: Columns<M>,
    cosines: Columns<M>,
}

impl<const M: usize> Turns<M> {
    const NONE: Self = Self {
        sines: [ZERO; M],
        cosines: [ZERO; M],
    };

    #[inline(always)]
    fn find<R, Output, const N: usize, const FUSED: bool>(&mut self, q: &[[Real; N]; LANES])
    where
        R: Forward<Output, N, M>,
    {
        if M <= UNROLLED {
            for k in 0..LANES {
                R::at::<Fused<FUSED>>(&q[k], Finding::<M, FUSED>(self, k));
            }
            return;
        }
        for k in 0..LANES {
            R::at::<Fused<FUSED>>(&q[k], Collecting(&mut self.sines, k));
        }
        for i in 0..M {
            let angles = self.sines[i].0;
            (self.sines[i].0, self.cosines[i].0) = lanes::side_by_side::<FUSED, LANES>(angles);
        }
    }
}

/// Writes down the sines and cosines that a lane asks for.
struct Finding<'a, const M: usize, const FUSED: bool>(&'a mut Turns<M>, usize);

impl<const M: usize, const FUSED: bool> SinCos<M> for Finding<'_, M, FUSED> {
    #[inline(always)]
    fn of(self, angles: [Real; M]) -> ([Real; M], [Real; M]) {
        let Self(Turns { sines, cosines }, k) = self;
        for i in 0..M {
            (sines[i][k], cosines[i][k]) = math::sin_cos_by::<FUSED>(angles[i]);
        }
        ([0.0; M], [0.0; M])
    }
}

/// Writes down which angles a lane asks for.
struct Collecting<'a, const M: usize>(&'a mut Columns<M>, usize);

impl<const M: usize> SinCos<M> for Collecting<'_, M> {
    #[inline(always)]
    fn of(self, angles: [Real; M]) -> ([Real; M], [Real; M]) {
        for i in 0..M {
            self.0[i][self.1] = angles[i];
        }
        ([0.0; M], [0.0; M])
    }
}

/// Has the sines and cosines of a lane.
struct Found<'a, const M: usize>(&'a Turns<M>, usize);

impl<const M: usize> SinCos<M> for Found<'_, M> {
    #[inline(always)]
    fn of(self, _: [Real; M]) -> ([Real; M], [Real; M]) {
        let lane = |columns: &Columns<M>| core::array::from_fn(|i| columns[i][self.1]);
        (lane(&self.0.sines), lane(&self.0.cosines))
    }
}
