//! The certificate: no inverse kinematics is emitted that was not seen to
//! work.
//!
//! The plan runs in the interpreter on random and on structured configurations
//! of the arm as given, and is held against the generic product of
//! exponentials, which shares no code with it: every configuration that made
//! the target must come back (*recovered*), every solution must reach the target
//! (*sound*), and no solution twice.

use crate::closed_form::{BranchSolution, ClosedForm, TOLERANCE};
use crate::geometry::{Linkage, conditioning, size};
use crate::model::{Model, configurations};
use crate::plan::Target;
use kin_runtime::{Chain, Pose};
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Below this conditioning of the Jacobian a configuration counts as singular:
/// its target may have a family of solutions, and one representative is enough.
pub const SINGULAR: f64 = 1e-5;

/// What the certificate saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Certificate {
    /// Configurations tried.
    pub configurations: usize,
    /// Of these, singular: answered by a representative.
    pub singular: usize,
    /// Singular ones to which no solution was found; on a idealized arm also those
    /// near a singular one that did not come back.
    pub unanswered: usize,
    /// Solutions found in all.
    pub solutions: usize,
    /// The largest distance of a solution from its target, metres.
    pub worst_residual: f64,
    /// The largest number of solutions to one regular target.
    pub most_solutions: usize,
}

/// What a plan got wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// No solution is the configuration that made the target.
    Lost(Vec<f64>),
    /// A solution does not reach the target that the configuration made.
    Unsound {
        /// The configuration.
        q: Vec<f64>,
        /// By how much, metres.
        distance: f64,
    },
    /// One solution came twice.
    Doubled(Vec<f64>),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Lost(q) => write!(f, "the configuration {q:.4?} is not among the solutions"),
            Failure::Unsound { q, distance } => write!(
                f,
                "a solution to the target of {q:.4?} misses it by {distance:.1e} m"
            ),
            Failure::Doubled(q) => write!(f, "a solution to the target of {q:.4?} comes twice"),
        }
    }
}

/// The configurations to try on an arm, with the targets that they make.
pub struct Trials<'a> {
    model: &'a Model,
    linkage: &'a Linkage,
    chain: Chain,
    all: Vec<Trial>,
}

struct Trial {
    q: Vec<f64>,
    pose: Pose,
    /// How far from singular.
    conditioning: f64,
}

impl<'a> Trials<'a> {
    /// Moves the arm to all the configurations.
    pub fn new(model: &'a Model, linkage: &'a Linkage, target: Target) -> Self {
        let (chain, size) = (model.chain(), size(model));
        let trial = |q: Vec<f64>| Trial {
            pose: chain.fk(&q),
            conditioning: conditioning(&chain, &q, size, target),
            q,
        };
        let all = configurations(model).into_iter().map(trial).collect();
        Self {
            model,
            linkage,
            chain,
            all,
        }
    }

    /// The arm as the file has it.
    pub fn model(&self) -> &Model {
        self.model
    }

    /// Its frames.
    pub fn linkage(&self) -> &Linkage {
        self.linkage
    }
}

/// Runs a closed form against the arm as given.
///
/// # Errors
///
/// The first configuration on which it is not sound, loses the configuration
/// or doubles a solution.
pub fn certify(trials: &Trials, form: &ClosedForm) -> Result<Certificate, Failure> {
    let size = trials.linkage.size;
    let mut certificate = Certificate::default();
    let excused = form.near_singular();
    for Trial {
        q,
        pose,
        conditioning,
    } in &trials.all
    {
        let solutions = form.solutions(pose);
        certificate.configurations += 1;
        certificate.solutions += solutions.len();
        for solution in &solutions {
            let found = trials.chain.fk(&solution.q);
            let distance = form.plan.target.distance(&found, pose, size);
            certificate.worst_residual = certificate.worst_residual.max(distance);
            if distance.is_nan() || distance > TOLERANCE * size {
                return Err(Failure::Unsound {
                    q: q.clone(),
                    distance,
                });
            }
        }
        if *conditioning < SINGULAR {
            certificate.singular += 1;
            certificate.unanswered += usize::from(solutions.is_empty());
            continue;
        }
        certificate.most_solutions = certificate.most_solutions.max(solutions.len());
        match recovered(trials.model, q, &solutions, *conditioning) {
            Err(Failure::Lost(_)) if *conditioning < excused => {
                certificate.singular += 1;
                certificate.unanswered += 1;
            }
            other => other?,
        }
    }
    Ok(certificate)
}

/// The configuration is among the solutions, to what its conditioning allows,
/// and no solution comes twice.
///
/// # Errors
///
/// Which of the two does not hold.
pub fn recovered(
    model: &Model,
    q: &[f64],
    solutions: &[BranchSolution],
    conditioning: f64,
) -> Result<(), Failure> {
    let tolerance = (1e-11 / conditioning.powi(2)).clamp(1e-7, 1e-2);
    let same = |a: &[f64], b: &[f64], tolerance: f64| {
        (0..a.len()).all(|i| joint_distance(model, i, a[i], b[i]) < tolerance)
    };
    if !solutions
        .iter()
        .any(|solution| same(&solution.q, q, tolerance))
    {
        return Err(Failure::Lost(q.to_vec()));
    }
    for (i, a) in solutions.iter().enumerate() {
        if solutions[..i].iter().any(|b| same(&a.q, &b.q, 1e-7)) {
            return Err(Failure::Doubled(q.to_vec()));
        }
    }
    Ok(())
}

/// The difference of two values of a coordinate, modulo 2π where it turns.
fn joint_distance(model: &Model, variable: usize, a: f64, b: f64) -> f64 {
    let d = (a - b).abs();
    if model.turns(variable) {
        let d = d % TAU;
        if d > PI { TAU - d } else { d }
    } else {
        d
    }
}
