//! Arms of one to five joints, and rails under them.

structures! {
    two_skew_joints: [SKEW, SKEW];
    universal_joint: [SKEW, MEET];
    waist_and_three_parallel: [SKEW, MEET, PARALLEL, PARALLEL];
    four_joints: [SKEW, SKEW, PARALLEL, SKEW];
    three_parallel_in_the_middle_of_five: [SKEW, SKEW, PARALLEL, PARALLEL, SKEW];
    three_parallel_before_a_wrist_of_two: [SKEW, PARALLEL, PARALLEL, SKEW, MEET];
    five_joints_with_a_spherical_wrist: [SKEW, PARALLEL, SKEW, MEET, MEET_THERE];
    rail_under_five_joints: [SLIDE, SKEW, MEET, PARALLEL, PARALLEL, SKEW];
    rail_under_four_joints: [SLIDE, SKEW, MEET, PARALLEL, PARALLEL];
}
