//! Three axes that meet in a point, behind every shoulder with a closed form,
//! and, read backwards, before it.

structures! {
    second_and_third_parallel: [SKEW, SKEW, PARALLEL, SKEW, MEET, MEET_THERE];
    second_and_third_parallel_from_one_point: [SKEW, MEET, PARALLEL, MEET, MEET, MEET_THERE];
    first_and_second_meet: [SKEW, MEET, SKEW, SKEW, MEET, MEET_THERE];
    second_and_third_meet: [SKEW, SKEW, MEET, SKEW, MEET, MEET_THERE];
    first_and_second_parallel: [SKEW, PARALLEL, SKEW, SKEW, MEET, MEET_THERE];
}
