//! Six joints whose first step is a pair of relations in two angles
//! (subproblem 6): few industrial arms are built so.

use crate::batches::inverse_batches;
use crate::complete::random_targets_have_all_answers;
use crate::complete::structured_targets_have_all_regular_answers;
use crate::forward::{jacobians_agree, poses_agree};
use crate::honest::{
    regular_answers_are_not_flagged, singular_answers_are_flagged, singular_targets_are_answered,
};
use crate::near::regular_targets_do_not_look_at_the_seed;
use crate::recovered::{random_configurations_come_back, structured_configurations_come_back};
use crate::rounded::{
    matrices_that_are_no_rotations_have_no_answers, no_answer_is_lost_to_a_digit,
};
use crate::sound::{
    angles_are_in_range, answers_are_distinct, answers_reach_the_target,
    answers_to_other_poses_reach_them, branches_are_in_order,
};
use crate::unreachable::far_targets_have_no_answers;

for_every_table_row!(no_answer_is_lost_to_a_digit);
for_every_table_row!(matrices_that_are_no_rotations_have_no_answers);
for_every_table_row!(inverse_batches);
for_every_table_row!(poses_agree);
for_every_table_row!(jacobians_agree);
for_every_table_row!(answers_reach_the_target);
for_every_table_row!(answers_to_other_poses_reach_them);
for_every_table_row!(answers_are_distinct);
for_every_table_row!(angles_are_in_range);
for_every_table_row!(branches_are_in_order);
for_every_table_row!(random_configurations_come_back);
for_every_table_row!(structured_configurations_come_back);
for_every_table_row!(random_targets_have_all_answers);
for_every_table_row!(structured_targets_have_all_regular_answers);
for_every_table_row!(regular_answers_are_not_flagged);
for_every_table_row!(singular_answers_are_flagged);
for_every_table_row!(singular_targets_are_answered);
for_every_table_row!(far_targets_have_no_answers);
for_every_table_row!(regular_targets_do_not_look_at_the_seed);
