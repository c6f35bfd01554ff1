//! Complex numbers, as real and imaginary part.

use super::lanes::Lanes;

pub(super) type Complex = [f64; 2];

/// Of the absolute value.
pub(super) fn square([re, im]: Complex) -> f64 {
    re * re + im * im
}

pub(super) fn conjugate([re, im]: Complex) -> Complex {
    [re, -im]
}

pub(super) fn product(x: Complex, y: Complex) -> Complex {
    plus([0.0; 2], x, y)
}

/// The same in lanes.
#[inline(always)]
pub(super) fn product_of<L: Lanes>([a, b]: [L; 2], [c, d]: [L; 2]) -> [L; 2] {
    [(a * c).minus(&b, &d), (a * d).plus(&b, &c)]
}

/// sum + x y.
pub(super) fn plus([re, im]: Complex, [a, b]: Complex, [c, d]: Complex) -> Complex {
    [re + a * c - b * d, im + a * d + b * c]
}

/// sum − x y.
pub(super) fn minus(sum: Complex, x: Complex, y: Complex) -> Complex {
    plus(sum, x.map(|x| -x), y)
}
