//! Arms with one joint more than their targets have coordinates.

use crate::{Kinematics, Pose, Solutions};

/// What an arm is given beside a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// The value of a joint, by its place from 0; radians, and metres of a prismatic
    /// one.
    Joint(usize),
    /// The turn of the tool about the tip's z axis from where the target has it, radians.
    Turn,
}

/// The inverse kinematics of an arm with one joint more than its targets have
/// coordinates: seven for whole poses, or six where the tool may turn. One number beside
/// the target, the parameter, leaves isolated solutions.
///
/// The parameter is the value of a joint, or the turn of the tool; generated robots tell
/// which.
pub trait RedundantKinematics<const N: usize>: Kinematics<N> {
    /// What the parameter is.
    const PARAMETER: Parameter;
    /// How many branches [`RedundantKinematics::ik_at`] looks at.
    const BRANCHES_AT: usize;

    /// All configurations with this parameter that put the tip at the target, as far as
    /// the target counts: every isolated one once, and none if the target is out of
    /// reach.
    fn ik_at(&self, target: &Pose, parameter: f64) -> Solutions<N>;

    /// The parameter of a configuration that puts the tip at the target.
    fn parameter_of(&self, target: &Pose, q: &[f64; N]) -> f64 {
        match Self::PARAMETER {
            Parameter::Joint(joint) => q[joint],
            Parameter::Turn => target.turn_to(&self.fk(q)),
        }
    }
}
