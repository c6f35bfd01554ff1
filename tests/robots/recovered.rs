//! The configuration that made the target is among the answers.

use crate::subject::Subject;
use kinematics::Kinematics;

for_every_robot!(random_configurations_come_back);
for_every_robot!(structured_configurations_come_back);

/// Below this conditioning a configuration may be one of a family.
const SINGULAR: f64 = 1e-6;
/// Rounding in the target, which conditioning magnifies.
const ROUNDING: f64 = 1e-12;

pub fn random_configurations_come_back<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(1000) {
        assert_comes_back(robot, &q);
    }
}

pub fn structured_configurations_come_back<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    let regular = robot
        .structured()
        .filter(|q| robot.conditioning(q) > SINGULAR);
    for q in regular {
        assert_comes_back(robot, &q);
    }
}

pub fn assert_comes_back<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>, q: &[f64; N]) {
    let tolerance = ROUNDING / robot.conditioning(q);
    let answers = robot.ik(&robot.chain.fk(q));
    let nearest = answers
        .iter()
        .map(|answer| robot.apart(&answer.q, q))
        .fold(f64::INFINITY, f64::min);
    assert!(
        nearest < tolerance,
        "{q:?} is {nearest:e} (allowed {tolerance:e}) from the nearest of {answers:#?}"
    );
}
