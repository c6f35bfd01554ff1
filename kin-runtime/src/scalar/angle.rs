//! The angle of a vector, for loops over lanes.

use super::math;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

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
    angle_by::<false>(y, x)
}

/// The same, with fused operations if they are asked for; see [`math::mul_add`].
#[inline(always)]
pub fn angle_by<const FUSED: bool>(y: f64, x: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let large = if ay > ax { ay } else { ax };
    let small = if ay > ax { ax } else { ay };
    let diagonal = mask(small > TAN_EIGHTH * large);
    let steep = mask(ay > ax);
    let left = mask(x < 0.0);

    let along = large + gate(diagonal, small);
    let across = small - gate(diagonal, large);
    let t = across / math::select(along < SMALLEST, SMALLEST, along);
    let off_axis = flip(atan_eighth::<FUSED>(t), steep ^ left);

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
fn atan_eighth<const FUSED: bool>(t: f64) -> f64 {
    let z = t * t;
    let z2 = z * z;
    let z4 = z2 * z2;
    let line = |a: f64, b: f64| math::mul_add::<FUSED>(z, b, a);
    let low = math::mul_add::<FUSED>(
        z2,
        line(-0.142_857_141_951_311_47, 0.111_111_066_480_681_27),
        line(-0.333_333_333_333_301_45, 0.199_999_999_990_874_53),
    );
    let middle = math::mul_add::<FUSED>(
        z2,
        line(-0.066_411_044_113_241_27, 0.056_924_499_825_848_21),
        line(-0.090_907_822_804_788_97, 0.076_900_664_010_314_3),
    );
    let high = line(-0.043_588_352_182_852_14, 0.021_256_629_784_503_4);
    let all = math::mul_add::<FUSED>(z4, math::mul_add::<FUSED>(z4, high, middle), low);
    math::mul_add::<FUSED>(t, z * all, t)
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
