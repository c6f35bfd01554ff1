//! The certificate: no inverse kinematics is emitted that was not seen to
//! work.
//!
//! The plan runs in the interpreter on random and on structured configurations
//! of the literal arm, and is held against the generic product of
//! exponentials, which shares no code with it: every configuration that made
//! the target must come back (*recovered*), every answer must reach the target
//! (*sound*), and no answer twice.

pub(crate) mod configurations;

use crate::geometry::{Linkage, along, cross, dot, size};
use crate::model::Model;
use crate::plan::Target;
use crate::solver::{Answer, ClosedForm};
use configurations::configurations;
use kin_runtime::{Chain, Pose, Twist};
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Answers must reach the target to this, relative to the arm's size.
pub const SOUND: f64 = 1e-9;
/// Below this independence of the Jacobian's columns, a configuration counts
/// as singular: its target may have a family of solutions, and one
/// representative is enough.
pub const SINGULAR: f64 = 1e-5;

/// How far from a singular configuration, in square roots of the relative
/// shift of a snapped arm's tip, the literal arm's solutions may be lost.
pub const BLUR: f64 = 3.0;
/// Columns that are all shorter than this, relative to the arm's size, are
/// rounding.
const NOTHING: f64 = 1e-4;
/// Above this, columns of the Jacobian are independent in general.
const GENERIC: f64 = 1e-9;

/// What the certificate saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Certificate {
    /// Configurations tried.
    pub configurations: usize,
    /// Of these, singular: answered by a representative.
    pub singular: usize,
    /// Singular ones to which no answer was found; on a snapped arm also those
    /// near a singular one that did not come back.
    pub unanswered: usize,
    /// Answers found in all.
    pub answers: usize,
    /// The largest distance of an answer from its target, metres.
    pub worst_residual: f64,
    /// The largest number of answers to one regular target.
    pub most_answers: usize,
}

/// What a plan got wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// No answer is the configuration that made the target.
    Lost(Vec<f64>),
    /// An answer does not reach the target that the configuration made.
    Unsound {
        /// The configuration.
        q: Vec<f64>,
        /// By how much, metres.
        distance: f64,
    },
    /// One answer came twice.
    Doubled(Vec<f64>),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Lost(q) => write!(f, "the configuration {q:.4?} is not among the answers"),
            Failure::Unsound { q, distance } => write!(
                f,
                "an answer to the target of {q:.4?} misses it by {distance:.1e} m"
            ),
            Failure::Doubled(q) => write!(f, "an answer to the target of {q:.4?} comes twice"),
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
    independence: f64,
}

impl<'a> Trials<'a> {
    /// Moves the arm to all the configurations.
    pub fn new(model: &'a Model, linkage: &'a Linkage, target: Target) -> Self {
        let (chain, size) = (chain(model), size(model));
        let trial = |q: Vec<f64>| Trial {
            pose: chain.fk(&q),
            independence: independence(&chain, &q, size, target),
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

/// Runs a closed form against the literal arm.
///
/// # Errors
///
/// The first configuration on which it is not sound, loses the configuration
/// or doubles an answer.
pub fn certify(trials: &Trials, solver: &ClosedForm) -> Result<Certificate, Failure> {
    let size = trials.linkage.size;
    let mut certificate = Certificate::default();
    // Two roots that are nearer than the root of the shift may have met on the
    // snapped arm, or have left each other.
    let blurred = BLUR * (solver.tip_shift / size).sqrt();
    for Trial {
        q,
        pose,
        independence,
    } in &trials.all
    {
        let answers = solver.answers(pose);
        certificate.configurations += 1;
        certificate.answers += answers.len();
        for answer in &answers {
            let found = trials.chain.fk(&answer.q);
            let distance = distance(&found, pose, size, solver.plan.target);
            certificate.worst_residual = certificate.worst_residual.max(distance);
            if distance.is_nan() || distance > SOUND * size {
                return Err(Failure::Unsound {
                    q: q.clone(),
                    distance,
                });
            }
        }
        if *independence < SINGULAR {
            certificate.singular += 1;
            certificate.unanswered += usize::from(answers.is_empty());
            continue;
        }
        certificate.most_answers = certificate.most_answers.max(answers.len());
        match recovered(trials.model, q, &answers, *independence) {
            Err(Failure::Lost(_)) if *independence < blurred => {
                certificate.singular += 1;
                certificate.unanswered += 1;
            }
            other => other?,
        }
    }
    Ok(certificate)
}

/// The configuration is among the answers, to what its conditioning allows,
/// and no answer comes twice.
///
/// # Errors
///
/// Which of the two does not hold.
pub fn recovered(
    model: &Model,
    q: &[f64],
    answers: &[Answer],
    independence: f64,
) -> Result<(), Failure> {
    let tolerance = (1e-11 / independence.powi(2)).clamp(1e-7, 1e-2);
    let same = |a: &[f64], b: &[f64], tolerance: f64| {
        (0..a.len()).all(|i| joint_distance(model, i, a[i], b[i]) < tolerance)
    };
    if !answers.iter().any(|answer| same(&answer.q, q, tolerance)) {
        return Err(Failure::Lost(q.to_vec()));
    }
    for (i, a) in answers.iter().enumerate() {
        if answers[..i].iter().any(|b| same(&a.q, &b.q, 1e-7)) {
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

/// The literal arm as a generic chain; one joint per coordinate.
pub fn chain(model: &Model) -> Chain {
    let twists = model.joints.iter().map(|joint| joint.twist()).collect();
    let links = model.joints.iter().map(|joint| joint.frame).collect();
    Chain::new(twists, model.home).with_links(links)
}

/// What an arm can be asked for: the position of its tip where that alone
/// fixes the joints (a planar 2R arm, the first three joints of a larger one),
/// otherwise the whole pose.
pub fn natural_target(model: &Model) -> Target {
    let chain = chain(model);
    let size = size(model);
    let n = model.joints.len();
    let fixed = |q: &Vec<f64>| independence(&chain, q, size, Target::Position) > GENERIC;
    if n <= 3 && !model.is_coupled() && configurations(model).iter().any(fixed) {
        Target::Position
    } else {
        Target::Pose
    }
}

/// The largest number of independent ways in which the joints move the tip.
pub fn rank(model: &Model) -> usize {
    let chain = chain(model);
    let size = size(model);
    let rank = |q: &Vec<f64>| {
        lengths(&chain, q, size, Target::Pose)
            .iter()
            .filter(|x| **x > GENERIC)
            .count()
    };
    configurations(model)
        .iter()
        .take(8)
        .map(rank)
        .max()
        .unwrap_or(0)
}

/// How far a pose is from a target, as far as the target counts: translation
/// and angle times the arm's size, as the legs of a right triangle. A pose that
/// an arm with a projected target can take has to agree as a whole.
pub fn distance(a: &Pose, b: &Pose, size: f64, target: Target) -> f64 {
    target.distance(a, b, size)
}

/// How independent the columns of the Jacobian are: the shortest that is left
/// when each is made perpendicular to those before it, longest first, relative
/// to the longest. Within a factor of the least singular value.
pub fn independence(chain: &Chain, q: &[f64], size: f64, target: Target) -> f64 {
    lengths(chain, q, size, target)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// The lengths of the Jacobian's columns when each is made perpendicular to
/// those before it, longest first, relative to the longest. Lengths are in
/// units of the arm's size.
fn lengths(chain: &Chain, q: &[f64], size: f64, target: Target) -> Vec<f64> {
    let z = [0, 1, 2].map(|i| chain.fk(q).rotation[i][2]);
    let yaw = chain
        .twists()
        .first()
        .map_or([0.0; 3], |twist| twist.angular);
    let rows = |twist: &Twist| -> Vec<f64> {
        let v = twist.linear.map(|x| x / size);
        let w = twist.angular;
        let about = dot(w, yaw);
        match target {
            Target::Pose => [v, w].concat(),
            Target::Position => v.to_vec(),
            Target::PositionAxis => [v, cross(w, z)].concat(),
            Target::Direction => cross(w, z).to_vec(),
            Target::Orientation => w.to_vec(),
            Target::PositionYaw => [v[0], v[1], v[2], about].to_vec(),
            Target::Planar => {
                let across = along(v, -dot(v, yaw), yaw);
                [across[0], across[1], across[2], about].to_vec()
            }
        }
    };
    let norm = |v: &Vec<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut columns: Vec<Vec<f64>> = chain.geometric_jacobian(q).iter().map(rows).collect();
    let mut lengths: Vec<f64> = Vec::new();
    while !columns.is_empty() {
        columns.sort_by(|a, b| norm(a).total_cmp(&norm(b)));
        let Some(next) = columns.pop() else { break };
        let length = norm(&next);
        lengths.push(length);
        for column in columns.iter_mut().filter(|_| length > 0.0) {
            let along: f64 = column.iter().zip(&next).map(|(x, y)| x * y).sum();
            for (x, y) in column.iter_mut().zip(&next) {
                *x -= along / (length * length) * y;
            }
        }
    }
    let longest = lengths.first().copied().unwrap_or(0.0).max(NOTHING);
    lengths.into_iter().map(|x| x / longest).collect()
}
