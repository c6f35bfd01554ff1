//! What is lost where the first or last joint of a UR stands at a right angle.

use crate::subject::Subject;
use crate::zoo::{Ur5e, Ur10e};
use kinematics::Kinematics;
use std::f64::consts::{FRAC_PI_2, PI};

/// The target of `q` has eight answers, `q` among them.
fn assert_eight<K: Kinematics<6>>(robot: &Subject<K, 6>, q: [f64; 6]) {
    let answers = robot.ik(&robot.chain.fk(&q));
    assert_eq!(answers.len(), 8, "{q:?}: {answers:#?}");
    let recovered = answers
        .iter()
        .any(|answer| robot.apart(&answer.q, &q) < 1e-10);
    assert!(recovered, "{q:?}: {answers:#?}");
}

fn with_joint<K: Kinematics<6>>(robot: &Subject<K, 6>, joint: usize, value: f64) {
    let mut q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    q[joint] = value;
    assert_eight(robot, q);
}

#[test]
fn first_joint_at_a_right_angle() {
    for value in [0.0, FRAC_PI_2, -FRAC_PI_2, PI] {
        with_joint(&Subject::new(Ur5e, "../robots/ur5e.urdf"), 0, value);
        with_joint(&Subject::new(Ur10e, "../robots/ur10e.yaml"), 0, value);
    }
}

#[test]
fn last_joint_at_a_right_angle() {
    for value in [0.0, FRAC_PI_2, -FRAC_PI_2, PI] {
        with_joint(&Subject::new(Ur5e, "../robots/ur5e.urdf"), 5, value);
        with_joint(&Subject::new(Ur10e, "../robots/ur10e.yaml"), 5, value);
    }
}

#[test]
fn tool_straight_down() {
    for yaw in [0.0, 0.3, FRAC_PI_2, PI] {
        assert_eight(
            &Subject::new(Ur5e, "../robots/ur5e.urdf"),
            [yaw, -1.2, 1.5, -1.87, -FRAC_PI_2, 0.0],
        );
    }
}
