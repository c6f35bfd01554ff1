//! Targets of several arms with a joint to spare, at the same places of a table.

use crate::contest::Input;
use crate::inputs::configurations;
use kinematics::{Kinematics, Pose};

/// A target for each of some arms, and the value of the joint that is given.
#[derive(Clone, Copy)]
pub struct Given<const A: usize> {
    /// By arm.
    pub targets: [Pose; A],
    /// Radians.
    pub parameter: f64,
}

impl<const A: usize> Input for Given<A> {
    fn nudged(&self, by: f64) -> Self {
        Self {
            targets: self.targets.map(|target| target.nudged(by)),
            ..*self
        }
    }
}

/// The configurations of six joints with a seventh, and the angle that it has.
pub fn seven() -> Vec<([f64; 7], f64)> {
    let all = configurations();
    let last = all.iter().rev().map(|q| q[0]);
    let seven = |(q, last): (&[f64; 6], f64)| {
        (
            std::array::from_fn(|i| if i < 6 { q[i] } else { last }),
            last,
        )
    };
    all.iter().zip(last).map(seven).collect()
}

/// The pose of an arm of six joints at the first six of these.
pub fn of_six(arm: &impl Kinematics<6>, q: &[f64; 7]) -> Pose {
    arm.fk(&std::array::from_fn(|i| q[i]))
}
