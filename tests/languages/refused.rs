//! What is not written as C or JavaScript is said, with a reason and a remedy.

use crate::program::generated;
use kin_codegen::spec::Diagnostic;
use kin_codegen::{Error, GeneratedC, Options, Source, generate_c, generate_js};
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

/// What is said of a robot that is written in either language.
fn in_both(robot: &str, options: &Options) -> [(&'static str, String); 2] {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let source = Source::read(robot, &root).unwrap();
    let c = generated(robot, "arm", options);
    let js = generate_js(&source, options).unwrap();
    [("C", told(&c.warnings)), ("JavaScript", told(&js.warnings))]
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

/// Its branches at a swivel angle are refined, and no elimination stands beside them.
const OFF: &str = "tests/robots/redundant/stray_iiwa.yaml";

fn refined() -> Options {
    Options {
        free: vec!["swivel".into()],
        ..Options::default()
    }
}

#[test]
fn an_arm_off_its_design() {
    let c = generated(OFF, "arm", &refined());
    is_forward_alone(&c, "the closed form is that of an arm whose tip is up to");
    for (language, said) in in_both(OFF, &refined()) {
        assert!(
            said.ends_with(&format!(
                "and the refinement of its solutions is not written as {language}\nhelp: write the \
                 relations between the axes exactly, as `kin explain` has them, or generate Rust, \
                 which has it; `--ik none` says that {language} without it is meant"
            )),
            "{said}"
        );
    }
}

#[test]
fn strict_makes_errors_of_it() {
    let refused = Options {
        strict: true,
        ..refined()
    };
    let said = error(OFF, &refused);
    assert!(
        said.starts_with(&format!("{OFF}: no inverse kinematics in C: ")),
        "{said}"
    );
    let strict = Options {
        strict: true,
        ..Options::default()
    };
    for robot in ["robots/ur5e.urdf", "robots/xarm6.yaml"] {
        for (language, said) in in_both(robot, &strict) {
            assert_eq!(said, "", "{robot} in {language}");
        }
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
