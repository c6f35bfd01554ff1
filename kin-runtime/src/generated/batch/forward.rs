//! Forward kinematics of many configurations.
//!
//! Blocks of as many configurations as there are lanes are turned into columns,
//! an array for each joint; the generated straight-line code runs over the lanes
//! of these, once to tell its angles and once to use their sines and cosines;
//! and what comes of it is turned back into rows. The loops over lanes become
//! packed instructions, and the results are those of single calls to the last
//! bit.

use super::super::super::generated::arithmetic::Fused;
use super::super::super::generated::dispatch::{Dispatched, dispatch};
use super::super::super::generated::forward::Forward;
use super::super::super::generated::lanes;
use super::super::super::generated::sin_cos::{SideBySide, SinCos};
use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose};
use super::LANES;
use crate::generated::arrays::Aligned;
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

/// An array for each of some numbers, with a lane for each configuration.
type Columns<const K: usize> = [Lanes; K];

/// A number of each lane.
type Lanes = Aligned<[Real; LANES]>;

const ZERO: Lanes = Aligned([0.0; LANES]);

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
        let (blocks, rest) = q.as_chunks();
        let (filled, last) = results.as_chunks_mut();
        let mut next = blocks.first().map_or([ZERO; N], columns);
        for (i, results) in filled.iter_mut().enumerate() {
            let block = next;
            // One block ahead: wide loads wait for narrow stores just before them.
            next = blocks.get(i + 1).map_or(next, columns);
            compute::<R, Output, N, M, FUSED>(&block, results);
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

#[inline(always)]
fn columns<const N: usize>(q: &[[Real; N]; LANES]) -> Columns<N> {
    let mut columns = [ZERO; N];
    for k in 0..LANES {
        for i in 0..N {
            columns[i].0[k] = q[k][i];
        }
    }
    columns
}

#[inline(always)]
fn compute<R, Output, const N: usize, const M: usize, const FUSED: bool>(
    q: &Columns<N>,
    results: &mut [Output; LANES],
) where
    R: Forward<Output, N, M>,
    Output: Entries,
{
    let q = |k: usize| core::array::from_fn(|i| q[i].0[k]);
    let mut angles = [ZERO; M];
    for k in 0..LANES {
        R::at::<Fused<FUSED>>(&q(k), Told(&mut angles, k));
    }
    let (mut sines, mut cosines) = ([ZERO; M], [ZERO; M]);
    for i in 0..M {
        (sines[i].0, cosines[i].0) = lanes::side_by_side::<FUSED, LANES>(angles[i].0);
    }
    let mut entries = Output::NONE;
    for k in 0..LANES {
        R::at::<Fused<FUSED>>(&q(k), Found(&sines, &cosines, k)).put(&mut entries, k);
    }
    Output::write(&entries, results);
}

/// Writes down which angles a lane asks for.
struct Told<'a, const M: usize>(&'a mut Columns<M>, usize);

impl<const M: usize> SinCos<M> for Told<'_, M> {
    #[inline(always)]
    fn of(self, angles: [Real; M]) -> ([Real; M], [Real; M]) {
        for i in 0..M {
            self.0[i].0[self.1] = angles[i];
        }
        ([0.0; M], [0.0; M])
    }
}

/// Has the sines and cosines of a lane.
struct Found<'a, const M: usize>(&'a Columns<M>, &'a Columns<M>, usize);

impl<const M: usize> SinCos<M> for Found<'_, M> {
    #[inline(always)]
    fn of(self, _: [Real; M]) -> ([Real; M], [Real; M]) {
        let lane = |columns: &Columns<M>| core::array::from_fn(|i| columns[i].0[self.2]);
        (lane(self.0), lane(self.1))
    }
}

/// What lanes are gathered in entry by entry, each in its own vector, before they
/// become results: a loop over results as they are would scatter.
pub trait Entries: Sized {
    /// An array for each entry.
    type Columns;
    /// Zeros.
    const NONE: Self::Columns;
    /// Puts the entries of lane `k` down.
    fn put(self, columns: &mut Self::Columns, k: usize);
    /// Makes results of all lanes.
    fn write(columns: &Self::Columns, results: &mut [Self; LANES]);
}

/// Writes one entry of all results.
#[inline(always)]
fn write<T>(lanes: &Lanes, results: &mut [T; LANES], entry: impl Fn(&mut T) -> &mut Real) {
    for k in 0..LANES {
        *entry(&mut results[k]) = lanes.0[k];
    }
}

type PoseColumns = [Columns<3>; 4];

#[inline(always)]
fn write_poses<T>(
    columns: &PoseColumns,
    results: &mut [T; LANES],
    pose: impl Fn(&mut T) -> &mut Pose,
) {
    for i in 0..3 {
        for j in 0..3 {
            write(&columns[i][j], results, |it| &mut pose(it).rotation[i][j]);
        }
    }
    for i in 0..3 {
        write(&columns[3][i], results, |it| &mut pose(it).translation[i]);
    }
}

impl Entries for Pose {
    type Columns = PoseColumns;
    const NONE: Self::Columns = [[ZERO; 3]; 4];

    #[inline(always)]
    fn put(self, columns: &mut Self::Columns, k: usize) {
        for i in 0..3 {
            for j in 0..3 {
                columns[i][j].0[k] = self.rotation[i][j];
            }
            columns[3][i].0[k] = self.translation[i];
        }
    }

    #[inline(always)]
    fn write(columns: &Self::Columns, results: &mut [Self; LANES]) {
        write_poses(columns, results, |pose| pose);
    }
}

impl<const N: usize> Entries for (Pose, Jacobian<N>) {
    type Columns = (PoseColumns, [Columns<N>; 6]);
    const NONE: Self::Columns = (Pose::NONE, [[ZERO; N]; 6]);

    #[inline(always)]
    fn put(self, (poses, rows): &mut Self::Columns, k: usize) {
        self.0.put(poses, k);
        for i in 0..6 {
            for j in 0..N {
                rows[i][j].0[k] = self.1.rows[i][j];
            }
        }
    }

    #[inline(always)]
    fn write((poses, rows): &Self::Columns, results: &mut [Self; LANES]) {
        write_poses(poses, results, |it| &mut it.0);
        for i in 0..6 {
            for j in 0..N {
                write(&rows[i][j], results, |it| &mut it.1.rows[i][j]);
            }
        }
    }
}
