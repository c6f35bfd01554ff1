//! The short verdict on a robot file.

use super::{Attempt, structure};
use crate::compiler::Compiled;
use crate::options::{Ik, Options};
use crate::plan::Target;
use crate::solver::ClosedForm;
use crate::spec::{Diagnostics, Source};
use crate::verify::chain;
use kin_runtime::{Chain, Goal, SearchOptions, math::wrap};
use std::f64::consts::PI;
use std::fmt;

/// Targets with a solution worse conditioned than this are left out: there
/// the numerical search itself may miss solutions.
const REGULAR: f64 = 1e-4;
/// Two configurations are the same if no joint differs by more.
const SAME: f64 = 1e-5;

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
    },
    /// The file is sound, and the arm has no closed form.
    Refused(String),
    /// The file or the options cannot be used.
    Broken(Diagnostics),
}

/// A closed form held against the numerical search on targets at random.
#[derive(Clone, Debug, PartialEq)]
pub struct Completeness {
    /// Targets compared; singular ones are not.
    pub targets: usize,
    /// Their solutions, by the numerical search.
    pub solutions: usize,
    /// Solutions that the closed form lost.
    pub lost: Vec<Vec<f64>>,
}

/// Reruns the certificate of a robot file; compares its closed form with the
/// numerical search on `deep` targets as well.
///
/// ```
/// use kin_codegen::{Options, Source, explain::{Verdict, check}};
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
/// assert!(completeness.is_some_and(|it| it.solutions == 10 && it.lost.is_empty()));
/// ```
pub fn check(source: &Source, options: &Options, deep: usize) -> Check {
    let verdict = match Attempt::new(source, options) {
        Err(diagnostics) => Verdict::Broken(diagnostics),
        Ok(Attempt {
            refusal: Some(reason),
            ..
        }) => Verdict::Refused(reason),
        Ok(Attempt { compiled, .. }) => solved(&compiled, options, deep),
    };
    Check {
        path: source.path.clone(),
        verdict,
    }
}

fn solved(compiled: &Compiled, options: &Options, deep: usize) -> Verdict {
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
        completeness: comparable.map(|solver| completeness(compiled, solver, deep)),
    }
}

fn completeness(compiled: &Compiled, solver: &ClosedForm, targets: usize) -> Completeness {
    let literal = chain(&compiled.model);
    let options = SearchOptions {
        goal: match solver.plan.target {
            Target::Position => Goal::Position,
            // Of what a part of the pose leaves open, the whole pose is a part.
            _ => Goal::Pose,
        },
        ..SearchOptions::default()
    };
    let mut seen = Completeness {
        targets: 0,
        solutions: 0,
        lost: Vec::new(),
    };
    for k in 1..=targets {
        seen.compare(compiled, solver, &literal, &options, k);
    }
    seen
}

impl Completeness {
    fn compare(
        &mut self,
        compiled: &Compiled,
        solver: &ClosedForm,
        literal: &Chain,
        options: &SearchOptions,
        k: usize,
    ) {
        let target = literal.fk(&scattered(compiled, k));
        let found = literal.ik_all(&target, options);
        if found.iter().any(|found| found.conditioning < REGULAR) {
            return;
        }
        let answers = solver.answers(&target);
        self.targets += 1;
        self.solutions += found.len();
        let lost = found
            .into_iter()
            .map(|found| found.q)
            .filter(|q| !answers.iter().any(|answer| same(compiled, &answer.q, q)));
        self.lost.extend(lost);
    }
}

/// The k-th of a row of configurations that fills the joint space: multiples
/// of the square roots of primes are spread evenly modulo 1.
fn scattered(compiled: &Compiled, k: usize) -> Vec<f64> {
    const PRIMES: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];
    let model = &compiled.model;
    let place = |i: usize| {
        let unit =
            (k as f64 * (PRIMES[i % PRIMES.len()] + (i / PRIMES.len()) as f64).sqrt()).fract();
        let [lower, upper] = match model.variables[i].limits {
            Some(limits) if !model.turns(i) => limits,
            _ if model.turns(i) => [-PI, PI],
            _ => [-0.5, 0.5],
        };
        lower + unit * (upper - lower)
    };
    (0..model.variables.len()).map(place).collect()
}

fn same(compiled: &Compiled, a: &[f64], b: &[f64]) -> bool {
    let apart = |i: usize| match compiled.model.turns(i) {
        true => wrap(a[i] - b[i]).abs(),
        false => (a[i] - b[i]).abs(),
    };
    (0..a.len()).all(|i| apart(i) < SAME)
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
            targets, solutions, ..
        } = self;
        match &self.lost[..] {
            [] => write!(f, "all {solutions} solutions of {targets} targets found"),
            lost => write!(
                f,
                "{} of {solutions} solutions of {targets} targets lost, the first at {:.6?}",
                lost.len(),
                lost[0]
            ),
        }
    }
}
