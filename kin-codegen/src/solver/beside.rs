//! Eliminations that are asked beside the branches of a plan.

use super::Certified;
use crate::certificate::{NearSingular, Trials, certify};
use crate::closed_form::{ClosedForm, Inverse, Refinement};
use crate::expr::inverse::{FreeJoints, inverse};
use crate::plan::Target;
use crate::univariate::{self, Kept, MOST};

/// A joint whose share in a motion is less hardly takes part in it.
const TAKES_PART: f64 = 0.1;

/// With more noise an elimination is not asked beside an idealized arm.
const NOISY: f64 = 1e-4;
/// Two eliminations neither of which is sure of its answer at all but this percentage of targets get a
/// third.
const OFTEN: f64 = 25.0;

/// Where a step of the plan degenerates and the arm does not, an elimination tells what is
/// lost, if it can; where nothing is, only targets that no branch reaches.
pub(super) fn completed(trials: &Trials, best: Certified) -> Certified {
    let form = &best.form;
    let asks =
        form.is_exact() && form.refinement == Refinement::Correction && form.single.is_none();
    let arm = asks
        .then(|| univariate::Arm::of_targets(trials.model(), trials.linkage(), form.plan.target));
    let Some(mut arm) = arm.flatten() else {
        return best;
    };
    // Singular targets are why it is asked, of which none is sure.
    arm.kept.truncate(1);
    let mut form = ClosedForm {
        refinement: Refinement::Univariate(Box::new(arm)),
        ..form.clone()
    };
    if best.certificate.lost > 0 {
        let (linkage, plan, free) = (&form.linkage, &form.plan, FreeJoints::Flagged);
        let flagged = inverse(linkage, plan, form.shift(), &free);
        form.inverse = Inverse::Expressions(Box::new(flagged));
        form.free = free;
    }
    // The certificate tries few of the targets next to singular ones, where the branches may reach none.
    let is_asked = |missing: (usize, usize)| match best.certificate.missing() {
        (0, unanswered) => missing <= (0, unanswered),
        more => missing < more,
    };
    match certify(trials, &form, best.certificate.lost) {
        Ok(certificate) if is_asked(certificate.missing()) => Certified { form, certificate },
        _ => best,
    }
}

/// The eliminations to ask beside the branches of an idealized arm: near a singular
/// configuration two solutions are apart along the motion that moves the tip least, and
/// a joint tells them apart if it takes part in that. Of those that lose least there and of what
/// others have lost, the one that most motions move and whose polynomial has the least noise; and
/// behind it what finds most of what it loses.
pub(super) fn eliminations_beside(trials: &Trials, form: &ClosedForm) -> Option<univariate::Arm> {
    let linkage = trials.linkage();
    let is_other = linkage.swivel.is_some() || linkage.coupling.is_some();
    if form.plan.target != Target::Pose || is_other {
        return None;
    }
    let near = trials.near_singular(form.least_conditioning());
    let mut arms = candidates(trials);
    arms.sort_by_key(|arm| (quarters_unmoved(&near, &arm.kept), arm.kept[0].rank()));
    let lost = |arm: &univariate::Arm| {
        let form = ClosedForm {
            refinement: Refinement::Univariate(Box::new(arm.clone())),
            ..form.clone()
        };
        let mut lost = trials.lost_near(&form, &near);
        lost.extend(trials.lost_again(&form));
        lost
    };
    let mut each = Vec::new();
    for arm in &arms {
        let lost = lost(arm);
        if !lost.contains(&true) {
            return Some(with_surer_ones(trials, &near, &arms, arm.clone()));
        }
        each.push((arm.clone(), lost));
    }
    fewest_lost(&each)
}

/// Arms that keep one joint each, without those whose polynomial is noisy or, unless all do, says
/// nothing.
fn candidates(trials: &Trials) -> Vec<univariate::Arm> {
    let mut arms = univariate::Arm::keeping_each(trials.model(), trials.linkage());
    arms.retain(|arm| arm.kept[0].noise < NOISY);
    if !arms.iter().all(univariate::Arm::says_nothing) {
        arms.retain(|arm| !arm.says_nothing());
    }
    arms
}

/// In how many of the motions none of the kept joints takes part.
fn unmoved(near: &[NearSingular], kept: &[Kept]) -> usize {
    let hardly = |near: &NearSingular, kept: &Kept| {
        near.motion[usize::from(kept.elimination.joints[0])].abs() < TAKES_PART
    };
    let by_none = |near: &&NearSingular| kept.iter().all(|kept| hardly(near, kept));
    near.iter().filter(by_none).count()
}

/// [`unmoved`] in quarters of all.
fn quarters_unmoved(near: &[NearSingular], kept: &[Kept]) -> usize {
    4 * unmoved(near, kept) / near.len().max(1)
}

/// An arm that was not seen to lose anything, with joints kept beside its own: where that hardly
/// moves something may be lost unseen, and what one is not sure of another may be.
fn with_surer_ones(
    trials: &Trials,
    near: &[NearSingular],
    arms: &[univariate::Arm],
    mut arm: univariate::Arm,
) -> univariate::Arm {
    if quarters_unmoved(near, &arm.kept) > 0 {
        let both = |other: &Kept| unmoved(near, &[arm.kept[0], *other]);
        let others = arms.iter().map(|other| other.kept[0]);
        let beside = others.min_by_key(both);
        let tells = |other: &Kept| both(other) < unmoved(near, &arm.kept);
        arm.kept.extend(beside.filter(tells));
    }
    // With joints behind its tip a shorter arm is nearly singular where it is not itself.
    let is_short = trials.linkage().variables() < 6;
    let is_beyond = |most: f64| move |kept: &Kept| kept.unsure > most;
    let lacks = |all: &[Kept]| match all.len() {
        1 => is_short || all.iter().any(is_beyond(0.0)),
        count => count < MOST && all.iter().all(is_beyond(OFTEN)),
    };
    while lacks(&arm.kept) {
        let others = arms.iter().map(|other| other.kept[0]);
        let others = others.filter(|other| !arm.kept.contains(other));
        let Some(surest) = others.min_by(|a, b| a.unsure.total_cmp(&b.unsure)) else {
            break;
        };
        arm.kept.push(surest);
    }
    arm
}

/// Of arms with what each loses the one that loses least, and behind it those that find most of
/// what is left.
fn fewest_lost(each: &[(univariate::Arm, Vec<bool>)]) -> Option<univariate::Arm> {
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
