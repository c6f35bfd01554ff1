//! Robots whose files say 1.5708 and 3.141, have stray micrometres, or describe
//! one calibrated arm. Closed forms are for the arm that was meant; answers are
//! for the one that is described.

use crate::complete::assert_matched;
use crate::forward::{jacobians_agree, poses_agree};
use crate::malformed::{infinity_has_no_answers, not_a_number_has_no_answers};
use crate::sound::{angles_are_in_range, answers_are_distinct, answers_reach_the_target};
use crate::subject::Subject;
use crate::unreachable::far_targets_have_no_answers;
use kinematics::{Kinematics, Pose};

for_every_noisy_robot!(poses_agree);
for_every_noisy_robot!(jacobians_agree);
for_every_noisy_robot!(answers_reach_the_target);
for_every_noisy_robot!(answers_are_distinct);
for_every_noisy_robot!(angles_are_in_range);
for_every_noisy_robot!(far_targets_have_no_answers);
for_every_noisy_robot!(not_a_number_has_no_answers);
for_every_noisy_robot!(infinity_has_no_answers);
for_every_noisy_robot!(configurations_come_back);
for_every_noisy_robot!(targets_have_all_answers);

/// Conditioning of configurations well away from singular ones, compared to
/// the noise.
const REGULAR: f64 = 0.02;

fn configurations_come_back<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let regular = |q: &[f64; N]| robot.conditioning(q) > REGULAR;
    for q in robot.random(1000).filter(regular) {
        let answers = robot.ik(&robot.chain.fk(&q));
        let nearest = answers.iter().map(|answer| robot.apart(&answer.q, &q));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-10, "{q:?} is {nearest:e} from {answers:#?}");
    }
}

fn targets_have_all_answers<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let mut tried = 0;
    for q in robot.random(100) {
        let target: Pose = robot.chain.fk(&q);
        let found = robot.search(&target);
        if found
            .iter()
            .all(|solution| robot.conditioning(&solution.q) > REGULAR)
        {
            tried += 1;
            let answers = robot.ik(&target);
            assert_eq!(
                answers.len(),
                found.len(),
                "{q:?}: {answers:#?}, {found:#?}"
            );
            for solution in &found {
                assert_matched(robot, solution, &answers, &q);
            }
        }
    }
    assert!(tried > 10, "only {tried} regular targets");
}
