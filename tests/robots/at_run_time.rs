//! The same robots read while the program runs: what generated code computes, to the last bit.

use crate::subject::Subject;
use crate::zoo::EXACT;
use kinematics::{Kinematics, Pose, Robot, RobotOptions, RobotSource, Twist};
use std::path::Path;

for_every_robot!(forward_kinematics_is_the_same);
for_every_robot!(solutions_are_the_same);

mod noisy {
    use super::*;
    for_every_noisy_robot!(forward_kinematics_is_the_same);
    for_every_noisy_robot!(solutions_are_the_same);
}

mod table {
    use super::*;
    for_every_table_row!(forward_kinematics_is_the_same);
    for_every_table_row!(solutions_are_the_same);
}

mod targets {
    use super::*;
    for_every_aimed_robot!(forward_kinematics_is_the_same);
    for_every_aimed_robot!(solutions_are_the_same);
}

/// Of a few dozen operations.
const ROUNDING: f64 = 1e-14;

fn loaded<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) -> Robot {
    let source = RobotSource::read(robot.path, Path::new("")).unwrap();
    let options = RobotOptions {
        target: Some(robot.counts),
        ..RobotOptions::default()
    };
    Robot::load(&source, &options).unwrap()
}

fn entries(pose: &Pose) -> Vec<f64> {
    let rotation = pose.rotation.iter().flatten();
    rotation.chain(&pose.translation).copied().collect()
}

fn of_columns(columns: &[Twist]) -> Vec<f64> {
    columns.iter().flat_map(|it| it.to_array()).collect()
}

pub fn forward_kinematics_is_the_same<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let (arm, loaded) = (&robot.arm, loaded(robot));
    assert_eq!(loaded.joint_names(), K::JOINT_NAMES);
    assert_eq!(loaded.link_names(), K::LINK_NAMES);
    assert_eq!((loaded.base(), loaded.tip()), (K::BASE, K::TIP));
    assert_eq!(loaded.limits(), K::LIMITS);
    assert_eq!(loaded.velocity_limits(), K::VELOCITY_LIMITS);
    assert_eq!(loaded.effort_limits(), K::EFFORT_LIMITS);
    assert_eq!(
        (loaded.target(), loaded.branches()),
        (K::TARGET, K::BRANCHES)
    );
    for q in robot.random(20).chain(robot.structured()) {
        assert_eq!(entries(&loaded.fk(&q)), entries(&arm.fk(&q)), "{q:?}");
        let links = arm.fk_links(&q).map(|pose| entries(&pose));
        let there: Vec<_> = loaded.fk_links(&q).iter().map(entries).collect();
        assert_eq!(there, links, "{q:?}");
        for (columns, jacobian) in [
            (loaded.body_jacobian(&q), arm.body_jacobian(&q)),
            (loaded.geometric_jacobian(&q), arm.geometric_jacobian(&q)),
        ] {
            assert_eq!(
                of_columns(&columns),
                of_columns(&jacobian.columns()),
                "{q:?}"
            );
        }
        // Generated code takes long ones from what it shares with the pose.
        let (columns, jacobian) = (loaded.spatial_jacobian(&q), arm.spatial_jacobian(&q));
        let pairs = of_columns(&columns)
            .into_iter()
            .zip(of_columns(&jacobian.columns()));
        for (a, b) in pairs {
            assert!((a - b).abs() < 1e-14 * robot.size.max(1.0), "{a} {b} {q:?}");
        }
        for frame in K::FRAMES {
            let (a, b) = (
                loaded.fk_frame(&q, frame.name).unwrap(),
                arm.fk_frame(&q, frame),
            );
            let apart = a.translation_distance(&b) + a.rotation_distance(&b);
            assert!(apart < 1e-12, "{apart} of {}", frame.name);
        }
        let determinants = [
            loaded.jacobian_determinant(&q),
            arm.jacobian_determinant(&q),
        ];
        if let [Some(a), Some(b)] = determinants {
            assert!(
                (a - b).abs() < 1e-12 * robot.size.powi(3).max(1.0),
                "{a} {b}"
            );
        }
        let values = loaded.singularities(&q);
        assert_eq!(values.len(), arm.singularities(&q).len());
        for ((name, value), known) in values.into_iter().zip(arm.singularities(&q).iter()) {
            assert_eq!((name, value), (known.name, known.value));
        }
    }
}

pub fn solutions_are_the_same<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let loaded = loaded(robot);
    let mut compared = 0;
    for q in robot.random(40).chain(robot.structured()) {
        let target = robot.arm.fk(&q);
        let (there, here) = (loaded.ik(&target), robot.arm.ik(&target));
        assert_eq!(there.len(), here.len(), "{q:?}: {there:#?}, {here:#?}");
        for (there, here) in there.iter().zip(&here) {
            // Only what is refined or corrected goes through other operations of forward
            // kinematics, whose rounding a singular target magnifies.
            let apart = robot.apart(there.q, &here.q);
            let conditioning = robot.conditioning(&here.q).max(1e-12);
            let tolerance = if EXACT.contains(&robot.path) && !here.singular {
                0.0
            } else {
                ROUNDING / conditioning
            };
            assert!(apart <= tolerance, "{apart} of {q:?}");
            assert_eq!((there.branch, there.singular), (here.branch, here.singular));
            compared += 1;
        }
        let (there, here) = (
            loaded.ik_nearest(&target, &q),
            robot.arm.ik_nearest(&target, &q),
        );
        assert_eq!(there.is_some(), here.is_some());
        if let (Some(there), Some(here)) = (there, here) {
            let apart = robot.apart(&there.q, &here.q);
            let conditioning = robot.conditioning(&here.q).max(1e-12);
            assert!(apart <= ROUNDING / conditioning, "{apart} of {q:?}");
        }
    }
    assert!(compared > 40, "{compared}");
}
