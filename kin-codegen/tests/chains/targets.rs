//! Targets of which a part counts.

/// `name: part, [how each axis lies to the one before];`
macro_rules! targets {
    ($($name:ident: $target:ident, [$($step:expr),*];)*) => {
        $(mod $name {
            use crate::arm::*;
            use crate::check::{Solved, commands};
            use crate::settings::in_cases;
            use kin_codegen::Target;
            use proptest::prop_assume;

            const STEPS: &[Step] = &[$($step),*];

            #[test]
            fn is_solved() {
                in_cases(16, placed(arm(STEPS), STEPS), &|(arm, q)| {
                    prop_assume!(commands(&arm, Target::$target));
                    Solved::new_for_target(&arm, Target::$target)?.check(&q)
                });
            }
        })*
    };
}

targets! {
    pan_and_tilt: Direction, [SKEW, MEET];
    pan_and_tilt_apart: Direction, [SKEW, SKEW];
    gimbal: Orientation, [SKEW, MEET, MEET_THERE];
    rings_apart: Orientation, [SKEW, SKEW, SKEW];
    shoulder: Position, [SKEW, SKEW, PARALLEL];
    three_skew_joints: Position, [SKEW, SKEW, SKEW];
    gantry: Position, [SLIDE, SLIDE, SLIDE];
    column: Position, [SKEW, SLIDE_ALONG, SLIDE];
    telescope: Position, [SKEW, MEET, SLIDE];
    four_axes_and_a_swing: PositionAxis, [SKEW, MEET, PARALLEL, PARALLEL, MEET];
    gantry_with_two_turns: PositionAxis, [SLIDE, SLIDE, SLIDE, SKEW, MEET];
    rail_under_four: PositionAxis, [SLIDE, SKEW, MEET, PARALLEL, PARALLEL];
    three_parallel_and_two: PositionAxis, [SKEW, PARALLEL, PARALLEL, SKEW, SKEW];
    a_wrist_in_front: PositionAxis, [SKEW, MEET, MEET_THERE, SKEW, SKEW];
    a_wrist_behind: PositionAxis, [SKEW, SKEW, SKEW, MEET, MEET_THERE];
    slide_behind_two_turns: Position, [SKEW, SKEW, SLIDE];
    slide_between_two_turns: Position, [SKEW, SLIDE, SKEW];
    slide_before_two_turns: Position, [SLIDE, SKEW, SKEW];
    turn_between_two_slides: Position, [SLIDE, SKEW, SLIDE];
    one_turn: Pose, [SKEW];
    two_turns: Pose, [SKEW, SKEW];
    three_turns: Pose, [SKEW, SKEW, SKEW];
    four_turns: Pose, [SKEW, SKEW, SKEW, SKEW];
    five_turns: Pose, [SKEW, SKEW, SKEW, SKEW, SKEW];
    five_turns_and_a_free_one: PositionAxis, [SKEW, SKEW, SKEW, SKEW, SKEW];
    offset_elbow_and_free_tool: PositionAxis, [SKEW, MEET, SKEW, MEET, SKEW];
    scara: PositionYaw, [SKEW, PARALLEL, PARALLEL, SLIDE_ALONG];
    planar: Planar, [SKEW, PARALLEL, PARALLEL];
}
