//! An arm and its closed form under examination.

use super::Settings;
use super::draw::Ranges;
use kin_codegen::Scalar;
use kin_codegen::certificate::{Failure, recovered};
use kin_codegen::closed_form::{BranchSolution, ClosedForm};
use kin_codegen::geometry::{SINGULAR, size, solved_chain};
use kin_codegen::model::Model;
use kin_runtime::{Chain, Parameter, Pose};
use std::borrow::Cow;
use std::time::{Duration, Instant};

/// The search takes what is this close to a target, of the arm's size: of one that is out of reach
/// by more a closed form has solutions within its tolerance, and the search none.
pub(super) const CONVERGED: f64 = 1e-12;
/// Its length is another than the arm's size, and its measure of a turn another than that of solutions:
/// closer by so much it takes what is a solution by either.
const SURELY: f64 = 0.1;

/// An arm and its closed form.
pub(super) struct Case<'a> {
    /// Whose joints move by themselves.
    model: Cow<'a, Model>,
    pub(super) form: &'a ClosedForm,
    /// The arm as a generic product of exponentials.
    pub(super) chain: Chain,
    /// Metres.
    pub(super) size: f64,
    /// Below this conditioning the certificate takes a configuration for
    /// singular, or too near to it for an arm that was idealized.
    pub(super) near_singular: f64,
    ranges: Ranges,
}

/// A configuration, its target and what the closed form finds.
pub(super) struct Outcome {
    pub(super) q: Vec<f64>,
    pub(super) target: Pose,
    pub(super) conditioning: f64,
    pub(super) solutions: Vec<BranchSolution>,
    /// How far the generic forward kinematics of each solution is from the
    /// target, metres.
    pub(super) residuals: Vec<f64>,
    pub(super) took: Duration,
}

impl<'a> Case<'a> {
    pub(super) fn new(model: &'a Model, form: &'a ClosedForm) -> Self {
        let size = size(model);
        let ranges = Ranges::new(model, size);
        // Of an arm that is solved its coordinates follow from the joints.
        let given = Some(form.given.locked.len()).filter(|given| *given > 0);
        let own = solved_chain(model, given).filter(|_| model.is_coupled());
        let model = own.map_or(Cow::Borrowed(model), |(own, _)| Cow::Owned(own));
        Self {
            chain: model.chain(),
            model,
            form,
            size,
            near_singular: SINGULAR.max(form.near_singular()),
            ranges,
        }
    }

    pub(super) fn draw(&self, settings: &Settings, number: usize) -> Vec<f64> {
        self.ranges.draw(settings.draw, settings.seed, number)
    }

    pub(super) fn run(&self, q: Vec<f64>) -> Outcome {
        let target = self.form.linkage.scalar.target(self.fk(&q));
        let start = Instant::now();
        let (parameters, _) = self.form.split(&q);
        let mut solutions = self.form.solutions_at(&target, &parameters);
        let took = start.elapsed();
        for solution in &mut solutions {
            solution.q = self.form.whole(&solution.q, &parameters);
        }
        let residual = |solution: &BranchSolution| self.residual(&solution.q, &target);
        Outcome {
            conditioning: self.conditioning(&q),
            residuals: solutions.iter().map(residual).collect(),
            q,
            target,
            solutions,
            took,
        }
    }

    pub(super) fn residual(&self, q: &[f64], target: &Pose) -> f64 {
        let projection = self.form.projection();
        let [tip, target] = [&self.fk(q), target].map(|pose| projection.pose(pose));
        projection.counts.distance(&tip, &target, self.size)
    }

    /// Whether the search surely takes what is this far from a target, metres; of solutions in single
    /// precision, whether one would be near: to a target that fewer joints than it has coordinates
    /// nearly reach there may be none.
    pub(super) fn is_taken(&self, residual: f64) -> bool {
        let form = &self.form;
        match form.linkage.scalar {
            Scalar::F64 => residual <= SURELY * CONVERGED * self.size,
            Scalar::F32 if form.given.variables() < form.plan.target.coordinates() => false,
            Scalar::F32 => self.is_sound(residual),
        }
    }

    /// The tip of a configuration, in double precision.
    pub(super) fn fk(&self, q: &[f64]) -> Pose {
        self.chain.fk(&self.form.joints(q))
    }

    /// The chain of the joints that targets are solved for, and their values.
    pub(super) fn solved_for(&self, q: &[f64]) -> (Cow<'_, Chain>, Vec<f64>) {
        let locked = &self.form.given.locked;
        if locked.is_empty() {
            return (Cow::Borrowed(&self.chain), q.to_vec());
        }
        // From the last on, so that the places of the others stay.
        let hold = |chain: Chain, &joint: &usize| chain.locked(joint, q[joint]);
        let chain = locked.iter().rev().fold(self.chain.clone(), hold);
        (Cow::Owned(chain), self.form.split(q).1)
    }

    /// The parameters of a configuration, for the numerical search.
    pub(super) fn given(&self, q: &[f64]) -> Vec<(Parameter, f64)> {
        let (values, _) = self.form.split(q);
        let locked = self.form.given.locked.iter();
        let joints = locked.map(|&joint| Parameter::Joint(joint));
        let swivel = self.form.given.swivel.iter();
        let swivel = swivel.map(|swivel| Parameter::Swivel(swivel.at_run_time(&self.model)));
        joints.chain(swivel).zip(values).collect()
    }

    /// How far from singular a configuration is.
    pub(super) fn conditioning(&self, q: &[f64]) -> f64 {
        let (chain, solved) = self.solved_for(q);
        let given = &self.form.given;
        given.conditioning(&chain, &solved, self.form.plan.target)
    }

    pub(super) fn is_near_singular(&self, q: &[f64]) -> bool {
        self.conditioning(q) < self.near_singular
    }

    pub(super) fn is_sound(&self, residual: f64) -> bool {
        let linkage = &self.form.linkage;
        residual <= linkage.scalar.tolerances().solved * linkage.size
    }

    /// Whether a configuration is among the solutions, to what its conditioning
    /// allows.
    pub(super) fn is_among(
        &self,
        q: &[f64],
        solutions: &[BranchSolution],
        conditioning: f64,
    ) -> bool {
        let by_joints = |solution: &BranchSolution| BranchSolution {
            q: self.form.joints(&solution.q),
            ..solution.clone()
        };
        let solutions: Vec<BranchSolution> = solutions.iter().map(by_joints).collect();
        let outcome = recovered(&self.model, &self.form.joints(q), &solutions, conditioning);
        !matches!(outcome, Err(Failure::Lost(_)))
    }

    /// Whether the last solution repeats one before it.
    pub(super) fn is_doubled(&self, solutions: &[BranchSolution]) -> bool {
        // At this conditioning the same is to the last digits.
        const EXACTLY: f64 = 1.0;
        solutions
            .split_last()
            .is_some_and(|(last, before)| self.is_among(&last.q, before, EXACTLY))
    }
}
