//! The comparison with the numerical search.

use super::case::{CONVERGED, Case, Outcome};
use super::{Kind, Split};
use kin_codegen::closed_form::BranchSolution;
use kin_runtime::{ChainSolution, Parameter, SearchOptions};
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
    /// Of these, not among the solutions.
    pub missing: Split,
    /// Solutions that the search does not find, even if it begins there.
    pub extra: Split,
    /// Solutions that the search finds only if it begins there.
    pub overlooked: usize,
}

impl Comparison {
    /// Whether closed form and search find the same, away from singular configurations.
    pub fn is_clean(&self) -> bool {
        self.missing.regular == 0 && self.extra.regular == 0
    }

    /// Tells `note` of every difference, and whether it is near singular.
    pub(super) fn compare(
        &mut self,
        case: &Case,
        outcome: &Outcome,
        mut note: impl FnMut(Kind, bool),
    ) {
        let found = search(case, outcome);
        if found.iter().any(|found| found.conditioning < REGULAR) {
            self.skipped += 1;
            return;
        }
        self.targets += 1;
        self.solutions += found.len();
        for solution in &found {
            let conditioning = case.conditioning(&solution.q);
            if !case.is_among(&solution.q, &outcome.solutions, conditioning) {
                let near_singular = conditioning < case.near_singular;
                self.missing.count(near_singular);
                note(Kind::Missing, near_singular);
            }
        }
        let found: Vec<BranchSolution> = found.iter().map(as_solution).collect();
        for (solution, &residual) in outcome.solutions.iter().zip(&outcome.residuals) {
            let conditioning = case.conditioning(&solution.q);
            if !case.is_taken(residual) || case.is_among(&solution.q, &found, conditioning) {
                continue;
            }
            if is_confirmed(case, outcome, solution, conditioning) {
                self.overlooked += 1;
            } else {
                let near_singular = conditioning < case.near_singular;
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

/// What the search finds for a target, with the parameters of the configuration. A pose that was
/// rounded to single precision is none that it could come near: it has the one that was rounded.
pub(super) fn search(case: &Case, outcome: &Outcome) -> Vec<ChainSolution> {
    let given = case.given(&outcome.q);
    let target = case.fk(&outcome.q);
    let found = case.chain.ik_all(&target, &options(case, &given));
    let found = found.into_iter();
    let found = found.map(|found| by_coordinates(case, found));
    // Joints that move by themselves reach more targets.
    let is_coupled = case.form.given.coupling.is_some();
    let reaches = |it: &ChainSolution| {
        let tolerance = it.residual + CONVERGED * case.size;
        case.residual(&it.q, &target) <= 10.0 * tolerance
    };
    found.filter(|it| !is_coupled || reaches(it)).collect()
}

/// A solution by the coordinates that follow from its joints.
fn by_coordinates(case: &Case, found: ChainSolution) -> ChainSolution {
    match &case.form.given.coupling {
        Some(coupling) => {
            let (parameters, joints) = case.form.split(&found.q);
            let q = case.form.whole(&coupling.coordinates(&joints), &parameters);
            ChainSolution {
                conditioning: case.conditioning(&q),
                q,
                ..found
            }
        }
        None => found,
    }
}

fn options<'a>(case: &Case, given: &'a [(Parameter, f64)]) -> SearchOptions<'a> {
    SearchOptions {
        target: case.form.plan.target,
        given,
        ..SearchOptions::default()
    }
}

/// A descent from the solution stays there.
fn is_confirmed(
    case: &Case,
    outcome: &Outcome,
    solution: &BranchSolution,
    conditioning: f64,
) -> bool {
    let given = case.given(&outcome.q);
    let options = options(case, &given);
    let start = case.form.joints(&solution.q);
    let target = case.fk(&outcome.q);
    let landed = case.chain.ik_from(&target, &options, &start);
    let landed = landed.map(|landed| by_coordinates(case, landed));
    landed.is_some_and(|landed| case.is_among(&solution.q, &[as_solution(&landed)], conditioning))
}

/// A solution of the search, to be looked for as solutions are.
pub(super) fn as_solution(found: &ChainSolution) -> BranchSolution {
    BranchSolution {
        q: found.q.clone(),
        residual: found.residual,
        branch: 0,
        singular: false,
    }
}
