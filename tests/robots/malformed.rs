//! Targets that are no poses.

use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{Kinematics, Pose};

for_every_robot!(not_a_number_has_no_answers);
for_every_robot!(infinity_has_no_answers);
for_every_robot!(a_stretched_rotation_is_out_of_reach);

/// A pose's entry: nine of the rotation, three of the translation.
fn with_entry(mut pose: Pose, entry: usize, value: f64) -> Pose {
    let entries = pose.rotation.iter_mut().flatten();
    if let Some(place) = entries.chain(&mut pose.translation).nth(entry) {
        *place = value;
    }
    pose
}

/// The entries that an arm looks at.
fn read(counts: Target) -> &'static [usize] {
    match counts {
        Target::Pose => &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11],
        Target::Position => &[9, 10, 11],
        Target::PositionAxis => &[2, 5, 8, 9, 10, 11],
        Target::Direction => &[2, 5, 8],
        Target::Orientation => &[0, 1, 2, 3, 4, 5, 6, 7, 8],
        // Of arms whose first axis is upright, and which are so at home.
        Target::PositionYaw => &[0, 1, 3, 4, 9, 10, 11],
        Target::Planar => &[0, 1, 3, 4, 9, 10],
    }
}

fn assert_no_answers<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>, value: f64) {
    for q in robot.random(5).chain(robot.structured().take(5)) {
        for &entry in read(robot.counts) {
            let target = with_entry(robot.chain.fk(&q), entry, value);
            let answers = robot.ik(&target);
            assert!(answers.is_empty(), "{answers:?} reach {target:?}");
        }
    }
}

pub fn not_a_number_has_no_answers<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    assert_no_answers(robot, f64::NAN);
}

pub fn infinity_has_no_answers<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    assert_no_answers(robot, f64::INFINITY);
    assert_no_answers(robot, f64::NEG_INFINITY);
}

/// Nothing is projected in silence. A matrix off a rotation by less than the
/// accuracy of answers is answered; one farther off cannot be reached.
fn a_stretched_rotation_is_out_of_reach<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(50) {
        for stretch in [1e-15, 1e-12, 1e-10, 1e-8, 1e-6, 1e-3] {
            let target = stretched(robot.chain.fk(&q), stretch);
            let answers = robot.ik(&target);
            let expected = robot.counts == Target::Position || stretch < 1e-11;
            assert!(expected || stretch < 1e-9 || answers.is_empty(), "{q:?}");
            assert!(!expected || !answers.is_empty(), "{q:?}, {stretch}");
        }
    }
}

fn stretched(pose: Pose, by: f64) -> Pose {
    let rotation = pose.rotation.map(|row| row.map(|x| x * (1.0 + by)));
    Pose { rotation, ..pose }
}
