//! What single precision lacks is said with a place, a reason and a remedy.

use kin_codegen::{Options, Scalar, Source, compile, generate_c, generate_js};
use std::path::Path;

fn read(file: &str) -> (Source, Options) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let options = Options {
        scalar: Scalar::F32,
        ..Options::default()
    };
    (Source::read(file, root).unwrap(), options)
}

fn said(file: &str) -> String {
    let (source, options) = read(file);
    compile(&source, &options).unwrap_err().to_string()
}

#[test]
fn arms_that_are_solved_otherwise() {
    let cases = [
        (
            "../robots/xarm6.yaml",
            "the polynomial that does is for f64 alone",
        ),
        (
            "../robots/panda.yaml",
            "what is given beside a target is for f64 alone",
        ),
        (
            "robots/noisy/calibrated.yaml",
            "off exact relations by more than the digits of f32 leave",
        ),
        (
            "robots/table/parallel_123.yaml",
            "the roots of a quartic, which are there in f64 alone",
        ),
    ];
    for (file, reason) in cases {
        let said = said(file);
        assert!(said.starts_with(file), "{said}");
        assert!(said.contains(reason), "{said}");
        assert!(
            said.contains("leave out `scalar = f32`; with it, `ik = none`"),
            "{said}"
        );
    }
}

/// A neck turns the head about an axis a few centimetres beside those of the spine: where its root is
/// nearly double, one configuration in 25 takes more than seven digits.
#[test]
fn arms_that_take_more_digits() {
    let text = "\
robot: spine
units: {angle: rad, length: m}
screws:
  - {name: spine_yaw, axis: [0, 0, 1], point: [0, 0, 0.1045]}
  - {name: spine_roll, axis: [1, 0, 0], point: [-0.015, 0, 0.1573]}
  - {name: spine_pitch, axis: [0, 1, 0], point: [-0.015, 0, 0.1923]}
  - {name: neck_yaw, axis: [0, 0, 1], point: [-0.015, 0, 0.5003]}
  - {name: neck_pitch, axis: [0, 1, 0], point: [0.01, 0.01, 0.7075]}
home: {xyz: [0.01, 0.01, 0.7075]}
";
    let source = Source {
        path: "spine.yaml".into(),
        text: text.into(),
    };
    let mut options = Options::default();
    assert!(compile(&source, &options).is_ok());
    options.scalar = Scalar::F32;
    let said = compile(&source, &options).unwrap_err().to_string();
    assert!(
        said.contains("a step of its plan is ill-conditioned where the arm is regular"),
        "{said}"
    );
    assert!(said.contains("leave out `scalar = f32`"), "{said}");
}

#[test]
fn mechanisms_and_other_languages() {
    let said = said("../robots/delta.yaml");
    assert!(
        said.contains("a parallel mechanism is computed in f64 alone"),
        "{said}"
    );
    assert!(said.contains("leave out `scalar = f32`"), "{said}");
    let (source, options) = read("../robots/ur5e.urdf");
    let said = generate_c(&source, &options).unwrap_err().to_string();
    assert!(
        said.contains("C is written in double precision alone"),
        "{said}"
    );
    assert!(said.contains("leave out the option `scalar`"), "{said}");
    let said = generate_js(&source, &options).unwrap_err().to_string();
    assert!(
        said.contains("`scalar` has no meaning in JavaScript"),
        "{said}"
    );
}

#[test]
fn robots_that_are_read_at_run_time() {
    let (source, options) = read("../robots/ur5e.urdf");
    let said = kinematics::Robot::load(&source, &options)
        .unwrap_err()
        .to_string();
    assert!(said.starts_with("../robots/ur5e.urdf"), "{said}");
    assert!(
        said.contains("a robot that is read at run time computes in f64 alone"),
        "{said}"
    );
    assert!(
        said.contains("leave out `scalar = f32`, or generate its code"),
        "{said}"
    );
}
