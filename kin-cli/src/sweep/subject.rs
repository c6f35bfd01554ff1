//! An arm and its closed form under examination.

use super::Settings;
use super::draw::Ranges;
use kin_codegen::model::Model;
use kin_codegen::solver::{Answer, ClosedForm};
use kin_codegen::verify::{
    BLUR, Failure, SINGULAR, SOUND, chain, distance, independence, recovered,
};
use kin_runtime::{Chain, Pose};
use std::time::{Duration, Instant};

/// An arm and its closed form.
pub(super) struct Subject<'a> {
    model: &'a Model,
    pub(super) form: &'a ClosedForm,
    /// The arm as a generic product of exponentials.
    pub(super) chain: Chain,
    /// Metres.
    pub(super) size: f64,
    /// Below this independence the certificate takes a configuration for
    /// singular, or too near to it for an arm that was snapped.
    pub(super) near_singular: f64,
    ranges: Ranges,
}

/// A configuration, its target and what the closed form answers.
pub(super) struct Seen {
    pub(super) q: Vec<f64>,
    pub(super) target: Pose,
    pub(super) independence: f64,
    pub(super) answers: Vec<Answer>,
    /// How far the generic forward kinematics of each answer is from the
    /// target, metres.
    pub(super) residuals: Vec<f64>,
    pub(super) took: Duration,
}

impl<'a> Subject<'a> {
    pub(super) fn new(model: &'a Model, form: &'a ClosedForm) -> Self {
        let size = kin_codegen::geometry::size(model);
        Self {
            model,
            form,
            chain: chain(model),
            size,
            near_singular: SINGULAR.max(BLUR * (form.tip_shift / size).sqrt()),
            ranges: Ranges::new(model, size),
        }
    }

    pub(super) fn draw(&self, settings: &Settings, number: usize) -> Vec<f64> {
        self.ranges.draw(settings.draw, settings.seed, number)
    }

    pub(super) fn look(&self, q: Vec<f64>) -> Seen {
        let target = self.chain.fk(&q);
        let start = Instant::now();
        let answers = self.form.answers(&target);
        let took = start.elapsed();
        let residual = |answer: &Answer| self.residual(&answer.q, &target);
        Seen {
            independence: self.independence(&q),
            residuals: answers.iter().map(residual).collect(),
            q,
            target,
            answers,
            took,
        }
    }

    fn residual(&self, q: &[f64], target: &Pose) -> f64 {
        distance(&self.chain.fk(q), target, self.size, self.form.plan.target)
    }

    /// How far from singular a configuration is.
    pub(super) fn independence(&self, q: &[f64]) -> f64 {
        independence(&self.chain, q, self.size, self.form.plan.target)
    }

    pub(super) fn is_near_singular(&self, q: &[f64]) -> bool {
        self.independence(q) < self.near_singular
    }

    pub(super) fn is_sound(&self, residual: f64) -> bool {
        residual <= SOUND * self.size
    }

    /// Whether a configuration is among the answers, to what its conditioning
    /// allows.
    pub(super) fn is_among(&self, q: &[f64], answers: &[Answer], independence: f64) -> bool {
        let seen = recovered(self.model, q, answers, independence);
        !matches!(seen, Err(Failure::Lost(_)))
    }

    /// Whether the last answer repeats one before it.
    pub(super) fn is_doubled(&self, answers: &[Answer]) -> bool {
        // At this independence the same is to the last digits.
        const EXACTLY: f64 = 1.0;
        answers
            .split_last()
            .is_some_and(|(last, before)| self.is_among(&last.q, before, EXACTLY))
    }
}
