//! What a closed form has to do.

use crate::arm::Arm;
use kin_codegen::geometry::size;
use kin_codegen::model::{JointKind, Model};
use kin_codegen::plan::Target;
use kin_codegen::solver::{Answer, ClosedForm, NoClosedForm, solve};
use kin_codegen::verify::{chain, distance, natural_target};
use kin_runtime::{Chain, Goal, Pose, SearchOptions};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Relative to the arm's size.
const SOUND: f64 = 1e-9;
/// Below this the search is no longer sure to find a solution.
const REGULAR: f64 = 1e-3;
/// The search accepts what is this close to the target, relative to the arm's
/// size; conditioning magnifies it.
const SEARCH: f64 = 1e-11;
/// Closer answers are one.
const SAME: f64 = 1e-7;

/// Rounding in the target, which conditioning magnifies.
const ROUNDING: f64 = 1e-11;

/// What does not hold.
pub type Check = Result<(), TestCaseError>;

/// An arm with its closed form and its generic chain.
pub struct Solved {
    arm: Model,
    chain: Chain,
    form: ClosedForm,
    size: f64,
    target: Target,
}

impl Solved {
    /// # Errors
    /// The arm has no closed form.
    pub fn try_new(Arm(arm): &Arm) -> Result<Solved, NoClosedForm> {
        let target = natural_target(arm);
        Ok(Solved {
            arm: arm.clone(),
            chain: chain(arm),
            form: solve(arm, target)?,
            size: size(arm),
            target,
        })
    }

    /// # Errors
    /// The arm has no closed form.
    pub fn new(arm: &Arm) -> Result<Solved, TestCaseError> {
        let refused = |reason| TestCaseError::fail(format!("refused: {reason:?}"));
        Solved::try_new(arm).map_err(refused)
    }

    /// The target of `q` has exactly the answers that the search finds, which
    /// includes `q`.
    pub fn check(&self, q: &[f64]) -> Check {
        self.check_quickly(q)?;
        let pose = self.chain.fk(q);
        self.complete(&self.form.answers(&pose), &pose)
    }

    /// The answers to the target of `q` reach it, each comes once, and `q` is
    /// one of them.
    pub fn check_quickly(&self, q: &[f64]) -> Check {
        let pose = self.chain.fk(q);
        let answers = self.form.answers(&pose);
        self.sound(&answers, &pose)?;
        self.distinct(&answers)?;
        if self.conditioning(q) > REGULAR {
            self.among(q, &answers, ROUNDING)?;
        }
        Ok(())
    }

    fn sound(&self, answers: &[Answer], pose: &Pose) -> Check {
        for answer in answers {
            let miss = distance(&self.chain.fk(&answer.q), pose, self.size, self.target);
            prop_assert!(miss <= SOUND * self.size, "{answer:?} misses by {miss:e}");
        }
        Ok(())
    }

    fn distinct(&self, answers: &[Answer]) -> Check {
        for (i, a) in answers.iter().enumerate() {
            for b in &answers[..i] {
                prop_assert!(self.apart(&a.q, &b.q) > SAME, "{a:?} and {b:?}");
            }
        }
        Ok(())
    }

    fn among(&self, q: &[f64], answers: &[Answer], rounding: f64) -> Check {
        let tolerance = rounding / self.conditioning(q);
        let same = |answer: &&Answer| self.apart(&answer.q, q) < tolerance;
        let count = answers.iter().filter(same).count();
        prop_assert!(
            count == 1,
            "{q:?} to {tolerance:e} among {answers:#?} of {}, {}",
            self.form.plan,
            self.reading(),
        );
        Ok(())
    }

    fn complete(&self, answers: &[Answer], pose: &Pose) -> Check {
        let found = self.chain.ik_all(pose, &self.search());
        let conditioning = |q: &Vec<f64>| self.conditioning(q);
        let regular = |q: &Vec<f64>| conditioning(q) > REGULAR;
        for solution in found.iter().filter(|solution| regular(&solution.q)) {
            self.among(&solution.q, answers, SEARCH)?;
        }
        let all = found
            .iter()
            .map(|s| &s.q)
            .chain(answers.iter().map(|a| &a.q));
        if all.into_iter().all(regular) {
            prop_assert!(answers.len() == found.len(), "{answers:#?}, {found:#?}");
        }
        Ok(())
    }

    /// The least conditioning of all configurations with the target of `q`.
    pub fn least_conditioning(&self, q: &[f64]) -> f64 {
        let found = self.chain.ik_all(&self.chain.fk(q), &self.search());
        let conditioning = found.iter().map(|solution| self.conditioning(&solution.q));
        conditioning.fold(f64::INFINITY, f64::min)
    }

    /// How the arm was read.
    fn reading(&self) -> String {
        let (shift, steps) = (self.form.tip_shift, self.form.polish);
        format!("tip shifted by {shift:e} m, {steps} steps of polish")
    }

    fn search(&self) -> SearchOptions {
        SearchOptions {
            goal: match self.target {
                Target::Position => Goal::Position,
                // Of what a part of the pose leaves open, the whole pose is a part.
                _ => Goal::Pose,
            },
            ..SearchOptions::default()
        }
    }

    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let joints = self.arm.joints.iter().zip(a.iter().zip(b));
        let difference = joints.map(|(joint, (a, b))| match joint.kind {
            JointKind::Revolute => {
                let d = (a - b).abs() % TAU;
                d.min(TAU - d)
            }
            JointKind::Prismatic => (a - b).abs() / self.size,
        });
        difference.fold(0.0, f64::max)
    }

    /// The least singular value of the target's Jacobian, lengths in units of
    /// the arm's size.
    fn conditioning(&self, q: &[f64]) -> f64 {
        let rows = match self.target {
            Target::Position => 3,
            _ => 6,
        };
        let columns: Vec<_> = self
            .chain
            .geometric_jacobian(q)
            .iter()
            .map(|twist| {
                let linear = twist.linear.map(|x| x / self.size);
                DVector::from_iterator(rows, linear.into_iter().chain(twist.angular).take(rows))
            })
            .collect();
        DMatrix::from_columns(&columns).singular_values().min()
    }
}
