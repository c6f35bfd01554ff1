//! Eight numbers side by side.

mod portable;
pub(super) mod reproducible;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
mod x86_64;

use crate::generated::dispatch::{Dispatched, dispatch};
use crate::generated::lanes;
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
    fn plus(self, a: Self, b: Self) -> Self;
    /// self − a b.
    fn minus(self, a: Self, b: Self) -> Self;

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
    fn plus_scaled(self, a: Self, b: f64) -> Self {
        self.plus(a, Self::splat(b))
    }

    /// Sine and cosine of angles in radians.
    #[inline(always)]
    fn sin_cos(self) -> [Self; 2] {
        let (sine, cosine) = lanes::sin_cos(self.numbers());
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
    let mut sum = L::ZERO;
    for i in 0..N {
        sum = sum.plus(a[i], b[i]);
    }
    sum
}

/// What is computed in lanes. `run` and all that it calls has to be `#[inline(always)]`, for
/// it is compiled for several instruction sets.
pub(super) trait InLanes<I> {
    type Output;
    fn run<L: Lanes>(input: I) -> Self::Output;
}

/// Runs `T` by the widest instructions that the processor has.
#[inline(always)]
pub(super) fn in_lanes<T: InLanes<I>, I>(input: I) -> T::Output {
    if reproducible::wanted() {
        return narrow::<T, I>(input);
    }
    dispatch::<Widest<T>, I>(input)
}

#[cold]
#[inline(never)]
fn narrow<T: InLanes<I>, I>(input: I) -> T::Output {
    Widest::<T>::run(input)
}

struct Widest<T>(PhantomData<T>);

impl<T: InLanes<I>, I> Dispatched<I> for Widest<T> {
    type Output = T::Output;

    #[inline(always)]
    fn run(input: I) -> T::Output {
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
        {
            T::run::<x86_64::Sse2>(input)
        }
        #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
        {
            T::run::<Portable>(input)
        }
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
