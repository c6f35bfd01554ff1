//! The configuration that made the target is among the answers.

use crate::subject::Subject;
use kinematics::{Kinematics, Solution};

for_every_robot!(random_configurations_come_back);
for_every_robot!(structured_configurations_come_back);
for_every_robot!(nearly_structured_configurations_come_back);

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

/// Next to configurations that are singular in several ways: something there is always. What is singular
/// in one way comes back, or what is as nearly singular stands for it; further ones leave no digit of it.
pub fn nearly_structured_configurations_come_back<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    const NEAR: f64 = 1e-2;
    const NEARLY_SINGULAR: f64 = 1e-9;
    for q in robot.nearly_structured(20_000) {
        let answers = robot.ik(&robot.chain.fk(&q));
        let is_near = |other: &[f64; N]| robot.apart(other, &q) < NEAR;
        let stands_for_it = |other: &[f64; N]| robot.conditioning(other) < NEARLY_SINGULAR;
        let comes_back = |it: &Solution<N>| it.singular || is_near(&it.q) || stands_for_it(&it.q);
        let comes_back = answers.iter().any(comes_back);
        let is_told = robot.least_singular_values(&q)[1] > SINGULAR;
        assert!(
            comes_back || !is_told && !answers.is_empty(),
            "{q:?}: {answers:#?}"
        );
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
