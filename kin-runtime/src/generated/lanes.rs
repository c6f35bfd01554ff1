//! Targets as array lanes, and elementary functions for loops over them.

use super::super::scalar::Real;
use super::super::{Pose, math};

pub use super::super::scalar::{angle, angle_of_unit};

/// The entries of T poses, row by row and the translation behind them: an array for
/// each, with a place for each pose.
#[inline(always)]
pub fn entries<const T: usize>(poses: &[Pose; T]) -> [[Real; T]; 12] {
    let mut entries = [[0.0; T]; 12];
    for t in 0..T {
        for i in 0..3 {
            for j in 0..3 {
                entries[3 * i + j][t] = poses[t].rotation[i][j];
            }
            entries[9 + i][t] = poses[t].translation[i];
        }
    }
    entries
}

/// How many numbers a vector of AVX2 has.
const VECTOR: usize = 32 / size_of::<Real>();

/// The sines and cosines of all angles, radians; see [`math::sin_cos`].
///
/// Loops over them become packed instructions where single calls do not; of no more than AVX2's
/// width, since straight-line code takes the lanes apart again, which costs more of wider vectors.
///
/// ```
/// use kin_runtime::__private::{lanes, math};
/// let ([s1, s2, s3], [c1, ..]) = lanes::sin_cos([0.1, 0.2, 0.3]);
/// assert_eq!((s1, c1), math::sin_cos(0.1));
/// assert_eq!((s2, s3), (math::sin_cos(0.2).0, math::sin_cos(0.3).0));
/// ```
#[inline(always)]
pub fn sin_cos<const N: usize>(angles: [Real; N]) -> ([Real; N], [Real; N]) {
    sin_cos_by::<false, N>(angles)
}

/// The same, with fused operations if they are asked for; see [`math::mul_add`].
#[inline(always)]
pub fn sin_cos_by<const FUSED: bool, const N: usize>(angles: [Real; N]) -> ([Real; N], [Real; N]) {
    match N {
        // No vectors: Rust uses none of 32-bit Arm, whose subnormal numbers are zeros.
        _ if cfg!(target_arch = "arm") => side_by_side::<FUSED, N>(angles),
        3 => filled_up::<FUSED, N, 4, 4>(angles),
        5..=8 => filled_up::<FUSED, N, 8, VECTOR>(angles),
        9..=16 => filled_up::<FUSED, N, 16, VECTOR>(angles),
        _ => side_by_side::<FUSED, N>(angles),
    }
}

/// With zeros behind them, so that they are `L`: whole vectors of `V`.
#[inline(always)]
fn filled_up<const FUSED: bool, const N: usize, const L: usize, const V: usize>(
    angles: [Real; N],
) -> ([Real; N], [Real; N]) {
    let mut all = [0.0; L];
    all[..N].copy_from_slice(&angles);
    let (mut sines, mut cosines) = ([0.0; L], [0.0; L]);
    for vector in 0..L / V {
        let part = vector * V..(vector + 1) * V;
        let angles: [Real; V] = core::array::from_fn(|k| all[part.start + k]);
        let (s, c) = side_by_side::<FUSED, V>(angles);
        sines[part.clone()].copy_from_slice(&s);
        cosines[part].copy_from_slice(&c);
    }
    let first = |all: [Real; L]| core::array::from_fn(|i| all[i]);
    (first(sines), first(cosines))
}

/// In one loop, however wide.
#[inline(always)]
pub(super) fn side_by_side<const FUSED: bool, const N: usize>(
    angles: [Real; N],
) -> ([Real; N], [Real; N]) {
    let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
    for k in 0..N {
        (sines[k], cosines[k]) = math::sin_cos_by::<FUSED>(angles[k]);
    }
    (sines, cosines)
}
