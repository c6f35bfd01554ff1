//! Random configurations and targets.

use kinematics::{Kinematics, Pose};
use std::f64::consts::PI;

/// Their configurations take 200 kB, their poses 400 kB.
const COUNT: usize = 4096;

/// The same numbers on every run: a xorshift generator.
pub struct Random(u64);

impl Default for Random {
    fn default() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }
}

impl Random {
    /// From 0 to 1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Configurations drawn from the whole turn of every joint.
pub fn configurations() -> Vec<[f64; 6]> {
    let mut random = Random::default();
    let mut angle = || (random.unit() * 2.0 - 1.0) * PI;
    (0..COUNT)
        .map(|_| std::array::from_fn(|_| angle()))
        .collect()
}

/// The poses of a robot at these configurations.
pub fn targets(robot: &impl Kinematics<6>) -> Vec<Pose> {
    configurations().iter().map(|q| robot.fk(q)).collect()
}
