//! What to do with an angle that a singular target leaves free.
//!
//! Any value would close the step at hand, and the branches take the seed's. But
//! not every value leaves the steps behind it a real root: a UR with its wrist
//! stretched can turn its elbow out of reach of the shoulder. Where that is seen
//! to lose targets, the branches say what the next root makes of the free angle,
//! and [`kin_runtime::free_angle`] turns it where the root is none. Regular
//! targets pay for one comparison.

use super::{MayBeFree, Writer};
use crate::expr::Expr;
use crate::plan::{Atom, Plan, Step, Subproblem};

/// What becomes of angles that a singular target leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FreeAngles {
    /// They keep the seed's value: right where no later step depends on them.
    Seeded,
    /// The same, and vectors that tell an angle badly are flagged as singular already: an
    /// elimination is asked there.
    Flagged,
    /// That of one step of the plan turns to where the next root has the most
    /// room if the seed's value leaves it none.
    TurnedAt(usize),
}

impl FreeAngles {
    /// Whether a later step of the plan has a root that could depend on the
    /// step whose angle may be free.
    pub fn may_help(self, plan: &Plan) -> bool {
        let FreeAngles::TurnedAt(i) = self else {
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

/// An angle that may be free, and what the next root says of it; see
/// [`kin_runtime::__private::free_angle::FreeAngle`].
#[derive(Clone, Copy, Debug)]
pub struct FreeAngle {
    /// The coordinate of the seed that turns it and nothing else.
    pub coordinate: usize,
    /// d of the root's equation.
    pub level: Expr,
    /// Positive where the angle is free and the root is none.
    pub no_root: Expr,
}

impl Writer<'_> {
    /// What the step just written says of a free angle; none if it has no root
    /// or its root does not depend on the angle.
    pub(super) fn said_of(&mut self, free: MayBeFree, plan: &Plan) -> Option<FreeAngle> {
        let level = self.level?;
        let angle = match free.unknown {
            Atom::Joint(joint) => self.trig[joint],
            Atom::Sum { run, .. } => self.sum[run],
        };
        let depends = self.g.reachable(&[level.d])[angle?.sin.index()];
        if !depends {
            return None;
        }
        let coordinate = self.linkage.coordinate(self.follower(free.unknown, plan))?;
        let [zero, one] = [self.g.zero(), self.g.one()];
        // A double root has room for itself, to rounding.
        let least = self.scaled(-self.tolerances.noise, level.amplitude);
        let none = self.g.select_less(level.discriminant, least, one, zero);
        let threshold = self.scaled(self.tolerances.nearly_free, free.scale);
        let no_root = self.g.select_less(free.factor, threshold, none, zero);
        Some(FreeAngle {
            coordinate,
            level: self.g.named(level.d, "level"),
            no_root: self.g.named(no_root, "no_root"),
        })
    }

    /// The joint whose value an unknown is. Of a sum it is the joint that is found as the remainder,
    /// since it has no free angle of its own.
    fn follower(&self, unknown: Atom, plan: &Plan) -> usize {
        let Atom::Sum { run, last, .. } = unknown else {
            let (joint, _) = self.extent(unknown);
            return joint;
        };
        let rest = plan.steps.iter().find_map(|step| match step.unknowns[..] {
            [Atom::Joint(joint)] if step.subproblem == Subproblem::Sum => Some(joint),
            _ => None,
        });
        rest.filter(|&joint| self.linkage.run_of(joint) == run)
            .unwrap_or(last)
    }
}
