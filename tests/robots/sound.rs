//! Every answer is one: it reaches the target, once, in range.

use crate::subject::Subject;
use kinematics::{Kinematics, Solution};
use std::f64::consts::PI;

for_every_robot!(answers_reach_the_target);
for_every_robot!(answers_to_other_poses_reach_them);
for_every_robot!(answers_are_distinct);
for_every_robot!(angles_are_in_range);
for_every_robot!(branches_are_in_order);

/// Relative to the arm's size.
const SOUND: f64 = 1e-9;
/// Two answers closer than this, in radians, are one.
const SAME: f64 = 1e-7;

/// Calls `check` with the answers to random and structured targets.
fn for_every_target<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    check: impl Fn(&[f64; N], &[Solution<N>]),
) {
    for q in robot.random(300).chain(robot.structured()) {
        check(&q, &robot.ik(&robot.chain.fk(&q)));
    }
}

pub fn answers_reach_the_target<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for_every_target(robot, |q, answers| {
        let target = robot.chain.fk(q);
        for answer in answers {
            let miss = robot.miss(&answer.q, &target);
            assert!(miss <= SOUND, "{answer:?} misses that of {q:?} by {miss:e}");
            assert!(answer.residual <= SOUND * robot.size, "{answer:?}");
        }
    });
}

/// Positions of one target with the orientation of another: within reach or
/// not, there may be answers, and they are sound.
pub fn answers_to_other_poses_reach_them<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let poses: Vec<_> = robot.random(300).map(|q| robot.chain.fk(&q)).collect();
    for pair in poses.windows(2) {
        let mut target = pair[0];
        target.rotation = pair[1].rotation;
        for answer in robot.ik(&target) {
            let miss = robot.miss(&answer.q, &target);
            assert!(miss <= SOUND, "{answer:?} misses {target:?} by {miss:e}");
        }
    }
}

pub fn answers_are_distinct<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for_every_target(robot, |q, answers| {
        for (i, a) in answers.iter().enumerate() {
            for b in &answers[..i] {
                assert!(robot.apart(&a.q, &b.q) > SAME, "{a:?} and {b:?} of {q:?}");
            }
        }
    });
}

pub fn angles_are_in_range<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for_every_target(robot, |q, answers| {
        for answer in answers {
            let angles = (0..N).filter(|&i| robot.turns(i)).map(|i| answer.q[i]);
            let out: Vec<f64> = angles.filter(|a| !(*a > -PI && *a <= PI)).collect();
            assert!(out.is_empty(), "{out:?} in {answer:?} of {q:?}");
        }
    });
}

pub fn branches_are_in_order<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    // An elimination completes the branches.
    let completed = [
        "desk_arm",
        "nearly_parallel",
        "parallel_123",
        "slide_of_rrp",
        "wrist_alone",
    ];
    let is_completed = completed.iter().any(|name| robot.path.contains(name));
    for_every_target(robot, |q, answers| {
        let is_branch = |answer: &Solution<N>| (answer.branch as usize) < K::BRANCHES;
        assert!(is_completed || answers.iter().all(is_branch), "{q:?}");
        assert!(answers.is_sorted_by_key(|answer| answer.branch), "{q:?}");
    });
}
