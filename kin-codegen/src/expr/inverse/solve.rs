//! The subproblems as expressions, each in the frame of its joint: the axis
//! is z, so every rotation is planar.

use super::carry::Carried;
use super::{Blur, Level, Spent, Writer};
use crate::expr::linear::{Trig, Vector};
use crate::expr::{Expr, RootField};
use crate::geometry::Travel;
use crate::plan::{Atom, Invariant, Kind, Relation, Step, Subproblem};

/// Roots of a difference: where cancellation leaves noise, relative to the
/// square of the amplitude. Branches nearer than its square root are one.
pub(super) const NOISE: f64 = 1e-13;
/// A root may be out of domain by this, relative to the square of the
/// amplitude: where an earlier step is nearly singular, it amplifies rounding.
/// Whether the target is in reach then shows in the residual.
const OUTSIDE: f64 = 1e-8;
/// On a snapped arm a root may be out of domain by this many times what the
/// arms differ and still have a solution on the literal one.
const BEYOND: f64 = 10.0;
/// A root this small (angle 3e-7) is reported singular.
const SINGULAR: f64 = 1e-13;
/// Vectors shorter than this, squared and relative to the arm's size, have no
/// direction: the angle is free. Roots of a sum of squares are accurate down
/// to here, and below it the branches are one.
const FREE: f64 = 1e-24;

/// The two sides of a relation at the unknown: `left` in the frame before the
/// joint, `right` in the frame behind it, and the same pair along the other,
/// known arc.
struct Split {
    left: Carried,
    right: Carried,
    other: Option<[Carried; 2]>,
}

fn kinds(relation: &Relation) -> (Kind, Option<Kind>) {
    (relation.from.kind, relation.to.as_ref().map(|to| to.kind))
}

/// a² + b² − d² of a cosine-sine equation.
#[derive(Clone, Copy)]
struct Discriminant {
    value: Expr,
    /// Relative to a² + b², below this it is rounding.
    noise: f64,
}

impl Discriminant {
    /// A sum of squares, which is never below zero.
    fn is_sum_of_squares(&self) -> bool {
        self.noise == FREE
    }
}

/// a cos θ + b sin θ + rest.
struct Side {
    cos: Expr,
    sin: Expr,
    rest: Expr,
}

impl Writer<'_> {
    /// Writes one step by one of its relations.
    pub(super) fn solve(&mut self, step: &Step, relation: &Relation) {
        match (step.subproblem, &step.unknowns[..]) {
            (Subproblem::Sp2, &[first, second]) => self.sp2(relation, first, second),
            (Subproblem::Sp6, &[outer, inner]) => self.sp6(relation, outer, inner),
            (Subproblem::Sp1, &[unknown]) => {
                let split = self.split(relation, unknown);
                let trig = self.sp1(unknown, split.left, split.right);
                self.set(unknown, trig);
            }
            (Subproblem::Sp3 | Subproblem::Sp4, &[unknown]) => {
                let split = self.split(relation, unknown);
                let (u, w, d) = self.bilinear(relation, &split);
                let (a, b, d) = self.cosine_sine(u, w, d);
                let trig = self.angle_with(unknown, a, b, d, None);
                self.set(unknown, trig);
            }
            (_, &[Atom::Joint(joint)]) => self.slide_to(step.subproblem, relation, joint),
            _ => {}
        }
    }

    /// The first joint and the end of the joints that an unknown stands for.
    fn extent(&self, unknown: Atom) -> (usize, usize) {
        match unknown {
            Atom::Joint(joint) => (joint, joint + 1),
            Atom::Sum { run, .. } => {
                let joints = &self.linkage.runs[run].joints;
                (joints.start, joints.end)
            }
        }
    }

    /// Carries both invariants to the unknown, and one to the other along the
    /// arc that holds no unknown.
    fn split(&mut self, relation: &Relation, unknown: Atom) -> Split {
        let (start, end) = self.extent(unknown);
        let from = &relation.from;
        let Some(to) = &relation.to else {
            let left = self.bring_before(from, from.joints.end, start);
            let right = self.bring_behind(from, from.joints.start, end);
            return Split {
                left,
                right,
                other: None,
            };
        };
        let between = from.joints.end <= start && end <= to.joints.start;
        let (near, far) = if between { (from, to) } else { (to, from) };
        let left = self.bring_before(near, near.joints.end, start);
        let right = self.bring_behind(far, far.joints.start, end);
        // Along the other arc, from behind `far` onwards to before `near`.
        let far_there = self.seen_from(far, far.joints.end);
        let far_there = self.onwards(far_there, far.joints.end, near.joints.start);
        let near_there = self.seen_from(near, near.joints.start);
        Split {
            left,
            right,
            other: Some([near_there, far_there]),
        }
    }

    fn bring_before(&mut self, x: &Invariant, body: usize, joint: usize) -> Carried {
        let x = self.seen_from(x, body);
        let x = self.onwards(x, body, joint);
        self.arrive_before(x, joint)
    }

    fn bring_behind(&mut self, x: &Invariant, body: usize, end: usize) -> Carried {
        let x = self.seen_from(x, body);
        self.backwards(x, body, end)
    }

    /// The relation as u · J w = d.
    fn bilinear(&mut self, relation: &Relation, split: &Split) -> (Vector, Vector, Expr) {
        let (u, w, offset) = self.measure(relation, split);
        let [near, far] = split.other.unwrap_or([split.left, split.right]);
        let other = self.value(relation, &near, &far);
        (u, w, self.g.sub(other, offset))
    }

    /// What a relation measures at its unknown: u · J w + offset. Of two
    /// points it is minus half the square of their distance.
    fn measure(&mut self, relation: &Relation, split: &Split) -> (Vector, Vector, Expr) {
        let zero = self.g.zero();
        let (left, right) = (&split.left, &split.right);
        match kinds(relation) {
            (Kind::Direction, _) => (self.direction(left), self.direction(right), zero),
            (Kind::Point, Some(Kind::Point)) => {
                let (u, w) = (self.point(left), self.point(right));
                let squares = [u, w].map(|v| self.g.dot(v, v));
                let sum = self.g.add(squares[0], squares[1]);
                let half = self.g.constant(-0.5);
                (u, w, self.g.mul(half, sum))
            }
            _ => {
                let plane_left = left.direction.is_some();
                let here = if plane_left { left } else { right };
                let (normal, foot) = (self.direction(here), self.point(here));
                let level = self.g.dot(normal, foot);
                let offset = self.g.neg(level);
                if plane_left {
                    (normal, self.point(right), offset)
                } else {
                    (self.point(left), normal, offset)
                }
            }
        }
    }

    /// What a relation measures where both invariants are in one frame.
    fn value(&mut self, relation: &Relation, near: &Carried, far: &Carried) -> Expr {
        match kinds(relation) {
            (Kind::Direction, _) => {
                let (a, b) = (self.direction(near), self.direction(far));
                self.g.dot(a, b)
            }
            (Kind::Point, Some(Kind::Point)) => {
                let (a, b) = (self.point(near), self.point(far));
                let gap = self.g.minus(a, b);
                let square = self.g.dot(gap, gap);
                let half = self.g.constant(-0.5);
                self.g.mul(half, square)
            }
            _ => {
                let (plane, x) = if near.direction.is_some() {
                    (near, far)
                } else {
                    (far, near)
                };
                let (foot, x, normal) = (self.point(plane), self.point(x), self.direction(plane));
                let gap = self.g.minus(x, foot);
                self.g.dot(normal, gap)
            }
        }
    }

    fn point(&mut self, x: &Carried) -> Vector {
        x.point.unwrap_or_else(|| self.g.vector([0.0; 3]))
    }

    fn direction(&mut self, x: &Carried) -> Vector {
        x.direction.unwrap_or_else(|| self.g.vector([0.0; 3]))
    }

    /// u · Rz(θ) w = d as a cos θ + b sin θ = d′.
    fn cosine_sine(&mut self, u: Vector, w: Vector, d: Expr) -> (Expr, Expr, Expr) {
        let [xx, yy] = [self.g.mul(u[0], w[0]), self.g.mul(u[1], w[1])];
        let [yx, xy] = [self.g.mul(u[1], w[0]), self.g.mul(u[0], w[1])];
        let zz = self.g.mul(u[2], w[2]);
        (self.g.add(xx, yy), self.g.sub(yx, xy), self.g.sub(d, zz))
    }

    /// a cos θ + b sin θ = d, both roots. `known` is its discriminant where
    /// there is a better way to compute it.
    fn angle_with(
        &mut self,
        unknown: Atom,
        a: Expr,
        b: Expr,
        d: Expr,
        known: Option<Discriminant>,
    ) -> Trig {
        let [aa, bb] = [self.g.square(a), self.g.square(b)];
        let amplitude = self.g.add(aa, bb);
        let discriminant = known.unwrap_or_else(|| {
            let dd = self.g.square(d);
            let value = self.g.sub(amplitude, dd);
            Discriminant {
                value,
                noise: NOISE,
            }
        });
        let exact = discriminant.is_sum_of_squares();
        self.level = (!exact).then_some(Level { d, amplitude });
        let sign = self.g.sign();
        let root = self.root(sign, discriminant, amplitude);
        // Out of domain the nearest angle is that of d at its limit.
        let d = if exact { d } else { self.clamped(d, amplitude) };
        let [ad, br] = [self.g.mul(a, d), self.g.mul(b, root)];
        let [bd, ar] = [self.g.mul(b, d), self.g.mul(a, root)];
        let trig = Trig {
            sin: self.g.add(bd, ar),
            cos: self.g.sub(ad, br),
        };
        let scale = self.g.constant(self.linkage.size.powi(4));
        if self.g.value(amplitude).is_none() {
            // Where the angle is free its two roots are one.
            let nothing = self.scaled(FREE, scale);
            let zero = self.g.zero();
            let minus = self.g.neg(sign);
            let second = self.g.select_less(amplitude, nothing, minus, zero);
            self.refuse(second);
        }
        self.normalized(unknown, trig, amplitude, scale)
    }

    /// d within ±√limit.
    fn clamped(&mut self, d: Expr, limit: Expr) -> Expr {
        let limit = self.g.sqrt(limit);
        let lower = self.g.neg(limit);
        let minus = self.g.neg(d);
        // min(d, limit) = −max(−d, −limit), and a NaN stays one.
        let below = self.g.max(lower, minus);
        let below = self.g.neg(below);
        self.g.max(lower, below)
    }

    /// ± the square root, with what it says about the branch: out of domain is
    /// invalid, a double root is singular and keeps its first branch only.
    fn root(&mut self, sign: Expr, discriminant: Discriminant, amplitude: Expr) -> Expr {
        let Discriminant { value, noise } = discriminant;
        if let Some(blur) = self.blur {
            return self.blurred_root(sign, value, amplitude, blur);
        }
        let zero = self.g.zero();
        let one = self.g.one();
        let minus = self.g.neg(sign);
        let [near, double, least] =
            [noise.max(SINGULAR), noise, -OUTSIDE].map(|k| self.scaled(k, amplitude));
        self.watch(value, near);
        let once = match discriminant.is_sum_of_squares() {
            true => minus,
            false => self.g.select_less(value, least, one, minus),
        };
        let invalid = self.g.select_less(value, double, once, zero);
        self.refuse(invalid);
        let kept = self.g.select_less(value, double, zero, value);
        let root = self.g.sqrt(kept);
        self.g.mul(sign, root)
    }

    /// The root on a snapped arm. Two roots that have met there may be apart on
    /// the literal arm, so both start, a little apart, and the polish decides.
    fn blurred_root(
        &mut self,
        sign: Expr,
        discriminant: Expr,
        amplitude: Expr,
        blur: Blur,
    ) -> Expr {
        let [zero, one] = [self.g.zero(), self.g.one()];
        let apart = self.scaled(blur.least, amplitude);
        let off = self.g.mul(blur.shift, amplitude);
        let least = self.scaled(-BEYOND, off);
        let invalid = self.g.select_less(discriminant, least, one, zero);
        self.refuse(invalid);
        let kept = self.g.max(discriminant, apart);
        // The angle's error: shift / ρ, and √shift at a double root.
        let share = self.g.div(kept, amplitude);
        let share = self.g.sqrt(share);
        self.amplify(blur, share);
        let root = self.g.sqrt(kept);
        self.g.mul(sign, root)
    }

    fn scaled(&mut self, k: f64, x: Expr) -> Expr {
        let k = self.g.constant(k);
        self.g.mul(k, x)
    }

    /// From here on the snapped arm's values are off by 1 + 1/`share` times as
    /// much as before.
    fn amplify(&mut self, blur: Blur, share: Expr) {
        let more = self.g.div(blur.shift, share);
        let shift = self.g.add(blur.shift, more);
        self.blur = Some(Blur { shift, ..blur });
    }

    /// Drops the branches in which a value is positive.
    fn refuse(&mut self, invalid: Expr) {
        self.invalid = if self.g.is(self.invalid, 0.0) {
            invalid
        } else {
            self.g.max(self.invalid, invalid)
        };
    }

    /// Flags branches in which a value is below a threshold as singular, unless
    /// it is held against a larger one already.
    fn watch(&mut self, value: Expr, threshold: Expr) {
        let covered = self.watched.iter().any(|(watched, already)| {
            let (new, old) = (self.g.value(threshold), self.g.value(*already));
            *watched == value && new.is_some() && new <= old
        });
        if covered {
            return;
        }
        self.watched.push((value, threshold));
        let [zero, one] = [self.g.zero(), self.g.one()];
        let singular = self.g.select_less(value, threshold, one, zero);
        self.singular = if self.g.is(self.singular, 0.0) {
            singular
        } else {
            self.g.max(self.singular, singular)
        };
    }

    /// (sin, cos) over a common factor; a factor of nothing leaves the angle
    /// free, and the fallback stands for all of them.
    fn normalized(&mut self, unknown: Atom, trig: Trig, factor: Expr, scale: Expr) -> Trig {
        if self.g.value(factor).is_some() {
            return Trig {
                sin: self.g.div(trig.sin, factor),
                cos: self.g.div(trig.cos, factor),
            };
        }
        let one = self.g.one();
        let nothing = self.nothing(factor, scale);
        let inverse = self.g.div(one, factor);
        let sin = self.g.mul(trig.sin, inverse);
        let cos = self.g.mul(trig.cos, inverse);
        self.may_be_free = Some(unknown);
        let seeded = self.seeded(unknown);
        let fallback = match self.spent {
            None => seeded,
            Some(Spent { best, room }) => {
                let zero = self.g.zero();
                Trig {
                    sin: self.g.select_less(zero, room, seeded.sin, best.sin),
                    cos: self.g.select_less(zero, room, seeded.cos, best.cos),
                }
            }
        };
        Trig {
            sin: self.g.select_less(factor, nothing, fallback.sin, sin),
            cos: self.g.select_less(factor, nothing, fallback.cos, cos),
        }
    }

    /// Below this a factor leaves its angle free. As a share of `scale` it is
    /// the square of the sine that tells the angle.
    fn nothing(&mut self, factor: Expr, scale: Expr) -> Expr {
        let nothing = self.scaled(FREE, scale);
        self.watch(factor, nothing);
        if let Some(blur) = self.blur {
            let share = self.g.max(factor, nothing);
            let share = self.g.div(share, scale);
            let share = self.g.sqrt(share);
            self.amplify(blur, share);
        }
        nothing
    }

    /// Rz(θ) right = left.
    fn sp1(&mut self, unknown: Atom, left: Carried, right: Carried) -> Trig {
        let point = left.point.is_some();
        let zero = self.g.vector([0.0; 3]);
        let of = |x: Carried| if point { x.point } else { x.direction }.unwrap_or(zero);
        let (l, r) = (of(left), of(right));
        let trig = self.across(l, r);
        let lengths = [l, r].map(|v| self.length_squared(v));
        // Directions keep their length, so a constant one is that of both.
        let constant = lengths
            .into_iter()
            .find(|&e| self.g.value(e).is_some_and(|x| x > 0.0));
        if let (false, Some(length)) = (point, constant) {
            let one = self.g.one();
            return self.normalized(unknown, trig, length, one);
        }
        let product = self.g.mul(lengths[0], lengths[1]);
        let factor = self.g.sqrt(product);
        let scale = self.square_scale(point);
        self.normalized(unknown, trig, factor, scale)
    }

    /// What the square of a vector is compared with.
    fn square_scale(&mut self, point: bool) -> Expr {
        let length = if point { self.linkage.size } else { 1.0 };
        self.g.constant(length * length)
    }

    /// The planar (cross, dot) product of right and left.
    fn across(&mut self, l: Vector, r: Vector) -> Trig {
        let [xx, yy] = [self.g.mul(r[0], l[0]), self.g.mul(r[1], l[1])];
        let [xy, yx] = [self.g.mul(r[0], l[1]), self.g.mul(r[1], l[0])];
        Trig {
            sin: self.g.sub(xy, yx),
            cos: self.g.add(xx, yy),
        }
    }

    fn length_squared(&mut self, v: Vector) -> Expr {
        let [xx, yy] = [self.g.square(v[0]), self.g.square(v[1])];
        self.g.add(xx, yy)
    }

    /// J₁ X J₂ y = x: the component along the first axis gives the second
    /// angle, and then the first turns one vector onto the other.
    fn sp2(&mut self, relation: &Relation, first: Atom, second: Atom) {
        let from = &relation.from;
        let point = from.kind == Kind::Point;
        let (first_start, first_end) = self.extent(first);
        let (second_start, second_end) = self.extent(second);
        let x = self.bring_before(from, from.joints.end, first_start);
        let y = self.bring_behind(from, from.joints.start, second_end);
        let zero = self.g.vector([0.0; 3]);
        let of = |x: Carried| if point { x.point } else { x.direction }.unwrap_or(zero);
        // The first axis, behind the first joint and before the second.
        let z = self.g.vector([0.0, 0.0, 1.0]);
        let axis = Carried {
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
        let square = if self.g.is(level, 0.0) {
            self.gram(x_vector, centred, h)
        } else {
            None
        };
        let squares = square
            .filter(Discriminant::is_sum_of_squares)
            .map(|squares| squares.value);
        let trig = self.angle_with(second, a, b, d, square);
        self.set(second, trig);
        let moved = self.bring_behind(from, from.joints.start, first_end);
        let turned = self.across(x_vector, of(moved));
        let (factor, scale) = match squares {
            // The threshold of the root itself.
            Some(squares) if !point => (squares, self.g.one()),
            // Of points out of reach the two lengths differ.
            _ => {
                let lengths = [x_vector, of(moved)].map(|v| self.length_squared(v));
                let product = self.g.mul(lengths[0], lengths[1]);
                let scale = if squares.is_some() {
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

    /// Two relations, each the same along the inner arc, where it depends on
    /// one unknown, and along the outer, where it depends on the other:
    /// B y + l = A x + k with x = (cos, sin) of the outer unknown and y of the
    /// inner. Then |y|² = 1 is a trigonometric quartic in the outer angle.
    fn sp6(&mut self, relation: &Relation, outer: Atom, inner: Atom) {
        let Some(second) = &relation.with else { return };
        let rows = [relation, second]
            .map(|relation| [self.side(relation, inner), self.side(relation, outer)]);
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
        self.set(outer, x);
        let y = self.unit(Trig {
            cos: y[0],
            sin: y[1],
        });
        self.set(inner, y);
    }

    /// A vector of nearly unit length, or of any where there is no root.
    fn unit(&mut self, t: Trig) -> Trig {
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

    /// |M x + m|² = 1 for the unit vector x, in all four places at once: two
    /// signs choose among them.
    fn quartic(&mut self, [c, s, m]: [[Expr; 2]; 3]) -> Trig {
        let mut dot = |a: [Expr; 2], b: [Expr; 2]| {
            let [p, q] = [self.g.mul(a[0], b[0]), self.g.mul(a[1], b[1])];
            self.g.add(p, q)
        };
        let (cc, ss, cs) = (dot(c, c), dot(s, s), dot(c, s));
        let (cm, sm, mm) = (dot(c, m), dot(s, m), dot(m, m));
        let [half, two, minus] = [0.5, 2.0, -1.0].map(|k| self.g.constant(k));
        let difference = self.g.sub(cc, ss);
        let sum = self.g.add(cc, ss);
        let mean = self.g.mul(half, sum);
        let level = self.g.add(mean, mm);
        let coefficients = [
            self.g.mul(half, difference),
            cs,
            self.g.mul(two, cm),
            self.g.mul(two, sm),
            self.g.add(level, minus),
        ];
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
        if self.blur.is_none() {
            self.refuse(absent);
        }
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
        let split = self.split(relation, unknown);
        let (u, w, offset) = self.measure(relation, &split);
        let (cos, sin, negative) = self.cosine_sine(u, w, zero);
        let turning_rest = self.g.neg(negative);
        let rest = self.g.add(turning_rest, offset);
        Side { cos, sin, rest }
    }

    /// The discriminant of a subproblem 2 whose axes meet in the origin.
    /// Rotations keep lengths, |x| = |y|, so that with the first axis h and its
    /// component c = h₃ along the second, a² + b² − d² is the Gram determinant
    /// (x₁² + x₂²) − (c|y|)² − y₃² + 2 c y₃ x₃. Where c and y₃ are small constants
    /// of the arm, it has no cancellation near the first axis, while the
    /// difference of squares loses all its digits there.
    fn gram(&mut self, x: Vector, y: Vector, h: Vector) -> Option<Discriminant> {
        let value = |g: &crate::expr::Graph, e| g.value(e);
        let c = value(&self.g, h[2])?;
        let across_h = self.length_squared(h);
        let unit = value(&self.g, across_h)? + c * c;
        let height = value(&self.g, y[2])?;
        let length = self.g.dot(y, y);
        let length = value(&self.g, length);
        if c != 0.0 && length.is_none() {
            return None;
        }
        // The better side is the one whose component is a constant of the arm.
        if (unit - 1.0).abs() > 1e-15 || value(&self.g, x[2]).is_some() {
            return None;
        }
        let across = self.length_squared(x);
        let offset = c * c * length.unwrap_or(0.0) + height * height;
        let noise = match length {
            _ if offset == 0.0 => FREE,
            Some(length) => FREE + NOISE * offset / length,
            None => NOISE,
        };
        let rate = self.scaled(2.0 * c * height, x[2]);
        let offset = self.g.constant(offset);
        let rest = self.g.sub(rate, offset);
        let value = self.g.add(across, rest);
        Some(Discriminant { value, noise })
    }

    /// A sliding joint.
    fn slide_to(&mut self, subproblem: Subproblem, relation: &Relation, joint: usize) {
        let Travel::Slide(v) = self.linkage.links[joint].travel else {
            return;
        };
        let v = self.g.vector(v);
        let split = self.split(relation, Atom::Joint(joint));
        let zero = self.g.vector([0.0; 3]);
        let (l, r) = (
            split.left.point.unwrap_or(zero),
            split.right.point.unwrap_or(zero),
        );
        let gap = self.g.minus(l, r);
        let value = match subproblem {
            Subproblem::T1 => self.t1(v, gap, &split),
            Subproblem::T2 => self.t2(joint, v, gap, &split),
            _ => self.g.dot(v, gap),
        };
        let name = format!("d{}", joint + 1);
        self.slide[joint] = Some(self.g.named(value, name));
    }

    /// |right + t v − left| = d: two values of t about the foot.
    fn t1(&mut self, v: Vector, gap: Vector, split: &Split) -> Expr {
        let zero = self.g.vector([0.0; 3]);
        let [near, far] = split.other.unwrap_or([split.left, split.right]);
        let other = self
            .g
            .minus(near.point.unwrap_or(zero), far.point.unwrap_or(zero));
        let foot = self.g.dot(v, gap);
        let distance = self.g.dot(other, other);
        let gap_squared = self.g.dot(gap, gap);
        let foot_squared = self.g.square(foot);
        let beside = self.g.sub(gap_squared, foot_squared);
        let discriminant = self.g.sub(distance, beside);
        let scale = self.g.constant(self.linkage.size.powi(2));
        let sign = self.g.sign();
        let discriminant = Discriminant {
            value: discriminant,
            noise: NOISE,
        };
        let root = self.root(sign, discriminant, scale);
        self.g.add(foot, root)
    }

    /// The height over a plane: linear.
    fn t2(&mut self, joint: usize, v: Vector, gap: Vector, split: &Split) -> Expr {
        let zero = self.g.vector([0.0; 3]);
        let [near, far] = split.other.unwrap_or([split.left, split.right]);
        let plane_left = split.left.direction.is_some();
        let here = if plane_left { split.left } else { split.right };
        let (plane, x) = if plane_left { (near, far) } else { (far, near) };
        let normal = here.direction.unwrap_or(zero);
        let between = self
            .g
            .minus(x.point.unwrap_or(zero), plane.point.unwrap_or(zero));
        let height = self.g.dot(plane.direction.unwrap_or(zero), between);
        let rate = self.g.dot(normal, v);
        // n · (x − p) measured here grows with t when the plane is before the
        // joint and falls when it is behind; `gap` is left − right.
        let measured = self.g.dot(normal, gap);
        let height = if plane_left {
            height
        } else {
            self.g.neg(height)
        };
        let rest = self.g.add(measured, height);
        if self.g.value(rate).is_some() {
            return self.g.div(rest, rate);
        }
        // Along the plane any travel will do, and the seed's stands for all.
        let square = self.g.square(rate);
        let one = self.g.one();
        let nothing = self.nothing(square, one);
        let link = &self.linkage.links[joint];
        let offset = self.g.constant(link.offset);
        let seeded = self.g.add(self.seed[link.variable], offset);
        let travel = self.g.div(rest, rate);
        self.g.select_less(square, nothing, seeded, travel)
    }
}
