//! Targets with lost digits: off by less than solutions may miss them, rounded,
//! or no poses at all.

use crate::random::Random;
use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{Kinematics, Pose};

for_every_robot!(no_answer_is_lost_to_a_digit);
for_every_robot!(matrices_that_are_no_rotations_have_no_answers);
for_every_robot!(rounded_rotations_are_answered_when_mended);

/// A motion by as much, along and about some axis.
fn nudge(random: &mut Random, size: f64, length: f64) -> Pose {
    let axis = [0, 1, 2].map(|_| random.angle());
    let long = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let shift = [0, 1, 2].map(|_| size * length * random.angle() / 3.2);
    Pose::from_axis_angle(axis.map(|x| x / long), size, shift)
}

/// Next to a target that is reached, one is within what a solution may miss.
pub fn no_answer_is_lost_to_a_digit<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    if N < 6 && robot.counts == Target::Pose {
        return;
    }
    let mut random = Random::new(77);
    for q in robot.structured() {
        for size in [1e-12, 1e-11, 1e-10] {
            let target = nudge(&mut random, size, robot.size) * robot.chain.fk(&q);
            let answers = robot.ik(&target);
            assert!(!answers.is_empty(), "{q:?} off by {size:e}");
            for answer in answers {
                assert!(
                    robot.miss(&answer.q, &target) < 1.001e-9,
                    "{q:?}: {answer:?}"
                );
            }
        }
    }
}

pub fn matrices_that_are_no_rotations_have_no_answers<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    if robot.counts == Target::Position {
        return;
    }
    for q in robot.random(20) {
        let pose = robot.chain.fk(&q);
        let r = pose.rotation;
        let scaled = |k: f64| r.map(|row| row.map(|x| k * x));
        let mirrored = r.map(|row| [row[0], row[1], -row[2]]);
        let one_off = {
            let mut r = r;
            r[1][1] += 1e-7;
            r
        };
        for rotation in [
            [[0.0; 3]; 3],
            scaled(-1.0),
            scaled(1.0 + 1e-8),
            mirrored,
            one_off,
        ] {
            let target = Pose { rotation, ..pose };
            assert!(robot.ik(&target).is_empty(), "{rotation:?}");
            assert!(target.rotation_error() > 1e-9);
        }
    }
}

fn rounded_rotations_are_answered_when_mended<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    if N < 6 && robot.counts == Target::Pose {
        return;
    }
    let six_digits = |x: f64| (x * 1e6).round() / 1e6;
    let single = |x: f64| f64::from(x as f32);
    for q in robot.random(20) {
        let pose = robot.chain.fk(&q);
        for rounded in [six_digits, single] {
            let target = Pose {
                rotation: pose.rotation.map(|row| row.map(rounded)),
                translation: pose.translation,
            };
            let mended = target.orthonormalized().unwrap();
            let near = |x: f64| x < 1e-3;
            let answers = robot.ik(&mended);
            assert!(
                answers.iter().any(|it| near(robot.apart(&it.q, &q))),
                "{q:?}: {answers:?}"
            );
        }
    }
}
