//! Arms with prismatic joints, and arms of which only the position counts.

structures! {
    scara: [SKEW, PARALLEL, PARALLEL, SLIDE_ALONG];
    scara_that_lifts_first: [SLIDE, PARALLEL, PARALLEL, PARALLEL];
    scara_that_lifts_at_the_elbow: [SKEW, PARALLEL, SLIDE_ALONG, PARALLEL];
    stanford: [SKEW, MEET, SLIDE, SKEW, MEET, MEET_THERE];
    cylindrical: [SKEW, SLIDE_ALONG, SLIDE, SKEW, MEET, MEET_THERE];
    gantry: [SLIDE, SLIDE, SLIDE, SKEW, MEET, MEET_THERE];
    two_joints_in_a_plane: [SKEW, PARALLEL];
    shoulder_and_elbow: [SKEW, SKEW, PARALLEL];
}
