//! Three axes that meet in a point, behind the shoulder that most industrial
//! arms have, and, read backwards, before it. Other shoulders are rows of the
//! [table](crate::table).

structures! {
    second_and_third_parallel_from_one_point: [SKEW, MEET, PARALLEL, MEET, MEET, MEET_THERE];
}
