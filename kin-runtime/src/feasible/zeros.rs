//! All zeros of an analytic function on an interval.
//!
//! The function is replaced by the polynomial through its values at Chebyshev points, on pieces
//! so short that the polynomial is the function to nine digits, as its last coefficients tell
//! (L. N. Trefethen, *Approximation Theory and Approximation Practice*, 2013, chapters 3, 4 and
//! 18). Of that the second derivative is bounded by its coefficients, and so every part of a
//! piece has, in the end, no zero or one.

use super::false_position::{Sample, false_position};
use super::interpolant::{Cosines, POINTS, Polynomial};
use crate::math;
use crate::scalar::golden_section::GoldenSection;
use alloc::collections::VecDeque;
use alloc::vec::Vec;
use core::f64::consts::PI;

/// The last three coefficients of a polynomial that is the function, relative to its values.
const RESOLVED: f64 = 1e-9;
/// The same at its ends, which are no points of its own.
const AT_ENDS: f64 = 1e-7;
/// What rounding may leave of them.
const NOISE: f64 = 1e-12;
/// Last coefficients below this, relative to values, are noise where those of a piece twice as
/// long were not larger by more than this factor.
const NOISY: f64 = 1e-6;
const STAYS: f64 = 0.7;
/// Halvings of a piece at most: at a kink.
const HALVINGS: u32 = 18;
/// Pieces that are halved at most, wide ones first: where the function is rounding, and at poles.
const HALVED: u32 = 96;
/// Halvings of a part between two points at most; two zeros in what is left are looked for by
/// the function itself.
const PARTS: u32 = 8;
/// Values below this are rounding.
const ROUNDING: f64 = 1e-13;
/// An extremum nearer to zero than this may be one, but for rounding.
const TOUCHING: f64 = 1e-9;
/// Golden-section steps towards an extremum.
const EXTREMUM: usize = 30;
/// Over which differences are derivatives.
const DISTANCE: f64 = 5e-3;

/// Where a function is zero.
#[derive(Debug, Default)]
pub(super) struct Zeros {
    /// Where it changes its sign, ascending.
    pub crossing: Vec<f64>,
    /// Where it comes so near to zero, and goes back, that rounding may keep it from getting there.
    pub touching: Vec<f64>,
}

/// The zeros of a function between `from` and `to`, looked for on so many pieces to begin with.
pub(super) fn zeros(
    cosines: &Cosines,
    f: &dyn Fn(f64) -> f64,
    from: f64,
    to: f64,
    pieces: usize,
) -> Zeros {
    let mut search = Search {
        cosines,
        f,
        found: Zeros::default(),
        waiting: VecDeque::new(),
        halved: 0,
    };
    let end = |i: usize| from + (to - from) * i as f64 / pieces as f64;
    let mut before = (from, f(from));
    for i in 1..=pieces {
        let next = (end(i), f(end(i)));
        search.waiting.push_back(Piece {
            ends: [before, next],
            halvings: HALVINGS,
            left: f64::INFINITY,
        });
        before = next;
    }
    while let Some(piece) = search.waiting.pop_front() {
        search.piece(piece);
    }
    search.found.crossing.sort_by(f64::total_cmp);
    search.found
}

/// A piece that is looked at.
struct Piece {
    ends: [Sample; 2],
    /// How often it may be halved.
    halvings: u32,
    /// What was left in the last coefficients of the piece that it is a half of.
    left: f64,
}

struct Search<'a> {
    cosines: &'a Cosines,
    f: &'a dyn Fn(f64) -> f64,
    found: Zeros,
    /// The widest first.
    waiting: VecDeque<Piece>,
    /// How many pieces were halved.
    halved: u32,
}

impl Search<'_> {
    fn piece(&mut self, piece: Piece) {
        let [from, to] = piece.ends;
        let (middle, half) = (0.5 * (from.0 + to.0), 0.5 * (to.0 - from.0));
        // From `from` to `to`: θ falls from π to 0.
        let place = |theta: f64| middle + half * math::sin_cos(theta).1;
        let theta = |j: usize| PI * (j as f64 + 0.5) / POINTS as f64;
        let values: [f64; POINTS] =
            core::array::from_fn(|j| (self.f)(middle + half * self.cosines.at(1, j)));
        let largest = values.iter().fold(0.0, |a, x| math::max(a, x.abs()));
        if largest < ROUNDING {
            return;
        }
        let polynomial = Polynomial::through(self.cosines, &values);
        let tail = &polynomial.coefficients[POINTS - 3..];
        let off_ends = [(PI, from.1), (0.0, to.1)];
        let off_ends = off_ends.map(|(theta, value)| (polynomial.at(theta) - value).abs());
        let left = tail.iter().fold(0.0, |most, c| math::max(most, c.abs()));
        // What halving does not lessen is noise, next to singular configurations.
        let is_noise = left <= NOISY * largest && left > STAYS * piece.left;
        let is_resolved = (left <= RESOLVED * largest + NOISE || is_noise)
            && off_ends
                .iter()
                .all(|off| *off <= AT_ENDS * largest + NOISE + 10.0 * left);
        if !is_resolved && piece.halvings > 0 && self.halved < HALVED {
            self.halved += 1;
            let middle = (middle, (self.f)(middle));
            let halves = [[from, middle], [middle, to]];
            self.waiting.extend(halves.map(|ends| Piece {
                ends,
                halvings: piece.halvings - 1,
                left,
            }));
            return;
        }
        let mut before = (PI, from.1);
        let inner = (0..POINTS).rev().map(|j| (theta(j), values[j]));
        for next in inner.chain([(0.0, to.1)]) {
            // What is no polynomial has a zero where its values change their sign.
            if is_resolved {
                self.part(&polynomial, &place, before, next, PARTS);
            } else if (before.1 < 0.0) != (next.1 < 0.0) {
                self.look(place(before.0), place(next.0));
            }
            before = next;
        }
    }

    /// The part of a piece between two values of θ, with the values there.
    fn part(
        &mut self,
        polynomial: &Polynomial,
        place: &dyn Fn(f64) -> f64,
        from: Sample,
        to: Sample,
        halvings: u32,
    ) {
        let width = from.0 - to.0;
        let bend = width * width * polynomial.bend;
        let changes = (from.1 < 0.0) != (to.1 < 0.0);
        let is_settled = match changes {
            // By the slope of the chord, which the function has somewhere.
            true => (from.1 - to.1).abs() > bend,
            // By how far it may be from the chord.
            false => math::max(-from.1.abs(), -to.1.abs()) < -0.125 * bend,
        };
        if !is_settled && halvings > 0 {
            let middle = 0.5 * (from.0 + to.0);
            let middle = (middle, polynomial.at(middle));
            self.part(polynomial, place, from, middle, halvings - 1);
            self.part(polynomial, place, middle, to, halvings - 1);
        } else if changes || !is_settled {
            self.look(place(from.0), place(to.0));
        }
    }

    /// The zero between two places, or the two.
    fn look(&mut self, from: f64, to: f64) {
        let ends = [from, to].map(|t| (t, (self.f)(t)));
        if (ends[0].1 < 0.0) != (ends[1].1 < 0.0) {
            let zero = false_position(self.f, ends[0], ends[1]);
            return self.found.crossing.push(zero);
        }
        match self.beyond(ends) {
            Ok(beyond) => {
                let both = [(ends[0], beyond), (beyond, ends[1])];
                let both = both.map(|(from, to)| false_position(self.f, from, to));
                self.found.crossing.extend(both);
            }
            Err(nearest) if (self.f)(nearest).abs() < TOUCHING => {
                let place = self.extremum(nearest);
                self.found.touching.push(place);
            }
            Err(_) => {}
        }
    }

    /// Where the function, which has the same sign at both ends, has the other one; otherwise
    /// where it is nearest to that.
    fn beyond(&self, [from, to]: [Sample; 2]) -> Result<Sample, f64> {
        let sign = if from.1 < 0.0 { 1.0 } else { -1.0 };
        let towards = |t: f64| sign * (self.f)(t);
        let mut section = GoldenSection::new(from.0, to.0, towards);
        for _ in 0..EXTREMUM {
            let (place, value) = section.best();
            if value > ROUNDING {
                return Ok((place, sign * value));
            }
            section.step(towards);
        }
        Err(section.best().0)
    }

    /// An extremum that values tell to the root of their rounding, by the zero of the derivative:
    /// differences over a distance at which rounding counts less.
    fn extremum(&self, near: f64) -> f64 {
        let at = |steps: f64| (self.f)(near + steps * DISTANCE);
        let [before, here, behind] = [at(-1.0), at(0.0), at(1.0)];
        let slope = (8.0 * (behind - before) - (at(2.0) - at(-2.0))) / (12.0 * DISTANCE);
        let bend = (before - 2.0 * here + behind) / (DISTANCE * DISTANCE);
        let step = slope / bend;
        match step.abs() < DISTANCE {
            true => near - step,
            false => near,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(f: &dyn Fn(f64) -> f64) -> Vec<f64> {
        zeros(&Cosines::new(), f, -1.0, 2.0, 2).crossing
    }

    #[track_caller]
    fn assert_are(found: &[f64], expected: &[f64]) {
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
        assert!(
            found.len() == expected.len() && found.iter().zip(expected).all(near),
            "{found:?} {expected:?}"
        );
    }

    #[test]
    fn zeros_of_waves_are_found() {
        let expected: Vec<f64> = (-9..=20).map(|k| 0.1 * f64::from(k) - 1e-4 / PI).collect();
        assert_are(&of(&|t| (10.0 * PI * t + 1e-3).sin()), &expected);
        assert!(of(&|t| t.cos() + 1.001).is_empty());
    }

    /// A bump that looks out of zero for so short a way that no point is near it.
    #[test]
    fn two_zeros_that_are_near_each_other_are_found() {
        for apart in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
            let (a, b) = (0.7123, 0.7123 + apart);
            for sign in [1.0, -1.0] {
                let f = |t: f64| sign * (t - a) * (t - b) * (1.5 + t.sin());
                let found = of(&f);
                assert_eq!(found.len(), 2, "{apart}");
                assert!((found[0] - a).abs() < 1e-9 && (found[1] - b).abs() < 1e-9);
            }
        }
    }

    /// Poles next to the interval, and a corner.
    #[test]
    fn steep_places_are_resolved() {
        let near = |t: f64| 1.0 / (1e-4 + (t - 0.3) * (t - 0.3)) - 5000.0;
        assert_are(&of(&near), &[0.29, 0.31]);
        assert_are(&of(&|t: f64| 0.01 - (t - 0.3).abs()), &[0.29, 0.31]);
    }

    /// Between the end of a piece and the first point of its polynomial.
    #[test]
    fn a_kink_at_an_end_is_seen() {
        for bend in [1e-3, 1e-5, 1e-6] {
            let f = |t: f64| (t - 0.5).abs() - bend;
            assert_are(&of(&f), &[0.5 - bend, 0.5 + bend]);
        }
    }

    #[test]
    fn where_zero_is_only_touched_is_told_apart() {
        for sign in [1.0, -1.0] {
            let f = |t: f64| sign * (t - 0.3) * (t - 0.3) * (1.5 + t.sin());
            let found = zeros(&Cosines::new(), &f, -1.0, 2.0, 2);
            assert!(found.crossing.is_empty(), "{found:?}");
            let is_there = |t: &f64| (t - 0.3).abs() < 1e-9;
            assert!(!found.touching.is_empty(), "{found:?}");
            assert!(found.touching.iter().all(is_there), "{found:?}");
        }
        let nothing = zeros(&Cosines::new(), &|_| 0.0, -1.0, 2.0, 2);
        assert!(nothing.crossing.is_empty() && nothing.touching.is_empty());
    }
}
