//! The `kinematics!` macro.
