//! Whole plans, run twice: by the subproblems of the runtime, in numbers and
//! along the twists of the chain, and by the expressions that code is generated
//! from. Neither shares a line with the other. Both find the same branches.

mod arms;
mod closed_loop;
mod execute;
mod point;

use arms::{Arm, every_arm};
use closed_loop::{ClosedLoop, wrapped};
use execute::execute;
use kin_codegen::closed_form::{BranchSolution, ClosedForm};
use kin_codegen::geometry::{Linkage, SINGULAR, conditioning};
use kin_codegen::model::Model;
use kin_codegen::plan::Subproblem;
use kin_codegen::random::Random;
use kin_codegen::solver::solve;
use kin_runtime::{Chain, Pose};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// Relative to the arm's size.
const SOUND: f64 = 1e-9;
/// Angles in radians, and lengths relative to the arm's size.
const SAME: f64 = 1e-6;

/// An arm with its closed form.
struct Case {
    name: String,
    chain: Chain,
    /// With the turn that the target leaves free as one more joint.
    closing: Chain,
    model: Model,
    closed_form: ClosedForm,
}

impl Case {
    /// Of the arm as its design has it: what a noisy file adds is refined
    /// behind the plan.
    fn new(
        Arm {
            name,
            model,
            target,
        }: Arm,
    ) -> Case {
        let solved = |model: &Model| {
            solve(model, &Linkage::new(model), target)
                .unwrap_or_else(|why| panic!("{name}: {why:?}"))
                .form
        };
        let mut closed_form = solved(&model);
        if !closed_form.is_exact() {
            closed_form = solved(&closed_form.idealized.model);
        }
        assert!(closed_form.is_exact(), "{name}");
        let model = closed_form.idealized.model.clone();
        let chain = model.chain();
        let linkage = &closed_form.linkage;
        let twists = (0..linkage.links.len()).map(|joint| linkage.twist(joint));
        let closing = match linkage.has_free_turn {
            true => Chain::new(twists.collect(), *chain.home()),
            false => chain.clone(),
        };
        Case {
            name,
            chain,
            closing,
            model,
            closed_form,
        }
    }

    /// What the subproblems find and forward kinematics confirms.
    fn executed(&self, target: &Pose, relation: usize) -> Vec<Vec<f64>> {
        let ClosedForm { linkage, plan, .. } = &self.closed_form;
        let closed = ClosedLoop::new(&self.closing, linkage, target);
        let mut found = execute(closed, plan, relation);
        found
            .iter_mut()
            .for_each(|q| q.truncate(self.model.joints.len()));
        let off = |q: &[f64]| {
            plan.target
                .distance(&self.chain.fk(q), target, linkage.size)
        };
        found.retain(|q| off(q) < SOUND * linkage.size);
        let mut distinct: Vec<Vec<f64>> = Vec::new();
        for q in found {
            if !distinct.iter().any(|known| self.same(known, &q)) {
                distinct.push(q);
            }
        }
        distinct
    }

    fn same(&self, a: &[f64], b: &[f64]) -> bool {
        let near = |i: usize| match self.model.turns(i) {
            true => wrapped(a[i] - b[i]).abs() < SAME,
            false => (a[i] - b[i]).abs() < SAME * self.closed_form.linkage.size,
        };
        (0..a.len()).all(near)
    }

    /// Flagged, or so near that rounding decides about double roots.
    fn is_singular(&self, solution: &BranchSolution) -> bool {
        let ClosedForm { linkage, plan, .. } = &self.closed_form;
        solution.singular
            || conditioning(&self.chain, &solution.q, linkage.size, plan.target) < SINGULAR
    }

    /// The most relations that pose any step.
    fn relations(&self) -> usize {
        let steps = self.closed_form.plan.steps.iter();
        steps.map(|step| step.relations.len()).max().unwrap_or(0)
    }

    /// The branches of a target, whichever relation poses a step: every one of
    /// the one run is one of the other, and there are as many. Whether the target
    /// was compared, and is not singular.
    fn compare(&self, q: &[f64], context: &str) -> bool {
        let target = self.chain.fk(q);
        let solutions = self.closed_form.solutions(&target);
        if solutions.iter().any(|solution| self.is_singular(solution)) {
            return false;
        }
        for relation in 0..self.relations() {
            let executed = self.executed(&target, relation);
            let found =
                |solution: &BranchSolution| executed.iter().any(|q| self.same(q, &solution.q));
            assert!(
                solutions.iter().all(found) && solutions.len() == executed.len(),
                "{}, {context} of {q:?}, relation {relation} of {}\n\
                 expressions {solutions:#?}\nsubproblems {executed:#?}",
                self.name,
                self.closed_form.plan,
            );
        }
        true
    }

    fn value(&self, joint: usize, random: &mut Random) -> f64 {
        let half = if self.model.turns(joint) {
            PI
        } else {
            0.5 * self.closed_form.linkage.size
        };
        random.between(-half, half)
    }
}

static CASES: LazyLock<Vec<Case>> =
    LazyLock::new(|| every_arm().into_iter().map(Case::new).collect());

#[test]
fn random_targets_have_the_same_branches() {
    let mut compared = 0;
    for case in &*CASES {
        let mut random = Random(0x9e37_79b9);
        for k in 0..40 {
            let q: Vec<f64> = (0..case.model.joints.len())
                .map(|joint| case.value(joint, &mut random))
                .collect();
            compared += usize::from(case.compare(&q, &format!("random target {k}")));
        }
    }
    assert!(compared > 2000, "{compared}");
}

/// Joints at home and at right angles. Singular targets are left out: of a
/// family each may give another member.
#[test]
fn structured_targets_have_the_same_branches() {
    let mut compared = 0;
    for case in &*CASES {
        let mut random = Random(0x1234_5678);
        for k in 0..60 {
            let q: Vec<f64> = (0..case.model.joints.len())
                .map(|joint| match random.below(5) {
                    0 => 0.0,
                    1 if case.model.turns(joint) => FRAC_PI_2,
                    2 if case.model.turns(joint) => -FRAC_PI_2,
                    3 if case.model.turns(joint) => PI,
                    _ => case.value(joint, &mut random),
                })
                .collect();
            compared += usize::from(case.compare(&q, &format!("structured target {k}")));
        }
    }
    assert!(compared > 1500, "{compared}");
}

#[test]
fn every_subproblem_is_run() {
    use Subproblem::{Hyperboloid, Lines, Slide, Slides, Sp1, Sp2, Sp3, Sp4, Sp6, Sum, T1, T2};
    let mut missing = vec![Sum, Sp1, Sp2, Sp3, Sp4, Sp6, Slide, T1, T2];
    missing.extend([Slides, Lines, Hyperboloid]);
    for case in &*CASES {
        let steps = &case.closed_form.plan.steps;
        missing.retain(|which| steps.iter().all(|step| step.subproblem != *which));
    }
    assert!(missing.is_empty(), "{missing:?}");
}
