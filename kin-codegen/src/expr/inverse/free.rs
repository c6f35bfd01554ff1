//! What to do with an angle that a singular target leaves free.
//!
//! Any value would close the step at hand, but not every value leaves the
//! steps behind it a real root: a UR with its wrist stretched can turn its
//! elbow out of reach of the shoulder. The value of the seed is kept where it
//! leaves the next root real. Otherwise the freedom is spent on that root: its
//! cosine-sine equation a cos θ + b sin θ = d has the more room the nearer d is
//! to zero, and as a function of the free angle d is d₀ + d₁ cos φ + d₂ sin φ.
//! The φ that brings it nearest to zero is one more such equation.

use super::root::NOISE;
use super::{Spent, Writer};
use crate::expr::Expr;
use crate::expr::linear::Trig;
use crate::plan::{Atom, Plan, Step, Subproblem};

/// What stands for the angles that a singular target leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FreeAngles {
    /// The seed's value: right where no later step depends on them.
    Seeded,
    /// At one step of the plan the value that leaves the next root the most
    /// room if the seed's leaves none, elsewhere the seed's.
    SpentAt(usize),
}

impl FreeAngles {
    /// Whether a later step of the plan has a root that could depend on the
    /// step whose angle may be free.
    pub fn may_help(self, plan: &Plan) -> bool {
        let FreeAngles::SpentAt(i) = self else {
            return true;
        };
        let (step, later) = (&plan.steps[i], &plan.steps[i + 1..]);
        let unsteady = |step: &Step| match step.subproblem {
            Subproblem::Sp2 => true,
            _ => step
                .relations
                .iter()
                .any(|r| r.depends.iter().any(|d| !d.steady)),
        };
        let roots = [Subproblem::Sp3, Subproblem::Sp4, Subproblem::T1];
        unsteady(step) && later.iter().any(|step| roots.contains(&step.subproblem))
    }
}

impl Writer<'_> {
    /// Writes a step, and looks ahead to what its free angle is good for.
    pub(super) fn write_ahead(&mut self, step: &Step, later: &[Step]) {
        let before = self.clone();
        self.may_be_free = None;
        self.write(step);
        let Some(free) = self.may_be_free else { return };
        let Some(best) = self.best_angle(&before, free, later) else {
            return;
        };
        *self = best;
        self.write(step);
        self.spent = None;
    }

    /// The writer as it was before the step, knowing how to spend the free
    /// angle on the next root; none if no root depends on it.
    fn best_angle(&self, before: &Self, free: Atom, later: &[Step]) -> Option<Self> {
        let mut ahead = self.clone();
        let placeholder = Trig {
            sin: ahead.g.input("free_sin"),
            cos: ahead.g.input("free_cos"),
        };
        ahead.assume(free, placeholder);
        let level = later.iter().find_map(|step| {
            ahead.level = None;
            ahead.write(step);
            let level = ahead.level?;
            let needed = ahead.g.reachable(&[level.d]);
            needed[placeholder.sin.index()].then_some(level)
        })?;
        let mut out = before.clone();
        let shared = before.g.nodes().len();
        let at = |out: &mut Self, e: Expr, sin: Expr, cos: Expr| {
            let inputs = [(placeholder.sin, sin), (placeholder.cos, cos)];
            out.g.import(&ahead.g, shared, e, &inputs)
        };
        // The level at φ = 0, π and π/2 tells it at all φ.
        let values = [(0.0, 1.0), (0.0, -1.0), (1.0, 0.0)].map(|(sin, cos)| {
            let (sin, cos) = (out.g.constant(sin), out.g.constant(cos));
            at(&mut out, level.d, sin, cos)
        });
        let seeded = out.seeded(free);
        let d = at(&mut out, level.d, seeded.sin, seeded.cos);
        let amplitude = at(&mut out, level.amplitude, seeded.sin, seeded.cos);
        let square = out.g.square(d);
        // A double root has room for itself, to rounding.
        let noise = out.g.constant(1.0 + NOISE);
        let limit = out.g.mul(noise, amplitude);
        let room = out.g.sub(limit, square);
        let best = out.nearest_to_zero(values);
        out.spent = Some(Spent { best, room });
        Some(out)
    }

    /// Puts a known angle in place of what was solved.
    fn assume(&mut self, atom: Atom, trig: Trig) {
        match atom {
            Atom::Joint(joint) => self.trig[joint] = Some(trig),
            Atom::Sum { run, .. } => self.sum[run] = Some(trig),
        }
    }

    /// The angle at which d₀ + d₁ cos φ + d₂ sin φ, known at 0, π and π/2, is
    /// nearest to zero.
    fn nearest_to_zero(&mut self, [at_0, at_pi, at_half_pi]: [Expr; 3]) -> Trig {
        let half = self.g.constant(0.5);
        let sum = self.g.add(at_0, at_pi);
        let difference = self.g.sub(at_0, at_pi);
        let mean = self.g.mul(half, sum);
        let a = self.g.mul(half, difference);
        let b = self.g.sub(at_half_pi, mean);
        let d = self.g.neg(mean);
        let squares = [a, b, d].map(|x| self.g.square(x));
        let amplitude = self.g.add(squares[0], squares[1]);
        let room = self.g.sub(amplitude, squares[2]);
        let zero = self.g.zero();
        let room = self.g.max(room, zero);
        let root = self.g.sqrt(room);
        let [ad, br] = [self.g.mul(a, d), self.g.mul(b, root)];
        let [bd, ar] = [self.g.mul(b, d), self.g.mul(a, root)];
        let (sin, cos) = (self.g.add(bd, ar), self.g.sub(ad, br));
        let [ss, cc] = [self.g.square(sin), self.g.square(cos)];
        let length = self.g.add(ss, cc);
        let length = self.g.sqrt(length);
        let nothing = self.g.constant(1e-200);
        let one = self.g.one();
        let inverse = self.g.div(one, length);
        let [sin, cos] = [sin, cos].map(|x| self.g.mul(x, inverse));
        Trig {
            sin: self.g.select_less(length, nothing, zero, sin),
            cos: self.g.select_less(length, nothing, one, cos),
        }
    }
}
