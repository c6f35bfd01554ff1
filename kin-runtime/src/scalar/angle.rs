//! The angle of a vector, for loops over lanes, where it takes two thirds of the time of
//! [`math::atan2`] or less: its comparisons become packed masks there. In scalar code
//! they become jumps.
//!
//! A diagonal of the octants is the axis where that is nearer, so that the vector is at
//! most π/8 off an axis, which a minimax polynomial (Remez) tells of the tangent or the
//! sine of that angle.

use super::math;
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI};

/// The angle of the vector (x, y) of any length in (−π, π] radians, 0 for (0, 0).
///
/// Within 3.5e-16 relative where the larger magnitude is in 1e-290..8e307; multiples of
/// π/4 are exact. NaN gives NaN; infinities give no meaning.
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
    let octant = Octant::of(y, x);
    let [small, large] = octant.magnitudes;
    let along = large + gate(octant.diagonal, small);
    let across = small - gate(octant.diagonal, large);
    let tangent = across / math::select(along < SMALLEST, SMALLEST, along);
    octant.turned(atan_eighth(tangent))
}

/// The angle of the unit vector (cosine, sine) in (−π, π] radians, 0 for (0, 0).
///
/// Without a division. Within 4.5e-16 relative; multiples of π/4 are exact. A length of
/// 1 + δ costs another 1.5 δ², 2e-18 for 1e-9. NaN gives NaN; other lengths give no meaning.
///
/// ```
/// use kin_runtime::__private::lanes::angle_of_unit;
/// let [sine, cosine] = [0.6, -0.8];
/// assert!((angle_of_unit::<false>(sine, cosine) - f64::atan2(sine, cosine)).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn angle_of_unit<const FUSED: bool>(sine: f64, cosine: f64) -> f64 {
    let octant = Octant::of(sine, cosine);
    let [small, large] = octant.magnitudes;
    let turned = FRAC_1_SQRT_2 * (small - large);
    let across = math::select(octant.diagonal != 0, turned, small);
    // A step of Newton's method towards the inverse of the length, by what it is off one.
    let square = math::mul_add::<FUSED>(cosine, cosine, sine * sine);
    let off = math::mul_add::<FUSED>(-0.5, square, 0.5);
    octant.turned(asin_eighth::<FUSED>(math::mul_add::<FUSED>(
        across, off, across,
    )))
}

/// Where a vector lies, as masks.
struct Octant {
    /// Nearer to a diagonal than to an axis.
    diagonal: u64,
    /// |y| > |x|.
    steep: u64,
    /// x < 0.
    left: u64,
    /// Of y.
    sign: u64,
    /// The smaller and the larger component.
    magnitudes: [f64; 2],
}

impl Octant {
    #[inline(always)]
    fn of(y: f64, x: f64) -> Self {
        let (ax, ay) = (x.abs(), y.abs());
        let large = if ay > ax { ay } else { ax };
        let small = if ay > ax { ax } else { ay };
        Self {
            diagonal: mask(small > TAN_EIGHTH * large),
            steep: mask(ay > ax),
            left: mask(x < 0.0),
            sign: y.to_bits(),
            magnitudes: [small, large],
        }
    }

    /// The angle of a vector that is so far off its axis or diagonal.
    #[inline(always)]
    fn turned(self, off_axis: f64) -> f64 {
        let Self {
            diagonal,
            steep,
            left,
            ..
        } = self;
        let upright = gate(diagonal, FRAC_PI_4) + gate(steep & !diagonal, FRAC_PI_2);
        let axis = (upright - gate(left, PI)).abs();
        let angle = flip(axis + flip(off_axis, steep ^ left), self.sign);
        math::select(angle <= -PI, PI, angle)
    }
}

/// tan π/8.
const TAN_EIGHTH: f64 = 0.414_213_562_373_095_1;
/// Turns 0/0 into 0 and changes nothing else.
const SMALLEST: f64 = f64::from_bits(1);
const SIGN: u64 = 1 << 63;

/// atan t for |t| ≤ tan π/8, to a relative error of 4e-17 and rounding.
#[inline(always)]
fn atan_eighth(t: f64) -> f64 {
    let z = t * t;
    let tail = polynomial::<false>(
        z,
        [
            -0.333_333_333_333_301_45,
            0.199_999_999_990_874_53,
            -0.142_857_141_951_311_47,
            0.111_111_066_480_681_27,
            -0.090_907_822_804_788_97,
            0.076_900_664_010_314_3,
            -0.066_411_044_113_241_27,
            0.056_924_499_825_848_21,
            -0.043_588_352_182_852_14,
            0.021_256_629_784_503_4,
        ],
    );
    t + t * (z * tail)
}

/// asin s for |s| ≤ sin π/8, to a relative error of 6e-18 and rounding.
#[inline(always)]
fn asin_eighth<const FUSED: bool>(s: f64) -> f64 {
    let z = s * s;
    let tail = polynomial::<FUSED>(
        z,
        [
            0.166_666_666_666_660_97,
            0.075_000_000_001_871_83,
            0.044_642_856_930_223_18,
            0.030_381_956_380_259_284,
            0.022_371_775_297_243_022,
            0.017_360_361_712_654_704,
            0.013_869_422_712_958_759,
            0.012_309_528_121_673_387,
            0.006_128_263_378_452_462,
            0.017_589_607_752_813_072,
        ],
    );
    math::mul_add::<FUSED>(s, z * tail, s)
}

/// Coefficients by rising powers, in pairs of pairs: most of it is not in a chain.
#[inline(always)]
fn polynomial<const FUSED: bool>(z: f64, c: [f64; 10]) -> f64 {
    let (z2, z4) = (z * z, (z * z) * (z * z));
    let line = |i: usize| math::mul_add::<FUSED>(z, c[i + 1], c[i]);
    let low = math::mul_add::<FUSED>(z2, line(2), line(0));
    let middle = math::mul_add::<FUSED>(z2, line(6), line(4));
    math::mul_add::<FUSED>(z4, math::mul_add::<FUSED>(z4, line(8), middle), low)
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
