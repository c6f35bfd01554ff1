//! The plan: which subproblem solves which joint, in which order.
//!
//! The chain with its target is a closed loop. A point, direction or plane
//! that some joints leave alone cuts the loop; two of them cut it into two
//! arcs, and what lies between them (a distance, an angle, a height) can be
//! written along either arc. Where all but one joint of both arcs are known,
//! that is a subproblem. The search knows no robot types: a spherical wrist,
//! a UR and their mirror images all come out of the same relations.

mod invariant;
mod posed;
mod relation;
mod relations;
mod search;
mod solved;

pub use invariant::{Invariant, Kind};
use kin_runtime::Solutions;
pub use kin_runtime::Target;
pub use relation::{Atom, Dependence, Relation};
pub use relations::Relations;
pub use search::Plans;

use std::fmt;

/// The subproblem of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subproblem {
    /// The angle left over from a known sum of parallel joints.
    Sum,
    /// Turn a vector onto another (Paden-Kahan 1).
    Sp1,
    /// Turn a vector onto another about two axes in turn (Paden-Kahan 2).
    Sp2,
    /// Turn a point to a distance (Paden-Kahan 3).
    Sp3,
    /// Turn a vector to a component along a direction.
    Sp4,
    /// Two relations between two unknowns, one on each arc of the loop: the
    /// quartic in the middle of subproblems 5 and 6.
    Sp6,
    /// Slide a point onto another.
    Slide,
    /// Slide a point to a distance.
    T1,
    /// Slide a point to a height.
    T2,
    /// The last resort: one joint from a trigonometric polynomial, and all others
    /// with it.
    Univariate,
    /// Slide a point onto another in two or three directions: linear.
    Slides,
    /// Slide a point, turn it and slide it onto another: two lines of known
    /// directions have to meet.
    Lines,
    /// Turn a point about two axes and slide it onto another, or the reverse: a
    /// circle meets the hyperboloid that a line sweeps.
    Hyperboloid,
}

impl Subproblem {
    /// How many solutions it has at most.
    pub fn roots(self) -> usize {
        match self {
            Subproblem::Univariate => Solutions::<6>::CAPACITY,
            other => 1 << other.choices(),
        }
    }

    /// How many binary choices its solution leaves open.
    pub fn choices(self) -> u8 {
        match self {
            Subproblem::Sp2
            | Subproblem::Sp3
            | Subproblem::Sp4
            | Subproblem::T1
            | Subproblem::Lines => 1,
            Subproblem::Sp6 | Subproblem::Hyperboloid => 2,
            _ => 0,
        }
    }
}

impl fmt::Display for Subproblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Subproblem::Sum => "sum",
            Subproblem::Sp1 => "SP1",
            Subproblem::Sp2 => "SP2",
            Subproblem::Sp3 => "SP3",
            Subproblem::Sp4 => "SP4",
            Subproblem::Sp6 => "SP6",
            Subproblem::Slide => "slide",
            Subproblem::T1 => "T1",
            Subproblem::T2 => "T2",
            Subproblem::Univariate => "univariate",
            Subproblem::Slides => "slides",
            Subproblem::Lines => "lines",
            Subproblem::Hyperboloid => "hyperboloid",
        })
    }
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The subproblem.
    pub subproblem: Subproblem,
    /// What it solves, in the order of the loop; of a univariate step all joints, the
    /// one that is kept first.
    pub unknowns: Vec<Atom>,
    /// Relations that pose it, each sufficient; empty for a sum.
    pub relations: Vec<Relation>,
    /// A relation of the same unknown that is strong where those are weak: of
    /// the two, every target takes the one that tells the angle better.
    pub complement: Option<Relation>,
}

/// A sequence of subproblems that solves every joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// In order.
    pub steps: Vec<Step>,
    /// What of the target it reads.
    pub target: Target,
}

impl Plan {
    /// How many branches the plan enumerates.
    pub fn branches(&self) -> usize {
        let steps = self.steps.iter();
        steps.map(|step| step.subproblem.roots()).product()
    }

    /// Whether its steps are the same, by relations between the same invariants.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        type Between<'a> = (&'a Invariant, Option<&'a Invariant>);
        fn relations(step: &Step) -> impl Iterator<Item = Between<'_>> {
            let all = step.relations.iter().chain(&step.complement);
            all.flat_map(|it| [Some(it), it.with.as_deref()])
                .flatten()
                .map(|it| (&it.from, it.to.as_ref()))
        }
        let is_same = |(a, b): (&Step, &Step)| {
            let asked = |step: &Step| (step.subproblem, step.complement.is_some());
            asked(a) == asked(b) && a.unknowns == b.unknowns && relations(a).eq(relations(b))
        };
        self.steps.len() == other.steps.len() && self.steps.iter().zip(&other.steps).all(is_same)
    }

    /// The number of square roots whose sign is free.
    pub fn choices(&self) -> u8 {
        self.steps
            .iter()
            .map(|step| step.subproblem.choices())
            .sum()
    }
}

impl fmt::Display for Plan {
    /// `SP4(q1) SP3(q3) SP1(q2) SP2(q4,q5) SP1(q6)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.steps.iter().enumerate() {
            let space = if i == 0 { "" } else { " " };
            let unknowns: Vec<String> = step.unknowns.iter().map(Atom::to_string).collect();
            write!(f, "{space}{}({})", step.subproblem, unknowns.join(","))?;
        }
        Ok(())
    }
}
