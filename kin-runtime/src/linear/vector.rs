//! Vectors as plain arrays.

use super::super::math;
use super::super::scalar::Real;

#[inline(always)]
pub(crate) fn add(a: [Real; 3], b: [Real; 3]) -> [Real; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn sub(a: [Real; 3], b: [Real; 3]) -> [Real; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn scale(k: Real, a: [Real; 3]) -> [Real; 3] {
    [k * a[0], k * a[1], k * a[2]]
}

#[inline(always)]
pub(crate) fn dot<const D: usize>(a: [Real; D], b: [Real; D]) -> Real {
    a.iter().zip(&b).map(|(x, y)| x * y).sum()
}

#[inline(always)]
pub(crate) fn cross(a: [Real; 3], b: [Real; 3]) -> [Real; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub(crate) fn norm<const D: usize>(a: [Real; D]) -> Real {
    math::sqrt(dot(a, a))
}
