//! One configuration in full.

use super::oracle::{as_answer, search};
use super::subject::{Seen, Subject};
use super::{Settings, Tally};
use kin_codegen::model::Model;
use kin_codegen::solver::{Answer, ClosedForm};
use serde::Serialize;

/// One configuration, its target, what the closed form answers and what the
/// numerical search finds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replay {
    /// The configuration.
    pub q: Vec<f64>,
    /// The rotation of its target.
    pub rotation: [[f64; 3]; 3],
    /// The translation of its target, metres.
    pub translation: [f64; 3],
    /// How independent the columns of its Jacobian are, 1 at best.
    pub independence: f64,
    /// Whether that is near singular, see [`Tally::near_singular_below`].
    pub near_singular: bool,
    /// What the closed form answers.
    pub answers: Vec<Answered>,
    /// What the numerical search finds.
    pub solutions: Vec<Found>,
    /// The verdict, as a sweep of this one target.
    pub tally: Tally,
}

/// An answer of the closed form.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answered {
    /// The configuration.
    pub q: Vec<f64>,
    /// Its distance from the target by the generic forward kinematics, metres.
    pub residual: f64,
    /// Its branch.
    pub branch: u32,
    /// Whether the closed form says that it is one of a family or a double
    /// root.
    pub singular: bool,
    /// How independent the columns of its Jacobian are.
    pub independence: f64,
    /// Whether it is the configuration that made the target.
    pub is_q: bool,
    /// Which of the solutions it is, from 0.
    pub solution: Option<usize>,
}

/// A solution of the numerical search.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// The configuration.
    pub q: Vec<f64>,
    /// Its distance from the target, metres.
    pub residual: f64,
    /// How independent the columns of its Jacobian are.
    pub independence: f64,
    /// Which of the answers it is, from 0.
    pub answer: Option<usize>,
}

impl Replay {
    /// Runs the closed form and the search on the target of a configuration.
    /// `q` has one finite value for each coordinate of the arm, radians or
    /// metres; otherwise there is nothing to run.
    ///
    /// ```
    /// use kin_cli::sweep::Replay;
    /// use kin_codegen::{Options, Source, compile};
    /// let text = "
    /// robot: planar
    /// units: {angle: rad, length: m}
    /// screws:
    ///   - {name: shoulder, axis: [0, 0, 1], point: [0, 0, 0]}
    ///   - {name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}
    /// home: {xyz: [0.9, 0, 0]}
    /// ";
    /// let source = Source { path: "planar.yaml".into(), text: text.into() };
    /// let compiled = compile(&source, &Options::default())?;
    /// let arm = compiled.arm().unwrap();
    /// let form = arm.inverse.as_ref().unwrap();
    /// let replay = Replay::new(&arm.model, form, &[0.3, 0.8]).unwrap();
    /// assert_eq!((replay.answers.len(), replay.solutions.len()), (2, 2));
    /// assert_eq!(replay.answers.iter().filter(|answer| answer.is_q).count(), 1);
    /// # Ok::<(), kin_codegen::Error>(())
    /// ```
    pub fn new(model: &Model, form: &ClosedForm, q: &[f64]) -> Option<Self> {
        if q.len() != model.variables.len() || q.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let subject = Subject::new(model, form);
        let seen = subject.look(q.to_vec());
        let settings = Settings {
            targets: 1,
            oracle: 1,
            ..Settings::default()
        };
        let mut tally = Tally::new(&subject, &settings);
        tally.count(&subject, &seen, 0);
        tally.compare(&subject, &seen, 0);
        let found = search(&subject, &seen);
        let solutions: Vec<Answer> = found.iter().map(as_answer).collect();
        Some(Replay {
            rotation: seen.target.rotation,
            translation: seen.target.translation,
            independence: seen.independence,
            near_singular: seen.independence < subject.near_singular,
            answers: answered(&subject, &seen, &solutions),
            solutions: solutions
                .iter()
                .map(|solution| Found {
                    q: solution.q.clone(),
                    residual: solution.residual,
                    independence: subject.independence(&solution.q),
                    answer: subject.place(solution, &seen.answers),
                })
                .collect(),
            q: seen.q,
            tally,
        })
    }
}

fn answered(subject: &Subject, seen: &Seen, solutions: &[Answer]) -> Vec<Answered> {
    let answers = seen.answers.iter().zip(&seen.residuals);
    answers
        .map(|(answer, &residual)| {
            let own = std::slice::from_ref(answer);
            Answered {
                q: answer.q.clone(),
                residual,
                branch: answer.branch,
                singular: answer.singular,
                independence: subject.independence(&answer.q),
                is_q: subject.is_among(&seen.q, own, seen.independence),
                solution: subject.place(answer, solutions),
            }
        })
        .collect()
}

impl Subject<'_> {
    /// Which of the others an answer is.
    fn place(&self, answer: &Answer, others: &[Answer]) -> Option<usize> {
        let independence = self.independence(&answer.q);
        let same =
            |other: &Answer| self.is_among(&answer.q, std::slice::from_ref(other), independence);
        others.iter().position(same)
    }
}
