//! The whole way from a robot file to verified expressions.

use crate::arm::{self, CompiledArm};
use crate::compiled::Compiled;
use crate::error::Error;
use crate::found::{Entry, Found};
use crate::mechanism;
use crate::options::Options;
use crate::refusal::{Reason, Refusal};
use crate::spec::{Diagnostics, Source, Spec};
use kin_runtime::__private::reproducible::reproducibly;
use std::path::Path;

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
    compile_found(source, options, None)
}

/// The same with a folder of what was found for robots before, by this version of the crate: for
/// one of these nothing is searched for or certified again. What it has for another text or other
/// options, what is damaged, and what was certified as other expressions than this build writes for
/// it is not used. Where it cannot be written, nothing is kept.
///
/// Whoever can write that folder decides what a robot answers.
///
/// # Errors
///
/// As [`compile`].
pub fn compile_cached(
    source: &Source,
    options: &Options,
    folder: &Path,
) -> Result<Compiled, Error> {
    let entry = Entry::new(folder, source, options);
    let before = entry.read();
    let compiled = compile_found(source, options, before.as_ref())?;
    let found = compiled.arm().and_then(CompiledArm::found);
    if let Some(found) = found.filter(|found| before.as_ref() != Some(found)) {
        // A robot that is not kept is a robot.
        let _ = entry.write(&found);
    }
    Ok(compiled)
}

fn compile_found(
    source: &Source,
    options: &Options,
    found: Option<&Found>,
) -> Result<Compiled, Error> {
    let (robot, reason) = reproducibly(|| robot(&Spec::parse(source)?, options, found))?;
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
fn robot(
    spec: &Spec,
    options: &Options,
    found: Option<&Found>,
) -> Result<(Compiled, Option<Reason>), Diagnostics> {
    Ok(match spec {
        Spec::Arm(spec) => {
            let (arm, refused) = arm::compile(spec, options, found)?;
            (Compiled::Arm(Box::new(arm)), refused.map(Reason::Arm))
        }
        Spec::Mechanism(spec) => {
            let (mechanism, refused) = mechanism::compile(spec, options)?;
            let robot = Compiled::Mechanism(Box::new(mechanism));
            (robot, refused.map(Reason::Chain))
        }
    })
}
