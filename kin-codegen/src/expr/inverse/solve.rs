//! The subproblems as expressions, each in the frame of its joint: the axis
//! is z, so every rotation is planar.

use super::Writer;
use super::carry::Carried;
use crate::expr::Expr;
use crate::expr::linear::{Trig, Vector};
use crate::geometry::Travel;
use crate::plan::{Atom, Invariant, Kind, Relation, Step, Subproblem};

/// Roots of a difference: where cancellation leaves noise, relative to the
/// square of the amplitude. Branches nearer than its square root are one.
const NOISE: f64 = 1e-13;
/// Roots of a sum of squares are accurate however small; below this (angle
/// 1e-10) the branches are one.
const EXACT_NOISE: f64 = 1e-20;
/// A root this small (angle 1e-7) is reported singular.
const SINGULAR: f64 = 1e-14;
/// Vectors shorter than this, squared and relative to the arm's size, have no
/// direction: the angle is free.
const FREE: f64 = 1e-24;

/// The two sides of a relation at the unknown: `left` in the frame before the
/// joint, `right` in the frame behind it, and the same pair along the other,
/// known arc.
struct Split {
    left: Carried,
    right: Carried,
    other: Option<[Carried; 2]>,
}

impl Writer<'_> {
    /// Writes one step by one of its relations.
    pub(super) fn solve(&mut self, step: &Step, relation: &Relation) {
        match (step.subproblem, &step.unknowns[..]) {
            (Subproblem::Sp2, &[first, second]) => self.sp2(relation, first, second),
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
        let zero = self.g.vector([0.0; 3]);
        let point = |x: &Carried| x.point.unwrap_or(zero);
        let direction = |x: &Carried| x.direction.unwrap_or(zero);
        let (left, right) = (&split.left, &split.right);
        let [near, far] = split.other.unwrap_or([*left, *right]);
        let kinds = (relation.from.kind, relation.to.as_ref().map(|to| to.kind));
        match kinds {
            (Kind::Direction, _) => {
                let d = self.g.dot(direction(&near), direction(&far));
                (direction(left), direction(right), d)
            }
            (Kind::Point, Some(Kind::Point)) => {
                let (u, w) = (point(left), point(right));
                let gap = self.g.minus(point(&near), point(&far));
                let squares = [u, w, gap].map(|v| self.g.dot(v, v));
                let sum = self.g.add(squares[0], squares[1]);
                let sum = self.g.sub(sum, squares[2]);
                let half = self.g.constant(0.5);
                (u, w, self.g.mul(half, sum))
            }
            _ => {
                let plane_left = left.direction.is_some();
                let (plane, x) = if plane_left { (near, far) } else { (far, near) };
                let gap = self.g.minus(point(&x), point(&plane));
                let height = self.g.dot(direction(&plane), gap);
                let here = if plane_left { left } else { right };
                let level = self.g.dot(direction(here), point(here));
                let d = self.g.add(height, level);
                if plane_left {
                    (direction(left), point(right), d)
                } else {
                    (point(left), direction(right), d)
                }
            }
        }
    }

    /// u · Rz(θ) w = d as a cos θ + b sin θ = d′.
    fn cosine_sine(&mut self, u: Vector, w: Vector, d: Expr) -> (Expr, Expr, Expr) {
        let [xx, yy] = [self.g.mul(u[0], w[0]), self.g.mul(u[1], w[1])];
        let [yx, xy] = [self.g.mul(u[1], w[0]), self.g.mul(u[0], w[1])];
        let zz = self.g.mul(u[2], w[2]);
        (self.g.add(xx, yy), self.g.sub(yx, xy), self.g.sub(d, zz))
    }

    /// a cos θ + b sin θ = d, both roots. `squares` is a² + b² − d² where it
    /// is known as a sum of squares.
    fn angle_with(
        &mut self,
        unknown: Atom,
        a: Expr,
        b: Expr,
        d: Expr,
        squares: Option<Expr>,
    ) -> Trig {
        self.level = squares.is_none().then_some(d);
        let [aa, bb] = [self.g.square(a), self.g.square(b)];
        let amplitude = self.g.add(aa, bb);
        let discriminant = squares.unwrap_or_else(|| {
            let dd = self.g.square(d);
            self.g.sub(amplitude, dd)
        });
        let noise = if squares.is_some() {
            EXACT_NOISE
        } else {
            NOISE
        };
        let root = self.root(discriminant, amplitude, noise);
        let [ad, br] = [self.g.mul(a, d), self.g.mul(b, root)];
        let [bd, ar] = [self.g.mul(b, d), self.g.mul(a, root)];
        let trig = Trig {
            sin: self.g.add(bd, ar),
            cos: self.g.sub(ad, br),
        };
        let scale = self.linkage.size;
        self.normalized(unknown, trig, amplitude, scale.powi(4))
    }

    /// ± the square root, with what it says about the branch: out of domain is
    /// invalid, a double root is singular and keeps its first branch only.
    fn root(&mut self, discriminant: Expr, amplitude: Expr, noise: f64) -> Expr {
        let sign = self.g.sign();
        let zero = self.g.zero();
        let one = self.g.one();
        let slack = self.slack.0;
        let scaled = |g: &mut crate::expr::Graph, k: f64| {
            let k = g.constant(k);
            g.mul(k, amplitude)
        };
        let least = scaled(&mut self.g, -(noise.max(slack)));
        let near = scaled(&mut self.g, noise.max(SINGULAR));
        let minus = self.g.neg(sign);
        let singular = self.g.select_less(discriminant, near, one, zero);
        self.singular = self.g.max(self.singular, singular);
        if slack > 0.0 {
            // The polish decides: branches start apart, and meet if they must.
            let apart = scaled(&mut self.g, slack * slack);
            let invalid = self.g.select_less(discriminant, least, one, zero);
            self.invalid = self.g.max(self.invalid, invalid);
            let kept = self.g.max(discriminant, apart);
            let root = self.g.sqrt(kept);
            return self.g.mul(sign, root);
        }
        let double = scaled(&mut self.g, noise);
        // A sum of squares is never below zero.
        let once = match noise == EXACT_NOISE {
            true => minus,
            false => self.g.select_less(discriminant, least, one, minus),
        };
        let invalid = self.g.select_less(discriminant, double, once, zero);
        self.invalid = self.g.max(self.invalid, invalid);
        let kept = self.g.select_less(discriminant, double, zero, discriminant);
        let root = self.g.sqrt(kept);
        self.g.mul(sign, root)
    }

    /// (sin, cos) over a common factor; a factor of nothing leaves the angle
    /// free, and the fallback stands for all of them.
    fn normalized(&mut self, unknown: Atom, trig: Trig, factor: Expr, scale: f64) -> Trig {
        if self.g.value(factor).is_some() {
            return Trig {
                sin: self.g.div(trig.sin, factor),
                cos: self.g.div(trig.cos, factor),
            };
        }
        let [zero, one] = [self.g.zero(), self.g.one()];
        let nothing = self.g.constant(FREE * scale);
        let singular = self.g.select_less(factor, nothing, one, zero);
        self.singular = self.g.max(self.singular, singular);
        let inverse = self.g.div(one, factor);
        let sin = self.g.mul(trig.sin, inverse);
        let cos = self.g.mul(trig.cos, inverse);
        self.may_be_free = Some(unknown);
        let fallback = self.fallback;
        Trig {
            sin: self.g.select_less(factor, nothing, fallback.sin, sin),
            cos: self.g.select_less(factor, nothing, fallback.cos, cos),
        }
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
            return self.normalized(unknown, trig, length, 1.0);
        }
        let product = self.g.mul(lengths[0], lengths[1]);
        let factor = self.g.sqrt(product);
        let scale = if point {
            self.linkage.size.powi(2)
        } else {
            1.0
        };
        self.normalized(unknown, trig, factor, scale)
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
        let squares = self.sum_of_squares(x_vector, y_vector, h, d, point, on_axis);
        let trig = self.angle_with(second, a, b, d, squares);
        self.set(second, trig);
        let moved = self.bring_behind(from, from.joints.start, first_end);
        let turned = self.across(x_vector, of(moved));
        let factor = match squares {
            Some(squares) => squares,
            None => {
                let lengths = [x_vector, of(moved)].map(|v| self.length_squared(v));
                let product = self.g.mul(lengths[0], lengths[1]);
                self.g.sqrt(product)
            }
        };
        let scale = if point {
            self.linkage.size.powi(2)
        } else {
            1.0
        };
        let trig = self.normalized(first, turned, factor, scale);
        self.set(first, trig);
    }

    /// The discriminant of a subproblem 2 without cancellation. Rotations keep
    /// lengths, |x| = |y|, so a² + b² − d² = (x₁² + x₂²) + rest, and where the
    /// axes are square to each other and y to the second, the rest is zero.
    fn sum_of_squares(
        &mut self,
        x: Vector,
        y: Vector,
        h: Vector,
        d: Expr,
        point: bool,
        on_axis: Vector,
    ) -> Option<Expr> {
        let hh = self.length_squared(h);
        let yy = self.length_squared(y);
        let reach = self.g.mul(hh, yy);
        let length = self.g.dot(y, y);
        let (reach, length) = (self.g.value(reach)?, self.g.value(length)?);
        let square = (reach - length).abs() < 1e-15 * length;
        let centred = !point || on_axis.iter().all(|&e| self.g.is(e, 0.0));
        (square && centred && d == x[2]).then(|| self.length_squared(x))
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
            Subproblem::T2 => self.t2(v, gap, &split),
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
        let root = self.root(discriminant, scale, NOISE);
        self.g.add(foot, root)
    }

    /// The height over a plane: linear.
    fn t2(&mut self, v: Vector, gap: Vector, split: &Split) -> Expr {
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
        self.g.div(rest, rate)
    }
}
