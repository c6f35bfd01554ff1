//! The kinematics compiler as a library.
pub mod model;
pub mod spec;
