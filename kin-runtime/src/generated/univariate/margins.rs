//! How far the polynomial in the kept joint is from having more or fewer real roots.
//!
//! With z = e^{iθ} it is one of degree 2n in z whose roots are on the unit circle, where θ is
//! real, or come in pairs z, 1/z̄ on both sides of it. As the target changes, a pair meets on
//! the circle and parts along it: two solutions more.

use super::Univariate;
use super::harmonics::{DEGREE, Harmonics};
use super::polynomial::polynomial;
use super::recover::Recovery;
use super::search::Search;
use crate::{Pose, math};

/// Rounds of Aberth's iteration at most.
const ROUNDS: usize = 40;
/// Changes of a root, relative to its size, of which the cube is rounding.
const STILL: f64 = 1e-9;
/// Roots whose angle has a smaller imaginary part are real: half the digits of a double root.
const REAL: f64 = 1e-6;
/// The margin of a pair that is real.
const NONE: f64 = 1.0;

type Complex = [f64; 2];

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

fn over(a: Complex, [c, d]: Complex) -> Complex {
    let square = c * c + d * d;
    times(a, [c / square, -d / square])
}

impl Univariate<'_> {
    /// By pair of roots of the first elimination's polynomial, minus the square of the imaginary
    /// part of their angles, and 1 where these are real. The pair that is farthest from real
    /// comes first, so that every entry is continuous as long as it is negative.
    pub fn margins(&self, target: &Pose) -> Option<[f64; 16]> {
        let elimination = self.eliminations.first()?;
        let search = Search::new(self, target);
        let recovery = Recovery::new(elimination, &self.frames, search.target());
        let f = polynomial(elimination, &recovery.equations);
        f.noise.is_finite().then(|| margins(&f))
    }
}

fn margins(f: &Harmonics) -> [f64; 16] {
    let mut beside = [0.0; 2 * DEGREE];
    let mut away = 0;
    for &[x, y] in &roots(f)[..2 * f.degree] {
        let imaginary = 0.5 * libm::log(x * x + y * y);
        if imaginary.abs() > REAL {
            beside[away] = imaginary * imaginary;
            away += 1;
        }
    }
    let beside = &mut beside[..away];
    beside.sort_unstable_by(|a, b| b.total_cmp(a));
    let mut out = [NONE; 16];
    for (out, pair) in out.iter_mut().zip(beside.chunks_exact(2)) {
        *out = -pair[0];
    }
    out
}

/// All roots in z, by Aberth's iteration (O. Aberth, "Iteration methods for finding all zeros of
/// a polynomial simultaneously", Mathematics of Computation 27, 1973).
fn roots(f: &Harmonics) -> [Complex; 2 * DEGREE] {
    let n = 2 * f.degree;
    let mut coefficients = [[0.0; 2]; 2 * DEGREE + 1];
    coefficients[f.degree] = [f.cosines[0], 0.0];
    for k in 1..=f.degree {
        let (a, b) = (0.5 * f.cosines[k], 0.5 * f.sines[k]);
        coefficients[f.degree + k] = [a, -b];
        coefficients[f.degree - k] = [a, b];
    }
    let coefficients = &coefficients[..=n];
    let mut z: [Complex; 2 * DEGREE] = core::array::from_fn(|i| {
        let (sin, cos) = math::sin_cos(0.4 + i as f64 * core::f64::consts::PI / f.degree as f64);
        let radius = if i % 2 == 0 { 0.8 } else { 1.25 };
        [radius * cos, radius * sin]
    });
    for _ in 0..ROUNDS {
        let mut moved: f64 = 0.0;
        for i in 0..n {
            let step = step(coefficients, &z[..n], i);
            z[i] = [z[i][0] - step[0], z[i][1] - step[1]];
            let change = step[0].abs() + step[1].abs();
            moved = math::max(moved, change / (1.0 + z[i][0].abs() + z[i][1].abs()));
        }
        if moved < STILL || moved.is_nan() {
            break;
        }
    }
    z
}

/// Newton's step of a root, kept away from the others.
fn step(coefficients: &[Complex], z: &[Complex], i: usize) -> Complex {
    let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
    for c in coefficients.iter().rev() {
        let next = times(slope, z[i]);
        slope = [next[0] + value[0], next[1] + value[1]];
        let next = times(value, z[i]);
        value = [next[0] + c[0], next[1] + c[1]];
    }
    if value == [0.0; 2] {
        return [0.0; 2];
    }
    let newton = over(value, slope);
    let mut away = [0.0; 2];
    for (j, other) in z.iter().enumerate() {
        if j != i {
            let apart = over([1.0, 0.0], [z[i][0] - other[0], z[i][1] - other[1]]);
            away = [away[0] + apart[0], away[1] + apart[1]];
        }
    }
    let kept = times(newton, away);
    over(newton, [1.0 - kept[0], -kept[1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generated::univariate::harmonics::samples;
    use core::f64::consts::TAU;

    fn of(degree: usize, f: impl Fn(f64) -> f64) -> [f64; 16] {
        let mut values = [0.0; 32];
        let n = samples(degree);
        for (i, value) in values[..n].iter_mut().enumerate() {
            *value = f(TAU * i as f64 / n as f64);
        }
        margins(&Harmonics::new(degree, &values[..n]))
    }

    /// cos 2θ = c has four real roots for |c| < 1, and two pairs with imaginary part
    /// arcosh(c) / 2 beyond.
    #[test]
    fn margins_tell_how_far_roots_are_from_real() {
        let far = of(2, |x| (2.0 * x).cos() - 1.5);
        let expected = (0.5 * 1.5_f64.acosh()).powi(2);
        assert!(
            (far[0] + expected).abs() < 1e-9 && (far[1] + expected).abs() < 1e-9,
            "{far:?}"
        );
        assert_eq!(of(2, |x| (2.0 * x).cos() - 0.5), [NONE; 16]);
        // Linear in what moves the roots, to the first order.
        for by in [1e-3, 1e-4] {
            let out = of(2, |x| (2.0 * x).cos() - 1.0 - by)[0];
            assert!((out + 0.5 * by).abs() < by * by, "{out}");
        }
    }

    #[test]
    fn the_pair_that_is_farthest_from_real_comes_first() {
        // Three pairs beside the circle, and two real roots.
        let f = |x: f64| {
            (1.3 - x.cos()) * (2.0 - (x - 1.0).cos()) * (1.1 - (x - 2.0).cos()) * (x - 3.0).sin()
        };
        let found = of(4, f);
        for (found, c) in found.iter().zip([2.0_f64, 1.3, 1.1]) {
            assert!((found + c.acosh().powi(2)).abs() < 1e-8, "{found} {c}");
        }
        assert_eq!(found[3], NONE);
    }
}
