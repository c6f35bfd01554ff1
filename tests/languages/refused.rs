//! Nothing that Rust has is left out of C and JavaScript, and what C cannot have is said, with a
//! reason and a remedy.

use crate::program::generated;
use kin_codegen::spec::Diagnostic;
use kin_codegen::{Error, Options, Source, generate_c, generate_js};
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

#[test]
fn nothing_is_left_out_of_what_rust_has() {
    let strict = Options {
        strict: true,
        ..Options::default()
    };
    let at_swivel = Options {
        free: vec!["swivel".into()],
        ..strict.clone()
    };
    for (robot, options) in [
        ("robots/ur5e.urdf", &strict),
        ("robots/xarm6.yaml", &strict),
        ("tests/robots/redundant/stray_iiwa.yaml", &at_swivel),
    ] {
        for (language, said) in in_both(robot, options) {
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
