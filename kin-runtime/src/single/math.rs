//! Branch-free elementary functions of `f32`; see those of `f64` for why they are so.
//!
//! No operation is one of `f64`, which processors with a unit of single precision alone
//! emulate. `tests/single.rs` measures the errors that are stated.

use core::f32::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// π/2 as a sum of three to 47 bits. The first two have 11 bits at most, so that their products
/// with integers below 2¹³ are exact.
const HALF_PI: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];

/// 1.5 · 2²³: adding it rounds to an integer, which is then left in the lowest bits of the sum.
const ROUNDER: f32 = 12_582_912.0;

/// Sine and cosine of `x` radians, within 1.0e-7 for |x| ≤ 1.2e4. Beyond, the error grows with
/// the angle; still larger arguments give finite values in [−1, 1] and no meaning. Infinities
/// and NaN give NaN.
///
/// Method: reduction to |r| ≤ π/4 by a three-part π/2, then minimax polynomials (Remez,
/// relative error 4e-9 for the sine, absolute 1e-10 for the cosine).
///
/// ```
/// let (s, c) = kin_runtime::single::__private::math::sin_cos(0.5);
/// assert!((s * s + c * c - 1.0).abs() < 2e-7);
/// ```
#[inline(always)]
pub fn sin_cos(x: f32) -> (f32, f32) {
    let rounded = x * FRAC_2_PI + ROUNDER;
    let quadrant = rounded.to_bits();
    let turns = rounded - ROUNDER;
    let r = ((x - turns * HALF_PI[0]) - turns * HALF_PI[1]) - turns * HALF_PI[2];
    // The quotient is off by its rounding, and r past π/4 by as much. Only meaningless arguments
    // reach the clamp; it keeps them finite.
    let r = clamp(r, 0.787);
    let (sine, cosine) = sin_cos_eighth(r);

    let swap = 0_u32.wrapping_sub(quadrant & 1);
    let flipped = (sine.to_bits() ^ cosine.to_bits()) & swap;
    let negate_sine = (quadrant & 2) << 30;
    let negate_cosine = (quadrant.wrapping_add(1) & 2) << 30;
    (
        f32::from_bits(sine.to_bits() ^ flipped ^ negate_sine),
        f32::from_bits(cosine.to_bits() ^ flipped ^ negate_cosine),
    )
}

/// The same: nothing is fused in this precision, as [`mul_add`] says.
#[inline(always)]
pub fn sin_cos_by<const FUSED: bool>(x: f32) -> (f32, f32) {
    sin_cos(x)
}

/// a b + c, rounded after each operation, `FUSED` or not: what is certified is the arithmetic of
/// `f32`, by rounding that of `f64`, which of a sum of a product rounds twice.
#[inline(always)]
pub fn mul_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    a * b + c
}

/// Sine and cosine on [−π/4, π/4].
#[inline(always)]
fn sin_cos_eighth(r: f32) -> (f32, f32) {
    let z = r * r;
    let s = -0.166_666_55 + z * (0.008_332_176 + z * -1.951_697_7e-4);
    let c = 0.041_666_646 + z * (-0.001_388_736_4 + z * 2.443_809e-5);
    (r + r * (z * s), 1.0 - (0.5 * z - z * z * c))
}

/// The angle of the vector (x, y) in (−π, π] radians, 0 for (0, 0); within 2.5e-7 where the
/// larger magnitude is in 1e-36..1e38, and multiples of π/4 are exact. NaN gives NaN; infinities
/// give no meaning.
///
/// Method: with a diagonal of the octants as the axis where that is nearer,
/// t = (y − x)/(x + y), else t = y/x, is at most tan π/8; a minimax polynomial (Remez, relative
/// error 2e-8) gives atan t.
///
/// ```
/// use core::f32::consts::PI;
/// use kin_runtime::single::__private::lanes::angle;
/// assert_eq!([angle(1.0, 1.0), angle(-0.0, -1.0)], [PI / 4.0, PI]);
/// ```
#[inline(always)]
pub fn angle(y: f32, x: f32) -> f32 {
    let angle = atan2(y, x);
    select(angle <= -PI, PI, angle)
}

/// The same, of a unit vector or any other.
#[inline(always)]
pub fn angle_of_unit<const FUSED: bool>(sine: f32, cosine: f32) -> f32 {
    angle(sine, cosine)
}

/// As [`angle`], in [−π, π] with the sign of `y`.
#[inline(always)]
pub fn atan2(y: f32, x: f32) -> f32 {
    let (ax, ay) = (x.abs(), y.abs());
    let large = if ay > ax { ay } else { ax };
    let small = if ay > ax { ax } else { ay };
    let diagonal = mask(small > TAN_EIGHTH * large);
    let steep = mask(ay > ax);
    let left = mask(x < 0.0);

    let along = large + gate(diagonal, small);
    let across = small - gate(diagonal, large);
    // The smallest positive number turns 0/0 into 0 and changes nothing else.
    let smallest = f32::from_bits(1);
    let t = across / select(along < smallest, smallest, along);
    let off_axis = flip(atan_eighth(t), steep ^ left);

    let upright = gate(diagonal, FRAC_PI_4) + gate(steep & !diagonal, FRAC_PI_2);
    let axis = (upright - gate(left, PI)).abs();
    flip(axis + off_axis, y.to_bits())
}

/// tan π/8.
const TAN_EIGHTH: f32 = 0.414_213_57;

/// atan t for |t| ≤ tan π/8.
#[inline(always)]
fn atan_eighth(t: f32) -> f32 {
    let z = t * t;
    let low = -0.333_329_54 + z * 0.199_778_67;
    let high = -0.138_791_52 + z * 0.080_578_77;
    t + t * (z * (low + z * z * high))
}

/// The angle `x`, radians, moved by a multiple of 2π into (−π, π]. Values already there come back
/// unchanged, and −π becomes π. Infinities and NaN give NaN.
///
/// ```
/// use core::f32::consts::PI;
/// use kin_runtime::single::__private::math::wrap;
/// assert_eq!([wrap(-PI), wrap(0.25)], [PI, 0.25]);
/// assert!((wrap(3.5 * PI) + 0.5 * PI).abs() < 1e-6);
/// ```
#[inline(always)]
pub fn wrap(x: f32) -> f32 {
    let turns = round(x * (0.25 * FRAC_2_PI));
    let part = |i: usize| turns * (4.0 * HALF_PI[i]);
    let r = ((x - part(0)) - part(1)) - part(2);
    // The quotient is off by its rounding.
    let r = select(r > PI, r - TAU, r);
    select(r <= -PI, r + TAU, r)
}

/// The integer nearest to `x`, of two the even one, for |x| < 2²².
#[inline(always)]
pub fn round(x: f32) -> f32 {
    (x + ROUNDER) - ROUNDER
}

/// The least integer that is not below `x`; as [`round`].
#[inline(always)]
pub fn ceil(x: f32) -> f32 {
    let near = round(x);
    near + select(near < x, 1.0, 0.0)
}

/// √x, NaN for negative `x`. Correctly rounded; one instruction with the feature `std` and on Arm
/// processors with a unit for floating point, otherwise from `libm`.
#[inline(always)]
pub fn sqrt(x: f32) -> f32 {
    #[cfg(feature = "std")]
    {
        x.sqrt()
    }
    #[cfg(all(not(feature = "std"), target_arch = "arm", target_abi = "eabihf"))]
    {
        let mut bits = x.to_bits();
        // SAFETY: where numbers are passed in its registers, the processor has the unit, and
        // with it this instruction. The register that it takes is as it was before: units of
        // single precision alone cannot be named as operands.
        unsafe {
            core::arch::asm!(
                "vpush {{s0}}",
                "vmov s0, {bits}",
                "vsqrt.f32 s0, s0",
                "vmov {bits}, s0",
                "vpop {{s0}}",
                bits = inout(reg) bits,
                options(pure, nomem)
            );
        }
        f32::from_bits(bits)
    }
    #[cfg(not(any(feature = "std", all(target_arch = "arm", target_abi = "eabihf"))))]
    {
        libm::sqrtf(x)
    }
}

/// `a` where `mask` holds, `b` elsewhere. Both are evaluated.
#[inline(always)]
pub const fn select(mask: bool, a: f32, b: f32) -> f32 {
    if mask { a } else { b }
}

/// The larger of two numbers, the second where either is NaN.
#[inline(always)]
pub fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of two numbers, the second where either is NaN.
#[inline(always)]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

const SIGN: u32 = 1 << 31;

#[inline(always)]
fn mask(holds: bool) -> u32 {
    0_u32.wrapping_sub(u32::from(holds))
}

/// `value` where the bits of `mask` are set, 0 where they are not.
#[inline(always)]
fn gate(mask: u32, value: f32) -> f32 {
    f32::from_bits(value.to_bits() & mask)
}

/// `value`, negated where the highest bit of `mask` is set.
#[inline(always)]
fn flip(value: f32, mask: u32) -> f32 {
    f32::from_bits(value.to_bits() ^ (mask & SIGN))
}

/// `x` limited to [−bound, bound]; NaN stays NaN.
#[inline(always)]
fn clamp(x: f32, bound: f32) -> f32 {
    let x = select(x > bound, bound, x);
    select(x < -bound, -bound, x)
}
