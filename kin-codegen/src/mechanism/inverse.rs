//! Inverse kinematics, chain by chain.

use super::freedom::Freedom;
use super::model::{Leg, Mechanism, meeting_point};
use crate::arm::CompiledArm;
use crate::geometry::{Linkage, Vec3, natural_target};
use crate::model::Model;
use crate::plan::Target;
use crate::solver::{NoClosedForm, solve};
use kin_runtime::Pose;

/// What the platform is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// A whole pose.
    Pose,
    /// A position: its orientation is that at home, always.
    Translation,
    /// What fixes one chain, which tells the others the pose: a position.
    Lead(usize),
}

/// How one chain finds its joints.
#[derive(Clone, Debug)]
pub enum LegForm {
    /// As one chain.
    Whole(Box<CompiledArm>),
    /// Up to the point where its last axes meet, and then about it.
    Split(Box<Split>),
}

/// A chain in two parts.
#[derive(Clone, Debug)]
pub struct Split {
    /// Up to the point, which its tip is at; at home turned as the base is.
    pub head: CompiledArm,
    /// About the point, from the base's orientation to the platform's.
    pub tail: CompiledArm,
    /// The point in the platform's frame.
    pub point: Vec3,
}

/// Inverse kinematics of a mechanism.
#[derive(Clone, Debug)]
pub struct Inverse {
    /// What it is asked for.
    pub aim: Aim,
    /// By chain.
    pub legs: Vec<LegForm>,
    /// Closed configurations that came back.
    pub verified: usize,
}

/// Joint values agree to this where the chain is regular.
pub(super) const SAME: f64 = 1e-6;

impl Inverse {
    /// Finds and verifies the closed forms of a mechanism whose platform `turns` in some assembly
    /// mode, though it may not do so in that of home.
    ///
    /// # Errors
    ///
    /// The first chain that has none, and why.
    pub fn find(
        mechanism: &Mechanism,
        freedom: &Freedom,
        turns: bool,
        file: &str,
    ) -> Result<Self, UnsolvedChain> {
        let aim = aim(mechanism, freedom, turns);
        let regular = regular(mechanism, freedom);
        let mut legs = Vec::new();
        for (k, leg) in mechanism.legs.iter().enumerate() {
            let [first, end] = mechanism.ranges()[k];
            let own = |q: &&Vec<f64>| q[first..end].to_vec();
            let samples: Vec<Vec<f64>> = regular.iter().map(own).collect();
            let form = leg_form(leg, k, aim, file, &samples);
            legs.push(form.map_err(|reason| UnsolvedChain { number: k, reason })?);
        }
        Ok(Inverse {
            aim,
            legs,
            verified: regular.len(),
        })
    }
}

/// A chain without a closed form.
#[derive(Clone, Debug, PartialEq)]
pub struct UnsolvedChain {
    /// Its number among the chains.
    pub number: usize,
    /// Why.
    pub reason: ChainRefusal,
}

/// Why a chain has no closed form.
#[derive(Clone, Debug, PartialEq)]
pub enum ChainRefusal {
    /// The search or its certificate says so.
    NoClosedForm(NoClosedForm),
    /// A closed configuration did not come back.
    Lost(Vec<f64>),
}

/// Samples at which no chain is singular: there all answers are isolated.
fn regular<'f>(mechanism: &Mechanism, freedom: &'f Freedom) -> Vec<&'f Vec<f64>> {
    let generic = mechanism.generic();
    let clear = |q: &&Vec<f64>| generic.inverse_jacobian(q).is_some();
    freedom.samples.iter().filter(clear).collect()
}

/// What the platform is asked for, which `turns` in some assembly mode.
fn aim(mechanism: &Mechanism, freedom: &Freedom, turns: bool) -> Aim {
    if freedom.translates && !turns {
        return Aim::Translation;
    }
    let fixed = |leg: &Leg| natural_target(&leg.model) == Target::Position;
    match mechanism.legs.iter().position(fixed) {
        Some(leg) if freedom.platform < 3 => Aim::Lead(leg),
        _ => Aim::Pose,
    }
}

fn leg_form(
    leg: &Leg,
    k: usize,
    aim: Aim,
    file: &str,
    samples: &[Vec<f64>],
) -> Result<LegForm, ChainRefusal> {
    let target = match aim {
        Aim::Lead(lead) if lead == k => Target::Position,
        _ => Target::Pose,
    };
    let whole = solved(file, leg.model.clone(), target)
        .map_err(ChainRefusal::NoClosedForm)
        .map(|compiled| LegForm::Whole(Box::new(compiled)))
        .and_then(|form| form.recovers(leg, samples));
    let by_subproblems = |form: &LegForm| match form {
        LegForm::Whole(arm) => {
            let found = arm.inverse.as_ref();
            found.is_some_and(|found| !found.form.asks_elimination())
        }
        LegForm::Split(_) => true,
    };
    match whole {
        Ok(form) if by_subproblems(&form) => Ok(form),
        other if target == Target::Pose => split(leg, file)
            .and_then(|form| form.recovers(leg, samples).ok())
            .map_or(other, Ok),
        other => other,
    }
}

/// The last two or three axes meet, and what is in front of them reaches their
/// point.
fn split(leg: &Leg, file: &str) -> Option<LegForm> {
    let model = &leg.model;
    let n = model.joints.len();
    [3, 2]
        .into_iter()
        .filter(|count| *count < n)
        .find_map(|count| {
            let at = n - count;
            let turn = |j: usize| model.joints[j].is_revolute();
            if !(at..n).all(turn) {
                return None;
            }
            let point = meeting_point(model, at..n)?;
            let wrist = Pose::from_translation(point);
            let head = part(model, 0..at, wrist, "wrist");
            let tail = Pose {
                translation: point,
                ..model.home
            };
            let tail = part(model, at..n, tail, &model.tip);
            Some(LegForm::Split(Box::new(Split {
                head: solved(file, head, Target::Position).ok()?,
                tail: solved(file, tail, Target::Orientation).ok()?,
                point: model.home.inverse().transform_point(point),
            })))
        })
}

/// A chain with its closed form.
pub(super) fn solved(
    file: &str,
    model: Model,
    target: Target,
) -> Result<CompiledArm, NoClosedForm> {
    let linkage = Linkage::new(&model);
    let form = solve(&model, &linkage, target)?;
    Ok(CompiledArm::new(file, model, linkage, Some(form)))
}

/// A chain without inverse kinematics.
pub(super) fn forward_alone(file: &str, model: Model) -> CompiledArm {
    let linkage = Linkage::new(&model);
    CompiledArm::new(file, model, linkage, None)
}

/// Some joints of a chain as a chain of their own.
pub(super) fn part(model: &Model, joints: std::ops::Range<usize>, home: Pose, tip: &str) -> Model {
    let first = joints.start;
    let mut part = Model {
        tip: tip.into(),
        joints: model.joints[joints.clone()].to_vec(),
        variables: model.variables[joints].to_vec(),
        home,
        frames: Vec::new(),
        ..model.clone()
    };
    part.joints
        .iter_mut()
        .for_each(|joint| joint.variable -= first);
    part
}

impl LegForm {
    /// How many branches it looks at.
    pub fn branches(&self) -> usize {
        match self {
            LegForm::Whole(whole) => whole.branches(),
            LegForm::Split(split) => split.head.branches() * split.tail.branches(),
        }
    }

    /// The plans, in short.
    pub fn plan(&self) -> String {
        let plan = |compiled: &CompiledArm| {
            let form = compiled.form();
            form.map_or_else(String::new, |form| form.plan.to_string())
        };
        match self {
            LegForm::Whole(whole) => plan(whole),
            LegForm::Split(split) => format!("{}, then {}", plan(&split.head), plan(&split.tail)),
        }
    }

    /// What the generated function will return, computed on the tapes of its arms.
    pub fn solutions(&self, target: &Pose) -> Vec<Vec<f64>> {
        let of = |compiled: &CompiledArm, target: &Pose| -> Vec<Vec<f64>> {
            let form = compiled.form();
            let solutions = form.map_or_else(Vec::new, |form| form.solutions(target));
            solutions.into_iter().map(|solution| solution.q).collect()
        };
        match self {
            LegForm::Whole(whole) => of(whole, target),
            LegForm::Split(split) => {
                let wrist = Pose::from_translation(target.transform_point(split.point));
                let tails = |head: Vec<f64>| {
                    let turned = split.head.model.chain().fk(&head);
                    let rest = turned.inverse() * *target;
                    let both = move |tail: Vec<f64>| [head.clone(), tail].concat();
                    of(&split.tail, &rest).into_iter().map(both)
                };
                of(&split.head, &wrist)
                    .into_iter()
                    .flat_map(tails)
                    .collect()
            }
        }
    }

    /// Every configuration comes back from the pose that it makes, and every
    /// solution makes that pose.
    fn recovers(self, leg: &Leg, samples: &[Vec<f64>]) -> Result<Self, ChainRefusal> {
        let chain = leg.chain();
        let same = |a: &[f64], b: &[f64]| {
            (0..a.len()).all(|j| leg.model.joint_distance(j, a[j], b[j]) < SAME)
        };
        for q in samples {
            let solutions = self.solutions(&chain.fk(q));
            if !solutions.iter().any(|solution| same(solution, q)) {
                return Err(ChainRefusal::Lost(q.clone()));
            }
        }
        Ok(self)
    }
}
