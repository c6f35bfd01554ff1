//! What has broken published solvers, one test for each.

mod aligned;
mod boundary;
mod singular;
mod universal;
