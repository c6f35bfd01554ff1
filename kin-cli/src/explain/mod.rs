//! What was found in a robot file and decided about it, in the field's words:
//! the chain, how its axes lie, what was idealized, the plan step by step and
//! its cost; of a mechanism its chains, mobility and actuation. An
//! [`Explanation`] is displayed as text, and serializes to JSON.

mod arm;
mod chain;
mod command;
mod idealization;
mod inverse;
mod mechanism;
mod singular;
mod step;
mod text;

pub use arm::ArmExplanation;
pub use chain::{Chain, FixedFrame, Joint, JointMotion, Mimic};
pub(crate) use command::run;
pub use idealization::{Idealization, Moved};
pub use inverse::{Inverse, KeptJoint, LaneCost, Weighed};
pub use mechanism::{
    Actuation, ForwardExplanation, InverseExplanation, LegExplanation, MechanismExplanation,
    Mobility,
};
pub use singular::{AxesCondition, ConditionKind, Singularities, Singularity};
pub use step::{Object, ObjectKind, Step};

use kin_codegen::spec::Diagnostic;
use kin_codegen::{Compiled, Error, Options, Source, compile};
use serde::Serialize;
use std::fmt;

/// The version of the JSON that [`Explanation`] serializes to. Grows when a
/// field changes its meaning or goes; new fields may come without.
pub const SCHEMA: u32 = 3;

/// All that there is to tell about a robot file.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Explanation {
    /// Of an arm.
    Arm(Box<ArmExplanation>),
    /// Of a parallel mechanism.
    Mechanism(Box<MechanismExplanation>),
}

impl Explanation {
    /// Of an arm, if it is one.
    pub fn arm(self) -> Option<ArmExplanation> {
        match self {
            Explanation::Arm(arm) => Some(*arm),
            Explanation::Mechanism(_) => None,
        }
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Explanation::Arm(arm) => arm.fmt(f),
            Explanation::Mechanism(mechanism) => mechanism.fmt(f),
        }
    }
}

/// What the file has that is odd, and changes nothing of the robot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Warning {
    /// Line and column, from 1; null if it is about the robot as a whole.
    pub at: Option<[u32; 2]>,
    /// What was found.
    pub reason: String,
    /// What to do.
    pub remedy: String,
}

impl Warning {
    fn all(diagnostics: &[Diagnostic]) -> Vec<Self> {
        let warning = |diagnostic: &Diagnostic| Self {
            at: diagnostic.at.map(|at| [at.line, at.column]),
            reason: diagnostic.reason.clone(),
            remedy: diagnostic.remedy.clone(),
        };
        diagnostics.iter().map(warning).collect()
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some([line, column]) = self.at {
            write!(f, "line {line}, column {column}: ")?;
        }
        write!(f, "{}; {}", self.reason, self.remedy)
    }
}

/// The section on warnings, if there are any.
fn write_warnings(warnings: &[Warning], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    if warnings.is_empty() {
        return Ok(());
    }
    writeln!(f, "Warnings")?;
    for warning in warnings {
        writeln!(f, "  {warning}")?;
    }
    writeln!(f)
}

/// Why there is no inverse kinematics, and what to do.
fn write_refusal(
    refusal: &Option<String>,
    remedy: &Option<String>,
    f: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    match refusal {
        Some(reason) => writeln!(f, "  {reason}")?,
        None => writeln!(f, "  not asked for")?,
    }
    match remedy {
        Some(remedy) => writeln!(f, "  help: {remedy}"),
        None => Ok(()),
    }
}

/// Explains a robot file. A robot without a closed form is explained too.
///
/// ```
/// use kin_cli::explain::explain;
/// use kin_codegen::{Options, Source};
/// let text = "
/// robot: planar
/// units: {angle: rad, length: m}
/// screws:
///   - {name: shoulder, axis: [0, 0, 1], point: [0, 0, 0]}
///   - {name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}
/// home: {xyz: [0.9, 0, 0]}
/// ";
/// let source = Source { path: "planar.yaml".into(), text: text.into() };
/// let explanation = explain(&source, &Options::default())?;
/// assert!(explanation.to_string().contains("1, 2 parallel"));
/// let inverse = explanation.arm().unwrap().inverse.unwrap();
/// assert_eq!((inverse.plan.as_str(), inverse.branches), ("SP3(q2) SP1(q1)", 2));
/// # Ok::<(), kin_codegen::Error>(())
/// ```
///
/// # Errors
///
/// What is wrong with the file or the options, or that they do not choose one
/// of several robots. A refusal is none.
pub fn explain(source: &Source, options: &Options) -> Result<Explanation, Error> {
    let (robot, refusal) = match compile(source, options) {
        Ok(robot) => (robot, None),
        Err(Error::Refused(refusal)) => {
            let diagnostic = refusal.diagnostic();
            (refusal.robot, Some(diagnostic))
        }
        Err(error) => return Err(error),
    };
    Ok(match robot {
        Compiled::Arm(arm) => Explanation::Arm(Box::new(ArmExplanation::of(&arm, refusal))),
        Compiled::Mechanism(mechanism) => {
            let explanation = MechanismExplanation::of(&mechanism, refusal);
            Explanation::Mechanism(Box::new(explanation))
        }
    })
}
