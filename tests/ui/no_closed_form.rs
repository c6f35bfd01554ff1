//! An arm without a closed form says why, and what can be had instead.

kinematics::kinematics!("robots/singular.yaml");

fn main() {}
