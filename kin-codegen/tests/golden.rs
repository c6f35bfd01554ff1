//! The generated code of some robots as it stands in `tests/golden`, so that
//! every change shows what it does to the code.
//!
//! `BLESS=1 cargo test --package kin-codegen --test golden` writes the files
//! anew.

use kin_codegen::{Options, Scalar, Source, generate, generate_c, generate_js};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn generated(robot: &str, options: &Options) -> String {
    let source = Source::read(robot, &root()).unwrap();
    generate(&source, options).unwrap().code()
}

/// The first line in which two texts differ, from 1, with what each has there.
fn first_difference<'t>(a: &'t str, b: &'t str) -> (usize, &'t str, &'t str) {
    let lines = a.lines().chain([""]).zip(b.lines().chain([""]));
    let differs = |(_, (a, b)): &(usize, (&str, &str))| a != b;
    let (i, (a, b)) = (lines.enumerate().find(differs)).unwrap_or((0, ("", "")));
    (i + 1, a, b)
}

fn check(robot: &str, golden: &str) {
    check_with(robot, &Options::default(), golden);
}

fn check_with(robot: &str, options: &Options, golden: &str) {
    compare(robot, &generated(robot, options), golden);
}

fn check_js(robot: &str, golden: &str) {
    let source = Source::read(robot, &root()).unwrap();
    let code = generate_js(&source, &Options::default()).unwrap().source;
    compare(robot, &code, golden);
}

fn check_c(robot: &str, [header, code]: [&str; 2]) {
    let source = Source::read(robot, &root()).unwrap();
    let c = generate_c(&source, &Options::default()).unwrap();
    compare(robot, &c.header, header);
    compare(robot, &c.source, code);
}

fn compare(robot: &str, code: &str, golden: &str) {
    let file = root().join("tests/golden").join(golden);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&file, code).unwrap();
    }
    let golden = std::fs::read_to_string(&file).unwrap_or_default();
    if code != golden {
        let (line, old, new) = first_difference(&golden, code);
        panic!(
            "the code of {robot} is not that of {}, first in line {line}:\n- {old}\n+ {new}\n\
             BLESS=1 writes the file anew, if the change is meant",
            file.display()
        );
    }
}

#[test]
fn three_parallel_axes() {
    check("robots/ur5e.urdf", "ur5e.rs");
}

#[test]
fn a_spherical_wrist() {
    check("robots/kr6_r900.yaml", "kr6_r900.rs");
}

#[test]
fn a_slide() {
    check("robots/scara.yaml", "scara.rs");
}

#[test]
fn a_calibrated_arm() {
    check("tests/robots/noisy/calibrated.yaml", "calibrated.rs");
}

#[test]
fn an_arm_without_a_closed_form() {
    check("robots/xarm6.yaml", "xarm6.rs");
}

#[test]
fn seven_joints_of_which_one_is_given() {
    check("robots/panda.yaml", "panda.rs");
}

#[test]
fn single_precision_without_a_token_of_double() {
    let options = Options {
        scalar: Scalar::F32,
        ..Options::default()
    };
    check_with("robots/scara.yaml", &options, "scara_f32.rs");
    let code = generated("robots/ur5e.urdf", &options);
    let code = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    assert!(code.into_iter().all(|line| !line.contains("f64")));
}

#[test]
fn a_parallel_mechanism() {
    check("robots/delta.yaml", "delta.rs");
}

#[test]
fn javascript_of_three_parallel_axes() {
    check_js("robots/ur5e.urdf", "ur5e.js");
}

#[test]
fn javascript_of_an_arm_with_a_parameter() {
    check_js("robots/panda.yaml", "panda.js");
}

#[test]
fn javascript_of_a_mechanism() {
    check_js("robots/delta.yaml", "delta.js");
}

#[test]
fn c_of_three_parallel_axes() {
    check_c("robots/ur5e.urdf", ["ur5e.h", "ur5e.c"]);
}

#[test]
fn c_of_a_mechanism() {
    check_c(
        "robots/slider_crank.yaml",
        ["slider_crank.h", "slider_crank.c"],
    );
}

/// What documentation alone names is not imported.
#[test]
fn links_in_documentation_do_not_need_imports() {
    let folder = std::fs::read_dir(root().join("tests/golden")).unwrap();
    let files = folder.map(|file| file.unwrap().path());
    let rust: Vec<PathBuf> = files
        .filter(|path| path.extension().is_some_and(|it| it == "rs"))
        .collect();
    assert!(rust.len() > 5);
    for path in rust {
        let text = std::fs::read_to_string(&path).unwrap();
        for (at, _) in text.match_indices("[`") {
            let (link, rest) = text[at..].split_once(']').unwrap();
            let resolves = link.starts_with("[`Self::") || rest.starts_with("(::kinematics");
            assert!(resolves, "{}: {link}]", path.display());
        }
    }
}
