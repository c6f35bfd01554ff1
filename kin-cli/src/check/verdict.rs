//! The short verdict on a robot file.

use kin_codegen::arm::CompiledArm;
use kin_codegen::geometry::structure;
use kin_codegen::mechanism::CompiledMechanism;
use kin_codegen::redundancy::Redundancy;
use kin_codegen::solver::Certified;
use kin_codegen::spec::one_line;
use kin_codegen::{Compiled, Diagnostics, Error, Options, Source, compile};
use std::fmt;

/// A robot file and what became of it. Displayed in one line.
#[derive(Clone, Debug)]
pub struct Check {
    /// The robot file, as the user named it.
    pub path: String,
    /// What became of it.
    pub verdict: Verdict,
}

/// What became of a robot file.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// It has a verified closed form, or none was asked for.
    Solved {
        /// How its axes lie; of a mechanism, the structure of its chains.
        structure: String,
        /// The plan, branches and worst residual, in short.
        inverse: String,
        /// The robot, to try more on it.
        robot: Box<Compiled>,
    },
    /// The file is sound, and the robot has no closed form.
    Refused(Diagnostics),
    /// The file is sound, and has several robots.
    Ambiguous(Diagnostics),
    /// The file or the options cannot be used.
    Broken(Diagnostics),
}

/// Reruns the certificate of a robot file.
///
/// ```
/// use kin_cli::check::{Verdict, check};
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
/// let Verdict::Solved { inverse, .. } = check(&source, &Options::default()).verdict else {
///     panic!("a planar arm is solved")
/// };
/// assert!(inverse.contains("2 branches"));
/// ```
pub fn check(source: &Source, options: &Options) -> Check {
    let verdict = match compile(source, options) {
        Err(Error::Broken(diagnostics)) => Verdict::Broken(diagnostics),
        Err(Error::Ambiguous(diagnostics)) => Verdict::Ambiguous(diagnostics),
        Err(Error::Refused(refusal)) => {
            Verdict::Refused(Diagnostics::one(&source.path, refusal.diagnostic()))
        }
        Ok(robot) => Verdict::Solved {
            structure: match &robot {
                Compiled::Arm(arm) => structure(&arm.model),
                Compiled::Mechanism(mechanism) => chains(mechanism),
            },
            inverse: match &robot {
                Compiled::Arm(arm) => of_arm(arm),
                Compiled::Mechanism(mechanism) => of_mechanism(mechanism),
            },
            robot: Box::new(robot),
        },
    };
    Check {
        path: source.path.clone(),
        verdict,
    }
}

const FORWARD_ALONE: &str = "forward kinematics alone";

fn of_arm(arm: &CompiledArm) -> String {
    match &arm.inverse {
        Some(Certified {
            form, certificate, ..
        }) => {
            let branches = form.plan.branches();
            let worst = certificate.worst_residual;
            let free = match &arm.redundancy {
                Some(redundancy) => format!("{} free, ", words(redundancy)),
                None => String::new(),
            };
            let mut line = format!(
                "{free}{}, {branches} branches, worst residual {worst:.1e} m",
                form.plan
            );
            if certificate.excused > 0 {
                line += &format!(", {:.1} % excused", 100.0 * certificate.excused_share);
            }
            if certificate.lost > 0 {
                let all = certificate.configurations;
                line += &format!(
                    ", {} of {all} lost or flagged as singular where a step degenerates",
                    certificate.lost
                );
            }
            if certificate.unanswered > 0 {
                line += &format!(
                    ", {} singular ones without a representative",
                    certificate.unanswered
                );
            }
            line
        }
        None => FORWARD_ALONE.into(),
    }
}

/// `q1`, `q3 and the turn of the tool`.
pub fn words(redundancy: &Redundancy) -> String {
    let joints = redundancy
        .joints
        .iter()
        .map(|joint| format!("q{}", joint + 1));
    let swivel = redundancy.swivel.map(|_| "the swivel angle".to_owned());
    let turn = redundancy.turn.then(|| "the turn of the tool".to_owned());
    let all: Vec<String> = joints.chain(swivel).chain(turn).collect();
    all.join(" and ")
}

fn of_mechanism(mechanism: &CompiledMechanism) -> String {
    match &mechanism.inverse {
        Some(inverse) => format!(
            "{} chains, {} closed configurations recovered",
            inverse.legs.len(),
            inverse.verified
        ),
        None => FORWARD_ALONE.into(),
    }
}

/// `UP*S, UP*S, UP*S`.
fn chains(mechanism: &CompiledMechanism) -> String {
    let legs = mechanism.mechanism.legs.iter();
    let structures: Vec<String> = legs.map(|leg| leg.structure()).collect();
    structures.join(", ")
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", one_line(&self.path), self.verdict)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Solved {
                structure, inverse, ..
            } => write!(f, "solved: {inverse}; {structure}"),
            Verdict::Refused(diagnostics) => write!(f, "refused: {}", diagnostics.first().reason),
            Verdict::Ambiguous(diagnostics) => {
                let reason = diagnostics.first().reason.lines().next();
                write!(f, "ambiguous: {}", reason.unwrap_or_default())
            }
            Verdict::Broken(diagnostics) => {
                write!(f, "broken: {}", diagnostics.first().reason)?;
                match diagnostics.len() {
                    1 => Ok(()),
                    n => write!(f, " (and {} more)", n - 1),
                }
            }
        }
    }
}
