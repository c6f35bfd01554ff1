//! A polynomial in two variables on a rectangle, in Bernstein's basis.
//!
//! All its values are between the least and the largest coefficient, and of its derivatives the
//! same is true of differences of coefficients
//! (G. Farin, *Curves and Surfaces for CAGD*, 2002, chapters 5 and 14).

use super::signs::Signs;
use crate::__private::Eliminant;

/// Coefficients along the parameter.
pub(super) const POINTS: usize = 12;
/// Coefficients along the kept joint, at most.
pub(super) const COEFFICIENTS: usize = Eliminant::HARMONICS;

/// Steps of Newton's method.
const STEPS: usize = 12;
/// A step that is shorter than this is the last, as a share of the rectangle.
const STILL: f64 = 1e-9;
/// How far beyond the rectangle it goes on, as a share.
const BEYOND: f64 = 0.5;
/// What rows count for at shares of the side along s: those at which h is looked at.
const PLACES: [[f64; POINTS]; 5] = [basis(0.5), basis(0.0), basis(1.0), basis(0.25), basis(0.75)];
/// Beyond the rectangle by this share is on it.
const SLACK: f64 = 1e-3;

/// g(s, t) on a rectangle.
#[derive(Clone, Copy)]
pub(super) struct Patch {
    /// By powers of s, those of t, of which so many count.
    pub rows: [[f64; COEFFICIENTS]; POINTS],
    pub count: usize,
    pub s: [f64; 2],
    pub t: [f64; 2],
    /// What its sides are of those of the rectangle that it is part of.
    pub shares: [f64; 2],
    /// How far the coefficients on that are off by rounding, and so values on this.
    pub noise: f64,
}

/// What a rectangle has of places where g = ∂g/∂t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Folds {
    /// None.
    None,
    /// One, at this s.
    One(f64),
    /// Two that rounding does not tell from one that is none: here curves cross, or are about to
    /// begin or end.
    Touching(f64),
    /// That is told by halves.
    Unknown,
}

impl Patch {
    /// None, if g or its slope along t has no zero. Where it is bent one way along t, the slope
    /// vanishes on a curve t(s), and folds are the zeros of h(s) = g(s, t(s)): one at most if g
    /// goes one way along s. As h'' ∂²g/∂t² is the determinant of second derivatives, h is bent
    /// one way if that has one sign, and its extremum tells whether it has zeros.
    pub fn folds(&self) -> Folds {
        // What differences of coefficients are off by is shared out among parts of a rectangle.
        let (noise, along_t) = (self.noise, self.shares[1]);
        let rows = self.rows.each_ref().map(|row| &row[..self.count]);
        let is_one = |of: fn(&[f64]) -> Signs, noise: f64| {
            let mut signs = Signs::NONE;
            // The first row that says otherwise ends it.
            let mut each = rows.iter().map(|row| {
                signs = signs.with(of(row));
                signs.is_one(noise)
            });
            each.all(|one| one)
        };
        if is_one(Signs::of, noise) || is_one(Signs::of_slope, 2.0 * noise * along_t) {
            return Folds::None;
        }
        match is_one(Signs::of_bend, 4.0 * noise * along_t * along_t) {
            true => self.folds_of_bent(),
            false => Folds::Unknown,
        }
    }

    fn folds_of_bent(&self) -> Folds {
        let bends = self
            .rows
            .iter()
            .map(|row| Signs::of_bend(&row[..self.count]));
        let bend = bends.fold(Signs::NONE, Signs::with);
        let [mut rate, mut twist, mut growth] = [Signs::NONE; 3];
        for i in 1..POINTS {
            for k in 0..self.count {
                let by = |i: usize, k: usize| self.rows[i][k] - self.rows[i - 1][k];
                rate.add(by(i, k));
                if k > 0 {
                    twist.add(by(i, k) - by(i, k - 1));
                }
                if i > 1 {
                    growth.add(by(i, k) - by(i - 1, k));
                }
            }
        }
        if rate.is_one(2.0 * self.noise * self.shares[0]) {
            let found = self.newton(|[[g, by_t, by_tt], [by_s, by_st, _], _]| {
                ([*g, *by_t], [[*by_s, *by_t], [*by_st, *by_tt]])
            });
            return found.map_or_else(|| self.undecided(), |(s, _)| Folds::One(s));
        }
        let [p, n] = [POINTS - 1, self.count - 1].map(|degree| degree as f64);
        let growth = growth.scaled(p * (p - 1.0));
        let bend = bend.scaled(n * (n - 1.0));
        let twist = twist.scaled(p * n);
        let Some(sign) = growth.times(bend).minus(twist.square()).sign() else {
            return self.undecided();
        };
        let steady = self.newton(|[[_, by_t, by_tt], [by_s, by_st, _], [by_ss, ..]]| {
            ([*by_s, *by_t], [[*by_ss, *by_st], [*by_st, *by_tt]])
        });
        match steady {
            Some((s, g)) if g.abs() <= self.noise => Folds::Touching(s),
            Some((_, g)) if g * sign * bend.least > 0.0 => Folds::None,
            _ => Folds::Unknown,
        }
    }

    /// Where h is rounding at all places, two solutions have the same θ, or nearly, at all s, as
    /// those of an arm do whose file rounds a closed form away: halves tell no more of them.
    fn undecided(&self) -> Folds {
        let mut is_seen = false;
        let is_rounding = PLACES.iter().all(|place| {
            let h = self.height(place);
            is_seen |= h.is_some();
            h.is_none_or(|h| h.abs() <= self.noise)
        });
        match is_rounding && is_seen {
            true => Folds::Touching(0.5 * (self.s[0] + self.s[1])),
            false => Folds::Unknown,
        }
    }

    /// h where rows count for so much; none if t(s) is beyond the rectangle.
    fn height(&self, shares: &[f64; POINTS]) -> Option<f64> {
        let mut row = [0.0; COEFFICIENTS];
        for (share, own) in shares.iter().zip(&self.rows) {
            for (x, own) in row.iter_mut().zip(own).take(self.count) {
                *x += share * own;
            }
        }
        let mut t = 0.5;
        for _ in 0..STEPS {
            let [g, by_t, by_tt] = jet(&row[..self.count], t);
            let step = by_t / by_tt;
            t -= step;
            if !(-BEYOND..=1.0 + BEYOND).contains(&t) {
                return None;
            }
            if step.abs() < STILL {
                return Some(g);
            }
        }
        None
    }

    /// Newton's method from the middle for two functions of what [`Self::jet`] gives, with
    /// their derivatives by s and t; s and g, if it gets to a zero on the rectangle.
    fn newton(
        &self,
        functions: impl Fn(&[[f64; 3]; 3]) -> ([f64; 2], [[f64; 2]; 2]),
    ) -> Option<(f64, f64)> {
        let mut at = [0.5; 2];
        for _ in 0..STEPS {
            let jet = self.jet(at);
            let ([f, g], [[a, b], [c, d]]) = functions(&jet);
            let determinant = a * d - b * c;
            let step = [(d * f - b * g) / determinant, (a * g - c * f) / determinant];
            at = [at[0] - step[0], at[1] - step[1]];
            if !at.iter().all(|x| (-BEYOND..=1.0 + BEYOND).contains(x)) {
                return None;
            }
            if step.iter().all(|x| x.abs() < STILL) {
                let inside = |x: &f64| (-SLACK..=1.0 + SLACK).contains(x);
                let s = self.s[0] + at[0] * (self.s[1] - self.s[0]);
                return at.iter().all(inside).then_some((s, jet[0][0]));
            }
        }
        None
    }

    /// g and its derivatives at shares of the sides, up to the second by each: those by s by row.
    fn jet(&self, [s, t]: [f64; 2]) -> [[f64; 3]; 3] {
        let mut columns = [[0.0; POINTS]; 3];
        for (i, row) in self.rows.iter().enumerate() {
            let along: [f64; 3] = jet(&row[..self.count], t);
            for (column, x) in columns.iter_mut().zip(along) {
                column[i] = x;
            }
        }
        let along = columns.map(|column| jet(&column, s));
        core::array::from_fn(|i| along.map(|column| column[i]))
    }
}

/// Bernstein's polynomials at a share of their interval.
const fn basis(at: f64) -> [f64; POINTS] {
    let mut out = [0.0; POINTS];
    out[0] = 1.0;
    let mut degree = 1;
    while degree < POINTS {
        let mut i = degree;
        while i > 0 {
            out[i] = at * out[i - 1] + (1.0 - at) * out[i];
            i -= 1;
        }
        out[0] *= 1.0 - at;
        degree += 1;
    }
    out
}

/// A polynomial by its coefficients, at a share of its interval, with its first two derivatives.
fn jet(coefficients: &[f64], at: f64) -> [f64; 3] {
    let mut c = [0.0; COEFFICIENTS];
    let count = coefficients.len();
    c[..count].copy_from_slice(coefficients);
    for last in (3..count).rev() {
        for j in 0..last {
            c[j] += at * (c[j + 1] - c[j]);
        }
    }
    let degree = (count - 1) as f64;
    let [a, b] = [c[1] - c[0], c[2] - c[1]];
    let [x, y] = [c[0] + at * a, c[1] + at * b];
    [
        x + at * (y - x),
        degree * (y - x),
        degree * (degree - 1.0) * (b - a),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::chebyshev::{bernstein, chebyshev, point};
    use super::*;
    use alloc::vec::Vec;

    /// A polynomial of degree 2 in t on −1 < t < 1, whose coefficients are functions of s there.
    fn of(f: impl Fn(f64) -> [f64; 3], noise: f64) -> Patch {
        let mut table = [[0.0; COEFFICIENTS]; POINTS];
        for (j, row) in table.iter_mut().enumerate() {
            let [c, b, a] = f(point(j));
            row[..3].copy_from_slice(&[c - b + a, c - a, c + b + a]);
        }
        let table = chebyshev(&table);
        let mut rows = [[0.0; COEFFICIENTS]; POINTS];
        for (row, own) in rows.iter_mut().zip(bernstein()) {
            for (share, from) in own.iter().zip(&table) {
                row.iter_mut()
                    .zip(from)
                    .for_each(|(to, x)| *to += share * x);
            }
        }
        Patch {
            rows,
            count: 3,
            s: [-1.0, 1.0],
            t: [-1.0, 1.0],
            shares: [1.0; 2],
            noise,
        }
    }

    /// Folds, and where there may be two, on a rectangle and its parts.
    fn all(patch: Patch) -> [Vec<f64>; 2] {
        let (mut folds, mut touching, mut waiting) = (Vec::new(), Vec::new(), alloc::vec![patch]);
        while let Some(patch) = waiting.pop() {
            match patch.folds() {
                Folds::None => {}
                Folds::One(s) => folds.push(s),
                Folds::Touching(s) => touching.push(s),
                Folds::Unknown => waiting.extend(patch.halves([1e-9; 2]).unwrap()),
            }
        }
        folds.sort_by(f64::total_cmp);
        // On an edge it is one of both sides.
        folds.dedup_by(|a, b| *a - *b < 1e-9);
        [folds, touching]
    }

    /// (s − 0.1)² + (t − 0.2 s)² = r², and the hyperbola beside it.
    #[test]
    fn ovals_and_gaps_have_two_folds_however_small_they_are() {
        for radius in [0.3, 1e-2, 1e-4] {
            for sign in [1.0, -1.0] {
                let f = |s: f64| {
                    let square = (s - 0.1) * (s - 0.1) - radius * radius;
                    [sign * square + 0.04 * s * s, -0.4 * s, 1.0]
                };
                let [folds, touching] = all(of(f, 1e-13));
                let expected = [0.1 - radius, 0.1 + radius];
                assert!(touching.is_empty(), "{touching:?}");
                assert_eq!(folds.len(), 2, "{radius} {sign}: {folds:?}");
                for (found, expected) in folds.iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-8 * (1.0 + 1e-4 / radius));
                }
            }
        }
    }

    #[test]
    fn curves_that_cross_have_none() {
        let f = |s: f64| {
            let (a, b) = (0.4 + s.sin(), 0.3 - 0.7 * s);
            [a * b, -a - b, 1.0]
        };
        let [folds, touching] = all(of(f, 1e-11));
        assert!(
            folds.is_empty() && touching.len() == 1,
            "{folds:?} {touching:?}"
        );
        let s: f64 = touching[0];
        assert!((0.4 + s.sin() - 0.3 + 0.7 * s).abs() < 1e-6, "{s}");
    }

    /// Both solutions of a rounded closed form, all along: halves would go on to the shortest.
    #[test]
    fn curves_that_are_double_are_not_followed() {
        for apart in [0.0, 1e-6] {
            let f = |s: f64| {
                let t = 0.1 + 0.2 * s + 0.3 * s * s * s;
                [(t - apart) * (t + apart), -2.0 * t, 1.0]
            };
            let (mut looked_at, mut touching) = (0, 0);
            let mut waiting = alloc::vec![of(f, 1e-11)];
            while let Some(patch) = waiting.pop() {
                looked_at += 1;
                match patch.folds() {
                    Folds::Unknown => waiting.extend(patch.halves([1e-4; 2]).unwrap()),
                    Folds::One(s) => panic!("{s}"),
                    found => touching += usize::from(found != Folds::None),
                }
            }
            assert!(touching > 0 && looked_at < 200, "{touching} of {looked_at}");
        }
    }

    /// A branch that does not turn, two that stay apart, and none.
    #[test]
    fn other_curves_have_none() {
        for f in [
            |s: f64| [s.cos() - 0.6, -1.0, 0.3],
            |s: f64| [-0.1 - s * s, 0.2, 1.0],
            |s: f64| [0.1 + s * s, 0.2, 1.0],
        ] {
            assert_eq!(all(of(f, 1e-12)), [const { Vec::new() }; 2]);
        }
    }
}
