//! Three parallel axes, two others that meet, and one more.

structures! {
    second_to_fourth: [SKEW, SKEW, PARALLEL, PARALLEL, SKEW, MEET];
    second_to_fourth_as_in_universal_robots: [SKEW, MEET, PARALLEL, PARALLEL, MEET, MEET];
    first_to_third: [SKEW, PARALLEL, PARALLEL, SKEW, SKEW, MEET];
    alone_in_a_plane: [SKEW, PARALLEL, PARALLEL];
}
