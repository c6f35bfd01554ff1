//! The search for a closed form: relations are read into the axes with growing
//! tolerance, and the plans for them certified, until one stands.

use crate::certificate::{Certificate, Failure, NearSingular, SOMEWHERE, Trials, certify};
use crate::closed_form::{ClosedForm, Inverse, Reading, Refinement, tip_shift};
use crate::expr::inverse::{DomainMargin, FreeAngles, InverseGraph, inverse, weight};
use crate::geometry::{
    AxisRelation, Idealized, Linkage, Moved, axes, cross, dot, idealize, norm, rank, relate,
};
use crate::model::{Joint, JointKind, Model};
use crate::plan::{Plan, Plans, Target};
use crate::scalar::Scalar;
use crate::univariate::{self, Kept, MOST};

/// Tolerances to read relations with, the strictest first: rounding of the
/// file's own digits, right angles of 9, 7 and 5 digits, and calibrated arms.
pub(crate) const TOLERANCES: [f64; 6] = [1e-12, 1e-8, 1e-6, 5e-5, 1e-3, NOISIEST];
/// The largest of them.
const NOISIEST: f64 = 8e-3;
/// Plans tried at one tolerance before the next: the cheap ones of an arm with
/// aligned or meeting axes may degenerate where the arm does not.
const PLANS: usize = 200;
/// The same of an arm that a polynomial solves already, but for a few targets.
const INSTEAD: usize = 8;
/// Plans of which the one with the fewest operations is tried first.
const COMPARED: usize = 4;
/// As [`CERTIFIED`], on an idealized arm: refinement makes a certificate dear.
const REFINED: usize = 2;
/// Plans tried from the first on that is certified but leaves singular targets
/// unanswered.
const CERTIFIED: usize = 8;
/// An arm whose tip is this far from that of one with exact relations, relative to
/// its size, was designed so: it is no noise, and solved without them if it can be.
pub(crate) const DESIGNED: f64 = 1e-2;

/// A joint whose share in a motion is less hardly takes part in it.
const TAKES_PART: f64 = 0.1;

/// With more noise an elimination is not asked beside an idealized arm.
const NOISY: f64 = 1e-4;

/// So many choices of eliminations are tried of an arm that is solved by them alone.
const CHOICES: usize = 6;

/// A closed form that was seen to work.
#[derive(Clone, Debug)]
pub struct Certified {
    /// The closed form.
    pub form: ClosedForm,
    /// What was seen when it was run.
    pub certificate: Certificate,
}

impl Certified {
    /// How many regular targets it loses, then how many singular ones.
    pub(crate) fn missing(&self) -> (usize, usize) {
        (self.certificate.lost, self.certificate.unanswered)
    }
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
}

/// Why an arm has none.
#[derive(Clone, Debug, PartialEq)]
pub enum NoClosedForm {
    /// What it is solved by is there in double precision alone.
    OnlyInDouble(Lack),
    /// Joints that mimic others couple the chain.
    Mimic,
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
    /// The axes are off exact relations, and a target of this kind is projected
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
        return Err(NoClosedForm::Mimic);
    }
    let joints = model.joints.len() - linkage.parameters();
    let rank = rank_without(model, &linkage.locked, target);
    if rank < joints.min(target.coordinates()) {
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

/// Plans that lose much are those of axes whose relation was read wrongly; so many of them
/// at one tolerance are borne before the next.
struct Patience {
    plans: usize,
    /// Whether it was over at any tolerance.
    ended: bool,
}

impl Patience {
    fn of(plans: usize) -> Self {
        Self {
            plans,
            ended: false,
        }
    }

    /// Whether it is over after so many.
    fn ends_with(&mut self, plans: usize) -> bool {
        let ends = plans >= self.plans;
        self.ended |= ends;
        ends
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
    let mut best: Option<Certified> = None;
    let mut last: Option<Vec<Moved>> = None;
    for tolerance in TOLERANCES {
        let idealized = idealize(model, tolerance);
        if last.as_ref() == Some(&idealized.moved) {
            continue;
        }
        last = Some(idealized.moved.clone());
        let shift = tip_shift(model, &idealized.model);
        // Beside the branches of an idealized arm an elimination is asked of whole poses alone.
        let alone = match target {
            Target::Pose => DESIGNED,
            _ => linkage.scalar.tolerances().unmoved,
        };
        if best.is_none()
            && shift > alone * linkage.size
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
                // The reading that answers more singular targets wins; one
                // that is exact or answers all cannot be beaten.
                let done = found.form.is_exact() && !found.certificate.loses_much()
                    || found.certificate.is_complete();
                best = better(best, found);
                if done {
                    break;
                }
            }
            Err(NoClosedForm::NoPlan(_)) => {}
            Err(other) => refusal = other,
        }
    }
    match best {
        Some(best) if best.certificate.lost > 0 => Ok(completed(trials, best)),
        Some(best) => Ok(best),
        None => last_resort(trials, target, refusal),
    }
}

/// Where a step of the plan degenerates and the arm does not, an elimination tells what is
/// lost, if it can.
fn completed(trials: &Trials, best: Certified) -> Certified {
    let form = &best.form;
    let is_whole = form.plan.target == Target::Pose && trials.linkage().locked.is_empty();
    let asks = |form: &ClosedForm| {
        form.is_exact() && form.refinement == Refinement::None && form.single.is_none()
    };
    let arm = (is_whole && asks(form)).then(|| univariate::Arm::new(trials.linkage()));
    let Some(mut arm) = arm.flatten() else {
        return best;
    };
    // Singular targets are why it is asked, of which none is sure.
    arm.kept.truncate(1);
    let flagged = inverse(
        &form.linkage,
        &form.plan,
        DomainMargin(0.0),
        FreeAngles::Flagged,
    );
    let form = ClosedForm {
        free: FreeAngles::Flagged,
        inverse: Inverse::Expressions(Box::new(flagged)),
        refinement: Refinement::Univariate(Box::new(arm)),
        ..form.clone()
    };
    match certify(trials, &form, best.certificate.lost) {
        Ok(certificate) if certificate.lost < best.certificate.lost => {
            Certified { form, certificate }
        }
        _ => best,
    }
}

/// An arm admits targets that are not projected, and these if its joints turn about axes that are
/// parallel but for noise.
///
/// # Errors
///
/// Which joints do not.
pub(crate) fn admits(model: &Model, target: Target) -> Result<(), NoClosedForm> {
    let turns = |joint: &&Joint| joint.kind == JointKind::Revolute;
    let mut turning = model.joints.iter().filter(turns);
    let Some(first) = turning.next().filter(|_| target.is_projected()) else {
        return Ok(());
    };
    let angle = |joint: &Joint| {
        let [cosine, sine] = [
            dot(first.axis, joint.axis).abs(),
            norm(cross(first.axis, joint.axis)),
        ];
        sine.atan2(cosine)
    };
    match turning.find(|joint| angle(joint) > NOISIEST) {
        None => Ok(()),
        Some(tilted) => Err(NoClosedForm::Tilted {
            target,
            joints: [first, tilted].map(|joint| joint.name.clone()),
            angle: angle(tilted),
        }),
    }
}

/// The largest number of independent ways in which the joints change targets that are not
/// locked.
fn rank_without(model: &Model, locked: &[usize], target: Target) -> usize {
    match locked.is_empty() {
        true => rank(model, target),
        false => rank(
            &model.locked(locked, &vec![SOMEWHERE; locked.len()]),
            target,
        ),
    }
}

/// A polynomial in one joint, for an arm that the subproblems do not solve.
fn last_resort(
    trials: &Trials,
    target: Target,
    refusal: NoClosedForm,
) -> Result<Certified, NoClosedForm> {
    let linkage = trials.linkage();
    if linkage.scalar == Scalar::F32 {
        return Err(match refusal {
            NoClosedForm::NoPlan(_) => NoClosedForm::OnlyInDouble(Lack::Polynomial),
            other => other,
        });
    }
    let arm = match target {
        Target::Pose => univariate::Arm::between(trials.model(), linkage),
        Target::PositionAxis if linkage.locked.is_empty() => {
            univariate::Arm::new(&Linkage::for_target(trials.model(), target))
        }
        _ => None,
    };
    let Some(arm) = arm else {
        return Err(refusal);
    };
    let eliminating = |arm| ClosedForm::eliminating(trials.model(), linkage, target, arm);
    let mut refusal = refusal;
    let mut best: Option<Certified> = None;
    let mut asked: Vec<univariate::Arm> = Vec::new();
    let mut next = arm;
    // What some lose others may find.
    while !asked.contains(&next) && asked.len() < CHOICES {
        asked.push(next.clone());
        let form = eliminating(next.clone());
        match certify(trials, &form, usize::MAX) {
            Ok(certificate) => {
                let done = certificate.lost == 0;
                best = better(best, Certified { form, certificate });
                if done {
                    break;
                }
            }
            Err(failure) => {
                let plan = form.plan.to_string();
                refusal = NoClosedForm::Uncertified { plan, failure };
            }
        }
        let alone = next.alone();
        let lost = alone.map(|arm| trials.lost_again(&eliminating(arm)));
        next = next.losing_fewest(&lost.collect::<Vec<_>>());
    }
    best.ok_or(refusal)
}

/// Joints that do the same as their successor, by their places in the chain: both turn about one
/// line, or slide along one direction.
pub(crate) fn alike(model: &Model) -> impl Iterator<Item = usize> {
    let axes = axes(model);
    let is_alike = move |&i: &usize| {
        let slides = [i, i + 1].map(|i| model.joints[i].kind == JointKind::Prismatic);
        match (slides, relate(&axes[i], &axes[i + 1], 1e-6, 1e-9)) {
            ([true, true], AxisRelation::Parallel { .. }) => true,
            ([a, b], AxisRelation::Coincident) => a == b,
            _ => false,
        }
    };
    (0..model.joints.len().saturating_sub(1)).filter(is_alike)
}

/// The one that misses less.
fn better(best: Option<Certified>, other: Certified) -> Option<Certified> {
    match best {
        Some(best) if best.missing() <= other.missing() => Some(best),
        _ => Some(other),
    }
}

fn solve_idealized(
    trials: &Trials,
    idealized: Idealized,
    target: Target,
    most: usize,
    patience: &mut Patience,
) -> Result<Certified, NoClosedForm> {
    let reading = Reading::new(trials.model(), trials.linkage(), idealized, target)
        .ok_or(NoClosedForm::NoPlan(target))?;
    let (linkage, exact) = (&reading.linkage, reading.is_exact());
    let locked = &linkage.locked;
    let solved = linkage.variables().min(target.coordinates());
    if !exact && rank_without(reading.model(), locked, target) < solved {
        // Of the ideal arm, the others are singular throughout.
        return Err(NoClosedForm::NoPlan(target));
    }
    if !exact && target.is_projected() {
        return Err(NoClosedForm::Noisy);
    }
    if !exact && linkage.scalar == Scalar::F32 {
        return Err(NoClosedForm::OnlyInDouble(Lack::Refinement));
    }
    let form = |plan: &Plan, free: FreeAngles| reading.form(plan, free);
    let mut plans = Plans::new(linkage, target);
    // The search estimates what a plan costs; of those that it comes by first, the
    // one that needs the fewest operations is tried first.
    let mut first: Vec<Plan> = plans.by_ref().take(COMPARED).collect();
    if exact && linkage.variables() == target.coordinates() + usize::from(linkage.swivel.is_some())
    {
        first.sort_by_cached_key(|plan| weight(linkage, plan));
    }
    let mut beside = match first.first() {
        Some(first) if !exact => eliminations_beside(trials, &form(first, FreeAngles::Seeded)),
        _ => None,
    };
    let mut chosen = 1;
    let mut refusal = NoClosedForm::NoPlan(target);
    let mut best: Option<Certified> = None;
    let mut certified = 0;
    let mut degenerate = 0;
    let mut first = first.into_iter();
    let mut later = Later {
        linkage,
        target,
        all: plans,
        told: 0,
        telling: None,
    };
    for tried in 0..most {
        let next = first.next().or_else(|| {
            let lost = if exact { trials.lost() } else { Vec::new() };
            later.next(&lost, best.is_some())
        });
        let Some(plan) = next else {
            break;
        };
        // To turn a free angle costs operations: only where it is seen to lose
        // targets, and not for plans that cost more than one that stands.
        let stands = best.as_ref().is_some_and(|best| best.certificate.lost == 0);
        let turned = if stands && tried >= COMPARED {
            0..0
        } else {
            0..plan.steps.len()
        };
        let turned = turned.map(FreeAngles::TurnedAt);
        let turned = turned.filter(|free| free.may_help(&plan));
        for free in std::iter::once(FreeAngles::Seeded).chain(turned) {
            let mut form = form(&plan, free);
            if let Some(arm) = &beside {
                form.refinement = Refinement::Univariate(Box::new(arm.clone()));
            }
            if form.single.is_some() && form.expressions().is_some_and(InverseGraph::has_quartic) {
                refusal = NoClosedForm::OnlyInDouble(Lack::Quartic);
                break;
            }
            if beside.is_some() && form.expressions().is_some_and(InverseGraph::tells_nothing) {
                // The elimination would be asked at every target, and does as well alone.
                break;
            }
            let losses = best
                .as_ref()
                .map_or(usize::MAX, |best| best.certificate.lost);
            let mut outcome = certify(trials, &form, losses);
            // What one elimination loses another may find.
            while outcome.is_err() && beside.is_some() && chosen < CHOICES {
                chosen += 1;
                let another = eliminations_beside(trials, &form);
                if another == beside {
                    break;
                }
                beside = another;
                if let Some(arm) = &beside {
                    form.refinement = Refinement::Univariate(Box::new(arm.clone()));
                }
                outcome = certify(trials, &form, losses);
            }
            match outcome {
                Ok(certificate) => {
                    let found = Certified { form, certificate };
                    let done = found.certificate.is_complete();
                    best = better(best, found);
                    if done {
                        return best.ok_or(refusal);
                    }
                }
                Err(failure) => {
                    let plan = plan.to_string();
                    refusal = NoClosedForm::Uncertified { plan, failure };
                    break;
                }
            }
        }
        let stands = best.as_ref().is_some_and(|best| best.certificate.lost == 0);
        certified += usize::from(stands);
        let loses_much = |best: &Certified| best.certificate.loses_much();
        degenerate += usize::from(best.as_ref().is_some_and(loses_much));
        if certified == if exact { CERTIFIED } else { REFINED } || patience.ends_with(degenerate) {
            break;
        }
    }
    best.ok_or(refusal)
}

/// The plans that are tried after the first ones.
struct Later<'a> {
    linkage: &'a Linkage,
    target: Target,
    all: Plans<'a>,
    /// How many configurations were lost when `telling` was asked for.
    told: usize,
    /// Those that tell the configurations that others have lost.
    telling: Option<Plans<'a>>,
}

impl Later<'_> {
    /// The next one. Where no plan tells the lost configurations and one stands that does
    /// not, another will not be better.
    fn next(&mut self, lost: &[Vec<f64>], stands: bool) -> Option<Plan> {
        if lost.len() > self.told {
            self.told = lost.len();
            let moved: Vec<Vec<f64>> = lost.iter().map(|q| self.linkage.by_joint(q)).collect();
            self.telling = Some(Plans::telling(self.linkage, self.target, &moved));
        }
        let telling = self.telling.as_mut().and_then(Iterator::next);
        match telling {
            None if stands && self.told > 0 => None,
            None => self.all.next(),
            telling => telling,
        }
    }
}

/// Of a short arm one that is not sure of its answer at more targets of a hundred has another
/// behind it.
const OFTEN: f64 = 25.0;

/// The eliminations to ask beside the branches of an idealized arm: near a singular
/// configuration two solutions are apart along the motion that moves the tip least, and
/// a joint tells them apart if it takes part in that. Of those that lose least there and of what
/// others have lost, the one that most motions move and whose polynomial has the least noise; and
/// behind it what finds most of what it loses.
fn eliminations_beside(trials: &Trials, form: &ClosedForm) -> Option<univariate::Arm> {
    if form.plan.target != Target::Pose || trials.linkage().swivel.is_some() {
        return None;
    }
    let near = trials.near_singular(form.untold());
    let mut arms = univariate::Arm::keeping_each(trials.model(), trials.linkage());
    arms.retain(|arm| arm.kept[0].noise < NOISY);
    // Those that say nothing are taken where all do: curves cost more.
    if !arms.iter().all(univariate::Arm::says_nothing) {
        arms.retain(|arm| !arm.says_nothing());
    }
    // How many of the motions no kept joint takes part in.
    let untold = |kept: &[Kept]| {
        let hardly = |near: &NearSingular, kept: &Kept| {
            near.motion[usize::from(kept.elimination.joints[0])].abs() < TAKES_PART
        };
        let by_none = |near: &&NearSingular| kept.iter().all(|kept| hardly(near, kept));
        near.iter().filter(by_none).count()
    };
    let quarters = |kept: &[Kept]| 4 * untold(kept) / near.len().max(1);
    let quality = |arm: &univariate::Arm| (quarters(&arm.kept), arm.kept[0].noise.to_bits());
    let lost = |arm: &univariate::Arm| {
        let form = ClosedForm {
            refinement: Refinement::Univariate(Box::new(arm.clone())),
            ..form.clone()
        };
        let mut lost = trials.lost_near(&form, &near);
        lost.extend(trials.lost_again(&form));
        lost
    };
    arms.sort_by_key(quality);
    let mut each = Vec::new();
    for arm in &arms {
        let lost = lost(arm);
        if lost.contains(&true) {
            each.push((arm.clone(), lost));
            continue;
        }
        // What was not seen to be lost may be where its joint hardly moves.
        let mut arm = arm.clone();
        if quarters(&arm.kept) > 0 {
            let both = |other: &Kept| untold(&[arm.kept[0], *other]);
            let others = arms.iter().map(|other| other.kept[0]);
            let beside = others.min_by_key(both);
            let tells = |other: &Kept| both(other) < untold(&arm.kept);
            arm.kept.extend(beside.filter(tells));
        }
        // With joints behind its tip a shorter arm is nearly singular where it is not itself.
        let is_short = trials.linkage().variables() < 6;
        let is_unsure = |kept: &Kept| is_short && kept.unsure > OFTEN;
        while arm.kept.len() < MOST && arm.kept.iter().all(is_unsure) {
            let others = arms.iter().map(|other| other.kept[0]);
            let others = others.filter(|other| !arm.kept.contains(other));
            let Some(surest) = others.min_by(|a, b| a.unsure.total_cmp(&b.unsure)) else {
                break;
            };
            arm.kept.push(surest);
        }
        return Some(arm);
    }
    let count = |lost: &[bool]| lost.iter().filter(|lost| **lost).count();
    let (mut best, mut left) = each.iter().min_by_key(|(_, lost)| count(lost)).cloned()?;
    while best.kept.len() < MOST {
        let both =
            |lost: &[bool]| -> Vec<bool> { left.iter().zip(lost).map(|(a, b)| *a && *b).collect() };
        let with = each.iter().map(|(arm, lost)| (arm, both(lost)));
        let Some((arm, fewer)) = with.min_by_key(|(_, lost)| count(lost)) else {
            break;
        };
        if count(&fewer) == count(&left) {
            break;
        }
        best.kept.extend(&arm.kept);
        left = fewer;
    }
    Some(best)
}
