//! The short verdict on a robot file.

use crate::explain::Attempt;
use crate::sweep::{Kind, Settings, sweep};
use kin_codegen::geometry::structure;
use kin_codegen::solver::ClosedForm;
use kin_codegen::{Compiled, Diagnostics, Ik, Options, Source};
use serde::Serialize;
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
        /// How its axes lie.
        structure: String,
        /// The plan, branches and worst residual, in short.
        inverse: String,
        /// The comparison with the numerical search, if it was asked for.
        completeness: Option<Completeness>,
        /// The arm, to try more on it.
        compiled: Box<Compiled>,
    },
    /// The file is sound, and the arm has no closed form.
    Refused(String),
    /// The file or the options cannot be used.
    Broken(Diagnostics),
}

/// A closed form held against the numerical search on targets at random.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Completeness {
    /// Targets compared; singular ones are not.
    pub targets: usize,
    /// Their solutions, by the numerical search.
    pub solutions: usize,
    /// Solutions that the closed form lost.
    pub lost: usize,
    /// The configuration that made the target of the first of these.
    pub first: Option<Vec<f64>>,
}

/// Reruns the certificate of a robot file; compares its closed form with the
/// numerical search on `deep` targets as well.
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
/// let Verdict::Solved { completeness, .. } = check(&source, &Options::default(), 5).verdict else {
///     panic!("a planar arm is solved")
/// };
/// assert!(completeness.is_some_and(|it| it.solutions == 10 && it.lost == 0));
/// ```
pub fn check(source: &Source, options: &Options, deep: usize) -> Check {
    let verdict = match Attempt::new(source, options) {
        Err(diagnostics) => Verdict::Broken(diagnostics),
        Ok(Attempt {
            refusal: Some(reason),
            ..
        }) => Verdict::Refused(reason),
        Ok(Attempt { compiled, .. }) => solved(compiled, options, deep),
    };
    Check {
        path: source.path.clone(),
        verdict,
    }
}

fn solved(compiled: Compiled, options: &Options, deep: usize) -> Verdict {
    let inverse = match &compiled.inverse {
        Some(solver) => format!(
            "{}, {} branches, worst residual {:.1e} m",
            solver.plan,
            solver.plan.branches(),
            solver.certificate.worst_residual
        ),
        None if options.ik == Ik::None => "forward kinematics alone".into(),
        None => "no inverse kinematics".into(),
    };
    let comparable = compiled.inverse.as_ref().filter(|_| deep > 0);
    Verdict::Solved {
        structure: structure(&compiled.model),
        inverse,
        completeness: comparable.map(|solver| completeness(&compiled, solver, deep)),
        compiled: Box::new(compiled),
    }
}

fn completeness(compiled: &Compiled, solver: &ClosedForm, targets: usize) -> Completeness {
    let settings = Settings {
        targets,
        oracle: targets,
        ..Settings::default()
    };
    let tally = sweep(&compiled.model, solver, &settings, &|_| {});
    let seen = tally.oracle.unwrap_or_default();
    let missing = |fault: &&crate::sweep::Fault| fault.kind == Kind::Missing;
    Completeness {
        targets: seen.targets,
        solutions: seen.solutions,
        lost: seen.missing.regular + seen.missing.near_singular,
        first: tally
            .faults
            .iter()
            .find(missing)
            .map(|fault| fault.q.clone()),
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.verdict)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Solved {
                structure,
                inverse,
                completeness,
                ..
            } => {
                write!(f, "solved: {inverse}; {structure}")?;
                completeness
                    .iter()
                    .try_for_each(|completeness| write!(f, "; {completeness}"))
            }
            Verdict::Refused(reason) => write!(f, "refused: {reason}"),
            Verdict::Broken(diagnostics) => {
                let first = diagnostics.list.first();
                let reason = first.map_or("", |first| first.reason.as_str());
                match diagnostics.list.len() {
                    0 | 1 => write!(f, "broken: {reason}"),
                    n => write!(f, "broken: {reason} (and {} more)", n - 1),
                }
            }
        }
    }
}

impl fmt::Display for Completeness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            targets,
            solutions,
            lost,
            ..
        } = self;
        match &self.first {
            None => write!(f, "all {solutions} solutions of {targets} targets found"),
            Some(q) => write!(
                f,
                "{lost} of {solutions} solutions of {targets} targets lost, the first to the \
                 target of {q:.6?}"
            ),
        }
    }
}
