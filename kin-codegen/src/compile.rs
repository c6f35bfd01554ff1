//! The whole way from a robot file to verified expressions.

use crate::arm::{self, CompiledArm};
use crate::error::Error;
use crate::mechanism::{self, CompiledMechanism};
use crate::options::Options;
use crate::spec::{Source, Spec};

/// A robot, compiled but not yet written as Rust.
#[derive(Clone, Debug)]
pub enum Compiled {
    /// A serial arm.
    Arm(Box<CompiledArm>),
    /// Several chains to one platform.
    Mechanism(Box<CompiledMechanism>),
}

impl Compiled {
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

/// Reads a robot file and compiles it.
///
/// ```
/// use kin_codegen::{Options, Source, compile};
/// let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
/// let compiled = compile(&Source::read("robots/ur5e.urdf", root)?, &Options::default())?;
/// assert_eq!(compiled.arm().unwrap().branches(), 8);
/// # Ok::<(), kin_codegen::Error>(())
/// ```
///
/// # Errors
///
/// What is wrong with the file or the options, or why the robot has no closed
/// form.
pub fn compile(source: &Source, options: &Options) -> Result<Compiled, Error> {
    match Spec::parse(source)? {
        Spec::Arm(spec) => arm::compile(&spec, options),
        Spec::Mechanism(spec) => mechanism::compile(&spec, options),
    }
}
