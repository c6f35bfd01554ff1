//! Answers near a seed: those of the target, and at a singular one the seed's
//! own.

use crate::subject::Subject;
use kinematics::{Kinematics, Solution};

for_every_robot!(regular_targets_do_not_look_at_the_seed);
for_every_robot!(a_singular_seed_comes_back);
for_every_robot!(answers_converge_to_the_seed);

/// A seed is where it was to this, radians; double roots have half the digits.
const KEPT: f64 = 1e-6;

pub fn regular_targets_do_not_look_at_the_seed<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    let seeds = robot.random(600).skip(300);
    for (q, seed) in robot.random(300).zip(seeds) {
        let target = robot.chain.fk(&q);
        let answers = robot.ik(&target);
        let near: Vec<_> = robot.arm.ik_seeded(&target, &seed).into_iter().collect();
        let regular = |answer: &Solution<N>| robot.conditioning(&answer.q) > 1e-3;
        if answers.iter().chain(&near).all(regular) {
            assert_eq!(near, answers, "{q:?}, {seed:?}");
        }
    }
}

/// How far from a seed the nearest answer to a target is.
fn from_seed<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    answers: &[Solution<N>],
    seed: &[f64; N],
) -> f64 {
    let apart = answers.iter().map(|answer| robot.apart(&answer.q, seed));
    apart.fold(f64::INFINITY, f64::min)
}

/// Singular configurations in which one way to move is lost.
fn singular<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) -> impl Iterator<Item = [f64; N]> {
    robot.structured().filter(|q| {
        let [least, next] = robot.least_singular_values(q);
        least < 1e-12 && next > 1e-6
    })
}

fn a_singular_seed_comes_back<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in singular(robot) {
        let target = robot.chain.fk(&q);
        let answers = robot.arm.ik_seeded(&target, &q);
        let kept = from_seed(robot, &answers, &q);
        assert!(kept < KEPT, "{q:?} is {kept:e} from {answers:#?}");
    }
}

/// On the way into the singularity, without a seed.
fn answers_converge_to_the_seed<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for seed in singular(robot) {
        for joint in 0..N {
            for step in [1e-2, 1e-4, 1e-6] {
                let mut q = seed;
                q[joint] += step;
                if robot.conditioning(&q) < 1e-3 * step {
                    // Still singular.
                    continue;
                }
                let answers = robot.ik(&robot.chain.fk(&q));
                let left = from_seed(robot, &answers, &seed);
                assert!(left < 2.0 * step, "{left:e} after {step:e} from {seed:?}");
            }
        }
    }
}
