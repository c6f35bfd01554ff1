//! From a step of the plan to a subproblem, each in the frame of its joint: the
//! axis is z, so every rotation is planar.

use super::Writer;
use super::root::Discriminant;
use super::transport::Transported;
use crate::expr::Expr;
use crate::expr::linear::Vector;
use crate::plan::{Atom, Invariant, Kind, Relation, Step, Subproblem};

/// The two sides of a relation at the unknown: `left` in the frame before the
/// joint, `right` in the frame behind it, and the same pair along the other,
/// known arc.
pub(super) struct Sides {
    pub left: Transported,
    pub right: Transported,
    pub other: Option<[Transported; 2]>,
}

/// What of the square of its amplitude counts where equations are compared by
/// their slopes.
const AMPLITUDE: f64 = 1e-8;

/// Lengths are nearly equal if they are so to this, relative to them: of the square of their difference
/// rounding is nothing beside what leaves the angle of a folded arm free.
const EQUAL: f64 = 1e-6;

/// a cos θ + b sin θ = d.
#[derive(Clone, Copy)]
struct CosineSine {
    a: Expr,
    b: Expr,
    d: Expr,
    /// What the coefficients are multiples of: 1, metres or their square.
    unit: f64,
}

fn kinds(relation: &Relation) -> (Kind, Option<Kind>) {
    (relation.from.kind, relation.to.as_ref().map(|to| to.kind))
}

impl Writer<'_> {
    /// Writes one step by one of its relations.
    pub(super) fn solve(&mut self, step: &Step, relation: &Relation) {
        match (step.subproblem, &step.unknowns[..]) {
            (Subproblem::Sp2, &[first, second]) => self.sp2(relation, first, second),
            (Subproblem::Sp6, &[first, second]) => self.sp6(relation, first, second),
            (Subproblem::Sp1, &[unknown]) => {
                let turn = self.sp1(relation, unknown);
                let other = step.complement.as_ref();
                let other = other.map(|relation| self.sp1(relation, unknown));
                let turn = match other {
                    Some(other) => self.longer(turn, other),
                    None => turn,
                };
                let trig = self.normalized(unknown, turn.trig, turn.factor, turn.scale);
                self.set(unknown, trig);
            }
            (Subproblem::Sp3 | Subproblem::Sp4, &[unknown]) => {
                let mut equation = self.equation(relation, unknown);
                let known = match &step.complement {
                    Some(other) => {
                        let other = self.equation(other, unknown);
                        equation = self.steeper(equation, other);
                        None
                    }
                    None => self.of_equal_links(relation, unknown),
                };
                let CosineSine { a, b, d, unit } = equation;
                let trig = self.angle_with(unknown, a, b, d, known, unit);
                self.set(unknown, trig);
            }
            (Subproblem::Slides, unknowns) => self.slides(relation, unknowns),
            (Subproblem::Lines, &[first, turn, last]) => self.lines(relation, first, turn, last),
            (Subproblem::Hyperboloid, &[first, turn, last]) => {
                self.hyperboloid(relation, first, turn, last);
            }
            (_, &[Atom::Joint(joint)]) => self.slide_to(step.subproblem, relation, joint),
            _ => {}
        }
    }

    /// A relation as an equation of its one unknown.
    fn equation(&mut self, relation: &Relation, unknown: Atom) -> CosineSine {
        let sides = self.sides(relation, unknown);
        let (u, w, d) = self.bilinear(relation, &sides);
        let (a, b, d) = self.cosine_sine(u, w, d);
        let unit = match kinds(relation) {
            (Kind::Direction, _) => 1.0,
            (Kind::Point, Some(Kind::Point)) => self.linkage.size.powi(2),
            _ => self.linkage.size,
        };
        CosineSine { a, b, d, unit }
    }

    /// The discriminant of a subproblem 3 of two points that are about as far from the axis, at l and r:
    /// folded they nearly meet, seen along it. The square of their distance across it, which is what is
    /// given, is (l − r)² there, and (l + r)² where the arm is stretched.
    fn of_equal_links(&mut self, relation: &Relation, unknown: Atom) -> Option<Discriminant> {
        if kinds(relation) != (Kind::Point, Some(Kind::Point)) {
            return None;
        }
        let sides = self.sides(relation, unknown);
        let points = [&sides.left, &sides.right].map(|side| self.point(side));
        let [left, right] = points.map(|point| {
            let square = self.length_squared(point);
            Some([self.g.value(square)?.sqrt(), self.g.value(point[2])?])
        });
        let ([left, height], [right, other]) = (left?, right?);
        if (left - right).abs() >= EQUAL * left {
            return None;
        }
        let least = (left - right).powi(2);
        let folded = match height - other {
            along if along.abs() < EQUAL * left => {
                let [near, far] = sides.other?.map(|side| self.point(&side));
                let gap = self.g.minus(near, far);
                let square = self.g.dot(gap, gap);
                self.less(square, least + along.powi(2))
            }
            _ => {
                let square = self.square_across(relation, unknown)?;
                self.less(square, least)
            }
        };
        let folded = self.scaled(0.5, folded);
        let most = self.g.constant(2.0 * left * right);
        let stretched = self.g.sub(most, folded);
        Some(Discriminant {
            value: self.g.mul(folded, stretched),
            noise: self.tolerances.noise,
            factors: Some([folded, stretched]),
        })
    }

    /// Zero where it would be negative.
    fn less(&mut self, value: Expr, by: f64) -> Expr {
        if by == 0.0 {
            return value;
        }
        let [by, zero] = [by, 0.0].map(|x| self.g.constant(x));
        let rest = self.g.sub(value, by);
        self.g.max(zero, rest)
    }

    /// Of two points, one of them on the first of the parallel axes of which the unknown's is one, the
    /// square of their distance across these, if all joints before them are known.
    fn square_across(&mut self, relation: &Relation, unknown: Atom) -> Option<Expr> {
        let (joint, _) = self.extent(unknown);
        let first = self.linkage.runs[self.linkage.run_of(joint)].joints.start;
        let (near, far) = (&relation.from, relation.to.as_ref()?);
        let is_known = self.solved.trig[..first].iter().all(Option::is_some);
        if !is_known || near.joints.start > first {
            return None;
        }
        let foot = self.bring_before(near, near.joints.end.min(first), first);
        let foot = self.point(&foot);
        let beside = self.length_squared(foot);
        if !self.g.is(beside, 0.0) {
            return None;
        }
        let far = self.bring_before(far, far.joints.end, first);
        let far = self.point(&far);
        Some(self.length_squared(far))
    }

    /// Of two equations of one unknown, the one that changes faster with it at
    /// its roots: a² + b² − d² is the square of that, in the unit of the first.
    /// Where both have a double root, the one with the larger amplitude tells it
    /// better: one whose amplitude is nothing tells no angle.
    fn steeper(&mut self, one: CosineSine, other: CosineSine) -> CosineSine {
        let share = one.unit / other.unit;
        let other = [other.a, other.b, other.d].map(|x| self.scaled(share, x));
        let terms = [one.a, one.b, one.d];
        let [first, second] = [terms, other].map(|equation| {
            let [aa, bb, dd] = equation.map(|x| self.g.square(x));
            let amplitude = self.g.add(aa, bb);
            let more = self.scaled(1.0 + AMPLITUDE, amplitude);
            self.g.sub(more, dd)
        });
        let [a, b, d] = [0, 1, 2].map(|i| self.g.select_less(first, second, other[i], terms[i]));
        let unit = one.unit;
        CosineSine { a, b, d, unit }
    }

    /// The first joint and the end of the joints that an unknown stands for.
    pub(super) fn extent(&self, unknown: Atom) -> (usize, usize) {
        let joints = unknown.joints(self.linkage);
        (joints.start, joints.end)
    }

    /// Transports both invariants to the unknown, and one to the other along the
    /// arc that holds no unknown.
    pub(super) fn sides(&mut self, relation: &Relation, unknown: Atom) -> Sides {
        let (start, end) = self.extent(unknown);
        // What slides of a run leave alone stands at its end, and no joint of the run is crossed.
        let within = |body: usize| start < body && body < end;
        let ahead = |x: &Invariant| match within(x.joints.end) {
            true => x.joints.start,
            false => x.joints.end,
        };
        let behind = |x: &Invariant| match within(x.joints.start) {
            true => x.joints.end,
            false => x.joints.start,
        };
        let from = &relation.from;
        let Some(to) = &relation.to else {
            let left = self.bring_before(from, ahead(from), start);
            let right = self.bring_behind(from, behind(from), end);
            return Sides {
                left,
                right,
                other: None,
            };
        };
        let between = from.joints.end <= start && end <= to.joints.start;
        let (near, far) = if between { (from, to) } else { (to, from) };
        let left = self.bring_before(near, ahead(near), start);
        let right = self.bring_behind(far, behind(far), end);
        // Along the other arc, from behind `far` onwards to before `near`.
        let far_there = self.seen_from(far, far.joints.end);
        let far_there = self.onwards(far_there, far.joints.end, near.joints.start);
        let near_there = self.seen_from(near, near.joints.start);
        Sides {
            left,
            right,
            other: Some([near_there, far_there]),
        }
    }

    pub(super) fn bring_before(&mut self, x: &Invariant, body: usize, joint: usize) -> Transported {
        let x = self.seen_from(x, body);
        let x = self.onwards(x, body, joint);
        self.arrive_before(x, joint)
    }

    pub(super) fn bring_behind(&mut self, x: &Invariant, body: usize, end: usize) -> Transported {
        let x = self.seen_from(x, body);
        self.backwards(x, body, end)
    }

    /// The relation as u · J w = d.
    pub(super) fn bilinear(
        &mut self,
        relation: &Relation,
        sides: &Sides,
    ) -> (Vector, Vector, Expr) {
        let (u, w, offset) = self.measure(relation, sides);
        let [near, far] = sides.other.unwrap_or([sides.left, sides.right]);
        let other = self.value(relation, &near, &far);
        (u, w, self.g.sub(other, offset))
    }

    /// What a relation measures at its unknown: u · J w + offset. Of two
    /// points it is minus half the square of their distance.
    pub(super) fn measure(&mut self, relation: &Relation, sides: &Sides) -> (Vector, Vector, Expr) {
        let zero = self.g.zero();
        let (left, right) = (&sides.left, &sides.right);
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
    fn value(&mut self, relation: &Relation, near: &Transported, far: &Transported) -> Expr {
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

    pub(super) fn point(&mut self, x: &Transported) -> Vector {
        x.point.unwrap_or_else(|| self.g.vector([0.0; 3]))
    }

    pub(super) fn direction(&mut self, x: &Transported) -> Vector {
        x.direction.unwrap_or_else(|| self.g.vector([0.0; 3]))
    }
}
