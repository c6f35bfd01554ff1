//! What has broken published solvers, one test for each.

mod aligned;
mod boundary;
mod fourfold;
mod singular;
mod universal;
