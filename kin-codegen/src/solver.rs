//! The closed form of an arm: the exact relations that were read into it, the
//! plan, its expressions, and the polish that returns to the literal arm.

use crate::expr::inverse::{FreeAngles, Inverse, Slack, inverse};
use crate::geometry::{Linkage, Snap, size, snap};
use crate::model::{JointKind, Model};
use crate::plan::{Plan, Target, search};
use crate::verify::{self, Certificate, Failure, SOUND, Trials, certify, chain};
use kin_runtime::branches::Acceptance;
use kin_runtime::free_angle::{SAMPLES, roomiest_turn};
use kin_runtime::polish::{Problem, land};
use kin_runtime::{Pose, Solution};

/// Tolerances to read relations with, the strictest first: rounding of the
/// file's own digits, right angles of 9, 7 and 5 digits, and calibrated arms.
const TOLERANCES: [f64; 6] = [1e-12, 1e-8, 1e-6, 5e-5, 1e-3, 8e-3];
/// Plans tried at one tolerance before the next.
const PLANS: usize = 8;
/// A snapped arm whose tip moved less than this, relative to its size, is the
/// literal one to rounding.
const UNMOVED: f64 = 1e-13;

/// Newton doubles the digits: two or three steps do at a regular
/// configuration. Near a singular one the first steps have to find the way.
const POLISH: usize = 24;
/// In square roots of the tip's shift, how near to a singular configuration the
/// branches of the snapped arm do not tell those of the literal one.
const BLUR: f64 = 0.5;

/// A root may be out of domain by this many times the shift of the tip and
/// still have a solution on the literal arm.
const SLACK: f64 = 5.0;

/// A verified closed form.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// The arm that the plan is for.
    pub snap: Snap,
    /// Its frames.
    pub linkage: Linkage,
    /// The frames of the arm as the file has it.
    pub literal: Linkage,
    /// The plan.
    pub plan: Plan,
    /// The plan as expressions.
    pub inverse: Inverse,
    /// How far the snapped arm's tip is from the literal one, metres.
    pub tip_shift: f64,
    /// Newton steps at most that land every branch on the literal arm; 0 if the
    /// snapped arm is the literal one.
    pub polish: usize,
    /// What was seen when the plan was run.
    pub certificate: Certificate,
}

/// Why an arm has none.
#[derive(Clone, Debug, PartialEq)]
pub enum NoClosedForm {
    /// Joints that mimic others couple the chain.
    Mimic,
    /// More joints than the target has coordinates.
    Redundant(Target),
    /// The search found no sequence of subproblems.
    NoPlan,
    /// The axes are off exact relations, and a target of this kind is projected
    /// to what the exact arm can choose.
    Noisy,
    /// The best plan failed its certificate.
    Uncertified {
        /// The plan, in short.
        plan: String,
        /// What it got wrong.
        failure: Failure,
    },
}

/// One answer of the interpreter.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The configuration.
    pub q: Vec<f64>,
    /// Its distance from the target, metres.
    pub residual: f64,
    /// Its branch.
    pub branch: u32,
    /// Whether it stands for a family or a double root.
    pub singular: bool,
}

/// Finds and verifies a closed form.
///
/// # Errors
///
/// Why there is none.
pub fn solve(model: &Model, linkage: &Linkage, target: Target) -> Result<ClosedForm, NoClosedForm> {
    if model.is_coupled() {
        return Err(NoClosedForm::Mimic);
    }
    if model.joints.len() > target.coordinates() {
        return Err(NoClosedForm::Redundant(target));
    }
    let trials = Trials::new(model, linkage, target);
    let mut refusal = NoClosedForm::NoPlan;
    let mut best: Option<ClosedForm> = None;
    let mut last: Option<Vec<crate::geometry::Moved>> = None;
    for tolerance in TOLERANCES {
        let snap = snap(model, tolerance);
        if last.as_ref() == Some(&snap.moved) {
            continue;
        }
        last = Some(snap.moved.clone());
        match solve_snapped(&trials, snap, target) {
            Ok(solver) => {
                // The reading that answers more singular targets wins; one
                // that is exact or answers all cannot be beaten.
                let done = solver.polish == 0 || solver.certificate.unanswered == 0;
                best = better(best, solver);
                if done {
                    break;
                }
            }
            Err(NoClosedForm::NoPlan) => {}
            Err(other) => refusal = other,
        }
    }
    best.ok_or(refusal)
}

fn better(best: Option<ClosedForm>, other: ClosedForm) -> Option<ClosedForm> {
    let unanswered = |solver: &ClosedForm| solver.certificate.unanswered;
    match best {
        Some(best) if unanswered(&best) <= unanswered(&other) => Some(best),
        _ => Some(other),
    }
}

fn solve_snapped(trials: &Trials, snap: Snap, target: Target) -> Result<ClosedForm, NoClosedForm> {
    let linkage = Linkage::new(&snap.model);
    let plans = search(&linkage, target, PLANS);
    let tip_shift = tip_shift(trials.model(), &snap.model);
    let literal = tip_shift < UNMOVED * linkage.size;
    if !literal && target.is_projected() {
        return Err(NoClosedForm::Noisy);
    }
    let mut refusal = NoClosedForm::NoPlan;
    let mut best: Option<ClosedForm> = None;
    let mut attempt = |plan: &Plan, free: FreeAngles| {
        let slack = if literal {
            0.0
        } else {
            SLACK * tip_shift / linkage.size
        };
        let mut solver = ClosedForm {
            snap: snap.clone(),
            linkage: linkage.clone(),
            literal: trials.linkage().clone(),
            plan: plan.clone(),
            inverse: inverse(&linkage, plan, Slack(slack), free),
            tip_shift,
            polish: if literal { 0 } else { POLISH },
            certificate: Certificate::default(),
        };
        match certify(trials, &solver) {
            Ok(certificate) => {
                solver.certificate = certificate;
                best = better(best.take(), solver);
            }
            Err(failure) => {
                let plan = plan.to_string();
                refusal = NoClosedForm::Uncertified { plan, failure };
            }
        }
        best.as_ref()
            .is_some_and(|best| best.certificate.unanswered == 0)
    };
    let done = plans.iter().any(|plan| attempt(plan, FreeAngles::Seeded));
    // To turn a free angle costs operations: only where it is seen to lose targets.
    if let (false, Some(plan)) = (done, plans.first()) {
        let turned = (0..plan.steps.len()).map(FreeAngles::TurnedAt);
        let _ = turned
            .filter(|free| free.may_help(plan))
            .any(|free| attempt(plan, free));
    }
    best.ok_or(refusal)
}

/// How far apart the tips of two arms get, with orientation as a length at
/// the distance of the arm's size; metres.
fn tip_shift(literal: &Model, snapped: &Model) -> f64 {
    let (a, b) = (chain(literal), chain(snapped));
    let size = size(literal);
    let at = |k: usize| {
        let q: Vec<f64> = (0..literal.variables.len())
            .map(|i| (i * 5 + k * 7) as f64 * 0.61 % 3.0)
            .collect();
        verify::distance(&a.fk(&q), &b.fk(&q), size, Target::Pose)
    };
    (0..8).map(at).fold(0.0, f64::max)
}

impl ClosedForm {
    /// What the generated function will answer, computed by the interpreter.
    pub fn answers(&self, target: &Pose) -> Vec<Answer> {
        let branches = self.branches(target);
        if self.polish == 0 {
            let reaches = |answer: &Answer| answer.residual <= self.acceptance().tolerance;
            return branches.into_iter().filter(reaches).collect();
        }
        match self.literal.variables() {
            1 => self.landed::<1>(target, &branches),
            2 => self.landed::<2>(target, &branches),
            3 => self.landed::<3>(target, &branches),
            4 => self.landed::<4>(target, &branches),
            5 => self.landed::<5>(target, &branches),
            _ => self.landed::<6>(target, &branches),
        }
    }

    /// The branches of the plan that exist.
    fn branches(&self, target: &Pose) -> Vec<Answer> {
        let branches = 0..self.plan.branches() as u32;
        branches
            .filter_map(|branch| self.branch(target, branch))
            .collect()
    }

    fn branch(&self, target: &Pose, branch: u32) -> Option<Answer> {
        let inverse = &self.inverse;
        let mut values = self.evaluate(target, branch, 0.0);
        if let Some(free) = inverse.free_angle
            && values[free.no_root.index()] > 0.0
        {
            let level = |turn| self.evaluate(target, branch, turn)[free.level.index()];
            let turn = roomiest_turn(SAMPLES.map(level));
            values = self.evaluate(target, branch, turn);
        }
        let of = |e: crate::expr::Expr| values[e.index()];
        (of(inverse.invalid) <= 0.0).then(|| Answer {
            q: inverse.q.iter().map(|&e| of(e)).collect(),
            residual: of(inverse.residual),
            singular: of(inverse.singular) > 0.0,
            branch,
        })
    }

    /// The values of a branch for a seed of zeros, but for a turn of the angle
    /// that may be free.
    fn evaluate(&self, target: &Pose, branch: u32, turn: f64) -> Vec<f64> {
        let inverse = &self.inverse;
        let mut inputs: Vec<f64> = target.rotation.iter().flatten().copied().collect();
        inputs.extend(target.translation);
        let seed = inputs.len();
        inputs.resize(usize::from(inverse.graph.inputs()), 0.0);
        if let Some(free) = inverse.free_angle {
            inputs[seed + free.coordinate] = turn;
        }
        let mut values = Vec::new();
        inverse.graph.evaluate(&inputs, branch, &mut values);
        values
    }

    /// The branches on the literal arm.
    fn landed<const N: usize>(&self, target: &Pose, branches: &[Answer]) -> Vec<Answer> {
        let problem = Problem {
            fk_jacobian: |q: &[f64; N]| self.literal.fk_jacobian(q),
            target,
            size: self.linkage.size,
            counts: self.plan.target,
        };
        let start = |answer: &Answer| Solution {
            q: std::array::from_fn(|i| answer.q[i]),
            residual: answer.residual,
            branch: answer.branch,
            singular: answer.singular,
        };
        let starts = branches.iter().map(start);
        land(&problem, starts, &self.acceptance(), self.polish)
            .iter()
            .map(|found| Answer {
                q: found.q.to_vec(),
                residual: found.residual,
                branch: found.branch,
                singular: found.singular,
            })
            .collect()
    }

    /// What makes a branch an answer.
    pub fn acceptance(&self) -> Acceptance {
        let slides = |variable: &usize| {
            let mut joints = self.snap.model.joints.iter();
            joints.any(|joint| joint.variable == *variable && joint.kind == JointKind::Prismatic)
        };
        let size = self.linkage.size;
        Acceptance {
            size,
            tolerance: SOUND * size,
            blur: if self.polish == 0 {
                0.0
            } else {
                BLUR * (self.tip_shift / size).sqrt()
            },
            prismatic: (0..self.literal.variables())
                .filter(slides)
                .map(|i| 1 << i)
                .sum(),
        }
    }
}
