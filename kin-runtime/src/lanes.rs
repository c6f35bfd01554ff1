//! Branches as array lanes.

/// Repeats the lanes of a value until they are `B`: when a plan takes another
/// sign, every branch so far becomes two, and lane k descends from lane k
/// modulo `A`.
///
/// ```
/// use kin_runtime::lanes::widen;
/// assert_eq!(widen([1.0, 2.0]), [1.0, 2.0, 1.0, 2.0]);
/// ```
#[inline(always)]
pub fn widen<const A: usize, const B: usize>(x: [f64; A]) -> [f64; B] {
    core::array::from_fn(|k| x[k % A])
}
