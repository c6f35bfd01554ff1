//! Three parallel axes as they are built; the general ones are rows of the
//! [table](crate::table).

structures! {
    as_in_universal_robots: [SKEW, MEET, PARALLEL, PARALLEL, MEET, MEET];
    alone_in_a_plane: [SKEW, PARALLEL, PARALLEL];
}
