//! What is not written as C or JavaScript is said, with a reason and a remedy.

use crate::program::generated;
use kin_codegen::spec::Diagnostic;
use kin_codegen::{Error, GeneratedC, Options, Source, Target, generate_c, generate_js};
use std::path::Path;

fn told(warnings: &[Diagnostic]) -> String {
    let warnings = warnings.iter();
    let lines = warnings.map(|it| format!("{}\nhelp: {}", it.reason, it.remedy));
    lines.collect::<Vec<_>>().join("\n")
}

fn error(robot: &str, options: &Options) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let source = Source::read(robot, &root).unwrap();
    match generate_c(&source, options) {
        Err(Error::Broken(diagnostics)) => diagnostics.to_string(),
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("{robot} is written"),
    }
}

/// Without inverse kinematics, and its header says why.
fn is_forward_alone(c: &GeneratedC, why: &str) {
    let GeneratedC { header, source, .. } = c;
    assert!(header.contains("void arm_fk(") && source.contains("void arm_body_jacobian("));
    assert!(!header.contains("arm_ik") && !source.contains("arm_ik"));
    let comment = header.replace("\n * ", " ");
    assert!(
        comment.contains(&format!("no inverse kinematics in C: {why}")),
        "{header}"
    );
}

#[test]
fn an_arm_without_a_closed_form() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let source = Source::read("robots/xarm6.yaml", &root).unwrap();
    let js = generate_js(&source, &Options::default()).unwrap();
    assert_eq!(
        told(&js.warnings),
        "no inverse kinematics in JavaScript: the arm has no closed form, and the polynomial in \
         one joint that solves it, univariate(q6,q5,q4,q3,q2,q1), is not written as JavaScript\n\
         help: generate Rust, which has it; `--ik none` says that JavaScript without it is meant"
    );
    let c = generated("robots/xarm6.yaml", "arm", &Options::default());
    assert_eq!(told(&c.warnings), "");
}

/// Of an arm off its design, for positions: no elimination stands beside its branches.
fn refined() -> Options {
    Options {
        target: Some(Target::Position),
        ..Options::default()
    }
}

#[test]
fn an_arm_off_its_design() {
    let c = generated("tests/robots/noisy/calibrated.yaml", "arm", &refined());
    is_forward_alone(&c, "the closed form is that of an arm whose tip is up to");
    assert!(told(&c.warnings).ends_with(
        "and the refinement of its solutions is not written as C\nhelp: write the relations \
         between the axes exactly, as `kin explain` has them, or generate Rust, which has it; \
         `--ik none` says that C without it is meant"
    ));
}

/// Of an arm without a closed form, and of one off its design.
#[test]
fn a_joint_that_is_given_between_others() {
    for (robot, joint) in [
        ("robots/sawyer.yaml", "right_j4"),
        ("tests/robots/redundant/stray_iiwa.yaml", "joint_a3"),
    ] {
        let options = Options {
            free: vec![joint.into()],
            ..Options::default()
        };
        let c = generated(robot, "arm", &options);
        is_forward_alone(&c, "joints between those that are solved for are given");
        assert_eq!(
            told(&c.warnings),
            "no inverse kinematics in C: joints between those that are solved for are given, and \
             their elimination at the values of these is not written as C\n\
             help: let joints at the ends of the chain stay free, or generate Rust, which has it; \
             `--ik none` says that C without it is meant"
        );
    }
}

#[test]
fn strict_makes_errors_of_it() {
    let refused = Options {
        strict: true,
        ..refined()
    };
    let said = error("tests/robots/noisy/calibrated.yaml", &refused);
    assert!(
        said.starts_with("tests/robots/noisy/calibrated.yaml: no inverse kinematics in C: "),
        "{said}"
    );
    let strict = Options {
        strict: true,
        ..Options::default()
    };
    for robot in ["robots/ur5e.urdf", "robots/xarm6.yaml"] {
        assert_eq!(told(&generated(robot, "arm", &strict).warnings), "");
    }
}

#[test]
fn a_crate() {
    let named = Options {
        krate: Some("::kinematics".into()),
        ..Options::default()
    };
    assert_eq!(
        error("robots/ur5e.urdf", &named),
        "robots/ur5e.urdf: C does not depend on the crate `kinematics`\nhelp: leave out the option \
         `crate`"
    );
}
