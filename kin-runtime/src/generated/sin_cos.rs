//! Where the sines and cosines of straight-line code come from.
//!
//! Generated forward kinematics asks once for those of all its angles, and who
//! calls it says how they are found: of one configuration [`SideBySide`], of
//! many with the same angle of the others (`batch/forward`). What is generated
//! is the same.

use super::super::scalar::Real;
use super::lanes;

/// The sines and cosines of M angles, radians.
pub trait SinCos<const M: usize> {
    /// Of these.
    fn of(self, angles: [Real; M]) -> ([Real; M], [Real; M]);
}

/// Those of one configuration, in packed instructions, fused if they are asked for so.
///
/// ```
/// use kin_runtime::__private::{SideBySide, SinCos, math};
/// let ([s1, s2, s3], _) = SideBySide::<false>.of([0.1, 0.2, 0.3]);
/// assert_eq!([s1, s2, s3], [0.1, 0.2, 0.3].map(|angle| math::sin_cos(angle).0));
/// ```
pub struct SideBySide<const FUSED: bool>;

impl<const FUSED: bool, const M: usize> SinCos<M> for SideBySide<FUSED> {
    #[inline(always)]
    fn of(self, angles: [Real; M]) -> ([Real; M], [Real; M]) {
        lanes::sin_cos_by::<FUSED, M>(angles)
    }
}

/// Those of angles that were known before, by whom they were asked for: of a seed of zeros they
/// are constants there.
#[derive(Clone, Copy)]
pub struct Known<const M: usize>([Real; M], [Real; M]);

impl<const M: usize> Known<M> {
    /// Those of these.
    #[inline(always)]
    pub fn new(angles: [Real; M]) -> Self {
        let (sines, cosines) = lanes::sin_cos(angles);
        Self(sines, cosines)
    }
}

impl<const M: usize> SinCos<M> for Known<M> {
    #[inline(always)]
    fn of(self, _: [Real; M]) -> ([Real; M], [Real; M]) {
        (self.0, self.1)
    }
}
