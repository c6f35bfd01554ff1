//! What a robot file becomes before it is written as code.

use crate::arm::CompiledArm;
use crate::mechanism::CompiledMechanism;
use crate::spec::Diagnostic;

/// A robot, compiled but not yet written as code.
#[derive(Clone, Debug)]
pub enum Compiled {
    /// A serial arm.
    Arm(Box<CompiledArm>),
    /// Several chains to one platform.
    Mechanism(Box<CompiledMechanism>),
}

impl Compiled {
    /// What the file has that is odd, and changes nothing of the robot.
    pub fn warnings(&self) -> &[Diagnostic] {
        match self {
            Compiled::Arm(arm) => &arm.model.warnings,
            Compiled::Mechanism(compiled) => &compiled.warnings,
        }
    }

    /// The arm, if it is one.
    pub fn arm(&self) -> Option<&CompiledArm> {
        match self {
            Compiled::Arm(arm) => Some(arm),
            Compiled::Mechanism(_) => None,
        }
    }

    /// The mechanism, if it is one.
    pub fn mechanism(&self) -> Option<&CompiledMechanism> {
        match self {
            Compiled::Arm(_) => None,
            Compiled::Mechanism(mechanism) => Some(mechanism),
        }
    }
}
