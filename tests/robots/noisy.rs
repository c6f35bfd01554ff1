//! Robots whose files say 1.5708 and 3.141, have stray micrometres, or describe
//! one calibrated arm. Closed forms are for the arm that was meant; answers are
//! for the one that is described.

use crate::closest::{
    little_is_gained_by_descending_from_it, not_a_number_has_none,
    out_of_reach_it_claims_no_solution, residual_is_the_distance, within_reach_it_is_a_solution,
};
use crate::complete::random_targets_have_all_answers;
use crate::forward::{jacobians_agree, poses_agree};
use crate::honest::{regular_answers_are_not_flagged, singular_answers_are_flagged};
use crate::malformed::{infinity_has_no_answers, not_a_number_has_no_answers};
use crate::near::regular_targets_do_not_look_at_the_seed;
use crate::recovered::assert_comes_back;
use crate::sound::{angles_are_in_range, answers_are_distinct, answers_reach_the_target};
use crate::subject::Subject;
use crate::unreachable::far_targets_have_no_answers;
use kinematics::Kinematics;

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
for_every_noisy_robot!(not_a_number_has_none);
for_every_noisy_robot!(regular_targets_do_not_look_at_the_seed);

/// Conditioning of configurations well away from singular ones, compared to
/// the noise.
const REGULAR: f64 = 0.01;

fn regular_configurations_come_back<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let regular = |q: &[f64; N]| robot.conditioning(q) > REGULAR;
    for q in robot.random(1000).filter(regular) {
        assert_comes_back(robot, &q);
    }
}
for_every_noisy_robot!(residual_is_the_distance);
for_every_noisy_robot!(within_reach_it_is_a_solution);
