//! Eight numbers side by side.

mod portable;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
mod x86_64;

use crate::generated::dispatch::{Dispatched, dispatch, unfused};
use crate::generated::lanes;
use crate::generated::reproducible;
use core::marker::PhantomData;
use core::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub};
pub(super) use portable::Portable;

/// Configurations, or values of a joint, that are worked on at once.
pub(super) const LANES: usize = 8;

/// One number in each lane, as vectors of one instruction set. Loops over arrays, which
/// elsewhere become such vectors, do not here: of a matrix of lanes the compiler pairs
/// neighbouring entries instead.
///
/// Operations are rounded as IEEE 754 says; sums of products once, where the instructions
/// have that.
pub(super) trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + MulAssign
{
    const ZERO: Self;
    const ONE: Self;

    fn of(numbers: [f64; LANES]) -> Self;
    fn numbers(self) -> [f64; LANES];
    fn splat(x: f64) -> Self;

    /// self + a b.
    fn plus(&self, a: &Self, b: &Self) -> Self;
    /// self − a b.
    fn minus(&self, a: &Self, b: &Self) -> Self;

    fn inverse(self) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The second where either is not a number.
    fn max(self, other: Self) -> Self;
    /// Where a lane is less than the other, `yes`, else `no`.
    fn where_less(self, other: Self, yes: Self, no: Self) -> Self;
    /// No nearer to 0 than `least`, with the sign that it has.
    fn away_from_zero(self, least: f64) -> Self;

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }

    #[inline(always)]
    fn scaled(self, x: f64) -> Self {
        self * Self::splat(x)
    }

    /// self + a b for the same b in all lanes.
    #[inline(always)]
    fn plus_scaled(&self, a: &Self, b: f64) -> Self {
        self.plus(a, &Self::splat(b))
    }

    /// Sine and cosine of angles in radians.
    #[inline(always)]
    fn sin_cos(self) -> [Self; 2] {
        let (sine, cosine) = lanes::side_by_side::<false, LANES>(self.numbers());
        [Self::of(sine), Self::of(cosine)]
    }

    /// The angle of (cosine, sine) times any length, radians.
    #[inline(always)]
    fn angle(sine: Self, cosine: Self) -> Self {
        let (sine, cosine) = (sine.numbers(), cosine.numbers());
        let mut angles = [0.0; LANES];
        for k in 0..LANES {
            angles[k] = lanes::angle(sine[k], cosine[k]);
        }
        Self::of(angles)
    }
}

/// The sum of products of what comes in pairs.
#[inline(always)]
pub(super) fn dot<L: Lanes, const N: usize>(a: &[L; N], b: &[L; N]) -> L {
    // Two sums, of which neither waits for the other.
    let mut sums = [L::ZERO; 2];
    for i in 0..N {
        sums[i % 2] = sums[i % 2].plus(&a[i], &b[i]);
    }
    sums[0] + sums[1]
}

/// What is computed in lanes. `run` and all that it calls has to be `#[inline(always)]`, for
/// it is compiled for several instruction sets; so arrays are filled by loops: what `map` and
/// `from_fn` are given may be compiled by itself, where every operation is a call.
pub(super) trait InLanes<I> {
    type Output;
    fn run<L: Lanes>(input: I) -> Self::Output;
}

/// Runs `T` by the widest instructions that the processor has.
#[inline(always)]
pub(super) fn in_lanes<T: InLanes<I>, I>(input: I) -> T::Output {
    match reproducible::wanted() {
        true => unfused::<Widest<T>, I>(input),
        false => dispatch::<Widest<T>, I>(input),
    }
}

struct Widest<T>(PhantomData<T>);

impl<T: InLanes<I>, I> Dispatched<I> for Widest<T> {
    type Output = T::Output;

    #[inline(always)]
    fn run<const FUSED: bool>(input: I) -> T::Output {
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
        {
            T::run::<x86_64::Sse2>(input)
        }
        #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
        {
            T::run::<Portable>(input)
        }
    }

    /// A compiler, a macro most of all, which Cargo does not optimize: there every vector instruction is
    /// a call, and single numbers take two thirds of the time.
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    #[inline(always)]
    fn run_avx(input: I) -> T::Output {
        T::run::<Portable>(input)
    }

    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    #[inline(always)]
    fn run_avx2(input: I) -> T::Output {
        T::run::<x86_64::Avx2>(input)
    }

    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    #[inline(always)]
    fn run_avx512(input: I) -> T::Output {
        T::run::<x86_64::Avx512>(input)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math;

    /// Numbers of all signs and sizes, and what is none.
    fn numbers(of: usize) -> [f64; LANES] {
        let some = [0.0, -0.0, 1.5, -3.25e-7, 2e30, -7e-30, f64::NAN, 0.1];
        core::array::from_fn(|k| some[(k * (2 * of + 1) + of) % LANES])
    }

    /// Whether each operation does in every lane what it does with single numbers; sums of
    /// products up to one rounding.
    fn agrees<L: Lanes>() {
        for [i, j, l] in [[0, 1, 2], [1, 3, 0], [2, 0, 3], [3, 2, 1]] {
            let [a, b, c] = [i, j, l].map(numbers);
            let [x, y, z] = [a, b, c].map(L::of);
            let same = |name: &str, lanes: L, of: &dyn Fn(usize) -> f64| {
                for (k, number) in lanes.numbers().into_iter().enumerate() {
                    let one = of(k);
                    let both_none = one.is_nan() && number.is_nan();
                    assert!(
                        both_none || one.to_bits() == number.to_bits(),
                        "{name} of {} {} {}: {number} for {one}",
                        a[k],
                        b[k],
                        c[k]
                    );
                }
            };
            same("add", x + y, &|k| a[k] + b[k]);
            same("sub", x - y, &|k| a[k] - b[k]);
            same("mul", x * y, &|k| a[k] * b[k]);
            same("neg", -x, &|k| -a[k]);
            same("inverse", x.inverse(), &|k| 1.0 / a[k]);
            same("sqrt", x.abs().sqrt(), &|k| a[k].abs().sqrt());
            same("max", x.max(y), &|k| math::max(a[k], b[k]));
            same("splat", L::splat(a[2]), &|_| a[2]);
            same("away", x.away_from_zero(0.2), &|k| {
                math::max(a[k].abs(), 0.2).copysign(a[k])
            });
            same("where_less", x.where_less(y, z, x), &|k| {
                if a[k] < b[k] { c[k] } else { a[k] }
            });
            for (name, lanes, sign) in [
                ("plus", x.plus(&y, &z), 1.0),
                ("minus", x.minus(&y, &z), -1.0),
            ] {
                for (k, number) in lanes.numbers().into_iter().enumerate() {
                    let product = sign * b[k] * c[k];
                    let off = (number - (a[k] + product)).abs();
                    let rounding = f64::EPSILON * (a[k].abs() + product.abs());
                    assert!(
                        off <= rounding || (off + rounding).is_nan(),
                        "{name}: {number}"
                    );
                }
            }
        }
    }

    /// Whether sums of products are, to the last bit, what SSE2 makes of them.
    fn rounds_twice<L: Lanes>() {
        let thirds = |of: usize| core::array::from_fn(|k| (k + of) as f64 / 3.0 - 2.0 / 7.0);
        let [a, b, c] = [1, 2, 3].map(thirds);
        let sums = [
            L::of(a).plus(&L::of(b), &L::of(c)),
            L::of(a).minus(&L::of(b), &L::of(c)),
        ];
        for k in 0..LANES {
            let product = b[k] * c[k];
            let numbers = sums.map(|sum| sum.numbers()[k]);
            assert_eq!(numbers, [a[k] + product, a[k] - product]);
        }
    }

    #[test]
    fn vectors_do_in_every_lane_what_is_done_with_single_numbers() {
        agrees::<Portable>();
        rounds_twice::<Portable>();
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
        {
            agrees::<x86_64::Sse2>();
            let has_fma = std::is_x86_feature_detected!("fma");
            if has_fma && std::is_x86_feature_detected!("avx2") {
                agrees::<x86_64::Avx2>();
            }
            if has_fma && std::is_x86_feature_detected!("avx512dq") {
                agrees::<x86_64::Avx512>();
            }
        }
    }
}
