//! What comes nearest to a target that is out of reach.

use crate::descent::descend;
use crate::subject::Subject;
use kinematics::{Kinematics, Pose, Solution};

for_every_robot!(within_reach_it_is_a_solution);
for_every_robot!(out_of_reach_it_claims_no_solution);
for_every_robot!(residual_is_the_distance);
for_every_robot!(little_is_gained_by_descending_from_it);
for_every_robot!(not_a_number_has_none);

/// Relative to the arm's size.
const SOUND: f64 = 1e-9;
/// The least-squares answers of the subproblems, one after the other, are not
/// that of the whole: the distance from the target is up to this many times
/// that of a local minimum.
const WORSE: f64 = 1.2;

pub fn within_reach_it_is_a_solution<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(200).chain(robot.structured()) {
        let target = robot.chain.fk(&q);
        let closest = robot.arm.ik_approximate(&target).unwrap();
        let answers = robot.ik(&target);
        let same = |answer: &Solution<N>| answer.q == closest.q;
        assert!(answers.iter().any(same), "{q:?}: {closest:?}, {answers:#?}");
        assert!(closest.residual <= SOUND * robot.size, "{closest:?}");
    }
}

/// Orientations within reach at positions from just outside to far outside.
fn out_of_reach<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) -> Vec<Pose> {
    let mut all = Vec::new();
    for q in robot.random(40) {
        let pose = robot.chain.fk(&q);
        let length = pose.translation.iter().map(|x| x * x).sum::<f64>().sqrt();
        for far in [1.5, 1.6, 2.0, 5.0, 100.0] {
            let translation = pose.translation.map(|x| x * far * robot.size / length);
            all.push(Pose {
                translation,
                ..pose
            });
        }
    }
    all.retain(|target| robot.ik(target).is_empty());
    all
}

pub fn out_of_reach_it_claims_no_solution<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for target in out_of_reach(robot) {
        let closest = robot.arm.ik_approximate(&target).unwrap();
        assert!(closest.q.iter().all(|x| x.is_finite()), "{closest:?}");
        assert!(closest.residual.is_finite(), "{closest:?}");
        assert!(closest.residual > SOUND * robot.size, "{closest:?}");
        assert_eq!(robot.arm.ik_approximate(&target), Some(closest));
    }
}

pub fn residual_is_the_distance<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for target in out_of_reach(robot) {
        let closest = robot.arm.ik_approximate(&target).unwrap();
        let missed = robot.miss(&closest.q, &target) * robot.size;
        let difference = (closest.residual - missed).abs();
        // A chord and the angle of a rotation differ where it is large.
        assert!(difference < 0.01 * missed, "{closest:?} is off by {missed}");
    }
}

pub fn little_is_gained_by_descending_from_it<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for target in out_of_reach(robot) {
        let closest = robot.arm.ik_approximate(&target).unwrap();
        let reached = robot.miss(&closest.q, &target);
        let least = descend(robot, closest.q, &target);
        assert!(
            reached <= WORSE * least,
            "{closest:?} is {reached} from {target:?}, {least} is near"
        );
    }
}

pub fn not_a_number_has_none<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let mut target = robot.chain.fk(&[0.1; N]);
    target.translation[0] = f64::NAN;
    assert_eq!(robot.arm.ik_approximate(&target), None);
}
