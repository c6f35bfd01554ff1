//! Which joints to give beside a target: the choices, the best first.

use crate::certificate::SOMEWHERE;
use crate::closed_form::tip_shift;
use crate::expr;
use crate::geometry::{Carried, Linkage, conditioning, idealizations, size, volume};
use crate::model::{Joint, Model, anywhere, configurations};
use crate::plan::{Plans, Relations, Target};
use crate::random::Random;
use crate::solver::{COMPARED, DESIGNED};
use crate::univariate;
use std::cmp::Reverse;
use std::rc::Rc;

/// Below this conditioning a configuration is nearly singular: an elbow that turns the
/// rest of an arm along its own self-motion is no parameter for that, even where the file
/// is off its design.
const NEARLY_SINGULAR: f64 = 1e-3;
/// Random configurations that tell.
const TRIED: usize = 16;
/// Random configurations between which joints sweep.
const SWEPT: usize = 64;
/// A choice that leaves joints which sweep less than this part of what others do comes behind those: few
/// values of what is given, as of the elbow of most arms of seven joints, then have a solution.
const NARROW: f64 = 0.15;
/// The same of those that cost about as much.
const ABOUT_AS_WIDE: f64 = 0.67;
/// Choices that cost less than one part in so many more than the best cost about as much.
const ALIKE: usize = 20;
/// Of so many targets in a hundred, and below this noise, a polynomial is as good as any that is
/// unsure more seldom, or has less.
const SELDOM: f64 = 2.0;
const QUIET: f64 = 1e-11;
/// A set of joints that could stay free.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighed {
    /// Their places in the chain, ascending.
    pub joints: Vec<usize>,
    /// What all branches of the cheapest of the first plans for the others cost, by
    /// [`expr::inverse::weight`]; none if there is none.
    pub weight: Option<usize>,
}

/// The choices, the best first. What an arm stands on is given where that leaves it regular: all other
/// choices come behind those that give it, whether or not these have a plan.
pub(super) fn weigh(
    model: &Model,
    linkage: &Linkage,
    target: Target,
    rows: Vec<Vec<Vec<usize>>>,
) -> Vec<Weighed> {
    let stand = stand(model);
    let stands = |joints: &Vec<usize>| {
        stand > 0
            && (0..stand).all(|joint| joints.contains(&joint))
            && is_usually_regular(model, joints, target)
    };
    let (standing, others): (Vec<_>, Vec<_>) = rows
        .into_iter()
        .map(|row| row.into_iter().partition::<Vec<_>, _>(stands))
        .unzip();
    let [mut first, rest] = [standing, others].map(|rows| weighed(model, linkage, target, rows));
    first.extend(rest);
    first
}

/// The choices of the first row that has any with a plan, the best first; without a plan in any
/// row, those of the first.
fn weighed(
    model: &Model,
    linkage: &Linkage,
    target: Target,
    mut rows: Vec<Vec<Vec<usize>>>,
) -> Vec<Weighed> {
    rows.retain(|row| !row.is_empty());
    let Some(first) = rows.first().cloned() else {
        return Vec::new();
    };
    for row in rows {
        let (mut weighed, left) = planned(model, linkage, target, row);
        if !weighed.is_empty() {
            weighed.extend(between(model, linkage, left, false));
            return weighed;
        }
    }
    between(model, linkage, first, true)
}

/// The choices that leave the others a plan, the best first, and those that do not. Of an arm off
/// its design those come first beside whose branches an elimination can be asked, and as long as
/// there is none it is read further from that design.
fn planned(
    model: &Model,
    linkage: &Linkage,
    target: Target,
    choices: Vec<Vec<usize>>,
) -> (Vec<Weighed>, Vec<Vec<usize>>) {
    let is_dear = |shift: f64, joints: &[usize]| {
        shift >= linkage.unmoved(target) && !leaves_row(linkage, joints)
    };
    let mut weighed: Vec<Weighed> = Vec::new();
    let mut left = choices;
    let mut shift = 0.0;
    for idealized in idealizations(model) {
        shift = tip_shift(model, &idealized.model, &linkage.projection(target));
        if shift > DESIGNED * linkage.size {
            break;
        }
        let ideal = Linkage::for_target(&idealized.model, target);
        let relations = Rc::new(Relations::new(&ideal, target, &[]));
        let weight = |joints: &[usize]| {
            let ideal = ideal.clone().with_locked(joints);
            let mut plans = Plans::of(&ideal, target, &relations)
                .take(COMPARED)
                .peekable();
            plans.peek()?;
            let is_regular = is_usually_regular(&idealized.model, joints, target);
            let weights = plans
                .filter(|_| is_regular)
                .map(|plan| expr::inverse::weight(&ideal, &plan));
            weights.min()
        };
        let mut rest = Vec::new();
        for joints in left {
            match weight(&joints) {
                None => rest.push(joints),
                weight => weighed.push(Weighed { joints, weight }),
            }
        }
        left = rest;
        if weighed.iter().any(|it| !is_dear(shift, &it.joints)) {
            break;
        }
    }
    let weighed = sorted(model, target, weighed, |joints| is_dear(shift, joints));
    (weighed, left)
}

/// The choices that leave the others a plan, the best first.
fn sorted(
    model: &Model,
    target: Target,
    weighed: Vec<Weighed>,
    is_dear: impl Fn(&[usize]) -> bool,
) -> Vec<Weighed> {
    let with_reach = |choice: Weighed| {
        let reach = swept(model, &choice.joints, target);
        (choice, reach)
    };
    let mut each: Vec<(Weighed, f64)> = weighed.into_iter().map(with_reach).collect();
    let widest = |each: &[(Weighed, f64)]| each.iter().map(|it| it.1).fold(0.0, f64::max);
    let most = widest(&each);
    let preference = |(choice, reach): &(Weighed, f64)| {
        let joints = &choice.joints;
        let is_narrow = *reach < NARROW * most;
        (
            is_dear(joints),
            is_narrow,
            Reverse(carriers(model, target, joints)),
            Reverse(carried(model, target, joints)),
        )
    };
    each.sort_by_key(|it| (preference(it), it.0.weight));
    // Of those that cost about as much as the best the last in the order of the joints comes first:
    // the joint that a left arm leaves free is then that of its mirror image.
    if let Some(best) = each.first() {
        let (preferred, least) = (preference(best), best.0.weight);
        let is_alike =
            |it: &(Weighed, f64)| preference(it) == preferred && costs_as_much(it.0.weight, least);
        let alike = each.iter().take_while(|it| is_alike(it)).count();
        let alike = &mut each[..alike];
        let most = widest(alike);
        let is_narrow = |reach: f64| reach < ABOUT_AS_WIDE * most;
        alike.sort_by_key(|(choice, reach)| (is_narrow(*reach), Reverse(choice.joints.clone())));
    }
    each.into_iter().map(|(choice, _)| choice).collect()
}

/// Whether plans cost about as much as the cheapest.
pub fn costs_as_much(weight: Option<usize>, least: Option<usize>) -> bool {
    let both = weight.zip(least);
    both.is_some_and(|(weight, least)| ALIKE * weight.saturating_sub(least) < least)
}

/// How much of the space of targets the joints that are not locked sweep: whatever the others are given,
/// a target should be in reach.
fn swept(model: &Model, locked: &[usize], target: Target) -> f64 {
    let (chain, size) = (model.chain(), size(model));
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let tried = (0..SWEPT).map(|_| anywhere(model, &mut random));
    tried
        .map(|q| volume(&chain, &q, size, target, locked))
        .sum()
}

/// How many of these joints, from the first of the chain on, carry the others: all but one, since an
/// arm of seven joints is solved as if it stood alone, and that one too if they are a rail, the
/// slides of a gantry, or the slides and the turn of a platform, or an arm that carries the wrist
/// which orients the tip; of positions these slides alone. Whoever stands an arm on these means to say
/// where they are.
pub fn carriers(model: &Model, target: Target, joints: &[usize]) -> usize {
    let platform = stand(model);
    let most = match target {
        Target::Orientation => joints.len(),
        Target::Position => platform,
        _ => platform.max(joints.len().saturating_sub(1)),
    };
    let from_first = joints.iter().zip(0..).take_while(|(joint, i)| *joint == i);
    let first = from_first.take(most).count();
    // Some slides of a gantry carry nothing without the others.
    if first < slides(model) { 0 } else { first }
}

/// How many joints an arm stands on: the slides of a rail or a gantry, or the two and the turn of a
/// platform.
fn stand(model: &Model) -> usize {
    let slides = slides(model);
    slides + usize::from(slides == 2)
}

/// How many joints from the first on are slides.
fn slides(model: &Model) -> usize {
    let is_slide = |joint: &&Joint| !joint.is_revolute();
    model.joints.iter().take_while(is_slide).count()
}

/// How many of these joints, from the last of the chain on, the others carry, of which a position is
/// asked: the wrist is given.
fn carried(model: &Model, target: Target, joints: &[usize]) -> usize {
    let from_last = joints.iter().rev().zip((0..model.joints.len()).rev());
    match target {
        Target::Position => from_last.take_while(|(joint, i)| *joint == i).count(),
        _ => 0,
    }
}

/// Whether the joints that are not locked stand in a row, for which all others can be
/// eliminated.
fn leaves_row(linkage: &Linkage, locked: &[usize]) -> bool {
    let linkage = linkage.clone().with_locked(locked);
    Carried::new(&linkage).between().is_empty()
}

/// Whether the joints that are not locked are independent at most configurations.
fn is_usually_regular(model: &Model, locked: &[usize], target: Target) -> bool {
    let held = model.locked(locked, &vec![SOMEWHERE; locked.len()]);
    let (chain, size) = (held.chain(), size(model));
    let tried = configurations(&held);
    let random = tried.iter().take(TRIED);
    let regular = random.filter(|q| conditioning(&chain, q, size, target) > NEARLY_SINGULAR);
    2 * regular.count() > TRIED
}

/// The choices without a plan that leave the other joints in a row; those whose
/// polynomial is surest of its roots come first, if any of them is to be taken.
fn between(
    model: &Model,
    linkage: &Linkage,
    choices: Vec<Vec<usize>>,
    matters: bool,
) -> Vec<Weighed> {
    let locked = |joints: &Vec<usize>| linkage.clone().with_locked(joints);
    let rows = choices
        .into_iter()
        .filter(|joints| leaves_row(linkage, joints));
    let quality = |joints: &Vec<usize>| {
        let arm =
            matters.then(|| univariate::Arm::of_targets(model, &locked(joints), Target::Pose));
        let kept = arm.flatten().map(|arm| arm.kept[0]);
        kept.map_or([f64::INFINITY; 3], |kept| {
            let unsure = kept.unsure.max(SELDOM);
            [
                unsure,
                kept.elimination.degree.into(),
                kept.noise.max(QUIET),
            ]
        })
    };
    let mut rows: Vec<([f64; 3], Vec<usize>)> = rows.map(|row| (quality(&row), row)).collect();
    let least = |i: usize| rows.iter().map(|it| it.0[i]).fold(f64::INFINITY, f64::min);
    let (unsure, noise) = (least(0), least(2));
    // The measures are those of a few targets, others of mirror images: of those about as good the
    // last in the order of the joints comes first, as of those with a plan.
    rows.sort_by_cached_key(|(quality, joints)| {
        (
            Reverse(carriers(model, Target::Pose, joints)),
            (quality[0] / unsure).log2() as i32,
            quality[1] as i32,
            (quality[2] / noise).log10() as i32,
            Reverse(joints.clone()),
        )
    });
    let weighed = rows.into_iter().map(|(_, joints)| Weighed {
        joints,
        weight: None,
    });
    weighed.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{ArmSpec, Source};
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn rails_and_platforms_carry_an_arm() {
        let carried_by = |kinds: &str, joints: &[usize]| {
            let joint = |(i, kind)| {
                let (kind, point) = match kind {
                    's' => ("prismatic", String::new()),
                    _ => ("revolute", format!(", point: [0.1, 0, 0.{i}]")),
                };
                format!("- {{name: q{i}, axis: [0, 0, 1]{point}, type: {kind}}}\n")
            };
            let screws: String = kinds.chars().enumerate().map(joint).collect();
            let source = Source {
                path: "arm.yaml".into(),
                text: format!(
                    "robot: arm\nunits: {{angle: rad, length: m}}\nscrews:\n{screws}home: {{xyz: [9, 0, 0]}}\n"
                ),
            };
            let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
            carriers(&model, Target::Pose, joints)
        };
        assert_eq!(carried_by("stttttt", &[0]), 1);
        assert_eq!(carried_by("sstttttt", &[0, 1]), 2);
        assert_eq!(carried_by("ssttttttt", &[0, 1, 2]), 3);
        // Of a torso and seven joints another one is given as well, which carries nothing.
        assert_eq!(carried_by("sttttttt", &[0, 3]), 1);
        assert_eq!(carried_by("sttttttt", &[0, 1]), 1);
        assert_eq!(carried_by("tttttttt", &[0, 7]), 1);
        assert_eq!(carried_by("ssstttttttt", &[0, 1, 2, 3]), 3);
        // Of a gantry all slides, or none.
        assert_eq!(carried_by("sssttttt", &[0, 1]), 0);
        // Turntables, slides within, and what a rail carries.
        assert_eq!(carried_by("ttttttt", &[0]), 0);
        assert_eq!(carried_by("tstttttt", &[1]), 0);
        assert_eq!(carried_by("stttttt", &[1]), 0);
        assert_eq!(carried_by("tttttt", &[]), 0);
    }

    /// Without a closed form for any six of its joints.
    #[test]
    fn mirrored_arms_are_given_the_same_joints() {
        let first = |offset: f64, mirrored: f64| {
            let links = [
                (offset, FRAC_PI_2, 0.2),
                (0.0, -FRAC_PI_2, 0.245),
                (0.54, PI, 0.0),
                (0.0, -FRAC_PI_2, 0.0),
                (0.0, FRAC_PI_2, -0.54),
                (0.0, -FRAC_PI_2, 0.15),
                (0.0, PI, -0.16),
            ];
            let row = |(i, (a, alpha, d)): (usize, &(f64, f64, f64))| {
                let alpha = alpha * mirrored;
                format!("- {{name: q{i}, a: {a}, alpha: {alpha}, d: {d}, theta: 0}}\n")
            };
            let rows: String = links.iter().enumerate().map(row).collect();
            let source = Source {
                path: "arm.yaml".into(),
                text: format!("robot: arm\nunits: {{angle: rad, length: m}}\ndh:\n{rows}"),
            };
            let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
            let linkage = Linkage::for_target(&model, Target::Pose);
            let ends = vec![vec![0], vec![6]];
            between(&model, &linkage, ends, true)[0].joints.clone()
        };
        for offset in [0.1, 0.4, 0.7] {
            assert_eq!(first(offset, 1.0), first(offset, -1.0), "{offset}");
        }
    }
}
