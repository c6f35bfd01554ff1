//! Forward kinematics of one configuration.

use super::super::Jacobian;
use super::super::scalar::Real;
use super::arithmetic::{Arithmetic, Fused};
use super::dispatch::{Dispatched, dispatch};
use super::sin_cos::{SideBySide, SinCos};
use core::marker::PhantomData;

/// Straight-line code from joint values to poses, a Jacobian, or a pose with its
/// Jacobian, that needs the sines and cosines of M angles.
pub trait Forward<Output, const N: usize, const M: usize> {
    /// At `q`, radians and metres, in some arithmetic. To be `#[inline(always)]`.
    fn at<A: Arithmetic>(q: &[Real; N], sin_cos: impl SinCos<M>) -> Output;
}

/// The spatial Jacobian by itself.
pub struct SpatialJacobian<const N: usize>(pub Jacobian<N>);

/// The body Jacobian.
pub struct BodyJacobian<const N: usize>(pub Jacobian<N>);

/// The geometric Jacobian.
pub struct GeometricJacobian<const N: usize>(pub Jacobian<N>);

/// What a robot computes of a configuration.
#[inline(always)]
pub fn evaluate<R, Output, const N: usize, const M: usize>(_: &R, q: &[Real; N]) -> Output
where
    R: Forward<Output, N, M>,
{
    dispatch::<Alone<R, Output, M>, _>(q)
}

/// One configuration. Its sines are in vectors of AVX2, and the rest has none; of AVX-512 it takes
/// the registers, of which it fills more than sixteen.
struct Alone<R, Output, const M: usize>(PhantomData<(R, Output)>);

impl<R, Output, const N: usize, const M: usize> Dispatched<&[Real; N]> for Alone<R, Output, M>
where
    R: Forward<Output, N, M>,
{
    type Output = Output;

    #[inline(always)]
    fn run<const FUSED: bool>(q: &[Real; N]) -> Output {
        R::at::<Fused<FUSED>>(q, SideBySide::<FUSED>)
    }
}
