//! Arrays of what the loops over lanes leave for later ones.

use core::ops::{Index, IndexMut};

/// An array that begins where a vector may: whole vectors of it lie in one line of the cache
/// each, wherever the stack is.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Aligned<A>(pub A);

impl<A: Index<usize>> Index<usize> for Aligned<A> {
    type Output = A::Output;

    #[inline(always)]
    fn index(&self, k: usize) -> &A::Output {
        &self.0[k]
    }
}

impl<A: IndexMut<usize>> IndexMut<usize> for Aligned<A> {
    #[inline(always)]
    fn index_mut(&mut self, k: usize) -> &mut A::Output {
        &mut self.0[k]
    }
}

/// Arrays to be written.
#[doc(hidden)]
#[macro_export]
macro_rules! aligned {
    ($($array:ident),* = $zeros:expr) => {
        $(let mut $array = $crate::__private::arrays::Aligned($zeros);)*
    };
}

/// Brings arrays from so many branches to more, as the function of this name.
#[doc(hidden)]
#[macro_export]
macro_rules! widen {
    ($($array:ident),* from $from:literal to $to:literal of $t:ident) => {
        $(let $array = $crate::__private::arrays::widen::<$from, $to, $t, _, _>(&$array);)*
    };
}

/// The branches of a value repeated until they are `B`: when a plan takes another
/// sign, every branch so far becomes two, and branch k descends from branch k
/// modulo `A`. Of one target they are copied, so that a loop over branches reads
/// neighbours; of several, whose loop is over targets, they stay where they are.
///
/// ```
/// use kin_runtime::__private::arrays::widen;
/// let one = [[1.0], [2.0]];
/// assert_eq!(widen::<2, 4, 1, _, _>(&one)[2], [1.0]);
/// let two = [[1.0, 5.0], [2.0, 6.0]];
/// assert_eq!(widen::<2, 4, 2, _, _>(&two)[3], [2.0, 6.0]);
/// ```
#[inline(always)]
pub fn widen<const A: usize, const B: usize, const T: usize, R, X>(
    narrow: &X,
) -> Widened<'_, A, B, T, R, X>
where
    R: Copy + Default,
    X: Index<usize, Output = [R; T]>,
{
    let mut wide = [[R::default(); T]; B];
    if T == 1 {
        for k in 0..B {
            wide[k] = narrow[k % A];
        }
    }
    Widened { narrow, wide }
}

/// What the function `widen` gives: an array of arrays, to be read.
pub struct Widened<'a, const A: usize, const B: usize, const T: usize, R, X> {
    narrow: &'a X,
    /// Filled for one target alone.
    wide: [[R; T]; B],
}

impl<const A: usize, const B: usize, const T: usize, R, X> Widened<'_, A, B, T, R, X>
where
    R: Copy,
    X: Index<usize, Output = [R; T]>,
{
    /// All branches.
    #[inline(always)]
    pub fn all(&self) -> [[R; T]; B] {
        core::array::from_fn(|k| self[k])
    }
}

impl<const A: usize, const B: usize, const T: usize, R, X> Index<usize>
    for Widened<'_, A, B, T, R, X>
where
    X: Index<usize, Output = [R; T]>,
{
    type Output = [R; T];

    #[inline(always)]
    fn index(&self, k: usize) -> &[R; T] {
        if T == 1 {
            &self.wide[k]
        } else {
            &self.narrow[k % A]
        }
    }
}
