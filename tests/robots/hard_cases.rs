//! What has broken published solvers, one test for each.

mod aligned;
mod boundary;
mod fourfold;
mod quartic;
mod singular;
mod universal;
