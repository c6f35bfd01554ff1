//! Subproblem 6: two relations between two unknowns.

use super::Writer;
use super::quartic::Free;
use crate::expr::Expr;
use crate::expr::linear::Trig;
use crate::plan::{Atom, Relation, Target};

/// a cos θ + b sin θ + rest.
struct Side {
    cos: Expr,
    sin: Expr,
    rest: Expr,
}

/// row · (cos θ₁, sin θ₁, cos θ₂, sin θ₂) = level.
struct Plane {
    row: [Expr; 4],
    level: Expr,
}

/// Householder's reflection v − k (w · v) w, which takes a unit vector to the first axis, up to
/// its sign.
struct Reflection {
    w: Vec<Expr>,
    k: Expr,
}

/// The radius of a circle of which rounding leaves none.
const LEAST: f64 = 1e-8;
/// Rounding leaves of terms of order one that cancel, and of the sum of some of them, no more.
const ROUNDING: f64 = 1e-12;

impl Writer<'_> {
    /// Two relations, each the same along both arcs of the loop, on one of which it depends
    /// on the first unknown, and on the other on the second: two planes in the space of
    /// z = (cos θ₁, sin θ₁, cos θ₂, sin θ₂), where |z|² = 2. On the circle in which all three
    /// meet, |(z₁, z₂)|² = |(z₃, z₄)|² is a trigonometric quartic in its angle. No block of the
    /// coefficients has to be regular, and where each of the relations has nearly an unknown of
    /// its own, roots are as far apart as the solutions.
    pub(super) fn sp6(&mut self, relation: &Relation, first: Atom, second: Atom) {
        let Some(with) = &relation.with else { return };
        let planes = [relation, with].map(|relation| self.plane(relation, first, second));
        let (circle, apart) = self.circle(planes);
        let [one, other] = [0, 2].map(|i| {
            let columns = circle.each_ref().map(|column| [column[i], column[i + 1]]);
            self.square(columns)
        });
        let coefficients = [0, 1, 2, 3, 4].map(|i| self.g.sub(one[i], other[i]));
        // Of a pose an elimination finds what rounding has lost.
        let rounding = (self.target == Target::Position).then_some(ROUNDING);
        let [cos, sin, centre] = circle;
        let free = self.free_circle([first, second], [&cos, &sin], &coefficients);
        let phi = self.quartic_roots(coefficients, rounding, free, Some(apart));
        let z = [0, 1, 2, 3].map(|i| {
            let [c, s] = [self.g.mul(cos[i], phi.cos), self.g.mul(sin[i], phi.sin)];
            let turning = self.g.add(c, s);
            self.g.add(turning, centre[i])
        });
        for (unknown, i) in [(first, 0), (second, 2)] {
            let trig = self.unit(Trig {
                cos: z[i],
                sin: z[i + 1],
            });
            self.set(unknown, trig);
        }
    }

    /// Where the quartic vanishes, all of the circle: of it, where it is nearest to the seed.
    fn free_circle(
        &mut self,
        unknowns: [Atom; 2],
        circle: [&[Expr]; 2],
        coefficients: &[Expr],
    ) -> Option<Free> {
        if self.deviation.is_some() {
            return None; // Its branches are followed wherever they lead.
        }
        let (square, scale) = (self.inner(coefficients, coefficients), self.g.one());
        let below = self.flag_free(&unknowns, square, scale);
        let seed = unknowns.map(|unknown| self.seeded(unknown));
        let seed = seed.map(|it| [it.cos, it.sin]).concat();
        let [cos, sin] = circle.map(|along| self.inner(along, &seed));
        // Across the circle from the seed all of it is as near.
        let least = self.g.constant(LEAST * LEAST);
        let cos = self.g.add(cos, least);
        let at = self.unit(Trig { sin, cos });
        Some(Free { square, below, at })
    }

    fn plane(&mut self, relation: &Relation, first: Atom, second: Atom) -> Plane {
        let [x, y] = [first, second].map(|unknown| self.side(relation, unknown));
        let [cos, sin] = [y.cos, y.sin].map(|it| self.g.neg(it));
        Plane {
            row: [x.cos, x.sin, cos, sin],
            level: self.g.sub(y.rest, x.rest),
        }
    }

    /// Where two planes meet the sphere |z|² = 2, as c cos φ + s sin φ + m: behind a reflection each
    /// plane tells a coordinate. And 0, or by how much the square of its radius is negative.
    fn circle(&mut self, [first, second]: [Plane; 2]) -> ([Vec<Expr>; 3], Expr) {
        let (outer, x) = self.reflection(&first.row, first.level);
        let across = self.reflect(&outer, &second.row);
        let known = self.g.mul(across[0], x);
        let level = self.g.sub(second.level, known);
        let (inner, y) = self.reflection(&across[1..], level);
        let [xx, yy] = [x, y].map(|it| self.g.square(it));
        let (two, known) = (self.g.constant(2.0), self.g.add(xx, yy));
        let square = self.g.sub(two, known);
        let least = self.g.constant(LEAST * LEAST);
        let radius = self.g.max(square, least);
        let radius = self.g.sqrt(radius);
        let zero = self.g.zero();
        let minus = self.g.neg(square);
        let apart = self.g.max(zero, minus);
        let inside = [[radius, zero], [zero, radius], [zero; 2]];
        let centre = [[zero; 2], [zero; 2], [x, y]];
        let circle = [0, 1, 2].map(|i| {
            let [[x, y], [cos, sin]] = [centre[i], inside[i]];
            let mut all = vec![x];
            all.extend(self.reflect(&inner, &[y, cos, sin]));
            self.reflect(&outer, &all)
        });
        (circle, apart)
    }

    /// The reflection that takes a plane's normal to the first axis, and where it takes the plane.
    fn reflection(&mut self, row: &[Expr], level: Expr) -> (Reflection, Expr) {
        let (zero, one) = (self.g.zero(), self.g.one());
        let minus = self.g.neg(one);
        let length = self.inner(row, row);
        let length = self.g.sqrt(length);
        let inverse = self.g.div(one, length);
        let mut w: Vec<Expr> = row.iter().map(|&it| self.g.mul(it, inverse)).collect();
        // Away from the axis that is nearer.
        let sign = self.g.select_less(w[0], zero, minus, one);
        let size = self.g.mul(sign, w[0]);
        let size = self.g.add(one, size);
        let k = self.g.div(one, size);
        w[0] = self.g.add(w[0], sign);
        let level = self.g.mul(level, inverse);
        let level = self.g.mul(sign, level);
        (Reflection { w, k }, self.g.neg(level))
    }

    fn reflect(&mut self, Reflection { w, k }: &Reflection, v: &[Expr]) -> Vec<Expr> {
        let along = self.inner(w, v);
        let along = self.g.mul(*k, along);
        let pairs = v.iter().zip(w);
        let moved = pairs.map(|(&v, &w)| {
            let w = self.g.mul(along, w);
            self.g.sub(v, w)
        });
        moved.collect()
    }

    fn inner(&mut self, a: &[Expr], b: &[Expr]) -> Expr {
        let zero = self.g.zero();
        a.iter().zip(b).fold(zero, |sum, (&a, &b)| {
            let product = self.g.mul(a, b);
            self.g.add(sum, product)
        })
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
