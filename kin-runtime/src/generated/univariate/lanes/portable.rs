//! Lanes without instructions of their own.

use super::{LANES, Lanes};
use crate::math;
use core::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub};

/// Single numbers, which the compiler makes vectors of where it can. Fields, since unoptimized it
/// makes an array for every result and copies that by a call.
#[derive(Clone, Copy)]
pub(in super::super) struct Portable(f64, f64, f64, f64, f64, f64, f64, f64);

/// In each lane, written out: a loop costs as much as what it does where a macro runs, unoptimized, in
/// a user's build.
macro_rules! each {
    ($($x:ident = $of:expr),+; $number:expr) => {
        Self(
            each!(0 $($x = $of),+; $number),
            each!(1 $($x = $of),+; $number),
            each!(2 $($x = $of),+; $number),
            each!(3 $($x = $of),+; $number),
            each!(4 $($x = $of),+; $number),
            each!(5 $($x = $of),+; $number),
            each!(6 $($x = $of),+; $number),
            each!(7 $($x = $of),+; $number),
        )
    };
    ($k:tt $($x:ident = $of:expr),+; $number:expr) => {{
        $(let $x = $of.$k;)+
        $number
    }};
}

impl Lanes for Portable {
    const ZERO: Self = Self(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    const ONE: Self = Self(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0);

    #[inline(always)]
    fn of(numbers: [f64; LANES]) -> Self {
        let [a, b, c, d, e, f, g, h] = numbers;
        Self(a, b, c, d, e, f, g, h)
    }
    #[inline(always)]
    fn numbers(self) -> [f64; LANES] {
        [
            self.0, self.1, self.2, self.3, self.4, self.5, self.6, self.7,
        ]
    }
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(x, x, x, x, x, x, x, x)
    }
    #[inline(always)]
    fn plus(&self, a: &Self, b: &Self) -> Self {
        each!(x = self, y = a, z = b; x + y * z)
    }
    #[inline(always)]
    fn minus(&self, a: &Self, b: &Self) -> Self {
        each!(x = self, y = a, z = b; x - y * z)
    }
    #[inline(always)]
    fn plus_scaled(&self, a: &Self, b: f64) -> Self {
        each!(x = self, y = a; x + y * b)
    }
    #[inline(always)]
    fn scaled(self, by: f64) -> Self {
        each!(x = self; x * by)
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        each!(x = self; 1.0 / x)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        each!(x = self; math::sqrt(x))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        each!(x = self; x.abs())
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        each!(x = self, y = other; math::max(x, y))
    }
    #[inline(always)]
    fn where_less(self, other: Self, yes: Self, no: Self) -> Self {
        each!(x = self, y = other, a = yes, b = no; math::select(x < y, a, b))
    }
    #[inline(always)]
    fn away_from_zero(self, least: f64) -> Self {
        each!(x = self; math::max(x.abs(), least).copysign(x))
    }
}

impl Neg for Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        each!(x = self; -x)
    }
}

impl Add for Portable {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        each!(x = self, y = other; x + y)
    }
}

impl Sub for Portable {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        each!(x = self, y = other; x - y)
    }
}

impl Mul for Portable {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        each!(x = self, y = other; x * y)
    }
}

impl AddAssign for Portable {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl MulAssign for Portable {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}
