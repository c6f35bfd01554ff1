//! Sines and cosines of parts of a turn, as constants.

use core::f64::consts::TAU;

/// cos 2πi/n, correctly rounded but for a unit in the last place; n is a
/// multiple of 8.
pub const fn cosine_of_turn(i: usize, n: usize) -> f64 {
    let i = i % n;
    let octant = n / 8;
    match i / octant {
        0 => cosine(i, n),
        1 => sine(2 * octant - i, n),
        2 => -sine(i - 2 * octant, n),
        3 => -cosine(4 * octant - i, n),
        _ if i == n / 2 => -1.0,
        _ => cosine_of_turn(n - i, n),
    }
}

/// sin 2πi/n.
pub(super) const fn sine_of_turn(i: usize, n: usize) -> f64 {
    cosine_of_turn(i + 3 * n / 4, n)
}

/// Taylor's series up to an eighth of a turn.
const fn cosine(i: usize, n: usize) -> f64 {
    let x = TAU * i as f64 / n as f64;
    let mut sum = 1.0;
    let mut k = 20;
    while k > 0 {
        sum = 1.0 - sum * x * x / (k * (k - 1)) as f64;
        k -= 2;
    }
    sum
}

const fn sine(i: usize, n: usize) -> f64 {
    let x = TAU * i as f64 / n as f64;
    let mut sum = 1.0;
    let mut k = 20;
    while k > 0 {
        sum = 1.0 - sum * x * x / (k * (k + 1)) as f64;
        k -= 2;
    }
    x * sum
}
