//! The widest instructions that the processor has, chosen when the program runs.
//!
//! Lanes are plain loops, which the compiler turns into the vector instructions
//! that it may use; by default on x86-64 those are SSE2's, two lanes at a time.
//! [`dispatch`] has the same source compiled for AVX2 and AVX-512 beside that,
//! and takes what there is. Each operation is rounded as IEEE 754 says, whatever the width; but
//! where the instructions have it, a product and a sum are one fused operation where that is
//! written ([`mul_add`](super::super::scalar::math::mul_add)): so AVX2 and AVX-512 give the same
//! results to the last bit, and SSE2 others in the last digits.
//!
//! Nothing is dispatched where the program is compiled for AVX2 or more
//! (`-C target-cpu=native`), on other architectures (NEON is part of aarch64),
//! and without the feature `std`, which knows what the processor has. For
//! Intel's processors LLVM then takes vectors of AVX2's width, though it may use
//! wider ones, unless told `-C target-feature=-prefer-256-bit` beside: that is a
//! matter of the target processor, which no attribute of a function changes.

/// What is compiled for several instruction sets. `run` has to be
/// `#[inline(always)]`, and so has all that it calls: what stays a call is
/// compiled once. It is told whether a product and a sum are to be `FUSED`.
pub trait Dispatched<I> {
    /// How many lanes much of it has. Where these leave vectors of AVX-512 half empty, AVX2 is as
    /// fast; and the few wide instructions among the others would slow those down: while some are
    /// under way, Intel's processors add and multiply narrow vectors at one port instead of two.
    const WIDTH: usize = 8;
    /// What comes of it.
    type Output;
    /// Computes it.
    fn run<const FUSED: bool>(input: I) -> Self::Output;
    /// The same for vectors of two lanes, where less side by side may be faster.
    #[inline(always)]
    fn run_narrow<const FUSED: bool>(input: I) -> Self::Output {
        Self::run::<FUSED>(input)
    }
    /// The same without fused operations where there is AVX.
    #[inline(always)]
    fn run_avx(input: I) -> Self::Output {
        Self::run::<false>(input)
    }
    /// The same where there are AVX2 and fused multiplication and addition.
    #[inline(always)]
    fn run_avx2(input: I) -> Self::Output {
        Self::run::<true>(input)
    }
    /// The same with AVX-512 beside these.
    #[inline(always)]
    fn run_avx512(input: I) -> Self::Output {
        Self::run::<true>(input)
    }
}

/// Runs `T` by the widest instructions that the processor has.
///
/// ```
/// use kin_runtime::__private::dispatch::{Dispatched, dispatch};
/// struct Sum;
/// impl Dispatched<&[f64; 8]> for Sum {
///     type Output = f64;
///     #[inline(always)]
///     fn run<const FUSED: bool>(x: &[f64; 8]) -> f64 {
///         x.iter().sum()
///     }
/// }
/// assert_eq!(dispatch::<Sum, _>(&[0.5; 8]), 4.0);
/// ```
#[inline(always)]
pub fn dispatch<T: Dispatched<I>, I>(input: I) -> T::Output {
    #[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
    {
        x86_64::dispatch::<T, I>(input)
    }
    #[cfg(target_feature = "avx2")]
    {
        if cfg!(not(target_feature = "fma")) {
            T::run::<false>(input)
        } else if cfg!(all(
            target_feature = "avx512f",
            target_feature = "avx512vl",
            target_feature = "avx512dq"
        )) {
            T::run_avx512(input)
        } else {
            T::run_avx2(input)
        }
    }
    #[cfg(not(any(target_feature = "avx2", all(feature = "std", target_arch = "x86_64"))))]
    {
        // NEON has it.
        match cfg!(target_arch = "aarch64") {
            true => T::run_narrow::<true>(input),
            false => T::run_narrow::<false>(input),
        }
    }
}

/// Runs `T` without fused operations, whatever the processor has: with the same results, to the last
/// bit, on all of them.
#[cold]
#[inline(never)]
pub fn unfused<T: Dispatched<I>, I>(input: I) -> T::Output {
    #[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
    {
        x86_64::unfused::<T, I>(input)
    }
    #[cfg(not(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2"))))]
    {
        T::run::<false>(input)
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
pub use x86_64::{Instructions, use_at_most};

#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
mod x86_64 {
    use super::Dispatched;
    use core::sync::atomic::{AtomicU8, Ordering};

    /// Instruction sets that code is compiled for, from narrow to wide.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    #[repr(u8)]
    pub enum Instructions {
        /// What every x86-64 processor has.
        Sse2 = 1,
        /// AVX2, four lanes at a time.
        Avx2 = 2,
        /// AVX-512 with its parts F, VL and DQ, eight lanes at a time.
        Avx512 = 3,
    }

    /// The instructions to use; 0 before the processor was asked.
    static CHOSEN: AtomicU8 = AtomicU8::new(0);

    impl Instructions {
        /// The widest that the processor has.
        pub fn of_this_processor() -> Self {
            if std::is_x86_feature_detected!("avx512f")
                && std::is_x86_feature_detected!("avx512vl")
                && std::is_x86_feature_detected!("avx512dq")
                && std::is_x86_feature_detected!("fma")
            {
                Self::Avx512
            } else if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
            {
                Self::Avx2
            } else {
                Self::Sse2
            }
        }
    }

    /// From now on uses no wider instructions than these, nor than the processor
    /// has, in all threads: for tests and measurements. Tells which.
    pub fn use_at_most(instructions: Instructions) -> Instructions {
        let chosen = instructions.min(Instructions::of_this_processor());
        CHOSEN.store(chosen as u8, Ordering::Relaxed);
        chosen
    }

    #[cold]
    fn ask_processor() -> u8 {
        use_at_most(Instructions::Avx512) as u8
    }

    #[inline(always)]
    fn chosen() -> u8 {
        match CHOSEN.load(Ordering::Relaxed) {
            0 => ask_processor(),
            chosen => chosen,
        }
    }

    const AVX2: u8 = Instructions::Avx2 as u8;
    const AVX512: u8 = Instructions::Avx512 as u8;

    #[inline(always)]
    pub fn dispatch<T: Dispatched<I>, I>(input: I) -> T::Output {
        match chosen() {
            // SAFETY: what is chosen is not more than the processor has.
            AVX512 if T::WIDTH >= 8 => unsafe { with_avx512::<T, I>(input) },
            // SAFETY: as above.
            AVX2 | AVX512 => unsafe { with_avx2::<T, I>(input) },
            _ => with_sse2::<T, I>(input),
        }
    }

    pub fn unfused<T: Dispatched<I>, I>(input: I) -> T::Output {
        match chosen() {
            // SAFETY: as above, and where there is AVX2 there is AVX.
            AVX2 | AVX512 => unsafe { with_avx::<T, I>(input) },
            _ => with_sse2::<T, I>(input),
        }
    }

    /// A function as well: its callers have no use for a copy.
    #[inline(never)]
    fn with_sse2<T: Dispatched<I>, I>(input: I) -> T::Output {
        T::run_narrow::<false>(input)
    }

    #[target_feature(enable = "avx")]
    fn with_avx<T: Dispatched<I>, I>(input: I) -> T::Output {
        T::run_avx(input)
    }

    #[target_feature(enable = "avx512f,avx512vl,avx512dq,fma")]
    fn with_avx512<T: Dispatched<I>, I>(input: I) -> T::Output {
        T::run_avx512(input)
    }

    #[target_feature(enable = "avx2,fma")]
    fn with_avx2<T: Dispatched<I>, I>(input: I) -> T::Output {
        T::run_avx2(input)
    }
}
