//! From lanes to results.
//!
//! A loop over lanes that writes to results as they are would scatter, number by number.
//! Where four numbers that stand side by side in each result are written to an array of
//! their own, that becomes packed shuffles, and what is copied from there is a vector of
//! AVX2.

use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose};
use super::LANES;
use crate::generated::arrays::Aligned;

/// An array for each of some numbers, with a lane for each configuration.
pub(super) type Columns<const K: usize> = [Lanes; K];

/// A number of each lane.
pub(super) type Lanes = Aligned<[Real; LANES]>;

pub(super) const ZERO: Lanes = Aligned([0.0; LANES]);

/// What lanes compute, number by number.
pub trait Entries: Sized {
    /// With so many angles or fewer, what uses their sines is so little that a loop of nothing
    /// else would be unrolled, and then not become packed instructions.
    const FEW: usize;
    /// Arrays for all entries.
    type Gathered;
    /// Zeros.
    const NONE: Self::Gathered;
    /// Puts the entries of lane `k` down.
    fn put(self, gathered: &mut Self::Gathered, k: usize);
    /// Makes results of all lanes.
    fn write(gathered: &mut Self::Gathered, results: &mut [Self; LANES]);
}

/// Four entries of each lane, side by side as in its result.
type Fours = Aligned<[[Real; 4]; LANES]>;

const NO_FOURS: Fours = Aligned([[0.0; 4]; LANES]);

/// Writes entries of lane `k` that stand side by side, the first of which is the first of four.
#[inline(always)]
fn write(fours: &[Fours], k: usize, entries: &mut [Real]) {
    for (four, entries) in fours.iter().zip(entries.chunks_mut(4)) {
        entries.copy_from_slice(&four[k][..entries.len()]);
    }
}

#[inline(always)]
fn write_pose(fours: &[Fours; 3], k: usize, pose: &mut Pose) {
    write(fours, k, pose.rotation.as_flattened_mut());
    pose.translation.copy_from_slice(&fours[2][k][1..]);
}

impl Entries for Pose {
    const FEW: usize = 4;
    type Gathered = [Fours; 3];
    const NONE: Self::Gathered = [NO_FOURS; 3];

    #[inline(always)]
    fn put(self, fours: &mut Self::Gathered, k: usize) {
        let [a, b, c] = fours.each_mut().map(|four| &mut four[k]);
        let ([x, y, z], p) = (self.rotation, self.translation);
        // Not row by row: zeros side by side would become a call that fills memory.
        (a[0], b[0], c[0]) = (x[0], y[1], z[2]);
        (a[1], b[1], c[1]) = (x[1], y[2], p[0]);
        (a[2], b[2], c[2]) = (x[2], z[0], p[1]);
        (a[3], b[3], c[3]) = (y[0], z[1], p[2]);
    }

    #[inline(always)]
    fn write(fours: &mut Self::Gathered, results: &mut [Self; LANES]) {
        for k in 0..LANES {
            write_pose(fours, k, &mut results[k]);
        }
    }
}

impl<const N: usize> Entries for (Pose, Jacobian<N>) {
    const FEW: usize = 0;
    /// Of the Jacobian there are 6 N / 4 fours, which is no number of places that Rust can tell.
    type Gathered = ([Fours; 3], [Columns<N>; 6], [[Fours; N]; 2]);
    const NONE: Self::Gathered = (Pose::NONE, [[ZERO; N]; 6], [[NO_FOURS; N]; 2]);

    #[inline(always)]
    fn put(self, (pose, rows, _): &mut Self::Gathered, k: usize) {
        self.0.put(pose, k);
        for i in 0..6 {
            for j in 0..N {
                rows[i][j][k] = self.1.rows[i][j];
            }
        }
    }

    #[inline(always)]
    fn write((pose, rows, fours): &mut Self::Gathered, results: &mut [Self; LANES]) {
        // Not in `put`: entries that are zeros for every configuration would fill memory there.
        for k in 0..LANES {
            for i in 0..6 {
                for j in 0..N {
                    let e = i * N + j;
                    fours[e / 4 / N][e / 4 % N][k][e % 4] = rows[i][j][k];
                }
            }
        }
        for k in 0..LANES {
            let (result, jacobian) = &mut results[k];
            write_pose(pose, k, result);
            write(fours.as_flattened(), k, jacobian.rows.as_flattened_mut());
        }
    }
}
