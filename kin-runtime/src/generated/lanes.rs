//! Branches as array lanes, and elementary functions for loops over them.

use crate::{Pose, math};
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use core::ops::Index;

/// The entries of T poses, row by row and the translation behind them: an array for
/// each, with a place for each pose.
#[inline(always)]
pub fn entries<const T: usize>(poses: &[Pose; T]) -> [[f64; T]; 12] {
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

/// The branches of a value repeated until they are `B`: when a plan takes another
/// sign, every branch so far becomes two, and branch k descends from branch k
/// modulo `A`. Of one target they are copied, so that a loop over branches reads
/// neighbours; of several, whose loop is over targets, they stay where they are.
///
/// ```
/// use kin_runtime::__private::widen;
/// let one = [[1.0], [2.0]];
/// assert_eq!(widen::<2, 4, 1, _>(&one).all(), [[1.0], [2.0], [1.0], [2.0]]);
/// let two = [[1.0, 5.0], [2.0, 6.0]];
/// assert_eq!(widen::<2, 4, 2, _>(&two)[3], [2.0, 6.0]);
/// ```
#[inline(always)]
pub fn widen<const A: usize, const B: usize, const T: usize, X>(
    narrow: &X,
) -> Widened<'_, A, B, T, X>
where
    X: Index<usize, Output = [f64; T]>,
{
    let mut wide = [[0.0; T]; B];
    if T == 1 {
        for k in 0..B {
            wide[k] = narrow[k % A];
        }
    }
    Widened { narrow, wide }
}

/// What [`widen`] gives: an array of arrays, to be read.
pub struct Widened<'a, const A: usize, const B: usize, const T: usize, X> {
    narrow: &'a X,
    /// Filled for one target alone.
    wide: [[f64; T]; B],
}

impl<const A: usize, const B: usize, const T: usize, X> Widened<'_, A, B, T, X>
where
    X: Index<usize, Output = [f64; T]>,
{
    /// All branches.
    #[inline(always)]
    pub fn all(&self) -> [[f64; T]; B] {
        core::array::from_fn(|k| self[k])
    }
}

impl<const A: usize, const B: usize, const T: usize, X> Index<usize> for Widened<'_, A, B, T, X>
where
    X: Index<usize, Output = [f64; T]>,
{
    type Output = [f64; T];

    #[inline(always)]
    fn index(&self, k: usize) -> &[f64; T] {
        if T == 1 {
            &self.wide[k]
        } else {
            &self.narrow[k % A]
        }
    }
}

/// The sines and cosines of all angles, radians; see [`math::sin_cos`].
///
/// One loop over them becomes packed instructions where single calls do not.
///
/// ```
/// use kin_runtime::__private::{lanes, math};
/// let ([s1, s2, s3], [c1, ..]) = lanes::sin_cos([0.1, 0.2, 0.3]);
/// assert_eq!((s1, c1), math::sin_cos(0.1));
/// assert_eq!((s2, s3), (math::sin_cos(0.2).0, math::sin_cos(0.3).0));
/// ```
#[inline(always)]
pub fn sin_cos<const N: usize>(angles: [f64; N]) -> ([f64; N], [f64; N]) {
    match N {
        3 => filled_up::<N, 4>(angles),
        5..=7 => filled_up::<N, 8>(angles),
        9..=15 => filled_up::<N, 16>(angles),
        _ => each_sin_cos(angles),
    }
}

/// With zeros behind them, so that they are `L`: whole vectors.
#[inline(always)]
fn filled_up<const N: usize, const L: usize>(angles: [f64; N]) -> ([f64; N], [f64; N]) {
    let mut all = [0.0; L];
    all[..N].copy_from_slice(&angles);
    let (sines, cosines) = each_sin_cos(all);
    let first = |all: [f64; L]| core::array::from_fn(|i| all[i]);
    (first(sines), first(cosines))
}

#[inline(always)]
fn each_sin_cos<const N: usize>(angles: [f64; N]) -> ([f64; N], [f64; N]) {
    let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
    for k in 0..N {
        (sines[k], cosines[k]) = math::sin_cos(angles[k]);
    }
    (sines, cosines)
}

/// The angle of the vector (x, y) in (−π, π] radians, 0 for (0, 0).
///
/// For a loop over lanes, where it takes two thirds of the time of
/// [`math::atan2`]: its comparisons become packed masks there. In scalar code
/// they become jumps. Within 3.5e-16 relative where the larger magnitude is in
/// 1e-290..8e307; multiples of π/4 are exact. NaN gives NaN; infinities give no
/// meaning.
///
/// Method: with a diagonal of the octants as the axis where that is nearer,
/// t = (y − x)/(x + y), else t = y/x, is at most tan π/8; a minimax polynomial
/// (Remez, relative error 4e-17) gives atan t.
///
/// ```
/// use kin_runtime::__private::lanes::angle;
/// let (y, x) = ([1.0, 0.0, -0.0, -1.0], [1.0, -1.0, -1.0, 0.0]);
/// let mut angles = [0.0; 4];
/// for k in 0..4 {
///     angles[k] = angle(y[k], x[k]);
/// }
/// use core::f64::consts::PI;
/// assert_eq!(angles, [PI / 4.0, PI, PI, -PI / 2.0]);
/// ```
#[inline(always)]
pub fn angle(y: f64, x: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let large = if ay > ax { ay } else { ax };
    let small = if ay > ax { ax } else { ay };
    let diagonal = mask(small > TAN_EIGHTH * large);
    let steep = mask(ay > ax);
    let left = mask(x < 0.0);

    let along = large + gate(diagonal, small);
    let across = small - gate(diagonal, large);
    let t = across / math::select(along < SMALLEST, SMALLEST, along);
    let off_axis = flip(atan_eighth(t), steep ^ left);

    let upright = gate(diagonal, FRAC_PI_4) + gate(steep & !diagonal, FRAC_PI_2);
    let axis = (upright - gate(left, PI)).abs();
    let angle = flip(axis + off_axis, y.to_bits());
    math::select(angle <= -PI, PI, angle)
}

/// tan π/8.
const TAN_EIGHTH: f64 = 0.414_213_562_373_095_1;
/// Turns 0/0 into 0 and changes nothing else.
const SMALLEST: f64 = f64::from_bits(1);
const SIGN: u64 = 1 << 63;

/// atan t for |t| ≤ tan π/8.
#[inline(always)]
fn atan_eighth(t: f64) -> f64 {
    let z = t * t;
    let z2 = z * z;
    let z4 = z2 * z2;
    let low = (-0.333_333_333_333_301_45 + z * 0.199_999_999_990_874_53)
        + z2 * (-0.142_857_141_951_311_47 + z * 0.111_111_066_480_681_27);
    let middle = (-0.090_907_822_804_788_97 + z * 0.076_900_664_010_314_3)
        + z2 * (-0.066_411_044_113_241_27 + z * 0.056_924_499_825_848_21);
    let high = -0.043_588_352_182_852_14 + z * 0.021_256_629_784_503_4;
    t + t * (z * (low + z4 * (middle + z4 * high)))
}

#[inline(always)]
fn mask(holds: bool) -> u64 {
    0_u64.wrapping_sub(u64::from(holds))
}

/// `value` where the bits of `mask` are set, 0 where they are not.
#[inline(always)]
fn gate(mask: u64, value: f64) -> f64 {
    f64::from_bits(value.to_bits() & mask)
}

/// `value`, negated where the highest bit of `mask` is set.
#[inline(always)]
fn flip(value: f64, mask: u64) -> f64 {
    f64::from_bits(value.to_bits() ^ (mask & SIGN))
}
