//! Arms with prismatic joints, and arms of which only the position counts.

structures! {
    scara: [SKEW, PARALLEL, PARALLEL, SLIDE_ALONG];
    scara_that_lifts_first: [SLIDE, PARALLEL, PARALLEL, PARALLEL];
    scara_that_lifts_at_the_elbow: [SKEW, PARALLEL, SLIDE_ALONG, PARALLEL];
    stanford: [SKEW, MEET, SLIDE, SKEW, MEET, MEET_THERE];
    cylindrical: [SKEW, SLIDE_ALONG, SLIDE, SKEW, MEET, MEET_THERE];
    slide_behind_two_turns: [SKEW, SKEW, SLIDE, SKEW, MEET, MEET_THERE];
    slide_between_two_turns: [SKEW, SLIDE, SKEW, SKEW, MEET, MEET_THERE];
    turn_between_two_slides: [SLIDE, SKEW, SLIDE, SKEW, MEET, MEET_THERE];
    turn_behind_two_slides: [SLIDE, SLIDE, SKEW, SKEW, MEET, MEET_THERE];
    slides_and_turns: [SLIDE, SKEW, SLIDE, SKEW, SLIDE, SKEW];
    gantry: [SLIDE, SLIDE, SLIDE, SKEW, MEET, MEET_THERE];
    two_joints_in_a_plane: [SKEW, PARALLEL];
    shoulder_and_elbow: [SKEW, SKEW, PARALLEL];
}
