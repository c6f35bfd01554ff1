//! The roots of trigonometric quartics, in four places at once.

use super::Writer;
use crate::expr::linear::Trig;
use crate::expr::{Expr, RootField};

/// What becomes of a joint that a singular target leaves free.
pub(super) struct Free {
    /// The square of what tells it.
    pub square: Expr,
    /// Below this it is free.
    pub below: Expr,
    /// And then here.
    pub at: Trig,
}

impl Writer<'_> {
    /// |c cos θ + s sin θ + m|² as a cos 2θ + b sin 2θ + c cos θ + d sin θ + e.
    pub(super) fn square(&mut self, [c, s, m]: [[Expr; 2]; 3]) -> [Expr; 5] {
        let mut dot = |a: [Expr; 2], b: [Expr; 2]| {
            let [p, q] = [self.g.mul(a[0], b[0]), self.g.mul(a[1], b[1])];
            self.g.add(p, q)
        };
        let (cc, ss, cs) = (dot(c, c), dot(s, s), dot(c, s));
        let (cm, sm, mm) = (dot(c, m), dot(s, m), dot(m, m));
        let [half, two] = [0.5, 2.0].map(|k| self.g.constant(k));
        let difference = self.g.sub(cc, ss);
        let sum = self.g.add(cc, ss);
        let mean = self.g.mul(half, sum);
        [
            self.g.mul(half, difference),
            cs,
            self.g.mul(two, cm),
            self.g.mul(two, sm),
            self.g.add(mean, mm),
        ]
    }

    /// The roots of a cos 2θ + b sin 2θ + c cos θ + d sin θ + e, in all four
    /// places at once: two signs choose among them. Of two roots that rounding of so much may have
    /// parted from zero the first stands. Where all coefficients vanish, the angle is `free`, and there
    /// is one branch. `apart` is positive where what the
    /// equation is of does not exist, and otherwise 0.
    pub(super) fn quartic_roots(
        &mut self,
        coefficients: [Expr; 5],
        rounding: Option<f64>,
        free: Option<Free>,
        apart: Option<Expr>,
    ) -> Trig {
        let signs = [self.g.sign(), self.g.sign()];
        let [sin, cos, state] = [RootField::Sin, RootField::Cos, RootField::State].map(|field| {
            let places = [0, 1, 2, 3].map(|place| self.g.trig_root(coefficients, place, field));
            self.choose(signs, places)
        });
        let [zero, one] = [self.g.zero(), self.g.one()];
        let [sin, cos, state] = match free {
            None => [sin, cos, state],
            Some(Free { square, below, at }) => {
                let only = self.choose(signs, [zero, one, one, one]);
                [(at.sin, sin), (at.cos, cos), (only, state)]
                    .map(|(free, root)| self.g.select_less(square, below, free, root))
            }
        };
        let trig = Trig { sin, cos };
        let [some, double] = [0.5, 1.5].map(|k| self.g.constant(k));
        let not_simple = match rounding {
            Some(_) => some,
            None => double,
        };
        let is_double = self.g.select_less(not_simple, state, one, zero);
        self.branch.singular = self.g.max(self.branch.singular, is_double);
        let absent = match rounding {
            Some(rounding) => {
                let [height, slope, bend] = self.derivatives(coefficients, trig);
                // 2 f″ times the height of the extremum nearby.
                let slope = self.g.square(slope);
                let height = self.g.mul(height, bend);
                let height = self.scaled(2.0, height);
                let extremum = self.g.sub(height, slope);
                let bend = self.scaled(2.0 * rounding, bend);
                let [extremum, most] = [extremum, bend].map(|x| self.g.square(x));
                let later = self.g.neg(signs[0]);
                self.g.select_less(extremum, most, later, one)
            }
            None => one,
        };
        let present = self.g.select_less(double, state, zero, absent);
        let absent = self.g.select_less(some, state, present, zero);
        match &self.deviation {
            None => self.refuse(absent),
            // Roots that nearly exist are not seen.
            Some(_) => self.branch.singular = one,
        }
        let discriminant = self.discriminant(coefficients);
        let meeting = match apart {
            Some(apart) => self.g.add(discriminant, apart),
            None => discriminant,
        };
        let all = self.branch.meetings.take();
        let all = all.map(|others| self.g.mul(others, meeting));
        self.branch.meetings = Some(all.unwrap_or(meeting));
        self.branch.arguments = None;
        trig
    }

    /// The discriminant of a cos 2θ + b sin 2θ + c cos θ + d sin θ + e, which is positive where
    /// four roots or none are real and negative where two are, by the invariants of the quartic in
    /// exp iθ whose last two coefficients are the conjugates of the first; relative to the sum of
    /// the squares of the coefficients.
    fn discriminant(&mut self, [a, b, c, d, e]: [Expr; 5]) -> Expr {
        let g = &mut self.g;
        let [aa, bb, cc, dd, ee] = [a, b, c, d, e].map(|x| g.square(x));
        let [second, first] = [(aa, bb), (cc, dd)].map(|(x, y)| g.add(x, y));
        // I = 3 |a + b i|² − ¾ |c + d i|² + e².
        let thrice = self.scaled(3.0, second);
        let less = self.scaled(0.75, first);
        let i = self.g.sub(thrice, less);
        let i = self.g.add(i, ee);
        // J = e (18 |a + b i|² + 9/4 |c + d i|² − 2 e²) − 27/4 (a (c² − d²) + 2 b c d).
        let [x, y, z] = [(18.0, second), (2.25, first), (-2.0, ee)];
        let [x, y, z] = [x, y, z].map(|(k, of)| self.scaled(k, of));
        let g = &mut self.g;
        let sum = g.add(x, y);
        let sum = g.add(sum, z);
        let even = g.mul(e, sum);
        let cosine = g.sub(cc, dd);
        let sine = g.mul(c, d);
        let sine = g.add(sine, sine);
        let [cosine, sine] = [(a, cosine), (b, sine)].map(|(x, y)| g.mul(x, y));
        let across = g.add(cosine, sine);
        let across = self.scaled(6.75, across);
        let g = &mut self.g;
        let j = g.sub(even, across);
        let (ii, jj) = (g.square(i), g.square(j));
        let cube = g.mul(ii, i);
        let four = self.scaled(4.0, cube);
        let g = &mut self.g;
        let discriminant = g.sub(four, jj);
        let size = g.add(second, first);
        let size = g.add(size, ee);
        let square = g.square(size);
        let cube = g.mul(square, size);
        g.div(discriminant, cube)
    }

    /// a cos 2θ + b sin 2θ + c cos θ + d sin θ + e, and its first two derivatives.
    fn derivatives(&mut self, [a, b, c, d, e]: [Expr; 5], t: Trig) -> [Expr; 3] {
        let twice = self.g.angle_sum(t, t);
        // k cos + l sin, and that turned by a right angle.
        let mut wave = |k, l, t: Trig| {
            let [kc, ls, lc, ks] =
                [(k, t.cos), (l, t.sin), (l, t.cos), (k, t.sin)].map(|(x, y)| self.g.mul(x, y));
            (self.g.add(kc, ls), self.g.sub(lc, ks))
        };
        let (second, second_slope) = wave(a, b, twice);
        let (first, first_slope) = wave(c, d, t);
        let waves = self.g.add(second, first);
        let second_slope = self.scaled(2.0, second_slope);
        let second = self.scaled(-4.0, second);
        [
            self.g.add(waves, e),
            self.g.add(second_slope, first_slope),
            self.g.sub(second, first),
        ]
    }

    /// One of four values by two signs.
    fn choose(&mut self, [first, second]: [Expr; 2], values: [Expr; 4]) -> Expr {
        let zero = self.g.zero();
        let high = self.g.select_less(second, zero, values[2], values[0]);
        let low = self.g.select_less(second, zero, values[3], values[1]);
        self.g.select_less(first, zero, low, high)
    }
}
