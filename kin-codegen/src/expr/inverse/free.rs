//! What to do with a joint that a singular target leaves free.
//!
//! Any value would close the step at hand, and the branches take the seed's. But not every value
//! leaves the steps behind it a real root: a UR with its wrist stretched can turn its elbow out of
//! reach of the shoulder, and an arm in the plane of its rail may be too far along it. Where that is
//! seen to lose targets, the branches say what later roots make of the free joints, and
//! [`kin_runtime::__private::free_joint`] moves these where a root is none. Regular targets pay for two
//! comparisons of each.

use super::{MayBeFree, Writer};
use crate::expr::Expr;
use crate::plan::{Atom, Plan, Subproblem};
use kin_runtime::__private::free_joint;

/// What becomes of joints that a singular target leaves free.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FreeJoints {
    /// They keep the seed's value: right where no later step depends on them.
    Seeded,
    /// The same, and vectors that tell an angle badly are flagged as singular already: an
    /// elimination is asked there.
    Flagged,
    /// Some move to where a later root is real if the seed's value leaves it none.
    Moved(Vec<Turn>),
}

/// A joint that moves where it is free, and the root that it makes room for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    /// The step of the plan that leaves it free.
    pub step: usize,
    /// The coordinate of the seed that moves it and nothing else.
    pub coordinate: usize,
    /// The step with the root.
    pub root: usize,
}

impl FreeJoints {
    /// All move that may be free, if a later root depends on them, of a plan for an arm of so many
    /// coordinates.
    pub(crate) fn all_moved(plan: &Plan, coordinates: usize) -> Self {
        let roots = 1..plan.steps.len();
        let pairs = roots.flat_map(|root| (0..root).map(move |step| (step, root)));
        let turns = pairs.flat_map(|(step, root)| {
            (0..coordinates).map(move |coordinate| Turn {
                step,
                coordinate,
                root,
            })
        });
        FreeJoints::Moved(turns.collect())
    }

    pub(super) fn moves_step(&self, step: usize) -> bool {
        match self {
            FreeJoints::Seeded | FreeJoints::Flagged => false,
            FreeJoints::Moved(turns) => turns.iter().any(|turn| turn.step == step),
        }
    }

    pub(super) fn includes(&self, turn: Turn) -> bool {
        match self {
            FreeJoints::Seeded | FreeJoints::Flagged => false,
            FreeJoints::Moved(turns) => turns.contains(&turn),
        }
    }
}

/// A joint that may be free, and what a later root says of it; see
/// [`kin_runtime::__private::free_joint::FreeJoints`].
#[derive(Clone, Copy, Debug)]
pub struct FreeJoint {
    /// Which joint, and which root.
    pub turn: Turn,
    /// See [`kin_runtime::__private::free_joint::FreeJoint::slide`]: the arm's size.
    pub slide: Option<f64>,
    /// d of the root's equation, as a share of its amplitude where that depends on the target.
    pub level: Expr,
    /// Positive where the joint is free and the root is none.
    pub no_root: Expr,
}

impl FreeJoint {
    /// As the runtime has it.
    pub(crate) fn joint(&self) -> free_joint::FreeJoint {
        free_joint::FreeJoint {
            coordinate: self.turn.coordinate,
            slide: self.slide,
        }
    }
}

impl Writer<'_> {
    /// What the step just written, `root`, says of a joint that `step` may leave free; none if it
    /// has no root or its root does not depend on the joint.
    pub(super) fn said_of(
        &mut self,
        step: usize,
        free: MayBeFree,
        root: usize,
        plan: &Plan,
    ) -> Option<FreeJoint> {
        let level = self.step.level?;
        let slide = match free.unknown {
            Atom::Joint(joint) => self.solved.slide[joint],
            Atom::Sum { .. } => None,
        };
        let angle = match free.unknown {
            Atom::Joint(joint) => self.solved.trig[joint],
            Atom::Sum { run, .. } => self.solved.sum[run],
        };
        let value = slide.or(angle.map(|angle| angle.sin))?;
        let depends = self.g.reachable(&[level.d, level.amplitude])[value.index()];
        if !depends {
            return None;
        }
        let joint = self.follower(free.unknown, plan);
        let coordinate = self.linkage.coordinate(joint)?;
        let of_size = self.linkage.size / self.linkage.links[joint].gain.abs();
        let amplitude = self.g.sqrt(level.amplitude);
        let share = self.g.div(level.d, amplitude);
        let [zero, one] = [self.g.zero(), self.g.one()];
        // A double root has room for itself, to rounding.
        let least = self.scaled(-self.tolerances.noise, level.amplitude);
        let none = self.g.select_less(level.discriminant, least, one, zero);
        let threshold = self.scaled(self.tolerances.nearly_free, free.scale);
        let threshold = free
            .nothing
            .map_or(threshold, |nothing| self.g.max(threshold, nothing));
        let no_root = self.g.select_less(free.factor, threshold, none, zero);
        Some(FreeJoint {
            turn: Turn {
                step,
                coordinate,
                root,
            },
            slide: slide.map(|_| of_size),
            level: share,
            no_root,
        })
    }

    /// Gives what is said of the joint with some number its symbols.
    pub(super) fn name_said(&mut self, number: usize, said: &FreeJoint) {
        let number = match number {
            0 => String::new(),
            other => (other + 1).to_string(),
        };
        self.g.named(said.level, format!("level{number}"));
        self.g.named(said.no_root, format!("no_root{number}"));
    }

    /// The joint whose value an unknown is. Of a sum it is the joint that is found as the remainder,
    /// since it has no free angle of its own.
    fn follower(&self, unknown: Atom, plan: &Plan) -> usize {
        let Atom::Sum { run, last, .. } = unknown else {
            let (joint, _) = self.extent(unknown);
            return joint;
        };
        let sums = plan.steps.iter();
        let mut sums = sums.filter(|step| step.subproblem == Subproblem::Sum);
        let rest = sums.find_map(|step| match step.unknowns[..] {
            [Atom::Joint(joint)] if self.linkage.run_of(joint) == run => Some(joint),
            _ => None,
        });
        rest.unwrap_or(last)
    }
}
