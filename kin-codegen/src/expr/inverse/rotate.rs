//! Subproblems 1 and 2: a vector turned onto another.

use super::Writer;
use super::root::Discriminant;
use super::transport::Transported;
use crate::expr::hash::NodeMap;
use crate::expr::linear::{Trig, Vector};
use crate::expr::{Expr, Node};
use crate::plan::{Atom, Kind, Relation};
use crate::scalar::Tolerances;

/// The sine and cosine of an angle over a common factor, which is compared with
/// `scale` to tell whether the angle is free.
#[derive(Clone, Copy)]
pub(super) struct ScaledTrig {
    pub trig: Trig,
    pub factor: Expr,
    pub scale: Expr,
}

/// A component of a vector along an axis, relative to its length or the arm's size, that is small
/// beside what it is taken from.
const SMALL: f64 = 1e-3;

impl Writer<'_> {
    /// Rz(θ) right = left.
    pub(super) fn sp1(&mut self, relation: &Relation, unknown: Atom) -> ScaledTrig {
        let sides = self.sides(relation, unknown);
        let (left, right) = (sides.left, sides.right);
        let point = left.point.is_some();
        let zero = self.g.vector([0.0; 3]);
        let of = |x: Transported| if point { x.point } else { x.direction }.unwrap_or(zero);
        let (l, r) = (of(left), of(right));
        let trig = self.across(l, r);
        let lengths = [l, r].map(|v| self.length_squared(v));
        // Directions keep their length, so a constant one is that of both.
        let constant = lengths
            .into_iter()
            .find(|&e| self.g.value(e).is_some_and(|x| x > 0.0));
        if let (false, Some(factor)) = (point, constant) {
            self.residual_share *= self.g.value(factor).map_or(1.0, f64::sqrt);
            let scale = self.g.one();
            return ScaledTrig {
                trig,
                factor,
                scale,
            };
        }
        let product = self.g.mul(lengths[0], lengths[1]);
        let factor = self.g.sqrt(product);
        let scale = self.square_scale(point);
        ScaledTrig {
            trig,
            factor,
            scale,
        }
    }

    /// Of two vectors that tell one angle, the one that is longer for its kind.
    pub(super) fn longer(&mut self, one: ScaledTrig, other: ScaledTrig) -> ScaledTrig {
        let [first, second] = [one, other].map(|turn| self.g.div(turn.factor, turn.scale));
        let mut choose = |x, y| self.g.select_less(first, second, y, x);
        let sin = choose(one.trig.sin, other.trig.sin);
        let cos = choose(one.trig.cos, other.trig.cos);
        let factor = choose(one.factor, other.factor);
        let scale = choose(one.scale, other.scale);
        let trig = Trig { sin, cos };
        ScaledTrig {
            trig,
            factor,
            scale,
        }
    }

    /// What the square of a vector is compared with.
    fn square_scale(&mut self, point: bool) -> Expr {
        let length = if point { self.linkage.size } else { 1.0 };
        self.g.constant(length * length)
    }

    /// The planar (cross, dot) product of right and left.
    pub(super) fn across(&mut self, l: Vector, r: Vector) -> Trig {
        let [xx, yy] = [self.g.mul(r[0], l[0]), self.g.mul(r[1], l[1])];
        let [xy, yx] = [self.g.mul(r[0], l[1]), self.g.mul(r[1], l[0])];
        Trig {
            sin: self.g.sub(xy, yx),
            cos: self.g.add(xx, yy),
        }
    }

    pub(super) fn length_squared(&mut self, v: Vector) -> Expr {
        let [xx, yy] = [self.g.square(v[0]), self.g.square(v[1])];
        self.g.add(xx, yy)
    }

    /// J₁ X J₂ y = x: the component along the first axis gives the second
    /// angle, and then the first turns one vector onto the other.
    pub(super) fn sp2(&mut self, relation: &Relation, first: Atom, second: Atom) {
        let from = &relation.from;
        let point = from.kind == Kind::Point;
        let (first_start, first_end) = self.extent(first);
        let (second_start, second_end) = self.extent(second);
        let x = match relation.is_swivel {
            true => self.elbow(),
            false => self.bring_before(from, from.joints.end, first_start),
        };
        let y = self.bring_behind(from, from.joints.start, second_end);
        let zero = self.g.vector([0.0; 3]);
        let of = |x: Transported| if point { x.point } else { x.direction }.unwrap_or(zero);
        // The first axis, behind the first joint and before the second.
        let z = self.g.vector([0.0, 0.0, 1.0]);
        let axis = Transported {
            point: point.then_some(zero),
            direction: Some(z),
        };
        let there = self.onwards(axis, first_end, second_start);
        let there = self.arrive_before(there, second_start);
        let (h, on_axis) = (there.direction.unwrap_or(zero), there.point.unwrap_or(zero));
        let (x_vector, y_vector) = (of(x), of(y));
        let level = self.g.dot(h, on_axis);
        let d = self.g.add(x_vector[2], level);
        let (a, b, d) = self.cosine_sine(h, y_vector, d);
        // The axes meet in the first frame's origin; from there lengths are kept.
        let centred = if point {
            self.g.minus(y_vector, on_axis)
        } else {
            y_vector
        };
        let unit = if point { self.linkage.size } else { 1.0 };
        let square = if self.g.is(level, 0.0) {
            self.gram(x_vector, centred, h, unit)
        } else {
            None
        };
        let squares = square.filter(|square| square.is_sum_of_squares(&self.tolerances));
        let keeps_digits = square.is_some_and(|square| square.keeps_digits(&self.tolerances));
        let mut trig = self.angle_with(second, a, b, d, square, unit);
        if point && square.is_some() {
            // Of a point out of reach the Gram determinant is that of no angle.
            trig = self.unit(trig);
        }
        self.set(second, trig);
        let moved = self.bring_behind(from, from.joints.start, first_end);
        let turned = self.across(x_vector, of(moved));
        let (factor, scale) = match squares {
            // The threshold of the root itself.
            Some(squares) if !point => (squares.value, self.g.one()),
            // Of points out of reach the two lengths differ.
            _ => {
                let lengths = [x_vector, of(moved)].map(|v| self.length_squared(v));
                let product = self.g.mul(lengths[0], lengths[1]);
                let scale = if keeps_digits && point {
                    // Less than where the root takes its branches for one:
                    // those that it tells apart keep their angles.
                    let square = self.g.dot(centred, centred);
                    self.scaled(0.01, square)
                } else {
                    self.square_scale(point)
                };
                (self.g.sqrt(product), scale)
            }
        };
        let trig = self.normalized(first, turned, factor, scale);
        self.set(first, trig);
    }

    /// The discriminant of a subproblem 2 whose axes meet in the origin.
    /// Rotations keep lengths, |x| = |y|, so that with the first axis h and its
    /// component c = h₃ along the second, a² + b² − d² is the Gram determinant
    /// (x₁² + x₂²) − (c|y|)² − y₃² + 2 c y₃ x₃. Where c and y₃ are small constants
    /// of the arm, or small whatever the joints between do, it has no cancellation near the first
    /// axis, while the difference of squares loses all its digits there.
    fn gram(&mut self, x: Vector, y: Vector, h: Vector, size: f64) -> Option<Discriminant> {
        let value = |g: &crate::expr::Graph, e| g.value(e);
        let c = value(&self.g, h[2])?;
        let across_h = self.length_squared(h);
        let unit = value(&self.g, across_h)? + c * c;
        let square = self.g.dot(y, y);
        let length = value(&self.g, square);
        let height = value(&self.g, y[2]).filter(|_| c == 0.0 || length.is_some());
        // The better side is the one whose component is a constant of the arm.
        if (unit - 1.0).abs() > 1e-15 || value(&self.g, x[2]).is_some() {
            return None;
        }
        let across = self.length_squared(x);
        let Some(height) = height else {
            return self.small_gram(across, x, y, c, size);
        };
        let offset = c * c * length.unwrap_or(0.0) + height * height;
        let Tolerances {
            free_below, noise, ..
        } = self.tolerances;
        let noise = match length {
            _ if offset == 0.0 => free_below,
            Some(length) => free_below + noise * offset / length,
            None => noise,
        };
        let rate = self.scaled(2.0 * c * height, x[2]);
        let offset = self.g.constant(offset);
        let rest = self.g.sub(rate, offset);
        let value = self.g.add(across, rest);
        Some(Discriminant {
            value,
            noise,
            factors: None,
        })
    }

    /// The same where y₃ or |y| is no constant of the arm, and c and y₃ are small: so is what is
    /// taken from x₁² + x₂², and its rounding.
    fn small_gram(
        &mut self,
        across: Expr,
        x: Vector,
        y: Vector,
        c: f64,
        size: f64,
    ) -> Option<Discriminant> {
        let small = c.abs() + self.bound(y[2], &mut NodeMap::default()) / size;
        if small.is_nan() || small > SMALL {
            return None;
        }
        let (square, height) = (self.g.dot(y, y), self.g.square(y[2]));
        let far = self.scaled(c * c, square);
        let product = self.g.mul(x[2], y[2]);
        let rate = self.scaled(2.0 * c, product);
        let offset = self.g.add(far, height);
        let rest = self.g.sub(rate, offset);
        let Tolerances {
            free_below, noise, ..
        } = self.tolerances;
        Some(Discriminant {
            value: self.g.add(across, rest),
            noise: free_below + noise * small,
            factors: None,
        })
    }

    /// What an expression of constants and of angles found does not exceed; infinite of others.
    /// What is known of shared parts is kept: behind many joints there are as many ways to one as
    /// powers of two.
    fn bound(&self, e: Expr, known: &mut NodeMap<Expr, f64>) -> f64 {
        if let Some(bound) = known.get(&e) {
            return *bound;
        }
        let found = self.solved.trig.iter().chain(&self.solved.sum).flatten();
        let mut sides = found.flat_map(|trig| [trig.sin, trig.cos]);
        let bound = match sides.find_map(|side| self.bound_as_side(e, side)) {
            Some(bound) => bound,
            None => match self.g.node(e) {
                Node::Constant(bits) => f64::from_bits(bits).abs(),
                Node::Add(a, b) | Node::Sub(a, b) => self.bound(a, known) + self.bound(b, known),
                Node::Mul(a, b) => self.bound(a, known) * self.bound(b, known),
                Node::Neg(a) => self.bound(a, known),
                _ => f64::INFINITY,
            },
        };
        known.insert(e, bound);
        bound
    }

    /// What an expression does not exceed of which a sine or cosine is a multiple.
    fn bound_as_side(&self, e: Expr, side: Expr) -> Option<f64> {
        match self.g.node(side) {
            _ if side == e => Some(1.0),
            Node::Neg(a) => self.bound_as_side(e, a),
            Node::Mul(k, a) | Node::Mul(a, k) if a == e => Some(1.0 / self.g.value(k)?.abs()),
            _ => None,
        }
    }
}
