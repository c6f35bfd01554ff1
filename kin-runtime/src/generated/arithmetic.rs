//! What generated code leaves open: whether a product and a sum are rounded once.

use super::super::math;
use super::super::scalar::{Real, angle_of_unit};

/// The operations that differ between instruction sets.
pub trait Arithmetic {
    /// a b + c.
    fn fma(a: Real, b: Real, c: Real) -> Real;
    /// The angle of the unit vector (cosine, sine) in (−π, π] radians, for loops over lanes.
    fn angle(sine: Real, cosine: Real) -> Real;
}

/// That of processors with fused operations, or of those without.
pub struct Fused<const IS: bool>;

impl<const IS: bool> Arithmetic for Fused<IS> {
    #[inline(always)]
    fn fma(a: Real, b: Real, c: Real) -> Real {
        math::mul_add::<IS>(a, b, c)
    }

    #[inline(always)]
    fn angle(sine: Real, cosine: Real) -> Real {
        angle_of_unit::<IS>(sine, cosine)
    }
}
