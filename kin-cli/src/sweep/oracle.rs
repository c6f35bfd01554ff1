//! The comparison with the numerical search.

use super::subject::{Seen, Subject};
use super::{Kind, Split};
use kin_codegen::solver::Answer;
use kin_runtime::{ChainSolution, SearchOptions};
use serde::Serialize;

/// Targets with a solution worse conditioned than this are left out: there the
/// search itself may miss solutions.
const REGULAR: f64 = 1e-4;

/// A closed form held against the numerical search.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// Targets compared.
    pub targets: usize,
    /// Targets left out: some solution of theirs is singular, or nearly.
    pub skipped: usize,
    /// Solutions that the search found.
    pub solutions: usize,
    /// Of these, not among the answers.
    pub missing: Split,
    /// Answers that the search does not find, even if it begins there.
    pub extra: Split,
    /// Answers that the search finds only if it begins there.
    pub overlooked: usize,
}

impl Comparison {
    /// Whether answers and solutions are the same, away from singular
    /// configurations.
    pub fn is_clean(&self) -> bool {
        self.missing.regular == 0 && self.extra.regular == 0
    }

    /// Tells `note` of every difference, and whether it is near singular.
    pub(super) fn compare(
        &mut self,
        subject: &Subject,
        seen: &Seen,
        mut note: impl FnMut(Kind, bool),
    ) {
        let found = search(subject, seen);
        if found.iter().any(|found| found.conditioning < REGULAR) {
            self.skipped += 1;
            return;
        }
        self.targets += 1;
        self.solutions += found.len();
        for solution in &found {
            let independence = subject.independence(&solution.q);
            if !subject.is_among(&solution.q, &seen.answers, independence) {
                let near_singular = independence < subject.near_singular;
                self.missing.count(near_singular);
                note(Kind::Missing, near_singular);
            }
        }
        let found: Vec<Answer> = found.iter().map(as_answer).collect();
        for (answer, &residual) in seen.answers.iter().zip(&seen.residuals) {
            let independence = subject.independence(&answer.q);
            if !subject.is_sound(residual) || subject.is_among(&answer.q, &found, independence) {
                continue;
            }
            if is_confirmed(subject, seen, answer, independence) {
                self.overlooked += 1;
            } else {
                let near_singular = independence < subject.near_singular;
                self.extra.count(near_singular);
                note(Kind::Extra, near_singular);
            }
        }
    }

    pub(super) fn add(&mut self, other: &Comparison) {
        self.targets += other.targets;
        self.skipped += other.skipped;
        self.solutions += other.solutions;
        self.missing.add(other.missing);
        self.extra.add(other.extra);
        self.overlooked += other.overlooked;
    }
}

/// What the search finds for a target.
pub(super) fn search(subject: &Subject, seen: &Seen) -> Vec<ChainSolution> {
    subject.chain.ik_all(&seen.target, &options(subject))
}

fn options(subject: &Subject) -> SearchOptions {
    SearchOptions {
        target: subject.form.plan.target,
        ..SearchOptions::default()
    }
}

/// A descent from the answer stays there.
fn is_confirmed(subject: &Subject, seen: &Seen, answer: &Answer, independence: f64) -> bool {
    let landed = subject
        .chain
        .ik_from(&seen.target, &options(subject), &answer.q);
    landed.is_some_and(|landed| subject.is_among(&answer.q, &[as_answer(&landed)], independence))
}

/// A solution of the search, to be looked for as answers are.
pub(super) fn as_answer(found: &ChainSolution) -> Answer {
    Answer {
        q: found.q.clone(),
        residual: found.residual,
        branch: 0,
        singular: false,
    }
}
