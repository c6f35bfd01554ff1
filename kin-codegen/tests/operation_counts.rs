//! What forward kinematics and Jacobians may cost: within 15 % of counts that
//! are known to be possible, and at them for arms with parallel axes.

use kin_codegen::arm::CompiledArm;
use kin_codegen::expr::Operations;
use kin_codegen::expr::forward::Outputs;
use kin_codegen::{Compiled, Ik, Options, Source, compile};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use std::fmt::Write;
use std::path::Path;

/// The forward half of a robot of `robots/`.
fn robot(file: &str) -> CompiledArm {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    forward(&Source::read(file, &root).unwrap())
}

fn forward(source: &Source) -> CompiledArm {
    let options = Options {
        ik: Ik::None,
        ..Options::default()
    };
    match compile(source, &options) {
        Ok(Compiled::Arm(arm)) => *arm,
        other => panic!("{other:?}\n{}", source.text),
    }
}

/// Multiplications and additions of the pose, and of pose and spatial Jacobian.
fn counts(compiled: &CompiledArm) -> [[usize; 2]; 2] {
    let pair = |cost: Operations| [cost.multiplications, cost.additions];
    let forward = compiled.forward();
    [
        pair(forward.tip_cost()),
        pair(forward.tip_and_jacobian_cost()),
    ]
}

#[track_caller]
fn assert_within(found: [[usize; 2]; 2], limits: [[usize; 2]; 2]) {
    let within = found.as_flattened().iter().zip(limits.as_flattened());
    assert!(
        within.into_iter().all(|(count, limit)| count <= limit),
        "{found:?} exceeds {limits:?}"
    );
}

#[test]
fn universal_robots() {
    for file in ["ur5e.urdf", "ur10e.yaml"] {
        assert_within(counts(&robot(file)), [[40, 23], [62, 38]]);
    }
}

/// The angle that a stretched wrist leaves free costs a branch of inverse kinematics three comparisons,
/// one of them for a shoulder next to its singularity, and the multiplication that makes a share of the
/// elbow's equation; what it turns to is found when it is free.
#[test]
fn a_free_joint_costs_regular_targets_three_selections_and_a_share() {
    for file in ["ur5e.urdf", "ur10e.yaml"] {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
        let source = Source::read(file, &root).unwrap();
        let compiled = compile(&source, &Options::default()).unwrap();
        let form = compiled.arm().unwrap().form();
        let inverse = form.unwrap().expressions().unwrap();
        let [with, without] = [true, false].map(|kept| {
            let mut inverse = inverse.clone();
            if !kept {
                inverse.free_joints.clear();
            }
            inverse.graph.operations(&inverse.outputs())
        });
        assert_eq!(inverse.free_joints.len(), 1);
        assert_eq!(
            with,
            Operations {
                selections: without.selections + 3,
                multiplications: without.multiplications + 1,
                ..without
            }
        );
    }
}

/// What does not depend on a sign is not computed for both: of all eight branches, with a flipped
/// wrist's forward kinematics and angles from those of the other.
#[test]
fn what_both_signs_share_is_computed_once() {
    for (file, [multiplications, arctangents]) in [
        ("ur5e.urdf", [631, 30]),
        ("kr6_r900.yaml", [519, 22]),
        ("irb6640.yaml", [519, 22]),
    ] {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
        let source = Source::read(file, &root).unwrap();
        let compiled = compile(&source, &Options::default()).unwrap();
        let form = compiled.arm().unwrap().form();
        let all = form.unwrap().expressions().unwrap().all_branches();
        assert!(all.multiplications <= multiplications, "{file}: {all:?}");
        assert!(all.arctangents <= arctangents, "{file}: {all:?}");
    }
}

#[test]
fn spherical_wrists_on_parallel_shoulders() {
    for file in [
        "puma560.yaml",
        "irb6640.yaml",
        "kr6_r900.yaml",
        "tx60.yaml",
        "elbow.yaml",
    ] {
        assert_within(counts(&robot(file)), [[52, 26], [85, 45]]);
    }
}

/// Six rows of Denavit-Hartenberg parameters without any structure.
fn general() -> impl Strategy<Value = Source> {
    let row = [-0.5..0.5, -0.5..0.5, -3.0..3.0_f64];
    prop::array::uniform6(row).prop_map(|rows| {
        let mut text = String::from("robot: general\nunits: {angle: rad, length: m}\ndh:\n");
        for (i, [d, a, alpha]) in rows.iter().enumerate() {
            writeln!(text, "  - {{name: j{i}, d: {d}, a: {a}, alpha: {alpha}}}").unwrap();
        }
        Source {
            path: "general.yaml".into(),
            text,
        }
    })
}

proptest! {
    #![proptest_config(Config {
        cases: 20,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1994),
        ..Config::default()
    })]

    #[test]
    fn any_six_revolute_joints(source in general()) {
        assert_within(counts(&forward(&source)), [[133, 78], [183, 117]]);
    }
}

/// Frames of links that are turned against each other in every direction, as CAD exports have them:
/// each costs what leads there from the one before, however long the chain.
#[test]
fn the_frames_of_links_cost_alike_each() {
    let per_link = |joints: usize| {
        let mut text = String::from("robot: snake\nunits: {angle: rad, length: m}\njoints:\n");
        for i in 0..joints {
            let k = (i % 5) as f64;
            let rpy = format!("[{}, {}, {}]", 0.3 + k, 0.2 - 0.1 * k, 0.9 * k);
            writeln!(
                text,
                "  - {{name: j{i}, axis: [0, 0, 1], xyz: [{k}, 0.1, 0.3], rpy: {rpy}}}"
            )
            .unwrap();
        }
        let source = Source {
            path: "snake.yaml".into(),
            text,
        };
        let (poses, links) = forward(&source).poses_of_links();
        let all = poses.graph.operations(&links.expressions());
        assert_eq!(links.len(), joints);
        (all.multiplications + all.additions) / joints
    };
    let costs = [6, 12, 24].map(per_link);
    assert!(costs.iter().all(|cost| *cost <= 90), "{costs:?}");
}

/// Base and tip anywhere cost a rotation each, and every joint its zero.
#[test]
fn a_base_and_a_tip_in_general_position_are_added() {
    let text = "\
robot: general
units: {angle: rad, length: m}
screws:
  - {name: j1, axis: [0.9, -1.4, -0.7], point: [0.1, -0.1, 0.3]}
  - {name: j2, axis: [0.4, -0.4, 1.1], point: [0.2, 0.4, 0]}
  - {name: j3, axis: [-0.3, 1.6, -0.6], point: [0.4, 0.5, 0.3]}
  - {name: j4, axis: [-0.5, 0.7, 0.5], point: [0.2, 0.4, 0.2]}
  - {name: j5, axis: [-0.5, 0.1, -1.3], point: [0.4, 0.5, 0.1]}
  - {name: j6, axis: [0.6, 0.5, -0.6], point: [0.3, 0.1, -0.5]}
home: {xyz: [0.2, -0.1, 0.3], rpy: [0.3, -1.1, 0.7]}
";
    let source = Source {
        path: "general.yaml".into(),
        text: text.into(),
    };
    assert_within(counts(&forward(&source)), [[153, 100], [210, 134]]);
}
