//! Random configurations and targets.

use kinematics::{Kinematics, Pose};
use std::f64::consts::PI;

/// Their configurations take 200 kB, their poses 400 kB.
const COUNT: usize = 4096;

/// Configurations drawn from the whole turn of every joint.
pub fn configurations() -> Vec<[f64; 6]> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut angle = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        ((state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0) * PI
    };
    (0..COUNT)
        .map(|_| std::array::from_fn(|_| angle()))
        .collect()
}

/// The poses of a robot at these configurations.
pub fn targets(robot: &impl Kinematics<6>) -> Vec<Pose> {
    configurations().iter().map(|q| robot.fk(q)).collect()
}
