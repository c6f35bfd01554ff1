//! Robots whose files say 1.5708 and 3.141, have stray micrometres, or describe
//! one calibrated arm. Closed forms are for the arm that was meant; answers are
//! for the one that is described.

use crate::closest::{
    little_is_gained_by_descending_from_it, not_a_number_has_none,
    out_of_reach_it_claims_no_solution, residual_is_the_distance, within_reach_it_is_a_solution,
};
use crate::complete::{assert_matched, random_targets_have_all_answers};
use crate::forward::{jacobians_agree, poses_agree};
use crate::honest::{regular_answers_are_not_flagged, singular_answers_are_flagged};
use crate::malformed::{infinity_has_no_answers, not_a_number_has_no_answers};
use crate::near::regular_targets_do_not_look_at_the_seed;
use crate::nearest::{the_nearest_is_that_of_all_solutions, the_reason_for_none_is_true};
use crate::random::Random;
use crate::recovered::assert_comes_back;
use crate::sound::{angles_are_in_range, answers_are_distinct, answers_reach_the_target};
use crate::subject::Subject;
use crate::unreachable::far_targets_have_no_answers;
use kinematics::{Kinematics, Robot};
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

for_every_noisy_robot!(poses_agree);
for_every_noisy_robot!(jacobians_agree);
for_every_noisy_robot!(answers_reach_the_target);
for_every_noisy_robot!(answers_are_distinct);
for_every_noisy_robot!(angles_are_in_range);
for_every_noisy_robot!(far_targets_have_no_answers);
for_every_noisy_robot!(not_a_number_has_no_answers);
for_every_noisy_robot!(infinity_has_no_answers);
for_every_noisy_robot!(random_targets_have_all_answers);
for_every_noisy_robot!(regular_answers_are_not_flagged);
for_every_noisy_robot!(singular_answers_are_flagged);
for_every_noisy_robot!(regular_configurations_come_back);
for_every_noisy_robot!(out_of_reach_it_claims_no_solution);
for_every_noisy_robot!(little_is_gained_by_descending_from_it);
for_every_noisy_robot!(residual_is_the_distance);
for_every_noisy_robot!(within_reach_it_is_a_solution);
for_every_noisy_robot!(not_a_number_has_none);
for_every_noisy_robot!(regular_targets_do_not_look_at_the_seed);
for_every_noisy_robot!(the_nearest_is_that_of_all_solutions);
for_every_noisy_robot!(the_reason_for_none_is_true);

for_every_noisy_robot!(nearly_singular_configurations_come_back);
for_every_noisy_robot!(nearly_singular_targets_have_all_answers);

/// Below this conditioning a configuration is not isolated to rounding.
const ISOLATED: f64 = 1e-5;

fn regular_configurations_come_back<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let regular = |q: &[f64; N]| robot.conditioning(q) > ISOLATED;
    for q in robot.random(1000).filter(regular) {
        assert_comes_back(robot, &q);
    }
}

/// With the fifth joint, the wrist of all these arms, near 0 and π. The meant
/// arm has nearly a family of solutions there, the described one has up to
/// sixteen isolated ones.
fn nearly_singular<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    count: usize,
) -> Vec<[f64; N]> {
    let bends = [0.1, -0.03, 0.01, -0.003, 1e-3, PI - 0.05, 0.005 - PI];
    let bent = bends.into_iter().flat_map(|bend| {
        robot.random(count).map(move |mut q| {
            q[4] = bend;
            q
        })
    });
    bent.filter(|q| robot.conditioning(q) > ISOLATED).collect()
}

fn nearly_singular_configurations_come_back<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for q in nearly_singular(robot, 100) {
        assert_comes_back(robot, &q);
    }
}

fn nearly_singular_targets_have_all_answers<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for q in nearly_singular(robot, 4) {
        let target = robot.chain.fk(&q);
        let answers = robot.ik(&target);
        for solution in robot.search(&target) {
            if robot.conditioning(&solution.q) > ISOLATED {
                assert_matched(robot, &solution, &answers, &q);
            }
        }
    }
}

/// Stretched arms and wrists, turned to the base's axis: pairs of solutions are 0.2 rad apart, and their
/// values of the kept joint 1e-5. What is taken to zero in the middle mixes the two.
#[test]
fn solutions_that_nearly_share_the_kept_joints_value_come_back() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/robots");
    let mut random = Random::new(5);
    for (file, stretched) in [
        (
            "measured_kr6.yaml",
            [0.0, -FRAC_PI_2, 0.0, 0.0, -FRAC_PI_2, -FRAC_PI_2],
        ),
        (
            "measured_lr.yaml",
            [0.0, 0.0, FRAC_PI_2, 0.0, FRAC_PI_2, PI],
        ),
    ] {
        let robot = Robot::from_yaml(folder.join(file)).unwrap();
        let mut tried = 0;
        for k in 0..2000 {
            let off = 0.1 * 10_f64.powi(-(k % 3));
            let q = stretched.map(|q| q + random.between(-off, off));
            if robot.manipulability(&q).sigma_min < 1e-2 {
                continue;
            }
            tried += 1;
            let is_same = |(a, b): (&f64, &f64)| (0.5 * (a - b)).sin().abs() < 1e-6;
            let solutions = robot.ik(&robot.fk(&q));
            let mut comes_back = solutions.iter().map(|it| it.q.iter().zip(&q).all(is_same));
            assert!(comes_back.any(|is| is), "{file}: {q:?}");
        }
        assert!(tried > 300, "{file}: {tried} tell nothing");
    }
}

/// Where an arm stretched straight up or folded has its wrist over the base's axis as well, the Jacobian
/// loses two ranks, and four solutions meet, none along the direction that moves the tip least.
#[test]
fn solutions_beside_two_singularities_at_once_come_back() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/robots/noisy/calibrated.yaml");
    let robot = Robot::from_yaml(file).unwrap();
    let mut random = Random::new(6);
    let mut tried = 0;
    for lift in [FRAC_PI_2, -FRAC_PI_2] {
        for wrist_1 in [FRAC_PI_2, -FRAC_PI_2] {
            for wrist_2 in [0.0, FRAC_PI_2] {
                for k in 0..500 {
                    let off = 0.01 * 4_f64.powi(-(k % 3));
                    let q = [0.5, lift, 0.0, wrist_1, wrist_2, -0.1];
                    let q = q.map(|q| q + random.between(-off, off));
                    // Nearer to singular, two solutions are one.
                    if robot.manipulability(&q).sigma_min < 2e-5 {
                        continue;
                    }
                    tried += 1;
                    let is_same = |(a, b): (&f64, &f64)| (0.5 * (a - b)).sin().abs() < 1e-6;
                    let solutions = robot.ik(&robot.fk(&q));
                    let mut comes_back =
                        solutions.iter().map(|it| it.q.iter().zip(&q).all(is_same));
                    assert!(comes_back.any(|is| is), "{q:?}");
                }
            }
        }
    }
    assert!(tried > 3000, "{tried} tell nothing");
}
