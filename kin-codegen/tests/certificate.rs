//! The certificate against plans that are wrong: each of its checks is the only
//! one that sees what is wrong with one of them.

use kin_codegen::certificate::{Certificate, Failure, Trials, certify};
use kin_codegen::closed_form::{ClosedForm, Inverse, Reading, Refinement};
use kin_codegen::expr::inverse::{FreeJoints, InverseGraph};
use kin_codegen::expr::{Choice, Expr, Node, Tape};
use kin_codegen::geometry::{Linkage, idealize, natural_target};
use kin_codegen::model::Model;
use kin_codegen::plan::{Plan, Plans, Subproblem, Target};
use kin_codegen::solver::solve;
use kin_codegen::spec::{ArmSpec, Source};
use std::path::Path;

struct Arm {
    model: Model,
    linkage: Linkage,
    target: Target,
}

impl Arm {
    fn read(path: &str) -> Arm {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let source = Source::read(path, &root).unwrap();
        Arm::of(&source)
    }

    fn of(source: &Source) -> Arm {
        let model = Model::new(&ArmSpec::parse(source).unwrap(), None, None).unwrap();
        Arm {
            linkage: Linkage::new(&model),
            target: natural_target(&model),
            model,
        }
    }

    fn certify(&self, form: &ClosedForm) -> Result<Certificate, Failure> {
        let trials = Trials::new(&self.model, &self.linkage, self.target);
        certify(&trials, form, 0)
    }

    fn solved(&self) -> ClosedForm {
        solve(&self.model, &self.linkage, self.target).unwrap().form
    }

    /// The first plan for which something holds, certified or not.
    fn form(&self, wanted: impl Fn(&Plan) -> bool) -> ClosedForm {
        let idealized = idealize(&self.model, 1e-12);
        let reading = Reading::new(&self.model, &self.linkage, idealized, self.target).unwrap();
        let plan = Plans::new(&reading.linkage, self.target)
            .find(wanted)
            .unwrap();
        reading.form(&plan, FreeJoints::Seeded)
    }
}

/// A form whose expressions were tampered with.
fn tampered(mut form: ClosedForm, tamper: impl Fn(&mut InverseGraph)) -> ClosedForm {
    let Inverse::Expressions(inverse) = &mut form.inverse else {
        panic!("the plan is run by expressions");
    };
    tamper(inverse);
    inverse.tape = Tape::new(&inverse.graph, &inverse.outputs());
    form
}

#[test]
fn a_right_plan_is_certified() {
    let arm = Arm::read("robots/kr6_r900.yaml");
    let certificate = arm.certify(&arm.solved()).unwrap();
    assert!(
        certificate.is_complete() && certificate.excused == 0,
        "{certificate:?}"
    );
    assert!(certificate.configurations > 200 && certificate.worst_residual < 1e-9);
}

/// Every configuration comes back to what the comparison tolerates, the residual
/// that the plan itself computes is small, and yet the targets are missed.
#[test]
fn a_plan_that_is_unsound_fails() {
    let arm = Arm::read("robots/kr6_r900.yaml");
    let form = tampered(arm.solved(), |inverse| {
        let off = inverse.graph.constant(1e-8);
        inverse.q[0] = inverse.graph.add(inverse.q[0], off);
    });
    assert!(matches!(arm.certify(&form), Err(Failure::Unsound { .. })));
}

/// Out of reach the residual alone refuses: a plan that claims to be there is
/// caught by the targets that no configuration made.
#[test]
fn a_plan_that_claims_what_is_out_of_reach_fails() {
    let arm = Arm::read("robots/elbow.yaml");
    let form = tampered(arm.solved(), |inverse| {
        let zero = inverse.graph.zero();
        inverse.residual = zero;
        inverse.invalid = zero;
    });
    assert!(matches!(arm.certify(&form), Err(Failure::Unsound { .. })));
}

#[test]
fn a_plan_that_doubles_fails() {
    let arm = Arm::read("robots/planar_2r.yaml");
    let mut form = arm.solved();
    let two_roots = |step: &&kin_codegen::plan::Step| step.subproblem.choices() == 1;
    let step = form.plan.steps.iter().find(two_roots).unwrap().clone();
    form.plan.steps.push(step);
    assert!(matches!(arm.certify(&form), Err(Failure::Doubled(_))));
}

#[test]
fn a_plan_that_loses_a_branch_fails() {
    let arm = Arm::read("robots/kr6_r900.yaml");
    let form = tampered(arm.solved(), |inverse| {
        let plus: Expr = inverse.graph.find(Node::Sign(Choice(0))).unwrap();
        inverse.invalid = plus;
    });
    assert!(matches!(arm.certify(&form), Err(Failure::Lost(_))));
}

/// Where the tool is upright, axes 1 and 5 are parallel and no neighbours: the
/// direction of the wrist does not tell the waist's angle, and the arm is regular.
#[test]
fn a_plan_that_degenerates_where_axes_align_fails() {
    let arm = Arm::read("tests/robots/targets/five_joints.yaml");
    let by_direction = |plan: &Plan| {
        plan.steps[0].subproblem == Subproblem::Sp2 && plan.steps[0].complement.is_none()
    };
    let form = arm.form(by_direction);
    assert!(
        matches!(arm.certify(&form), Err(Failure::Lost(_))),
        "{}",
        form.plan
    );
    let complemented = |plan: &Plan| plan.steps.iter().any(|step| step.complement.is_some());
    assert!(complemented(&arm.solved().plan));
}

/// The same with a tilt of the file: no relation is exactly degenerate at the
/// configurations that are round numbers.
#[test]
fn a_tilt_does_not_hide_a_degenerate_plan() {
    let text = "\
robot: tilted
units: {angle: rad, length: m}
joints:
  - {name: waist,    xyz: [0, 0, 0.104],  axis: [0, 0, 1]}
  - {name: shoulder, xyz: [0, 0, 0],      axis: [0, 1, 0]}
  - {name: elbow,    xyz: [0.05, 0, 0.15], axis: [0, -1, 0]}
  - {name: pitch,    xyz: [0.15, 0, 0],   rpy: [0, 5.1e-12, 0], axis: [0, -1, 0]}
  - {name: roll,     xyz: [0.065, 0, 0],  rpy: [0, 0.3, 0], axis: [1, 0, 0]}
tip: {link: tool, xyz: [0.043, 0, 0]}
";
    let arm = Arm::of(&Source {
        path: "tilted.yaml".into(),
        text: text.into(),
    });
    let form = arm.solved();
    let upright = {
        // The roll axis upright: q2 − q3 − q4 + 0.3 = −π/2, about y.
        let sum = -std::f64::consts::FRAC_PI_2 - 0.3;
        [0.3, 0.2, 0.4, 0.2 - 0.4 - sum, 0.5]
    };
    let solutions = form.solutions(&arm.model.chain().fk(&upright));
    let near = |q: &[f64]| (0..5).all(|i| (q[i] - upright[i]).abs() < 1e-7);
    assert!(
        solutions.iter().any(|solution| near(&solution.q)),
        "{solutions:?}"
    );
}

/// A calibrated arm's certificate excuses next to nothing. Where no elimination stands
/// beside the branches, more than a few percent are no certificate.
#[test]
fn what_is_excused_is_counted() {
    let arm = Arm::read("tests/robots/noisy/calibrated.yaml");
    let mut found = solve(&arm.model, &arm.linkage, arm.target).unwrap();
    assert!(found.certificate.excused_share < 0.01, "{found:?}");
    found.form.refinement = Refinement::Correction;
    let trials = Trials::new(&arm.model, &arm.linkage, arm.target);
    let seen = certify(&trials, &found.form, usize::MAX).unwrap_err();
    assert!(
        matches!(seen, Failure::NearSingular(share) if share > 0.05),
        "{seen:?}"
    );
    let told = seen.to_string();
    assert!(
        told.contains("% of random configurations are so near to singular"),
        "{told}"
    );
    let few = Certificate {
        excused: 3,
        excused_share: 0.034,
        ..found.certificate
    };
    let told = few.reservations().concat();
    assert!(told.contains("3.4 % of random configurations"), "{told}");
}

/// Limits of ±1e6 m, as mobile bases have them, and the largest numbers there are.
#[test]
fn a_slide_whose_limits_mean_none_is_tried_like_one_without() {
    let tried = |limits: &str| {
        let text = format!(
            "robot: rail
units: {{angle: rad, length: m}}
joints:
  - {{name: x, type: prismatic, axis: [1, 0, 0]{limits}}}
  - {{name: pan, xyz: [0, 0, 0.3], axis: [0, 0, 1]}}
  - {{name: tilt, xyz: [0.3, 0, 0], axis: [0, 1, 0]}}
tip: {{link: tool, xyz: [0.2, 0, 0]}}
"
        );
        let path = "rail.yaml".into();
        let arm = Arm::of(&Source { path, text });
        let found = solve(&arm.model, &arm.linkage, arm.target).unwrap();
        let certificate = &found.certificate;
        let plan = found.form.plan.to_string();
        (plan, certificate.configurations, certificate.worst_residual)
    };
    let without = tried("");
    for limits in [
        ", limits: [-1000000, 1000000]",
        ", limits: [0, 1.0e9]",
        ", limits: [-1.7e308, 1.7e308]",
    ] {
        assert_eq!(tried(limits), without, "{limits}");
    }
}

/// The first plans of this arm, whose third joint slides, leave singular targets without an answer: once
/// one of them was the last that was tried.
#[test]
fn a_plan_that_answers_all_singular_targets_is_found() {
    let arm = Arm::of(&Source {
        path: "rrprrr.yaml".into(),
        text: "\
robot: rrprrr
units: {angle: rad, length: m}
screws:
  - {name: j1, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: j2, axis: [1, 0, 0], point: [0, 0, 0]}
  - {name: j3, type: prismatic, axis: [0, 1, 0], limits: [0, 0.5]}
  - {name: j4, axis: [0, 1, 0], point: [0, 0, 0]}
  - {name: j5, axis: [1, 0, 0], point: [0, 0.4, 0]}
  - {name: j6, axis: [0, 1, 0], point: [0, 0, 0]}
home: {xyz: [0, 0.6, 0]}
"
        .into(),
    });
    let found = solve(&arm.model, &arm.linkage, arm.target).unwrap();
    assert_eq!(
        (found.certificate.lost, found.certificate.unanswered),
        (0, 0)
    );
}
