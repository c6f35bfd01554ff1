//! Subproblem 6: two relations between two unknowns.

use super::Writer;
use crate::expr::linear::Trig;
use crate::expr::{Expr, RootField};
use crate::plan::{Atom, Relation};

/// a cos θ + b sin θ + rest.
struct Side {
    cos: Expr,
    sin: Expr,
    rest: Expr,
}

impl Writer<'_> {
    /// Two relations, each the same along both arcs of the loop, on one of which it depends
    /// on the unknown that is kept, and on the other on the one that is eliminated:
    /// B y + l = A x + k with x = (cos, sin) of the former and y of the latter. Then |y|² = 1 is
    /// a trigonometric quartic in the angle that is kept.
    pub(super) fn sp6(&mut self, relation: &Relation, kept: Atom, eliminated: Atom) {
        let Some(second) = &relation.with else { return };
        let rows = [relation, second]
            .map(|relation| [self.side(relation, eliminated), self.side(relation, kept)]);
        let [[b1, a1], [b2, a2]] = rows;
        let determinant = self.determinant(b1.cos, b1.sin, b2.cos, b2.sin);
        let one = self.g.one();
        let inverse = self.g.div(one, determinant);
        // y = M x + m, column by column of (cos, sin, 1).
        let rest = [self.g.sub(a1.rest, b1.rest), self.g.sub(a2.rest, b2.rest)];
        let columns = [[a1.cos, a2.cos], [a1.sin, a2.sin], rest].map(|[first, second]| {
            let cos = self.determinant(first, b1.sin, second, b2.sin);
            let sin = self.determinant(b1.cos, first, b2.cos, second);
            [self.g.mul(inverse, cos), self.g.mul(inverse, sin)]
        });
        let x = self.quartic(columns);
        let y: [Expr; 2] = [0, 1].map(|i| {
            let [c, s, m] = columns.map(|column| column[i]);
            let [cx, sx] = [self.g.mul(c, x.cos), self.g.mul(s, x.sin)];
            let turning = self.g.add(cx, sx);
            self.g.add(turning, m)
        });
        self.set(kept, x);
        let y = self.unit(Trig {
            cos: y[0],
            sin: y[1],
        });
        self.set(eliminated, y);
    }

    /// A vector of nearly unit length, or of any where there is no root.
    pub(super) fn unit(&mut self, t: Trig) -> Trig {
        let length = self.length_squared([t.cos, t.sin, t.sin]);
        let length = self.g.sqrt(length);
        Trig {
            sin: self.g.div(t.sin, length),
            cos: self.g.div(t.cos, length),
        }
    }

    /// p s − q r.
    fn determinant(&mut self, p: Expr, q: Expr, r: Expr, s: Expr) -> Expr {
        let [ps, qr] = [self.g.mul(p, s), self.g.mul(q, r)];
        self.g.sub(ps, qr)
    }

    /// |M x + m|² = 1 for the unit vector x, by its columns.
    fn quartic(&mut self, columns: [[Expr; 2]; 3]) -> Trig {
        let mut coefficients = self.square(columns);
        let minus = self.g.constant(-1.0);
        coefficients[4] = self.g.add(coefficients[4], minus);
        self.quartic_roots(coefficients)
    }

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
    /// places at once: two signs choose among them.
    pub(super) fn quartic_roots(&mut self, coefficients: [Expr; 5]) -> Trig {
        let signs = [self.g.sign(), self.g.sign()];
        let [sin, cos, state] = [RootField::Sin, RootField::Cos, RootField::State].map(|field| {
            let places = [0, 1, 2, 3].map(|place| self.g.trig_root(coefficients, place, field));
            self.choose(signs, places)
        });
        let [zero, one] = [self.g.zero(), self.g.one()];
        let [some, double] = [0.5, 1.5].map(|k| self.g.constant(k));
        let is_double = self.g.select_less(double, state, one, zero);
        self.singular = self.g.max(self.singular, is_double);
        let present = self.g.select_less(double, state, zero, one);
        let absent = self.g.select_less(some, state, present, zero);
        match &self.deviation {
            None => self.refuse(absent),
            // Roots that nearly exist are not seen.
            Some(_) => self.singular = one,
        }
        let minus = self.g.constant(-1.0);
        let margin = self.g.select_less(some, state, one, minus);
        self.narrow(margin);
        self.arguments = None;
        Trig { sin, cos }
    }

    /// One of four values by two signs.
    fn choose(&mut self, [first, second]: [Expr; 2], values: [Expr; 4]) -> Expr {
        let zero = self.g.zero();
        let high = self.g.select_less(second, zero, values[2], values[0]);
        let low = self.g.select_less(second, zero, values[3], values[1]);
        self.g.select_less(first, zero, low, high)
    }

    /// What a relation measures, along the arc on which an unknown lies, as
    /// a cos θ + b sin θ + rest.
    fn side(&mut self, relation: &Relation, unknown: Atom) -> Side {
        let zero = self.g.zero();
        let sides = self.sides(relation, unknown);
        let (u, w, offset) = self.measure(relation, &sides);
        let (cos, sin, negative) = self.cosine_sine(u, w, zero);
        let turning_rest = self.g.neg(negative);
        let rest = self.g.add(turning_rest, offset);
        Side { cos, sin, rest }
    }
}
