//! What a closed form has to do.

use crate::arm::Arm;
use kin_codegen::closed_form::{BranchSolution, ClosedForm};
use kin_codegen::geometry::{Linkage, natural_target, size};
use kin_codegen::model::{JointKind, Model};
use kin_codegen::plan::Target;
use kin_codegen::solver::{NoClosedForm, solve};
use kin_runtime::{Chain, ChainSolution, Pose, SearchOptions, Twist};
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
    /// The chain with joints for what of a target does not count.
    freed: Chain,
    form: ClosedForm,
    size: f64,
    target: Target,
}

impl Solved {
    /// # Errors
    /// The arm has no closed form.
    pub fn try_new(arm: &Arm) -> Result<Solved, NoClosedForm> {
        Solved::for_target(arm, natural_target(&arm.0))
    }

    /// With targets of which only a part counts.
    ///
    /// # Errors
    /// The arm has no closed form.
    pub fn for_target(Arm(arm): &Arm, target: Target) -> Result<Solved, NoClosedForm> {
        Ok(Solved {
            arm: arm.clone(),
            chain: arm.chain(),
            freed: freed(&arm.chain(), target),
            form: solve(arm, &Linkage::new(arm), target)?.form,
            size: size(arm),
            target,
        })
    }

    /// # Errors
    /// The arm has no closed form.
    pub fn new(arm: &Arm) -> Result<Solved, TestCaseError> {
        Solved::new_for_target(arm, natural_target(&arm.0))
    }

    /// # Errors
    /// The arm has no closed form.
    pub fn new_for_target(arm: &Arm, target: Target) -> Result<Solved, TestCaseError> {
        let refused = |reason| TestCaseError::fail(format!("refused: {reason:?}"));
        Solved::for_target(arm, target).map_err(refused)
    }

    /// The target of `q` has exactly the answers that the search finds, which
    /// includes `q`.
    pub fn check(&self, q: &[f64]) -> Check {
        self.check_quickly(q)?;
        let pose = self.chain.fk(q);
        self.complete(&self.form.solutions(&pose), &pose)
    }

    /// The answers to the target of `q` reach it, each comes once, and `q` is
    /// one of them.
    pub fn check_quickly(&self, q: &[f64]) -> Check {
        let pose = self.chain.fk(q);
        let answers = self.form.solutions(&pose);
        self.sound(&answers, &pose)?;
        self.distinct(&answers)?;
        if self.conditioning(q) > REGULAR {
            self.among(q, &answers, ROUNDING)?;
        }
        Ok(())
    }

    fn sound(&self, answers: &[BranchSolution], pose: &Pose) -> Check {
        for answer in answers {
            let miss = self
                .target
                .distance(&self.chain.fk(&answer.q), pose, self.size);
            prop_assert!(miss <= SOUND * self.size, "{answer:?} misses by {miss:e}");
        }
        Ok(())
    }

    fn distinct(&self, answers: &[BranchSolution]) -> Check {
        for (i, a) in answers.iter().enumerate() {
            for b in &answers[..i] {
                prop_assert!(self.apart(&a.q, &b.q) > SAME, "{a:?} and {b:?}");
            }
        }
        Ok(())
    }

    fn among(&self, q: &[f64], answers: &[BranchSolution], rounding: f64) -> Check {
        let tolerance = rounding / self.conditioning(q);
        let same = |answer: &&BranchSolution| self.apart(&answer.q, q) < tolerance;
        let count = answers.iter().filter(same).count();
        prop_assert!(
            count == 1,
            "{q:?} to {tolerance:e} among {answers:#?} of {}, {}",
            self.form.plan,
            self.reading(),
        );
        Ok(())
    }

    fn complete(&self, answers: &[BranchSolution], pose: &Pose) -> Check {
        let found = self.found(pose);
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
        let found = self.found(&self.chain.fk(q));
        let conditioning = found.iter().map(|solution| self.conditioning(&solution.q));
        conditioning.fold(f64::INFINITY, f64::min)
    }

    /// How the arm was read.
    fn reading(&self) -> String {
        let (shift, how) = (self.form.tip_shift, &self.form.refinement);
        format!("tip shifted by {shift:e} m, {how:?}")
    }

    /// What the numerical search finds.
    fn found(&self, pose: &Pose) -> Vec<ChainSolution> {
        let options = SearchOptions {
            target: self.target,
            ..SearchOptions::default()
        };
        self.chain.ik_all(pose, &options)
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

    /// See [`conditioning`].
    fn conditioning(&self, q: &[f64]) -> f64 {
        conditioning(&self.freed, q, self.size, self.target)
    }
}

/// Whether the joints move what of a target counts independently, somewhere.
pub fn commands(Arm(arm): &Arm, target: Target) -> bool {
    let freed = freed(&arm.chain(), target);
    let somewhere = |k: usize| -> Vec<f64> {
        let value = |i: usize| (i * 5 + k * 7) as f64 * 0.61 % 3.0;
        (0..arm.joints.len()).map(value).collect()
    };
    (0..4).any(|k| conditioning(&freed, &somewhere(k), size(arm), target) > 0.01)
}

/// The least singular value of the target's Jacobian, lengths in units of the
/// arm's size.
fn conditioning(freed: &Chain, q: &[f64], size: f64, target: Target) -> f64 {
    let mut q = q.to_vec();
    q.resize(freed.twists().len(), 0.0);
    let rows = match target {
        Target::Position => 3,
        _ => 6,
    };
    let columns: Vec<_> = freed
        .geometric_jacobian(&q)
        .iter()
        .map(|twist| {
            let linear = twist.linear.map(|x| x / size);
            DVector::from_iterator(rows, linear.into_iter().chain(twist.angular).take(rows))
        })
        .collect();
    DMatrix::from_columns(&columns).singular_values().min()
}

/// The chain with joints at its tip for what of a target does not count; it
/// reaches a whole pose where the chain reaches the part that counts.
fn freed(chain: &Chain, target: Target) -> Chain {
    let tip = chain.home();
    let spin = Twist::revolute(tip.rotate([0.0, 0.0, 1.0]), tip.translation);
    let slides =
        [0, 1, 2].map(|i| Twist::prismatic([0, 1, 2].map(|j| f64::from(u8::from(i == j)))));
    let mut twists = chain.twists().to_vec();
    match target {
        Target::PositionAxis => twists.push(spin),
        Target::Orientation => twists.extend(slides),
        Target::Direction => {
            twists.push(spin);
            twists.extend(slides);
        }
        Target::Pose | Target::Position | Target::PositionYaw | Target::Planar => {}
    }
    Chain::new(twists, *tip)
}
