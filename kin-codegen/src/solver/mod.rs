//! The search for a closed form: relations are read into the axes with growing
//! tolerance, and the plans for them certified, until one stands.

mod beside;
mod last_resort;
mod search;

use crate::certificate::{Certificate, Failure, SOMEWHERE, Trials};
use crate::closed_form::{ClosedForm, Inverse, tip_shift};
use crate::geometry::{
    Linkage, NOISIEST, PairRelation, Undetermined, angle, axes, coupled_rank, idealizations, rank,
    relate, uncoupled,
};
use crate::model::{Joint, JointKind, Model};
use crate::plan::Target;
use beside::completed;
use last_resort::last_resort;
pub(crate) use search::COMPARED;
use search::{Patience, solve_idealized};

/// Plans tried at one tolerance before the next: the cheap ones of an arm with
/// aligned or meeting axes may degenerate where the arm does not.
const PLANS: usize = 200;
/// The same of an arm that a polynomial solves already, but for a few targets.
const INSTEAD: usize = 8;
/// So many choices of eliminations are tried of an arm that is solved by them.
const CHOICES: usize = 6;
/// An arm whose tip is this far from that of one with exact relations, relative to
/// its size, was designed so: it is no noise, and solved without them if it can be.
pub(crate) const DESIGNED: f64 = 1e-2;
/// Axes that differ by less are parallel, radians.
const PARALLEL: f64 = 1e-11;

/// Why a chain whose joints mimic each other is not solved.
#[derive(Clone, Debug, PartialEq)]
pub enum Coupled {
    /// The coordinates do not follow from the values of its joints.
    Undetermined(Undetermined),
    /// More joints than targets have coordinates, neighbours about one line taken as one.
    Joints {
        /// How many.
        joints: usize,
        /// What of targets counts.
        target: Target,
    },
    /// With joints that stay free, but for those in front of all that mimic or are mimicked.
    Redundant,
    /// A slide, by name, that moves others along it, and is not among the joints that stay free.
    Geared(String),
    /// As a chain whose joints move by themselves it is not solved.
    Unsolved(Box<NoClosedForm>),
}

impl From<Undetermined> for Coupled {
    fn from(undetermined: Undetermined) -> Self {
        Self::Undetermined(undetermined)
    }
}

/// A closed form that was seen to work.
#[derive(Clone, Debug)]
pub struct Certified {
    /// The closed form.
    pub form: ClosedForm,
    /// What was seen when it was run.
    pub certificate: Certificate,
}

/// What single precision lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lack {
    /// Refinement onto an arm that is off the one that is solved.
    Refinement,
    /// The elimination of all joints but one.
    Polynomial,
    /// The roots of quartics.
    Quartic,
    /// Numbers that are given beside a target.
    Parameter,
    /// Enough digits for its steps.
    Digits,
}

/// Why an arm has none.
#[derive(Clone, Debug, PartialEq)]
pub enum NoClosedForm {
    /// What it is solved by is there in double precision alone.
    OnlyInDouble(Lack),
    /// Joints that mimic others couple the chain.
    Mimic(Coupled),
    /// The joints are never independent: the chain is singular in every
    /// configuration.
    Singular {
        /// In how many independent ways they change targets at most.
        rank: usize,
        /// What of targets counts.
        target: Target,
        /// Two neighbours that turn about one line, or slide along one direction, by name.
        alike: Option<([String; 2], JointKind)>,
    },
    /// More joints than the target has coordinates.
    Redundant(Target),
    /// The others are not solved when these joints stay free, the first choice if none was
    /// asked for.
    Free {
        /// Their names.
        joints: Vec<String>,
        /// Why.
        reason: Box<NoClosedForm>,
    },
    /// The search found no sequence of subproblems for targets of this kind.
    NoPlan(Target),
    /// The axes are off exact relations, and joints are given beside a target that is projected
    /// to what the exact arm can choose.
    Noisy,
    /// A target of this kind is projected to what arms can choose whose axes are all parallel.
    Tilted {
        /// What of targets counts.
        target: Target,
        /// The first joint that turns, and one that turns about another direction, by name.
        joints: [String; 2],
        /// The angle between them, radians.
        angle: f64,
    },
    /// A target of this kind has a turn, and no joint turns.
    Unturned(Target),
    /// A slide that is solved for lifts the tip along the axes about which an arm with planar targets
    /// turns, which leave the height open.
    Lifting {
        /// The slide, by name.
        joint: String,
        /// How far it is from going across the axes, radians.
        angle: f64,
    },
    /// The best plan failed its certificate.
    Uncertified {
        /// The plan, in short.
        plan: String,
        /// What it got wrong.
        failure: Failure,
    },
}

/// Finds and verifies a closed form; the joints that the linkage has locked are given
/// with the target.
///
/// # Errors
///
/// Why there is none.
pub fn solve(model: &Model, linkage: &Linkage, target: Target) -> Result<Certified, NoClosedForm> {
    if model.is_coupled() {
        return solve_coupled(model, target);
    }
    let joints = model.joints.len() - linkage.parameters();
    let coordinates = match &linkage.coupling {
        Some(_) => linkage.variables(),
        None => joints,
    };
    let rank = rank_without(model, linkage, target);
    if rank < coordinates.min(target.coordinates()) {
        let alike = alike(model).next().map(|i| {
            let names = [i, i + 1].map(|j| model.joints[j].name.clone());
            (names, model.joints[i].kind)
        });
        return Err(NoClosedForm::Singular {
            rank,
            target,
            alike,
        });
    }
    if joints > target.coordinates() {
        return Err(NoClosedForm::Redundant(target));
    }
    let trials = Trials::new(model, linkage, target);
    let mut patience = Patience::of(COMPARED);
    match solve_readings(&trials, target, &mut patience) {
        Ok(found) if !found.certificate.loses_much() => Ok(found),
        found if !patience.ended => found,
        _ => solve_readings(&trials, target, &mut Patience::of(usize::MAX)),
    }
}

/// The same of an arm whose joints mimic each other, as one whose joints move by themselves.
fn solve_coupled(model: &Model, target: Target) -> Result<Certified, NoClosedForm> {
    let uncoupled = uncoupled(model).map_err(|reason| NoClosedForm::Mimic(reason.into()))?;
    let (model, linkage) = uncoupled;
    solve_uncoupled(&model, &linkage, target)
}

/// The same once its joints move by themselves.
pub(crate) fn solve_uncoupled(
    model: &Model,
    linkage: &Linkage,
    target: Target,
) -> Result<Certified, NoClosedForm> {
    let joints = model.joints.len() - linkage.parameters();
    if joints > target.coordinates() {
        return Err(NoClosedForm::Mimic(Coupled::Joints { joints, target }));
    }
    match solve(model, linkage, target) {
        Err(reason @ (NoClosedForm::NoPlan(_) | NoClosedForm::Uncertified { .. })) => {
            Err(NoClosedForm::Mimic(Coupled::Unsolved(Box::new(reason))))
        }
        solved => solved,
    }
}

/// The best plan at all tolerances.
fn solve_readings(
    trials: &Trials,
    target: Target,
    patience: &mut Patience,
) -> Result<Certified, NoClosedForm> {
    let (model, linkage) = (trials.model(), trials.linkage());
    let mut refusal = NoClosedForm::NoPlan(target);
    let is_determined = model.joints.len() - linkage.parameters() == target.coordinates();
    let mut best: Option<Certified> = None;
    for idealized in idealizations(model) {
        // Branches of as many joints as targets have coordinates say where others may be missing.
        let is_clear = is_determined || idealized.is_clear(model);
        let shift = tip_shift(model, &idealized.model, &linkage.projection(target));
        // Beside the branches of an idealized arm an elimination is asked of whole poses alone.
        let alone = match target {
            Target::Pose => DESIGNED * linkage.size,
            _ => linkage.unmoved(target),
        };
        if best.is_none()
            && shift > alone
            && let Ok(found) = last_resort(trials, target, refusal.clone())
        {
            if found.certificate.lost == 0 {
                return Ok(found);
            }
            best = Some(found);
        }
        let stands = best.as_ref().map(|best| &best.form.inverse);
        let most = match stands {
            Some(Inverse::Univariate(_)) => INSTEAD,
            _ => PLANS,
        };
        match solve_idealized(trials, idealized, target, most, patience) {
            Ok(found) => {
                // The reading that answers more singular targets wins; one that is exact, or
                // clear and answers all, cannot be beaten.
                if is_clear && found.certificate.is_complete() {
                    best = Some(found);
                    break;
                }
                let is_exact = found.form.is_exact() && !found.certificate.loses_much();
                best = better(best, found);
                if is_exact {
                    break;
                }
            }
            Err(NoClosedForm::NoPlan(_)) => {}
            Err(other) => refusal = other,
        }
    }
    match best {
        Some(best) if !best.certificate.is_complete() => Ok(completed(trials, best)),
        Some(best) => Ok(best),
        None => last_resort(trials, target, refusal),
    }
}

/// An arm admits targets that are not projected, and these if its joints turn about axes that are
/// parallel but for noise.
///
/// # Errors
///
/// Which joints do not, or that none turns.
pub(crate) fn admits(model: &Model, target: Target) -> Result<(), NoClosedForm> {
    if !target.is_projected() {
        return Ok(());
    }
    let first = turning(model).next();
    let first = first.ok_or(NoClosedForm::Unturned(target))?;
    match tilted(model, NOISIEST) {
        None => Ok(()),
        Some((tilted, angle)) => Err(NoClosedForm::Tilted {
            target,
            joints: [first, tilted].map(|joint| joint.name.clone()),
            angle,
        }),
    }
}

fn turning(model: &Model) -> impl Iterator<Item = &Joint> {
    let turns = |joint: &&Joint| joint.is_revolute();
    model.joints.iter().filter(turns)
}

/// Whether all joints that turn do so about parallel axes, to rounding.
fn turns_about_one_direction(model: &Model) -> bool {
    tilted(model, PARALLEL).is_none()
}

/// A joint that turns about an axis more than so many radians off that of the first, and by how many.
fn tilted(model: &Model, beyond: f64) -> Option<(&Joint, f64)> {
    let first = turning(model).next()?;
    let mut angles = turning(model).map(|joint| (joint, angle(first.axis, joint.axis)));
    angles.find(|(_, angle)| *angle > beyond)
}

/// The largest number of independent ways in which the joints change targets that are not
/// locked.
fn rank_without(model: &Model, linkage: &Linkage, target: Target) -> usize {
    let locked = &linkage.locked;
    let held = (!locked.is_empty()).then(|| model.locked(locked, &vec![SOMEWHERE; locked.len()]));
    let held = held.as_ref().unwrap_or(model);
    match &linkage.coupling {
        Some(coupling) => coupled_rank(held, coupling, target),
        None => rank(held, target),
    }
}

/// Joints that do the same as their successor, by their places in the chain: both turn about one
/// line, or slide along one direction.
pub(crate) fn alike(model: &Model) -> impl Iterator<Item = usize> {
    let axes = axes(model);
    let is_alike = move |&i: &usize| {
        let slides = [i, i + 1].map(|i| !model.joints[i].is_revolute());
        match (slides, relate(&axes[i], &axes[i + 1], 1e-6, 1e-9)) {
            ([true, true], PairRelation::Parallel) => true,
            ([a, b], PairRelation::Coincident) => a == b,
            _ => false,
        }
    };
    (0..model.joints.len().saturating_sub(1)).filter(is_alike)
}

/// The one that misses less.
fn better(best: Option<Certified>, other: Certified) -> Option<Certified> {
    match best {
        Some(best) if best.certificate.missing() <= other.certificate.missing() => Some(best),
        _ => Some(other),
    }
}
