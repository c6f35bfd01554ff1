//! The certificate: no inverse kinematics is emitted that was not seen to
//! work.
//!
//! The plan runs on a tape, on random and on structured configurations
//! of the arm as given, and is held against the generic product of
//! exponentials, which shares no code with it: every configuration that made
//! the target must come back (*recovered*), every solution must reach the target
//! (*sound*), and no solution twice. Among the configurations are those in which axes are
//! aligned, and those in which what the plan divides by vanishes.

mod alignment;
mod degenerate;
mod held;
mod near_singular;
mod parameters;
mod recovery;
mod trials;
mod vanishing;

pub use near_singular::NearSingular;
pub(crate) use parameters::SOMEWHERE;
pub use recovery::recovered;
pub use trials::Trials;

use crate::closed_form::{BranchSolution, ClosedForm};
use crate::geometry::SINGULAR;
use crate::threads;
use held::{Held, Made, Trial};
use kin_runtime::Pose;
use recovery::is_among;
use std::fmt;
use std::rc::Rc;

/// Excused configurations that are tried all the same: near a singular one the
/// refinement of a branch costs a hundred times as much.
const EXCUSED: usize = 40;
/// With a larger share of configurations that are excused there is no certificate.
const MOST_EXCUSED: f64 = 0.05;
/// With a larger share of random configurations that do not come back there is none either.
const MOST_LOST: f64 = 0.05;
/// With a larger share of singular ones too little is seen.
const MOST_SINGULAR: f64 = 0.5;

/// A thread solves no more targets before what comes of them is looked at: where one is lost, the rest
/// were in vain.
const TOGETHER: usize = 32;

/// Above this conditioning a configuration is far from singular.
const REGULAR: f64 = 1e-3;

/// What the certificate saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Certificate {
    /// Configurations tried.
    pub configurations: usize,
    /// Of these, singular: answered by a representative.
    pub singular: usize,
    /// Those nearer to singular than an idealized arm's branches can tell: what
    /// is lost there is excused, and of these only some are tried. None if the
    /// arm is exact.
    pub excused: usize,
    /// The share of excused ones among random configurations, 0 to 1.
    pub excused_share: f64,
    /// Singular ones to which no solution was found, and excused ones that did
    /// not come back.
    pub unanswered: usize,
    /// Regular ones that did not come back, with axes aligned that are no
    /// neighbours or nothing to divide by, or came back flagged as singular: a
    /// step of the plan degenerates there, and the arm does not.
    pub lost: usize,
    /// Of these, those that are anywhere, by chance, and did not come back: joints that are coupled
    /// leave a plan nothing to divide by there.
    pub lost_anywhere: usize,
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
    /// A solution does not reach its target.
    Unsound {
        /// The solution.
        q: Vec<f64>,
        /// By how much, metres.
        distance: f64,
    },
    /// One solution came twice.
    Doubled(Vec<f64>),
    /// So large a share of configurations is so near to singular that nothing is promised there.
    NearSingular(f64),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Lost(q) => write!(f, "the configuration {q:.4?} is not among the solutions"),
            Failure::Unsound { q, distance } => write!(
                f,
                "the solution {q:.4?} misses its target by {distance:.1e} m"
            ),
            Failure::Doubled(q) => write!(f, "a solution to the target of {q:.4?} comes twice"),
            Failure::NearSingular(share) => write!(
                f,
                "{:.0} % of random configurations are so near to singular that solutions to their \
                 targets may be missing",
                100.0 * share
            ),
        }
    }
}

/// Runs a closed form against the arm as given. Of configurations where a step
/// may degenerate it may lose so many.
///
/// # Errors
///
/// The first configuration on which it is not sound, loses the configuration
/// or doubles a solution, the one with which too many are lost where no axes are
/// aligned; or that there are too few on which it could.
pub fn certify(trials: &Trials, form: &ClosedForm, losses: usize) -> Result<Certificate, Failure> {
    let excused = form.near_singular();
    let excused_share = trials.share_below(excused);
    let singular_share = trials.share_below(SINGULAR);
    if excused_share > MOST_EXCUSED || singular_share > MOST_SINGULAR {
        return Err(Failure::NearSingular(excused_share.max(singular_share)));
    }
    let mut certificate = Certificate {
        excused_share,
        ..Certificate::default()
    };
    // What was lost before is likely to be lost again, and then the others are not asked.
    let [before, others] = trials.in_order();
    certificate.try_all(trials, form, &before, 1, losses)?;
    certificate.try_all(trials, form, &others, form.side_by_side(), losses)?;
    let own = trials.vanishing(form);
    certificate.try_all(trials, form, &own, form.side_by_side(), losses)?;
    for held in &trials.held {
        let targets = held.elsewhere(trials.target);
        let targets: Vec<Pose> = targets.map(|it| trials.linkage.scalar.target(it)).collect();
        let given = targets.iter().map(|it| (it, &held.parameters[..]));
        let solutions = solved(form, &given.collect::<Vec<_>>());
        for (target, solutions) in targets.iter().zip(solutions) {
            certificate.sound(&Run { trials, held }, target, &solutions)?;
        }
    }
    Ok(certificate)
}

/// The solutions of each target with its parameters.
fn solved(form: &ClosedForm, targets: &[(&Pose, &[f64])]) -> Vec<Vec<BranchSolution>> {
    let shares: Vec<_> = targets.chunks(form.side_by_side()).collect();
    let solved = threads::each(&shares, |share| form.solutions_each(share.iter().copied()));
    solved.into_iter().flatten().collect()
}

/// What solutions are held against.
struct Run<'a> {
    trials: &'a Trials<'a>,
    held: &'a Held,
}

impl Certificate {
    /// Whether so much is lost that relations between axes have to be read otherwise.
    pub(crate) fn loses_much(&self) -> bool {
        4 * self.lost > self.configurations
    }

    /// Tries a closed form on configurations, so many together at first.
    fn try_all(
        &mut self,
        trials: &Trials,
        form: &ClosedForm,
        all: &[(usize, Rc<Trial>)],
        mut together: usize,
        losses: usize,
    ) -> Result<(), Failure> {
        let mut rest = all;
        while !rest.is_empty() {
            let (some, others) = rest.split_at(together.min(rest.len()));
            rest = others;
            let mut tried = Vec::with_capacity(some.len());
            for (held, trial) in some {
                self.configurations += 1;
                let is_excused = trial.conditioning < form.near_singular();
                self.excused += usize::from(is_excused);
                let is_dear = trial.is_attack() || self.excused > EXCUSED;
                if !(is_excused && is_dear) {
                    tried.push((*held, trial, is_excused));
                }
            }
            let targets = tried
                .iter()
                .map(|(_, it, _)| (&it.pose, &it.parameters[..]));
            let solutions = solved(form, &targets.collect::<Vec<_>>());
            together = (2 * together).min(TOGETHER * threads::count());
            for ((held, trial, is_excused), solutions) in tried.into_iter().zip(solutions) {
                let before = self.lost;
                let run = Run {
                    trials,
                    held: &trials.held[held],
                };
                let added = self.add(&run, trial, &solutions, is_excused, losses);
                if added.is_err() || self.lost > before {
                    let mut lost = trials.lost.borrow_mut();
                    if lost.iter().all(|(_, known)| !Rc::ptr_eq(known, trial)) {
                        lost.push((held, trial.clone()));
                    }
                }
                added?;
            }
        }
        Ok(())
    }

    /// All solutions to a target reach it.
    fn sound(
        &mut self,
        run: &Run,
        target: &Pose,
        solutions: &[BranchSolution],
    ) -> Result<(), Failure> {
        let Run { trials, held } = run;
        let size = trials.linkage.size;
        let projection = trials.linkage.projection(trials.target);
        let target = projection.pose(target);
        self.solutions += solutions.len();
        for solution in solutions {
            let found = projection.pose(&held.fk(trials.linkage, &solution.q));
            let distance = trials.target.distance(&found, &target, size);
            self.worst_residual = self.worst_residual.max(distance);
            if distance.is_nan() || distance > trials.linkage.scalar.tolerances().solved * size {
                let q = solution.q.clone();
                return Err(Failure::Unsound { q, distance });
            }
        }
        Ok(())
    }

    /// How many regular targets were lost, then how many singular ones unanswered.
    pub(crate) fn missing(&self) -> (usize, usize) {
        (self.lost, self.unanswered)
    }

    /// Whether nothing was seen to be missing.
    pub fn is_complete(&self) -> bool {
        self.missing() == (0, 0)
    }

    /// What is not promised, in sentences.
    pub fn reservations(&self) -> Vec<String> {
        let excused = (self.excused > 0).then(|| {
            let share = match 100.0 * self.excused_share {
                percent if percent < 0.05 => "Less than 0.1 %".to_owned(),
                percent => format!("{percent:.1} %"),
            };
            format!(
                "{share} of random configurations are so near to singular that a solution to \
                 their targets may be missing."
            )
        });
        let lost = (self.lost > 0).then(|| {
            format!(
                "Where a step degenerates and the arm does not, solutions are lost or flagged as \
                 singular: {} of {} configurations.",
                self.lost, self.configurations
            )
        });
        excused.into_iter().chain(lost).collect()
    }

    fn add(
        &mut self,
        run: &Run,
        trial: &Trial,
        solutions: &[BranchSolution],
        is_excused: bool,
        losses: usize,
    ) -> Result<(), Failure> {
        let Trial {
            q,
            pose,
            conditioning,
            ..
        } = trial;
        let model = &run.held.model;
        self.sound(run, pose, solutions)?;
        if *conditioning < SINGULAR {
            self.singular += 1;
            self.unanswered += usize::from(solutions.is_empty());
            return Ok(());
        }
        self.most_solutions = self.most_solutions.max(solutions.len());
        let flagged = solutions.iter().filter(|solution| solution.singular);
        let linkage = run.trials.linkage;
        let flagged = flagged.map(|solution| solution.by_joints(linkage));
        let flagged: Vec<BranchSolution> = flagged.collect();
        let is_flagged = || {
            let tolerance = 10.0 * model.scalar.tolerances().same;
            is_among(model, &linkage.joints_at(q), &flagged, tolerance)
        };
        match run.held.recovered(linkage, q, solutions, *conditioning) {
            Err(Failure::Lost(_)) if is_excused => self.unanswered += 1,
            Err(Failure::Lost(q)) if trial.may_degenerate && self.lost < losses => {
                self.lost += 1;
                self.lost_anywhere += usize::from(trial.made == Made::Random);
                if self.lost_anywhere as f64 > MOST_LOST * run.trials.random() as f64 {
                    return Err(Failure::Lost(q));
                }
            }
            Err(other) => return Err(other),
            // A double root that is none of the arm has half of its digits.
            Ok(()) if *conditioning > REGULAR && is_flagged() => {
                if self.lost == losses {
                    return Err(Failure::Lost(q.clone()));
                }
                self.lost += 1;
            }
            Ok(()) => {}
        }
        Ok(())
    }
}
