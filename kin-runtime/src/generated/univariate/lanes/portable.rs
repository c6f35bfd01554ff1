//! Lanes without instructions of their own.

use super::{LANES, Lanes};
use crate::math;
use core::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub};

/// Loops, which the compiler makes vectors of where it can.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(in super::super) struct Portable([f64; LANES]);

macro_rules! each {
    ($k:ident, $number:expr) => {{
        let mut out = [0.0; LANES];
        for $k in 0..LANES {
            out[$k] = $number;
        }
        Self(out)
    }};
}

impl Lanes for Portable {
    const ZERO: Self = Self([0.0; LANES]);
    const ONE: Self = Self([1.0; LANES]);

    #[inline(always)]
    fn of(numbers: [f64; LANES]) -> Self {
        Self(numbers)
    }
    #[inline(always)]
    fn numbers(self) -> [f64; LANES] {
        self.0
    }
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; LANES])
    }
    #[inline(always)]
    fn plus(self, a: Self, b: Self) -> Self {
        self + a * b
    }
    #[inline(always)]
    fn minus(self, a: Self, b: Self) -> Self {
        self - a * b
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        each!(k, 1.0 / self.0[k])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        each!(k, math::sqrt(self.0[k]))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        each!(k, self.0[k].abs())
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        each!(k, math::max(self.0[k], other.0[k]))
    }
    #[inline(always)]
    fn where_less(self, other: Self, yes: Self, no: Self) -> Self {
        each!(k, math::select(self.0[k] < other.0[k], yes.0[k], no.0[k]))
    }
    #[inline(always)]
    fn away_from_zero(self, least: f64) -> Self {
        each!(k, math::max(self.0[k].abs(), least).copysign(self.0[k]))
    }
}

impl Neg for Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        each!(k, -self.0[k])
    }
}

impl Add for Portable {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        each!(k, self.0[k] + other.0[k])
    }
}

impl Sub for Portable {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        each!(k, self.0[k] - other.0[k])
    }
}

impl Mul for Portable {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        each!(k, self.0[k] * other.0[k])
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
