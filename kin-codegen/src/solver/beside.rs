//! Eliminations that are asked beside the branches of a plan.

use super::Certified;
use crate::certificate::{NearSingular, Trials, certify};
use crate::closed_form::{ClosedForm, Inverse, Refinement};
use crate::expr::inverse::{DomainMargin, FreeAngles, inverse};
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
        let (linkage, plan, free) = (&form.linkage, &form.plan, FreeAngles::Flagged);
        let flagged = inverse(linkage, plan, DomainMargin(0.0), &free);
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
    let near = trials.near_singular(form.untold());
    let mut arms = univariate::Arm::keeping_each(trials.model(), trials.linkage());
    arms.retain(|arm| arm.kept[0].noise < NOISY);
    // Those that say nothing are taken where all do.
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
    let quality = |arm: &univariate::Arm| (quarters(&arm.kept), arm.kept[0].rank());
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
        // What one is not sure of another may be; with joints behind its tip a shorter arm is nearly
        // singular where it is not itself.
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
