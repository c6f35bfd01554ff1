//! Harmonics that are polynomials of the parameter on a piece of it, between −1 and 1.

use super::patch::{COEFFICIENTS, POINTS};
use crate::math;
use core::f64::consts::PI;

/// Factors that are divided by, at most.
const FACTORS: usize = 6;
/// What is divided by such a factor has more noise by this.
const DEFLATED: f64 = 4.0;
/// Steps of the Gauss-Newton method, and how far beyond the piece it goes.
const STEPS: usize = 16;
const BEYOND: f64 = 0.05;

/// Harmonics by Chebyshev point, or by coefficient.
pub(super) type Table = [[f64; COEFFICIENTS]; POINTS];

/// A Chebyshev point.
pub(super) fn point(j: usize) -> f64 {
    math::sin_cos(PI * (j as f64 + 0.5) / POINTS as f64).1
}

/// From values at Chebyshev points to coefficients of Chebyshev polynomials.
pub(super) fn chebyshev(values: &Table) -> Table {
    let mut out = [[0.0; COEFFICIENTS]; POINTS];
    for (k, out) in out.iter_mut().enumerate() {
        let weight = if k == 0 { 1.0 } else { 2.0 } / POINTS as f64;
        for (j, row) in values.iter().enumerate() {
            let angle = PI * (k * (2 * j + 1)) as f64 / (2 * POINTS) as f64;
            let share = weight * math::sin_cos(angle).1;
            for (to, from) in out.iter_mut().zip(row) {
                *to += share * from;
            }
        }
    }
    out
}

/// Divided by what all harmonics have in common, and how far the quotients are off, of harmonics
/// that are off by `noise`.
///
/// Where an elimination fails at a value of the parameter, its polynomial vanishes there for all
/// values of the kept joint, and says nothing of solutions.
pub(super) fn without_factors(mut coefficients: Table, mut noise: f64) -> (Table, f64) {
    for _ in 0..FACTORS {
        let Some(root) = common_root(&coefficients, noise) else {
            break;
        };
        coefficients = deflated(&coefficients, root);
        noise *= DEFLATED;
    }
    (coefficients, noise)
}

/// Where all harmonics vanish: between −1 and 1, by the Gauss-Newton method from the least of
/// their values at some places.
fn common_root(coefficients: &Table, zero: f64) -> Option<f64> {
    let at = |x: f64| {
        let (mut square, mut slope, mut steepness) = (0.0, 0.0, 0.0);
        for [value, rise] in values(coefficients, x) {
            square += value * value;
            slope += value * rise;
            steepness += rise * rise;
        }
        (square, slope, steepness)
    };
    const PLACES: usize = 4 * POINTS;
    let place = |i: usize| -1.0 + 2.0 * i as f64 / PLACES as f64;
    let squares: [f64; PLACES + 1] = core::array::from_fn(|i| at(place(i)).0);
    let least = |i: &usize| {
        let beside = |j: Option<&f64>| j.is_none_or(|&other| squares[*i] <= other);
        beside(squares[..*i].last()) && beside(squares.get(i + 1))
    };
    (0..=PLACES).filter(least).find_map(|i| {
        let mut x = place(i);
        for _ in 0..STEPS {
            let (square, slope, steepness) = at(x);
            if square <= zero * zero {
                return Some(x);
            }
            x -= slope / steepness;
            if x.is_nan() || x.abs() > 1.0 + BEYOND {
                return None;
            }
        }
        None
    })
}

/// The harmonics at a place between −1 and 1, and their slopes there.
fn values(coefficients: &Table, x: f64) -> [[f64; 2]; COEFFICIENTS] {
    let mut out = [[0.0; 2]; COEFFICIENTS];
    let (mut t, mut before) = ([1.0, 0.0], [x, 1.0]);
    for row in coefficients {
        for (out, c) in out.iter_mut().zip(row) {
            *out = [out[0] + c * t[0], out[1] + c * t[1]];
        }
        let next = [
            2.0 * x * t[0] - before[0],
            2.0 * (t[0] + x * t[1]) - before[1],
        ];
        (before, t) = (t, next);
    }
    out
}

/// Divided by x − `root`, which is what they have in common, by the recurrence of Clenshaw.
fn deflated(coefficients: &Table, root: f64) -> Table {
    let mut out = [[0.0; COEFFICIENTS]; POINTS];
    for h in 0..COEFFICIENTS {
        let (mut a, mut b) = (0.0, 0.0);
        for k in (1..POINTS).rev() {
            (a, b) = (coefficients[k][h] + 2.0 * root * a - b, a);
            out[k - 1][h] = if k == 1 { a } else { 2.0 * a };
        }
    }
    out
}

/// By coefficient in Bernstein's basis, what Chebyshev polynomials give to it:
/// Tₖ = Σᵢ (−1)ᵏ⁻ⁱ C(2k, 2i) / C(k, i) Bᵢᵏ, raised to the highest degree.
pub(super) fn bernstein() -> [[f64; POINTS]; POINTS] {
    let mut out = [[0.0; POINTS]; POINTS];
    for k in 0..POINTS {
        let mut own = [0.0; POINTS];
        let mut term = if k % 2 == 0 { 1.0 } else { -1.0 };
        for (i, own) in own[..=k].iter_mut().enumerate() {
            *own = term;
            // C(2k, 2i + 2) / C(2k, 2i) by C(k, i + 1) / C(k, i).
            term *= -((2 * (k - i)) as f64 - 1.0) / (2 * i + 1) as f64;
        }
        for degree in k + 1..POINTS {
            for i in (0..=degree).rev() {
                let share = i as f64 / degree as f64;
                let before = if i == 0 { 0.0 } else { own[i - 1] };
                own[i] = share * before + (1.0 - share) * own[i];
            }
        }
        for (i, own) in own.into_iter().enumerate() {
            out[i][k] = own;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Two harmonics, which are these functions.
    fn of(f: impl Fn(f64) -> [f64; 2]) -> Table {
        let mut table = [[0.0; COEFFICIENTS]; POINTS];
        for (j, row) in table.iter_mut().enumerate() {
            row[..2].copy_from_slice(&f(point(j)));
        }
        chebyshev(&table)
    }

    #[track_caller]
    fn assert_is(table: &Table, f: impl Fn(f64) -> [f64; 2]) {
        for x in [-1.0, -0.3, 0.0, 0.62, 1.0] {
            let (found, expected) = (values(table, x), f(x));
            for h in 0..2 {
                assert!((found[h][0] - expected[h]).abs() < 1e-12, "{found:?}");
            }
        }
    }

    #[test]
    fn factors_in_common_are_divided_by() {
        let both = |x: f64| [1.3 + x * x, 0.4 + x * x * x];
        for roots in [[0.31, -0.75], [0.31, 0.31]] {
            let factor = |x: f64| (x - roots[0]) * (x - roots[1]);
            let table = of(|x| both(x).map(|y| y * factor(x)));
            let (divided, noise) = without_factors(table, 1e-11);
            assert_eq!(noise, 16.0 * 1e-11);
            let near = |x: f64| values(&divided, x).map(|y| y[0]);
            for x in [-0.9, 0.1, 0.8] {
                for h in 0..2 {
                    assert!((near(x)[h] - both(x)[h]).abs() < 1e-4, "{roots:?} {x}");
                }
            }
        }
        // One of them has a zero of its own, and so has the other.
        let own = |x: f64| [x - 0.2, x + 0.2];
        let (same, noise) = without_factors(of(own), 1e-11);
        assert_eq!(noise, 1e-11);
        assert_is(&same, own);
    }

    #[test]
    fn bernstein_has_the_same_polynomial() {
        let f = |x: f64| x.exp() - x * x;
        let table = of(|x| [f(x), 0.0]);
        let coefficients: Vec<f64> = bernstein()
            .iter()
            .map(|own| own.iter().zip(&table).map(|(a, row)| a * row[0]).sum())
            .collect();
        // By de Casteljau's algorithm.
        for share in [0.0, 0.21, 0.5, 1.0] {
            let mut c = coefficients.clone();
            while c.len() > 1 {
                c = c.windows(2).map(|x| x[0] + share * (x[1] - x[0])).collect();
            }
            assert!((c[0] - f(2.0 * share - 1.0)).abs() < 1e-9, "{c:?}");
        }
    }
}
