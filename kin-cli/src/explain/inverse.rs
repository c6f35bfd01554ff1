//! The closed form: its plan, why it was chosen, and what it costs.

use super::{Idealization, Step};
use kin_codegen::arm::CompiledArm;
use kin_codegen::certificate::Certificate;
use kin_codegen::expr::Operations;
use kin_codegen::expr::inverse::InverseGraph;
use kin_codegen::geometry::{Coupling, Linkage};
use kin_codegen::plan::{Plan, Plans};
use kin_codegen::redundancy::{self, carriers};
use kin_codegen::solver::Certified;
use kin_codegen::univariate::{Arm, Kept};
use serde::Serialize;

/// Other plans told of.
const ALTERNATIVES: usize = 3;
/// Of so many plans that are found.
const LOOKED_AT: usize = 24;

/// A verified closed form.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inverse {
    /// What of a pose counts, as the option `target` has it.
    pub target: &'static str,
    /// The same as sentences; none where six joints or more have whole poses for targets.
    pub targets: Option<String>,
    /// What is given beside a target: a joint, `q7`, `swivel`, or `turn`, that of the tool; empty
    /// where targets have isolated solutions.
    pub free: Vec<String>,
    /// The same as the option `free` takes it: joints by the names that the file has for them.
    pub given: Vec<String>,
    /// What the joints that stay free were chosen from, the best first; empty where they
    /// were asked for or nothing is given.
    pub weighed: Vec<Weighed>,
    /// What was idealized; none if the file is exact.
    pub idealization: Option<Idealization>,
    /// What the joints of the plan are, where joints mimic others.
    pub coupling: Option<String>,
    /// The plan in short: `SP4(q1) SP3(q3) SP1(q2) SP2(q4,q5) SP1(q6)`.
    pub plan: String,
    /// The plan step by step.
    pub steps: Vec<Step>,
    /// How many branches it enumerates.
    pub branches: usize,
    /// Other plans that the search came by, the cheapest first, in short.
    pub others: Vec<String>,
    /// What computing the branches takes; none of a univariate step.
    pub cost: Option<LaneCost>,
    /// The joints that are kept while all others are eliminated, in the order in which they
    /// are asked; empty where subproblems tell all solutions.
    pub kept: Vec<KeptJoint>,
    /// What was seen when the plan was run.
    pub certificate: Certificate,
}

/// Joints that could stay free.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Weighed {
    /// `q7`.
    pub free: Vec<String>,
    /// How many of them, from the first joint of the chain on, carry the arm.
    pub carriers: usize,
    /// The operations of all branches of the cheapest of the first plans for the others, each by
    /// what it costs; none if there is no plan.
    pub weight: Option<usize>,
}

/// A joint that is kept while all others are eliminated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KeptJoint {
    /// `q4`, or `the turn about the tool`.
    pub unknown: String,
    /// The degree of the trigonometric polynomial in it.
    pub degree: u8,
    /// On how many of a hundred random targets it was not sure to tell all solutions.
    pub unsure: f64,
    /// The noise of the polynomial, relative to its largest coefficient, at 95 of a
    /// hundred random targets.
    pub noise: f64,
}

/// What inverse kinematics takes, without the refinement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct LaneCost {
    /// One branch.
    pub one_branch: Operations,
    /// All branches, with what they share computed once.
    pub all_branches: Operations,
}

impl Inverse {
    pub(super) fn of(arm: &CompiledArm, certified: &Certified) -> Self {
        let form = &certified.form;
        let redundancy = arm.redundancy.iter();
        let turn = redundancy.clone().filter(|it| it.turn);
        let swivel = redundancy.clone().filter(|it| it.swivel.is_some());
        let weighed = redundancy.clone().flat_map(|it| &it.weighed);
        let joints = redundancy.clone().flat_map(|it| unknowns(&it.joints));
        let named = redundancy.flat_map(|it| &it.joints);
        let named = named.map(|&joint| arm.model.variables[joint].name.clone());
        let beside = |joints: &mut dyn Iterator<Item = String>| -> Vec<String> {
            let swivel = swivel.clone().map(|_| redundancy::SWIVEL.into());
            joints
                .chain(swivel)
                .chain(turn.clone().map(|_| "turn".into()))
                .collect()
        };
        let plan = &form.plan;
        let steps = plan.steps.iter();
        Self {
            target: arm.target().word(),
            targets: arm.targets(),
            free: beside(&mut joints.into_iter()),
            given: beside(&mut named.into_iter()),
            weighed: weighed.map(|it| Weighed::of(arm, it)).collect(),
            idealization: Idealization::of(form),
            coupling: form.linkage.coupling.as_ref().map(Coupling::sentence),
            plan: plan.to_string(),
            steps: steps.map(|step| Step::of(step, &form.linkage)).collect(),
            branches: plan.branches(),
            others: others(&form.linkage, plan),
            cost: form.expressions().map(LaneCost::of),
            kept: {
                let arms = form.elimination().into_iter();
                let kept = arms.flat_map(|arm| arm.kept.iter().map(move |kept| (arm, kept)));
                kept.map(|(arm, kept)| KeptJoint::of(arm, kept, &form.given))
                    .collect()
            },
            certificate: certified.certificate,
        }
    }
}

/// Other plans that the search comes by first; those that differ in what a step is read from
/// alone are one.
fn others(linkage: &Linkage, plan: &Plan) -> Vec<String> {
    let plans = Plans::new(linkage, plan.target).take(LOOKED_AT);
    let mut names = vec![plan.to_string()];
    for name in plans.map(|other| other.to_string()) {
        if names.len() <= ALTERNATIVES && !names.contains(&name) {
            names.push(name);
        }
    }
    names.split_off(1)
}

/// `q1`, for each.
fn unknowns(joints: &[usize]) -> Vec<String> {
    joints
        .iter()
        .map(|joint| format!("q{}", joint + 1))
        .collect()
}

impl Weighed {
    fn of(arm: &CompiledArm, weighed: &redundancy::Weighed) -> Self {
        Self {
            free: unknowns(&weighed.joints),
            carriers: carriers(&arm.model, arm.target(), &weighed.joints),
            weight: weighed.weight,
        }
    }
}

impl KeptJoint {
    fn of(arm: &Arm, kept: &Kept, given: &Linkage) -> Self {
        Self {
            unknown: arm.kept_name(kept, given),
            degree: kept.elimination.degree,
            unsure: kept.unsure,
            noise: kept.noise,
        }
    }
}

impl LaneCost {
    fn of(inverse: &InverseGraph) -> Self {
        Self {
            one_branch: inverse.one_branch(),
            all_branches: inverse.all_branches(),
        }
    }
}
