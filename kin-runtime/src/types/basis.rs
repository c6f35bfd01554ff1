//! A few vectors that span a space.

use core::ops::Deref;

/// Orthonormal vectors that span a space whose dimension is known only at run
/// time, at most `CAPACITY`. A slice of them, without allocation.
///
/// ```
/// use kin_runtime::{Jacobian, Twist};
/// // Two hinges on one axis: what the one turns, the other turns back.
/// let hinge = Twist::revolute([0.0, 0.0, 1.0], [0.3, 0.0, 0.0]);
/// let motions = Jacobian::from_columns([hinge, hinge]).internal_motions();
/// assert_eq!(motions.len(), 1);
/// assert!((motions[0][0] + motions[0][1]).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basis<T, const CAPACITY: usize> {
    vectors: [T; CAPACITY],
    dimension: usize,
}

impl<T: Copy, const CAPACITY: usize> Basis<T, CAPACITY> {
    /// The first `dimension` of some vectors.
    pub(crate) fn new(vectors: [T; CAPACITY], dimension: usize) -> Self {
        Basis { vectors, dimension }
    }
}

impl<T, const CAPACITY: usize> Deref for Basis<T, CAPACITY> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.vectors[..self.dimension]
    }
}

impl<'a, T, const CAPACITY: usize> IntoIterator for &'a Basis<T, CAPACITY> {
    type Item = &'a T;
    type IntoIter = core::slice::Iter<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
