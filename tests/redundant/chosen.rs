//! Which joint stays free, what is said of that, and of options that cannot be followed.

use kin_cli::explain::explain;
use kin_codegen::{Options, Source, Target, compile};
use kinematics::Parameter;
use std::path::Path;

fn source(path: &str) -> Source {
    Source::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn free(joints: &[&str]) -> Options {
    Options {
        free: joints.iter().map(|&joint| joint.into()).collect(),
        ..Options::default()
    }
}

#[test]
fn the_cheapest_plan_decides_and_is_told() {
    let arm = compile(&source("../robots/panda.yaml"), &Options::default()).unwrap();
    let arm = arm.arm().unwrap().clone();
    let redundancy = arm.redundancy.unwrap();
    assert_eq!(redundancy.joints, [6]);
    let weights: Vec<usize> = redundancy
        .weighed
        .iter()
        .filter_map(|it| it.weight)
        .collect();
    assert!(weights.len() > 2 && weights.is_sorted(), "{weights:?}");
    let code = kin_codegen::generate(&source("../robots/panda.yaml"), &Options::default());
    let code = code.unwrap().code();
    assert!(
        code.contains("the value of q7 (`joint7`), radians"),
        "{code}"
    );
    let told = explain(&source("../robots/panda.yaml"), &Options::default()).unwrap();
    assert!(
        told.to_string().contains("Given beside a target: q7"),
        "{told}"
    );
}

#[test]
fn constants_tell_what_is_given() {
    let swivel = kinematics::Swivel {
        shoulder: [0.0, 0.0, 0.36],
        link: 2,
        elbow: [0.0, 0.0, 0.42],
        wrist: [0.0, 0.0, -0.126],
        reference: [0.0, 0.0, 1.0],
    };
    assert_eq!(crate::Iiwa14::PARAMETERS, [Parameter::Swivel(swivel)]);
    assert_eq!(crate::IiwaByFlange::PARAMETERS, [Parameter::Joint(6)]);
    assert_eq!(crate::IiwaByElbow::PARAMETERS, [Parameter::Joint(2)]);
    assert_eq!(crate::Rail::PARAMETERS, [Parameter::Joint(0)]);
    assert_eq!(crate::Ur5e::PARAMETERS, [Parameter::Turn]);
    assert_eq!((crate::Panda::BRANCHES_AT, crate::Panda::BRANCHES), (8, 0));
}

fn refused(path: &str, options: &Options) -> String {
    compile(&source(path), options).unwrap_err().to_string()
}

#[track_caller]
fn assert_refused(path: &str, options: &Options, reason: &str, remedy: &str) {
    let said = refused(path, options);
    assert!(said.contains(reason) && said.contains(remedy), "{said}");
}

#[test]
fn options_that_cannot_be_followed_have_a_remedy() {
    let panda = "../robots/panda.yaml";
    assert_refused(
        panda,
        &free(&["jiont7"]),
        "there is no joint `jiont7` to stay free",
        "did you mean `joint7`?",
    );
    assert_refused(
        "../robots/ur5e.urdf",
        &Options {
            target: Some(Target::PositionAxis),
            ..free(&["wrist_3_tool0"])
        },
        "the joint `wrist_3_tool0` is fixed, and cannot stay free",
        "wrist_3_joint",
    );
    assert_refused(
        panda,
        &free(&["swivel"]),
        "the first three and the last three meet in a point each; from `base` to `joint7_link` \
         this is spherical shoulder at 1, 2, 3",
        "name a joint in `free`, or leave it out",
    );
    assert_refused(
        "../robots/iiwa14.yaml",
        &free(&["swivel", "joint_a7"]),
        "names 2 joints, and 7 joints have 1 more",
        "name 1 joint at most",
    );
    assert_refused(
        panda,
        &free(&["joint7", "joint7"]),
        "names the joint `joint7` twice",
        "once",
    );
    assert_refused(
        "../robots/ur5e.urdf",
        &free(&["elbow_joint"]),
        "6 joints have 0 more than the 6 coordinates of whole poses",
        "leave out `free`, or choose a `target` of fewer coordinates",
    );
    assert_refused(
        panda,
        &free(&["joint1", "joint7"]),
        "names 2 joints, and 7 joints have 1 more",
        "name 1 joint at most",
    );
    assert_refused(
        panda,
        &Options {
            tip: Some("joint6_link".into()),
            target: Some(Target::PositionAxis),
            ..free(&["joint7"])
        },
        "the joint `joint7` is not between `base` and `joint6_link`",
        "joint1",
    );
    assert_refused(
        panda,
        &Options {
            ik: kin_codegen::Ik::None,
            ..free(&["joint7"])
        },
        "without inverse kinematics no joint stays free",
        "leave out `free`, or `ik = none`",
    );
    assert_refused(
        "../robots/delta.yaml",
        &free(&["joint7"]),
        "the option `free` has no meaning",
        "leave it out",
    );
}

#[test]
fn a_joint_that_mimics_cannot_stay_free() {
    let text = "
robot: coupled
units: {angle: deg, length: m}
joints:
  - {name: one, axis: [0, 0, 1], limits: [-90, 90]}
  - {name: two, xyz: [1, 0, 0], axis: [0, 0, 1], mimic: {joint: one}}
  - {name: three, xyz: [1, 0, 0], axis: [0, 0, 1], limits: [-90, 90]}
tip: tip
";
    let source = Source {
        path: "coupled.yaml".into(),
        text: text.into(),
    };
    let options = Options {
        target: Some(Target::Direction),
        ..free(&["two"])
    };
    let said = compile(&source, &options).unwrap_err().to_string();
    assert!(
        said.contains("the joint `two` mimics `one`, and cannot stay free"),
        "{said}"
    );
}

#[test]
fn an_inner_joint_without_a_closed_form_is_refused() {
    assert_refused(
        "../robots/sawyer.yaml",
        &free(&["right_j3"]),
        "with `right_j3` free, no sequence of the subproblems",
        "let a joint at an end of the chain stay free, or leave out `free`",
    );
    // Turning the elbow of an SRS arm changes how far it reaches.
    assert_refused(
        "../robots/iiwa14.yaml",
        &free(&["joint_a4"]),
        "with `joint_a4` free, they move the tip in 5 independent ways at most",
        "`ik = none`",
    );
}

#[test]
fn of_too_many_joints_some_have_to_be_named() {
    let mut text = "robot: snake\nunits: {angle: deg, length: m}\ndh:\n".to_owned();
    for i in 0..10 {
        let alpha = if i % 2 == 0 { 90 } else { -90 };
        text += &format!("  - {{name: j{i}, theta: 0, d: 0, a: 0.1, alpha: {alpha}}}\n");
    }
    let source = Source {
        path: "snake.yaml".into(),
        text,
    };
    let said = compile(&source, &Options::default())
        .unwrap_err()
        .to_string();
    let remedy = "name those that stay free, one for each coordinate too many, with `free`";
    assert!(said.contains(remedy), "{said}");
}
