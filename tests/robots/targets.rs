//! Targets of fewer coordinates than a pose, and arms with fewer joints than
//! their targets have coordinates.

mod directions;
mod overdetermined;
mod part;

use crate::batches::inverse_batches;
use crate::complete::random_targets_have_all_answers;
use crate::complete::structured_targets_have_all_regular_answers;
use crate::forward::{jacobians_agree, poses_agree};
use crate::honest::{
    regular_answers_are_not_flagged, singular_answers_are_flagged, singular_targets_are_answered,
};
use crate::limits::{
    a_configuration_inside_comes_back_as_it_was, windings_stay_inside_and_reach_the_target,
};
use crate::malformed::{infinity_has_no_answers, not_a_number_has_no_answers};
use crate::near::regular_targets_do_not_look_at_the_seed;
use crate::recovered::{random_configurations_come_back, structured_configurations_come_back};
use crate::sound::{
    angles_are_in_range, answers_are_distinct, answers_reach_the_target,
    answers_to_other_poses_reach_them, branches_are_in_order,
};
use crate::unreachable::far_targets_have_no_answers;

for_every_aimed_robot!(inverse_batches);
for_every_aimed_robot!(poses_agree);
for_every_aimed_robot!(jacobians_agree);
for_every_aimed_robot!(answers_reach_the_target);
for_every_aimed_robot!(answers_to_other_poses_reach_them);
for_every_aimed_robot!(answers_are_distinct);
for_every_aimed_robot!(angles_are_in_range);
for_every_aimed_robot!(branches_are_in_order);
for_every_aimed_robot!(random_configurations_come_back);
for_every_aimed_robot!(structured_configurations_come_back);
for_every_aimed_robot!(random_targets_have_all_answers);
for_every_aimed_robot!(structured_targets_have_all_regular_answers);
for_every_aimed_robot!(regular_answers_are_not_flagged);
for_every_aimed_robot!(singular_answers_are_flagged);
for_every_aimed_robot!(singular_targets_are_answered);
for_every_aimed_robot!(far_targets_have_no_answers);
for_every_aimed_robot!(not_a_number_has_no_answers);
for_every_aimed_robot!(infinity_has_no_answers);
for_every_aimed_robot!(windings_stay_inside_and_reach_the_target);
for_every_aimed_robot!(a_configuration_inside_comes_back_as_it_was);
for_every_aimed_robot!(regular_targets_do_not_look_at_the_seed);
