//! The prismatic subproblems.

use super::Writer;
use super::root::Discriminant;
use super::solve::Sides;
use crate::expr::Expr;
use crate::expr::linear::Vector;
use crate::plan::{Atom, Relation, Subproblem};

/// So many times the rounding of a joint's travel is within what solutions may miss a target by.
const ROUNDINGS: f64 = 8.0;

impl Writer<'_> {
    /// A sliding joint.
    pub(super) fn slide_to(&mut self, subproblem: Subproblem, relation: &Relation, joint: usize) {
        let v = self.g.vector(self.linkage.links[joint].direction);
        let sides = self.sides(relation, Atom::Joint(joint));
        let zero = self.g.vector([0.0; 3]);
        let (l, r) = (
            sides.left.point.unwrap_or(zero),
            sides.right.point.unwrap_or(zero),
        );
        let gap = self.g.minus(l, r);
        let value = match subproblem {
            Subproblem::T1 => self.t1(v, gap, &sides),
            Subproblem::T2 => self.t2(joint, v, gap, &sides),
            _ => self.g.dot(v, gap),
        };
        let name = format!("d{}", joint + 1);
        self.solved.slide[joint] = Some(self.g.named(value, name));
    }

    /// |right + t v − left| = d: two values of t about the foot.
    fn t1(&mut self, v: Vector, gap: Vector, sides: &Sides) -> Expr {
        let zero = self.g.vector([0.0; 3]);
        let [near, far] = sides.other.unwrap_or([sides.left, sides.right]);
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
            noise: self.tolerances.noise,
            factors: None,
        };
        let root = self.root(sign, discriminant, scale, self.linkage.size);
        self.g.add(foot, root)
    }

    /// The height over a plane: linear.
    fn t2(&mut self, joint: usize, v: Vector, gap: Vector, sides: &Sides) -> Expr {
        let zero = self.g.vector([0.0; 3]);
        let [near, far] = sides.other.unwrap_or([sides.left, sides.right]);
        let plane_left = sides.left.direction.is_some();
        let here = if plane_left { sides.left } else { sides.right };
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
        let nothing = self.flag_free(&[Atom::Joint(joint)], square, one);
        let seeded = self.seeded_joint(joint);
        let seeded = seeded.unwrap_or_else(|| self.g.zero());
        let travel = self.g.div(rest, rate);
        let travel = self.g.select_less(square, nothing, seeded, travel);
        self.refuse_beyond_digits(travel);
        travel
    }

    /// Drops the branches in which a joint slides so far that rounding of its travel alone leaves the
    /// tip off the target: slides that are nearly parallel, or across what they change, make up for
    /// little by much.
    pub(super) fn refuse_beyond_digits(&mut self, travel: Expr) {
        let digits = self.tolerances.accepted / (ROUNDINGS * self.tolerances.epsilon);
        let far = self.g.constant(digits * self.linkage.size);
        let back = self.g.neg(travel);
        let length = self.g.max(travel, back);
        let [zero, one] = [self.g.zero(), self.g.one()];
        let invalid = self.g.select_less(far, length, one, zero);
        self.refuse(invalid);
    }
}
