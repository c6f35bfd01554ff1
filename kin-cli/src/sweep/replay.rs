//! One configuration in full.

use super::case::{Case, Outcome};
use super::oracle::{as_solution, search};
use super::{Settings, Tally};
use kin_codegen::closed_form::{BranchSolution, ClosedForm};
use kin_codegen::model::Model;
use serde::Serialize;

/// One configuration, its target, what the closed form and what the numerical search finds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replay {
    /// The configuration.
    pub q: Vec<f64>,
    /// The rotation of its target.
    pub rotation: [[f64; 3]; 3],
    /// The translation of its target, metres.
    pub translation: [f64; 3],
    /// The conditioning of its Jacobian, 1 at best.
    pub conditioning: f64,
    /// Whether that is near singular, see [`Tally::near_singular_below`].
    pub near_singular: bool,
    /// What the closed form finds.
    pub solutions: Vec<FormSolution>,
    /// What the numerical search finds.
    pub found: Vec<Found>,
    /// The verdict, as a sweep of this one target.
    pub tally: Tally,
}

/// A solution of the closed form.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FormSolution {
    /// The configuration.
    pub q: Vec<f64>,
    /// Its distance from the target by the generic forward kinematics, metres.
    pub residual: f64,
    /// Its branch.
    pub branch: u32,
    /// Whether the closed form says that it is one of a family or a double
    /// root.
    pub singular: bool,
    /// The conditioning of its Jacobian.
    pub conditioning: f64,
    /// Whether it is the configuration that made the target.
    pub is_q: bool,
    /// Which of the solutions it is, from 0.
    pub found: Option<usize>,
}

/// A solution of the numerical search.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// The configuration.
    pub q: Vec<f64>,
    /// Its distance from the target, metres.
    pub residual: f64,
    /// The conditioning of its Jacobian.
    pub conditioning: f64,
    /// Which of the solutions it is, from 0.
    pub solution: Option<usize>,
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
    /// let form = arm.form().unwrap();
    /// let replay = Replay::new(&arm.model, form, &[0.3, 0.8]).unwrap();
    /// assert_eq!((replay.solutions.len(), replay.found.len()), (2, 2));
    /// assert_eq!(replay.solutions.iter().filter(|solution| solution.is_q).count(), 1);
    /// # Ok::<(), kin_codegen::Error>(())
    /// ```
    pub fn new(model: &Model, form: &ClosedForm, q: &[f64]) -> Option<Self> {
        if q.len() != model.variables.len() || q.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let case = Case::new(model, form);
        let outcome = case.run(q.to_vec());
        let settings = Settings {
            targets: 1,
            oracle: 1,
            ..Settings::default()
        };
        let mut tally = Tally::new(&case, &settings);
        tally.count(&case, &outcome, 0);
        tally.compare(&case, &outcome, 0);
        let found = search(&case, &outcome);
        let searched: Vec<BranchSolution> = found.iter().map(as_solution).collect();
        Some(Replay {
            rotation: outcome.target.rotation,
            translation: outcome.target.translation,
            conditioning: outcome.conditioning,
            near_singular: outcome.conditioning < case.near_singular,
            solutions: form_solutions(&case, &outcome, &searched),
            found: searched
                .iter()
                .map(|found| Found {
                    q: found.q.clone(),
                    residual: found.residual,
                    conditioning: case.conditioning(&found.q),
                    solution: case.index(found, &outcome.solutions),
                })
                .collect(),
            q: outcome.q,
            tally,
        })
    }
}

fn form_solutions(
    case: &Case,
    outcome: &Outcome,
    searched: &[BranchSolution],
) -> Vec<FormSolution> {
    let solutions = outcome.solutions.iter().zip(&outcome.residuals);
    solutions
        .map(|(solution, &residual)| {
            let own = std::slice::from_ref(solution);
            FormSolution {
                q: solution.q.clone(),
                residual,
                branch: solution.branch,
                singular: solution.singular,
                conditioning: case.conditioning(&solution.q),
                is_q: case.is_among(&outcome.q, own, outcome.conditioning),
                found: case.index(solution, searched),
            }
        })
        .collect()
}

impl Case<'_> {
    /// Which of the others a solution is.
    fn index(&self, solution: &BranchSolution, others: &[BranchSolution]) -> Option<usize> {
        let conditioning = self.conditioning(&solution.q);
        let same = |other: &BranchSolution| {
            self.is_among(&solution.q, std::slice::from_ref(other), conditioning)
        };
        others.iter().position(same)
    }
}
