//! Vectors of SSE2, AVX2 and AVX-512; the last two with fused multiplications and additions.
//!
//! All `unsafe` is of two kinds: arrays of numbers are taken for vectors and back, which have the same
//! size and bits; and the wider types are used where [`dispatch`](crate::generated::dispatch) has seen
//! that the processor has the instructions.

use super::{LANES, Lanes};
use core::arch::x86_64::*;
use core::mem::transmute;
use core::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub};

/// The numbers as some vectors of one width, and what is done with each: written out, not in a loop,
/// which costs as much as what it does in a build that is not optimized.
macro_rules! vectors {
    (
        $(#[$doc:meta])*
        $name:ident: $($k:tt $vector:ty),*;
        set $set:ident,
        add $add:ident,
        sub $sub:ident,
        mul $mul:ident,
        div $div:ident,
        sqrt $sqrt:ident,
        max $max:ident,
        and $and:ident,
        and_not $and_not:ident,
        or $or:ident,
        xor $xor:ident,
        plus |$sum:ident, $a:ident, $b:ident| $plus:expr,
        minus $minus:expr,
        less |$x:ident, $y:ident, $yes:ident, $no:ident| $select:expr,
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        #[repr(C)]
        pub(in super::super) struct $name($($vector),*);

        impl Lanes for $name {
            // SAFETY: vectors are arrays of numbers.
            const ZERO: Self = unsafe { transmute::<[f64; LANES], Self>([0.0; LANES]) };
            // SAFETY: as above.
            const ONE: Self = unsafe { transmute::<[f64; LANES], Self>([1.0; LANES]) };

            #[inline(always)]
            fn of(numbers: [f64; LANES]) -> Self {
                // SAFETY: as above.
                unsafe { transmute::<[f64; LANES], Self>(numbers) }
            }
            #[inline(always)]
            fn numbers(self) -> [f64; LANES] {
                // SAFETY: as above.
                unsafe { transmute::<Self, [f64; LANES]>(self) }
            }
            #[inline(always)]
            fn splat(x: f64) -> Self {
                Self::of([x, x, x, x, x, x, x, x])
            }
            #[inline(always)]
            fn plus(&self, a: &Self, b: &Self) -> Self {
                Self($({
                    let ($sum, $a, $b) = (self.$k, a.$k, b.$k);
                    // SAFETY: see the head of this file.
                    unsafe { $plus }
                }),*)
            }
            #[inline(always)]
            fn minus(&self, a: &Self, b: &Self) -> Self {
                Self($({
                    let ($sum, $a, $b) = (self.$k, a.$k, b.$k);
                    // SAFETY: see the head of this file.
                    unsafe { $minus }
                }),*)
            }
            #[inline(always)]
            fn inverse(self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $div($set(1.0), self.$k) }),*)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $sqrt(self.$k) }),*)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $and_not($set(-0.0), self.$k) }),*)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $max(self.$k, other.$k) }),*)
            }
            #[inline(always)]
            fn where_less(self, other: Self, yes: Self, no: Self) -> Self {
                Self($({
                    let ($x, $y, $yes, $no) = (self.$k, other.$k, yes.$k, no.$k);
                    // SAFETY: see the head of this file.
                    unsafe { $select }
                }),*)
            }
            #[inline(always)]
            fn away_from_zero(self, least: f64) -> Self {
                let away = self.abs().max(Self::splat(least));
                // SAFETY: see the head of this file.
                Self($(unsafe { $or(away.$k, $and($set(-0.0), self.$k)) }),*)
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $xor($set(-0.0), self.$k) }),*)
            }
        }

        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $add(self.$k, other.$k) }),*)
            }
        }

        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $sub(self.$k, other.$k) }),*)
            }
        }

        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: see the head of this file.
                Self($(unsafe { $mul(self.$k, other.$k) }),*)
            }
        }

        impl AddAssign for $name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl MulAssign for $name {
            #[inline(always)]
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }
    };
}

vectors! {
    /// Two numbers in each of four vectors: what every x86-64 processor has.
    Sse2: 0 __m128d, 1 __m128d, 2 __m128d, 3 __m128d;
    set _mm_set1_pd,
    add _mm_add_pd,
    sub _mm_sub_pd,
    mul _mm_mul_pd,
    div _mm_div_pd,
    sqrt _mm_sqrt_pd,
    max _mm_max_pd,
    and _mm_and_pd,
    and_not _mm_andnot_pd,
    or _mm_or_pd,
    xor _mm_xor_pd,
    plus |sum, a, b| _mm_add_pd(sum, _mm_mul_pd(a, b)),
    minus _mm_sub_pd(sum, _mm_mul_pd(a, b)),
    less |x, y, yes, no| {
        let mask = _mm_cmplt_pd(x, y);
        _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no))
    },
}

vectors! {
    /// Four numbers in each of two vectors.
    Avx2: 0 __m256d, 1 __m256d;
    set _mm256_set1_pd,
    add _mm256_add_pd,
    sub _mm256_sub_pd,
    mul _mm256_mul_pd,
    div _mm256_div_pd,
    sqrt _mm256_sqrt_pd,
    max _mm256_max_pd,
    and _mm256_and_pd,
    and_not _mm256_andnot_pd,
    or _mm256_or_pd,
    xor _mm256_xor_pd,
    plus |sum, a, b| _mm256_fmadd_pd(a, b, sum),
    minus _mm256_fnmadd_pd(a, b, sum),
    less |x, y, yes, no| _mm256_blendv_pd(no, yes, _mm256_cmp_pd::<_CMP_LT_OQ>(x, y)),
}

vectors! {
    /// All numbers in one vector.
    Avx512: 0 __m512d;
    set _mm512_set1_pd,
    add _mm512_add_pd,
    sub _mm512_sub_pd,
    mul _mm512_mul_pd,
    div _mm512_div_pd,
    sqrt _mm512_sqrt_pd,
    max _mm512_max_pd,
    and _mm512_and_pd,
    and_not _mm512_andnot_pd,
    or _mm512_or_pd,
    xor _mm512_xor_pd,
    plus |sum, a, b| _mm512_fmadd_pd(a, b, sum),
    minus _mm512_fnmadd_pd(a, b, sum),
    less |x, y, yes, no| {
        _mm512_mask_blend_pd(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(x, y), no, yes)
    },
}
