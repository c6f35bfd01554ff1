//! The whole way from a robot file to verified expressions.

use crate::arm;
use crate::compiled::Compiled;
use crate::error::Error;
use crate::mechanism;
use crate::options::Options;
use crate::refusal::{Reason, Refusal};
use crate::spec::{Diagnostics, Source, Spec};
use kin_runtime::__private::univariate::reproducibly;

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
    let (robot, reason) = reproducibly(|| robot(&Spec::parse(source)?, options))?;
    if options.strict
        && let Some(warnings) = Diagnostics::of(&source.path, robot.warnings().to_vec())
    {
        return Err(Error::Broken(warnings.into_errors()));
    }
    match reason {
        None => Ok(robot),
        Some(reason) => Err(Error::Refused(Box::new(Refusal {
            robot,
            reason,
            source: source.clone(),
        }))),
    }
}

/// A robot with all that was found, and why it has no closed form.
fn robot(spec: &Spec, options: &Options) -> Result<(Compiled, Option<Reason>), Diagnostics> {
    Ok(match spec {
        Spec::Arm(spec) => {
            let (arm, refused) = arm::compile(spec, options)?;
            (Compiled::Arm(Box::new(arm)), refused.map(Reason::Arm))
        }
        Spec::Mechanism(spec) => {
            let (mechanism, refused) = mechanism::compile(spec, options)?;
            let robot = Compiled::Mechanism(Box::new(mechanism));
            (robot, refused.map(Reason::Chain))
        }
    })
}
