//! Branch-free elementary functions.
//!
//! Generated kinematics spends most of its time in sines and arctangents, and
//! computes all branches of an inverse side by side as array lanes. The
//! functions here are written so that a plain loop over such lanes compiles to
//! packed instructions on every target: no table, no call, no data-dependent
//! jump, and a fused multiply-add only where it is asked for (without hardware
//! support that is a call).
//! `tests/math.rs` measures every error stated below against references of
//! higher precision.
//!
//! ```
//! use kin_runtime::__private::math;
//! let angles = [0.1, 0.2, 0.3, 0.4];
//! let mut sines = [0.0; 4];
//! for lane in 0..4 {
//!     sines[lane] = math::sin_cos(angles[lane]).0;
//! }
//! assert!((sines[2] - 0.3_f64.sin()).abs() < 2e-16);
//! ```

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// π/2 = `HALF_PI_HEAD` + `HALF_PI_TAIL` to 86 bits. The head has 33 bits, so
/// its product with an integer below 2²⁰ is exact (the reduction of Cody and
/// Waite; the same split as in Sun's fdlibm).
const HALF_PI_HEAD: f64 = 1.570_796_326_734_125_6;
const HALF_PI_TAIL: f64 = 6.077_100_506_506_192e-11;

/// 1.5 · 2⁵²: adding it rounds to an integer, which is then left in the lowest
/// bits of the sum. Unlike `round`, this is one instruction everywhere.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Sine and cosine of `x` radians.
///
/// For |x| ≤ 1.6e6 both are within 1.5e-16 of the truth; for |x| ≤ π/4 the sine
/// also has a relative error below 1.2e-16. Beyond that range the error grows
/// like 1.5e-16 |x|, up to |x| ≈ 3e15 where no bit of the angle is left; still
/// larger arguments give finite values in [−1, 1] and no meaning. Infinities
/// and NaN give NaN.
///
/// Method: reduction to |r| ≤ π/4 by a two-part π/2, then minimax polynomials
/// (Remez, relative error 4e-18 for the sine, absolute 5e-20 for the cosine).
///
/// ```
/// let (s, c) = kin_runtime::__private::math::sin_cos(0.5);
/// assert!((s * s + c * c - 1.0).abs() < 4e-16);
/// ```
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    sin_cos_by::<false>(x)
}

/// The same, with fused operations if they are asked for; see [`mul_add`].
#[inline(always)]
pub fn sin_cos_by<const FUSED: bool>(x: f64) -> (f64, f64) {
    let rounded = mul_add::<FUSED>(x, FRAC_2_PI, ROUNDER);
    let quadrant = rounded.to_bits();
    let turns = rounded - ROUNDER;
    let r = mul_add::<FUSED>(-turns, HALF_PI_HEAD, x);
    let r = mul_add::<FUSED>(-turns, HALF_PI_TAIL, r);
    // Only meaningless arguments reach the clamp; it keeps them finite.
    let r = clamp(r, 0.785_41);
    let (sine, cosine) = sin_cos_eighth::<FUSED>(r);

    let swap = 0_u64.wrapping_sub(quadrant & 1);
    let flipped = (sine.to_bits() ^ cosine.to_bits()) & swap;
    let negate_sine = (quadrant & 2) << 62;
    let negate_cosine = (quadrant.wrapping_add(1) & 2) << 62;
    (
        f64::from_bits(sine.to_bits() ^ flipped ^ negate_sine),
        f64::from_bits(cosine.to_bits() ^ flipped ^ negate_cosine),
    )
}

/// Sine and cosine on [−π/4, π/4].
#[inline(always)]
fn sin_cos_eighth<const FUSED: bool>(r: f64) -> (f64, f64) {
    let z = r * r;
    let zz = z * z;
    let line = |a: f64, b: f64| mul_add::<FUSED>(z, b, a);
    let s = mul_add::<FUSED>(
        zz,
        mul_add::<FUSED>(
            zz,
            line(-2.505_074_770_837_915_5e-8, 1.589_622_690_454_601e-10),
            line(-0.000_198_412_698_295_886, 2.755_731_362_104_882_4e-6),
        ),
        line(-0.166_666_666_666_666_3, 0.008_333_333_333_322_118),
    );
    let c = mul_add::<FUSED>(
        zz,
        mul_add::<FUSED>(
            zz,
            line(2.087_572_364_357_017_8e-9, -1.135_966_767_435_332_4e-11),
            line(2.480_158_728_949_087e-5, -2.755_731_435_495_288_7e-7),
        ),
        line(0.041_666_666_666_666_6, -0.001_388_888_888_887_413_8),
    );
    (
        mul_add::<FUSED>(r, z * s, r),
        1.0 - mul_add::<FUSED>(-zz, c, 0.5 * z),
    )
}

/// a b + c, rounded once if `FUSED`, else after each operation. That is one
/// instruction where a function is compiled for one, and a slow call elsewhere, so it is asked for
/// by who knows the instructions; without the feature `std` it is not to be had.
///
/// ```
/// use kin_runtime::__private::math::mul_add;
/// let (a, b) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
/// assert_eq!(mul_add::<false>(a, b, -1.0), 0.0);
/// # #[cfg(feature = "std")]
/// assert_eq!(mul_add::<true>(a, b, -1.0), -f64::EPSILON * f64::EPSILON);
/// ```
#[inline(always)]
pub fn mul_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    #[cfg(feature = "std")]
    if FUSED {
        return a.mul_add(b, c);
    }
    a * b + c
}

/// The angle of the vector (x, y) in [−π, π] radians, as `f64::atan2(y, x)`.
///
/// Within 3.3e-16 relative where the larger magnitude is in 1e-290..8e307, and
/// coarser but sound below; multiples of π/4 are exact. The sign is that of `y`;
/// `atan2(±0, x)` is ±0 for x ≥ 0 (also for x = −0, where the standard library
/// says ±π) and ±π for x < 0. In particular `atan2(0, 0)` is 0. Infinities and
/// NaN give NaN.
///
/// Method: with c ∈ {0, ½, 1} nearest to the smaller over the larger
/// magnitude, t = (y − c x)/(x + c y) is at most ¼; a minimax polynomial
/// (Remez, relative error 5e-18) gives atan t, and the constants are added
/// from the small to the large.
///
/// ```
/// use kin_runtime::__private::math::atan2;
/// assert_eq!(atan2(0.0, -1.0), core::f64::consts::PI);
/// assert_eq!(atan2(0.0, 0.0), 0.0);
/// ```
#[inline(always)]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let large = if ay > ax { ay } else { ax };
    let small = if ay > ax { ax } else { ay };

    let past_quarter = below(0.25 * large, small);
    let past_three_quarters = below(0.75 * large, small);
    let center = gate(past_quarter, 0.5) + gate(past_three_quarters, 0.5);
    let head = gate(past_quarter, ATAN_HALF) + gate(past_three_quarters, FRAC_PI_4 - ATAN_HALF);
    let tail = gate(past_quarter, ATAN_HALF_TAIL) + gate(past_three_quarters, STEP_TAIL);
    // The smallest positive number turns 0/0 into 0 and changes nothing else.
    let t = (small - center * large) / at_least(large + center * small, f64::from_bits(1));
    let octant = tail + atan_quarter(t);

    // angle = axis ± (head + octant), with the sign and the axis of the sector.
    let steep = below(ax, ay);
    // Adding 0 turns −0, which is no left half-plane, into +0.
    let left = below(x + 0.0, 0.0);
    let axis = gate(steep, FRAC_PI_2) + gate(left & !steep, PI);
    let backward = (steep ^ left) & SIGN;
    let tail_of_axis = f64::from_bits((axis * TAIL_OF_PI).to_bits() ^ backward);
    let offset = head + (octant + tail_of_axis);
    let angle = axis + f64::from_bits(offset.to_bits() ^ backward);
    f64::from_bits(angle.to_bits() ^ (y.to_bits() & SIGN))
}

/// atan ½ as a sum of two doubles.
const ATAN_HALF: f64 = 0.463_647_609_000_806_1;
const ATAN_HALF_TAIL: f64 = 2.269_877_745_296_168_7e-17;
/// What turns the tail of atan ½ into that of π/4.
const STEP_TAIL: f64 = 3.061_616_997_868_383e-17 - ATAN_HALF_TAIL;

/// (π − its nearest double) / π, which is also that of π/2.
const TAIL_OF_PI: f64 = 3.898_171_832_295_186e-17;

const SIGN: u64 = 1 << 63;

/// atan t for |t| ≤ ¼.
#[inline(always)]
fn atan_quarter(t: f64) -> f64 {
    let z = t * t;
    let zz = z * z;
    let low = (-0.333_333_333_333_325_43 + z * 0.199_999_999_995_889_05)
        + zz * (-0.142_857_142_123_261_23 + z * 0.111_111_047_661_682_27);
    let high = (-0.090_906_048_304_036_15 + z * 0.076_837_649_984_332_39)
        + zz * (-0.065_261_714_654_967_4 + z * 0.046_093_150_867_149_844);
    t + t * (z * (low + zz * zz * high))
}

/// The angle `x`, radians, moved by a multiple of 2π into (−π, π].
///
/// Values already there come back unchanged, and −π becomes π. The error is
/// below 5e-16 for |x| ≤ 6e6 and grows like 1.2e-16 |x| beyond, but the result
/// is always in the interval. Infinities and NaN give NaN.
///
/// ```
/// use core::f64::consts::PI;
/// use kin_runtime::__private::math::wrap;
/// assert_eq!(wrap(-PI), PI);
/// assert_eq!(wrap(0.25), 0.25);
/// assert!((wrap(3.5 * PI) + 0.5 * PI).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn wrap(x: f64) -> f64 {
    let turns = round(x * (0.25 * FRAC_2_PI));
    let r = (x - turns * (4.0 * HALF_PI_HEAD)) - turns * (4.0 * HALF_PI_TAIL);
    // Rounding may leave r an ulp outside; −π itself belongs on the other end.
    let r = select(r > PI, PI, r);
    select(r <= -PI, PI, r)
}

/// The integer nearest to `x`, of two the even one, for |x| < 2⁵¹; larger
/// values to within 2 units. Infinities and NaN stay. Unlike `f64::round` no
/// call anywhere.
///
/// ```
/// use kin_runtime::__private::math::round;
/// assert_eq!([2.4, 2.5, -0.6].map(round), [2.0, 2.0, -1.0]);
/// ```
#[inline(always)]
pub fn round(x: f64) -> f64 {
    (x + ROUNDER) - ROUNDER
}

/// The least integer that is not below `x`; as [`round`].
///
/// ```
/// use kin_runtime::__private::math::ceil;
/// assert_eq!([2.1, 2.0, -0.6].map(ceil), [3.0, 2.0, 0.0]);
/// ```
#[inline(always)]
pub fn ceil(x: f64) -> f64 {
    let near = round(x);
    near + select(near < x, 1.0, 0.0)
}

/// √x, NaN for negative `x`. Correctly rounded; with the feature `std` it is
/// one instruction and vectorizes, without it comes from `libm`.
///
/// ```
/// assert_eq!(kin_runtime::__private::math::sqrt(6.25), 2.5);
/// ```
#[inline(always)]
pub fn sqrt(x: f64) -> f64 {
    #[cfg(feature = "std")]
    {
        x.sqrt()
    }
    #[cfg(not(feature = "std"))]
    {
        libm::sqrt(x)
    }
}

/// `a` where `mask` holds, `b` elsewhere. Both are evaluated; in a loop over
/// lanes this is a packed blend.
///
/// ```
/// assert_eq!(kin_runtime::__private::math::select(2.0 > 1.0, 10.0, 20.0), 10.0);
/// ```
#[inline(always)]
pub const fn select(mask: bool, a: f64, b: f64) -> f64 {
    if mask { a } else { b }
}

/// All bits set where `a` < `b`, else none. The mask is drawn from the sign of
/// a difference because scalar code jumps on the result of a comparison.
#[inline(always)]
fn below(a: f64, b: f64) -> u64 {
    ((a - b).to_bits().cast_signed() >> 63).cast_unsigned()
}

/// `value` where the bits of `mask` are set, 0 where they are not.
#[inline(always)]
fn gate(mask: u64, value: f64) -> f64 {
    f64::from_bits(value.to_bits() & mask)
}

/// The larger of two numbers that are not NaN.
#[inline(always)]
fn at_least(x: f64, bound: f64) -> f64 {
    select(x > bound, x, bound)
}

/// `x` limited to [−bound, bound]; NaN stays NaN.
#[inline(always)]
fn clamp(x: f64, bound: f64) -> f64 {
    let x = select(x > bound, bound, x);
    select(x < -bound, -bound, x)
}

/// The larger of two numbers, the second where either is NaN: one instruction,
/// where `f64::max` takes three to look for NaN.
///
/// ```
/// use kin_runtime::__private::math::max;
/// assert_eq!(max(1.0, 2.0), 2.0);
/// assert!(max(1.0, f64::NAN).is_nan());
/// ```
#[inline(always)]
pub fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers, the second where either is NaN.
#[inline(always)]
pub fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
