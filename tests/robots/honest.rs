//! Singular answers are flagged, regular ones are not, and a singular target
//! has at least one answer.

use crate::subject::Subject;
use kinematics::Kinematics;

for_every_robot!(regular_answers_are_not_flagged);
for_every_robot!(singular_answers_are_flagged);
for_every_robot!(singular_targets_are_answered);

/// Where the Jacobian has lost rank, to rounding.
const SINGULAR: f64 = 1e-12;
/// Far from it.
const REGULAR: f64 = 1e-3;

pub fn regular_answers_are_not_flagged<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(300).chain(robot.structured()) {
        for answer in robot.ik(&robot.chain.fk(&q)) {
            let regular = robot.conditioning(&answer.q) > REGULAR;
            assert!(!(regular && answer.singular), "{answer:?} of {q:?}");
        }
    }
}

pub fn singular_answers_are_flagged<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.structured() {
        for answer in robot.ik(&robot.chain.fk(&q)) {
            let singular = robot.conditioning(&answer.q) < SINGULAR;
            assert!(!singular || answer.singular, "{answer:?} of {q:?}");
        }
    }
}

pub fn singular_targets_are_answered<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.structured() {
        let answers = robot.ik(&robot.chain.fk(&q));
        assert!(!answers.is_empty(), "no answer to the target of {q:?}");
        let singular = robot.conditioning(&q) < SINGULAR;
        let flagged = answers.iter().any(|answer| answer.singular);
        assert!(!singular || flagged, "{q:?}: {answers:#?}");
    }
}
