//! An arm without a closed form says why, and what can be had instead.

kinematics::kinematics!("robots/general.yaml");

fn main() {}
