//! Arms with more joints than their targets have coordinates: which joints are given
//! with the target, so that the others have isolated solutions.

mod choices;

use crate::certificate::SOMEWHERE;
use crate::closed_form::tip_shift;
use crate::expr;
use crate::geometry::{
    Carried, Linkage, Swivel, conditioning, idealizations, rank, size, structure,
};
use crate::model::{Joint, JointKind, Model, configurations};
use crate::plan::{Plans, Relations, Target};
use crate::solver::{COMPARED, Certified, Coupled, DESIGNED, NoClosedForm, alike, solve};
use crate::spec::{ArmSpec, Diagnostic, Diagnostics, JointType, did_you_mean};
use crate::univariate;
use crate::vector::{cross, dot};
use choices::{all, choices};
use kin_runtime::__private::Completion;
use std::cmp::{Ordering, Reverse};
use std::rc::Rc;

/// Below this conditioning a configuration is nearly singular: an elbow that turns the
/// rest of an arm along its own self-motion is no parameter for that, even where the file
/// is off its design.
const NEARLY_SINGULAR: f64 = 1e-3;
/// Random configurations that tell.
const TRIED: usize = 16;
/// A choice of joints that sweep less than this part of what others do comes behind those.
const WIDE: f64 = 0.5;
/// Choices that cost less than one part in so many more than the best cost about as much.
const ALIKE: usize = 20;
/// Of so many targets in a hundred, and below this noise, a polynomial is as good as any that is
/// unsure more seldom, or has less.
const SELDOM: f64 = 2.0;
const QUIET: f64 = 1e-11;
/// Choices that are solved in search of one that has a solution at every singular target.
const SOLVED: usize = 8;

/// What the option `free` calls the swivel angle, where no joint has this name.
pub const SWIVEL: &str = "swivel";
/// Axes of a shoulder or wrist meet to this, in radians and of the arm's size.
const MEETING: f64 = 1e-3;

/// What the option `free` asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Asked {
    /// Joints, by their places in the chain, ascending.
    pub joints: Vec<usize>,
    /// The swivel, if its angle is to be given.
    pub swivel: Option<Swivel>,
}

impl Asked {
    /// How many numbers are given by it.
    pub(crate) fn count(&self) -> usize {
        self.joints.len() + usize::from(self.swivel.is_some())
    }
}

/// The joints that stay free, and why these.
#[derive(Clone, Debug, PartialEq)]
pub struct Redundancy {
    /// Their places in the chain, ascending; one parameter for each.
    pub joints: Vec<usize>,
    /// The swivel, if its angle is a parameter, behind those.
    pub swivel: Option<Swivel>,
    /// Whether the turn of the tool about the tip's z axis is a parameter, behind those.
    /// The closed form is then one for whole poses.
    pub turn: bool,
    /// What of targets counts.
    pub target: Target,
    /// What they were chosen from, the best first; empty where they were asked for.
    pub weighed: Vec<Weighed>,
}

impl Redundancy {
    /// How many numbers are given beside a target.
    pub fn parameters(&self) -> usize {
        self.joints.len() + usize::from(self.swivel.is_some()) + usize::from(self.turn)
    }
}

/// A set of joints that could stay free.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighed {
    /// Their places in the chain, ascending.
    pub joints: Vec<usize>,
    /// What all branches of the cheapest of the first plans for the others cost, by
    /// [`expr::inverse::weight`]; none if there is none.
    pub weight: Option<usize>,
}

/// The joints that the option `free` names, or the swivel.
///
/// # Errors
///
/// What is wrong with a name, or with how many there are.
pub fn named(
    spec: &ArmSpec,
    model: &Model,
    target: Target,
    names: &[String],
) -> Result<Asked, Diagnostics> {
    let mut joints = Vec::new();
    let mut swivel = None;
    let fail = |reason: String, remedy: String| {
        Diagnostics::one(&spec.source.path, Diagnostic::whole(reason, remedy))
    };
    for name in names {
        let is_joint = spec.joints.iter().any(|joint| joint.name == *name);
        if name == SWIVEL && !is_joint {
            let found = Swivel::of(model, MEETING)
                .ok_or_else(|| fail(no_swivel(model), NO_SWIVEL.into()))?;
            swivel = Some(found);
            continue;
        }
        let joint =
            named_one(spec, model, name).map_err(|(reason, remedy)| fail(reason, remedy))?;
        if joints.contains(&joint) {
            let reason = format!("the option `free` names the joint `{name}` twice");
            return Err(fail(reason, "name every joint once".into()));
        }
        joints.push(joint);
    }
    let (n, coordinates) = (model.variables.len(), coordinates(model, target));
    let most = n.saturating_sub(coordinates);
    let count = joints.len() + usize::from(swivel.is_some());
    if count > most {
        let of = match coordinates == target.coordinates() {
            true => format!("coordinates of {}", target.phrase()),
            false if target == Target::Pose => "independent ways in which they move the tip".into(),
            false => format!("independent ways in which they change {}", target.phrase()),
        };
        let reason = format!(
            "the option `free` names {}, and {n} joints have {most} more than the {coordinates} {of}",
            counted(count),
        );
        let remedy = match most {
            0 => "leave out `free`, or choose a `target` of fewer coordinates".into(),
            _ => format!("name {} at most", counted(most)),
        };
        return Err(fail(reason, remedy));
    }
    joints.sort_unstable();
    Ok(Asked { joints, swivel })
}

/// How many coordinates of its targets an arm can choose at once: as many as there are independent
/// ways in which the joints change them. One at least: joints that change nothing are refused for
/// that, and not given one and all.
fn coordinates(model: &Model, target: Target) -> usize {
    match model.is_coupled() {
        true => target.coordinates(),
        false => rank(model, target).clamp(1, target.coordinates()),
    }
}

/// Whether joints are given beside a target: because they are asked for, or because fewer can choose
/// as much. Two neighbours that turn about one line are rather a slip in the file, and not passed
/// over unless they have to be.
pub fn is_redundant(model: &Model, target: Target, asked: &Asked) -> bool {
    let n = match model.is_coupled() {
        true => model.variables.len(),
        false => model.joints.len(),
    };
    let turns_twice = || alike(model).any(|i| model.joints[i].kind == JointKind::Revolute);
    asked.count() > 0
        || n > target.coordinates()
        || n > coordinates(model, target) && !turns_twice()
}

/// What to do without a swivel angle.
const NO_SWIVEL: &str = "name a joint in `free`, or leave it out";

/// Why an arm has no swivel angle.
fn no_swivel(model: &Model) -> String {
    format!(
        "a swivel angle is that of seven joints that turn, of which the first three and the last \
         three meet in a point each; from `{}` to `{}` this is {}",
        model.base,
        model.tip,
        structure(model)
    )
}

fn counted(joints: usize) -> String {
    match joints {
        1 => "1 joint".into(),
        n => format!("{n} joints"),
    }
}

/// The place of a joint in the chain, or what is wrong with it and what to do.
fn named_one(spec: &ArmSpec, model: &Model, name: &str) -> Result<usize, (String, String)> {
    let known: Vec<&str> = model
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    if let Some(place) = model.joints.iter().position(|joint| joint.name == name) {
        let variable = &model.variables[model.joints[place].variable].name;
        if variable != name {
            let reason = format!("the joint `{name}` mimics `{variable}`, and cannot stay free");
            return Err((reason, "name a joint that mimics none in `free`".into()));
        }
        return Ok(place);
    }
    let (base, tip) = (&model.base, &model.tip);
    let reason = match spec.joints.iter().find(|joint| joint.name == name) {
        Some(joint) if joint.kind == JointType::Fixed => {
            format!("the joint `{name}` is fixed, and cannot stay free")
        }
        Some(_) => format!("the joint `{name}` is not between `{base}` and `{tip}`"),
        None => format!("there is no joint `{name}` to stay free"),
    };
    let listed: Vec<&str> = name.split(',').map(str::trim).collect();
    let remedy = match listed.len() > 1 && listed.iter().all(|part| known.contains(part)) {
        true => format!("name each by itself: `free = {listed:?}`, or `--free` once for each"),
        false => did_you_mean(name, &known),
    };
    Err((reason, remedy))
}

/// Finds and verifies a closed form of an arm with more joints than its targets have
/// coordinates. Of the joints that may stay free, those are taken whose plan needs the
/// fewest operations, of an arm off its design first those at the ends of the chain, of positions
/// those that leave joints which reach far, and of these the last; where no others have a plan,
/// those at an end that leave the best polynomial between them.
///
/// # Errors
///
/// Why there is none.
pub fn solve_redundant(
    model: &Model,
    linkage: &Linkage,
    target: Target,
    asked: &Asked,
) -> Result<(Certified, Redundancy), NoClosedForm> {
    if model.is_coupled() {
        return Err(NoClosedForm::Mimic(Coupled::Redundant));
    }
    let wanted = Wanted::new(model, target, asked);
    match wanted.by_swivel(model, linkage, asked) {
        Some(found) => found,
        None => wanted.by_joints(model, linkage, &asked.joints),
    }
}

/// What is given beside a target, and what is left to be solved.
struct Wanted {
    /// What of targets counts.
    aim: Target,
    /// Whether the turn of the tool is given.
    turn: bool,
    /// What counts of what is left.
    target: Target,
    /// How many joints are given, or the swivel.
    count: usize,
}

impl Wanted {
    fn new(model: &Model, aim: Target, asked: &Asked) -> Self {
        let excess = model.joints.len() - coordinates(model, aim);
        // Of a target that leaves the turn of the tool free, that is a parameter before any
        // joint is, if the joints turn it, and what is left to be solved are whole poses.
        let turn = aim == Target::PositionAxis
            && asked.count() < excess
            && coordinates(model, Target::Pose) > coordinates(model, aim);
        Self {
            aim,
            turn,
            target: if turn { Target::Pose } else { aim },
            count: excess - usize::from(turn),
        }
    }

    fn redundancy(&self, joints: Vec<usize>, swivel: Option<Swivel>) -> Redundancy {
        Redundancy {
            joints,
            swivel,
            turn: self.turn,
            target: self.aim,
            weighed: Vec::new(),
        }
    }

    /// With the swivel given, if it is asked for, or none is and it solves the arm at best; none
    /// otherwise.
    fn by_swivel(
        &self,
        model: &Model,
        linkage: &Linkage,
        asked: &Asked,
    ) -> Option<Result<(Certified, Redundancy), NoClosedForm>> {
        let may_be = asked.joints.is_empty() && self.count == 1 && self.target == Target::Pose;
        let swivel = asked.swivel.or_else(|| {
            // Off its design an arm is solved faster, and loses less, with a joint at an end given.
            let unmoved = linkage.scalar.tolerances().unmoved;
            may_be.then(|| Swivel::of(model, unmoved)).flatten()
        })?;
        let linkage = linkage.clone().with_swivel(Some(swivel));
        let is_asked = asked.swivel.is_some();
        match solve(model, &linkage, self.target) {
            Ok(found) if is_asked || found.certificate.is_complete() && found.form.is_exact() => {
                Some(Ok((found, self.redundancy(Vec::new(), Some(swivel)))))
            }
            Err(reason) if is_asked => Some(Err(NoClosedForm::Free {
                joints: vec![SWIVEL.into()],
                reason: Box::new(reason),
            })),
            _ => None,
        }
    }

    /// With the joints given that are asked for, and the best of those that may be beside them.
    fn by_joints(
        &self,
        model: &Model,
        linkage: &Linkage,
        asked: &[usize],
    ) -> Result<(Certified, Redundancy), NoClosedForm> {
        let given = with_repeated(model, asked, self.count);
        let n = model.joints.len();
        let choices = choices(n, self.count, &given);
        let weighed = match choices.iter().flatten().collect::<Vec<_>>()[..] {
            [only] => vec![Weighed {
                joints: only.clone(),
                weight: None,
            }],
            _ => weigh(model, linkage, self.target, choices),
        };
        let mut found = Vec::new();
        let mut refusal = None;
        let chosen = weighed.iter().map(|choice| &choice.joints);
        // Where none of these is solved, the rest may be.
        let rest = all(n, self.count, asked).unwrap_or_default();
        let rest = rest
            .iter()
            .filter(|joints| chosen.clone().all(|it| it != *joints));
        for (joints, is_rest) in chosen
            .clone()
            .map(|it| (it, false))
            .chain(rest.map(|it| (it, true)))
        {
            if is_rest && !found.is_empty() {
                break;
            }
            match solve(model, &linkage.clone().with_locked(joints), self.target) {
                Ok(certified) => {
                    let Certified { form, certificate } = &certified;
                    let is_good = match form.completion() {
                        Completion::Unanswered => false,
                        _ => certificate.is_complete(),
                    };
                    // An elimination looks for solutions of each infinite family, if it is asked.
                    let may_be_better = !form.asks_elimination() && found.len() + 1 < SOLVED;
                    let is_last = certificate.lost == 0 && (is_good || !may_be_better);
                    found.push((certified, joints.clone()));
                    if is_last {
                        break;
                    }
                }
                Err(reason) => {
                    let name = |&joint: &usize| model.joints[joint].name.clone();
                    refusal.get_or_insert(match joints[..] {
                        [] => reason,
                        _ => NoClosedForm::Free {
                            joints: joints.iter().map(name).collect(),
                            reason: Box::new(reason),
                        },
                    });
                }
            }
        }
        let quality = |it: &Certified| {
            let is_completed = it.form.completion() == Completion::Unanswered;
            (it.certificate.missing(), is_completed)
        };
        let best = found.into_iter().min_by_key(|(it, _)| quality(it));
        let Some((found, joints)) = best else {
            return Err(refusal.unwrap_or(NoClosedForm::Redundant(self.target)));
        };
        let mut redundancy = self.redundancy(joints, None);
        if asked.len() != self.count {
            redundancy.weighed = weighed;
        }
        Ok((found, redundancy))
    }
}

/// Joints that are asked for, and those that have to be given in any case: of neighbours that do the
/// same all but one.
fn with_repeated(model: &Model, asked: &[usize], count: usize) -> Vec<usize> {
    let mut given = asked.to_vec();
    let alike: Vec<usize> = alike(model).collect();
    for run in alike.chunk_by(|a, b| a + 1 == *b) {
        let run = run[0]..run[0] + run.len() + 1;
        let mut left: Vec<usize> = run.filter(|joint| !asked.contains(joint)).collect();
        left.pop();
        given.extend(left);
    }
    given.truncate(count);
    given
}

/// The choices of the first row that has any with a plan, the best first; without a plan in any
/// row, those of the first.
fn weigh(
    model: &Model,
    linkage: &Linkage,
    target: Target,
    rows: Vec<Vec<Vec<usize>>>,
) -> Vec<Weighed> {
    let first = rows[0].clone();
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
/// its design those come first beside whose branches an elimination can be asked.
fn planned(
    model: &Model,
    linkage: &Linkage,
    target: Target,
    choices: Vec<Vec<usize>>,
) -> (Vec<Weighed>, Vec<Vec<usize>>) {
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
        if !weighed.is_empty() {
            break;
        }
    }
    let is_noisy = shift >= linkage.unmoved(target);
    let is_dear = |joints: &[usize]| is_noisy && !leaves_row(linkage, joints);
    let reach: Vec<f64> = weighed
        .iter()
        .map(|choice| swept(model, &choice.joints, target))
        .collect();
    let most = reach.iter().copied().fold(0.0, f64::max);
    let mut each: Vec<(Weighed, f64)> = weighed.into_iter().zip(reach).collect();
    let preference = |(choice, reach): &(Weighed, f64)| {
        let joints = &choice.joints;
        let little = *reach < WIDE * most;
        (
            is_dear(joints),
            little,
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
        each[..alike].sort_by(|(a, _), (b, _)| b.joints.cmp(&a.joints));
    }
    let weighed = each.into_iter().map(|(choice, _)| choice).collect();
    (weighed, left)
}

/// Whether plans cost about as much as the cheapest.
pub fn costs_as_much(weight: Option<usize>, least: Option<usize>) -> bool {
    let both = weight.zip(least);
    both.is_some_and(|(weight, least)| ALIKE * weight.saturating_sub(least) < least)
}

/// How much of space the joints that are not locked sweep, where these are to bring the tip to a
/// position and most joints are given: whatever those are, the target should be in reach. Otherwise
/// as much as any.
fn swept(model: &Model, locked: &[usize], target: Target) -> f64 {
    if target != Target::Position || locked.len() < 2 {
        return 1.0;
    }
    let chain = model.chain();
    let volume = |q: &Vec<f64>| {
        let columns = chain.geometric_jacobian(q).into_iter().enumerate();
        let solved = columns.filter(|(joint, _)| !locked.contains(joint));
        let moves: Vec<[f64; 3]> = solved.map(|(_, column)| column.linear).collect();
        match moves[..] {
            [a, b, c] => dot(a, cross(b, c)).abs(),
            _ => 1.0,
        }
    };
    let tried = configurations(model);
    tried.iter().take(TRIED).map(volume).sum()
}

/// How many of these joints, from the first of the chain on, carry the others: all but one, since an
/// arm of seven joints is solved as if it stood alone, and that one too if they are a rail, the
/// slides of a gantry, or the slides and the turn of a platform, or an arm that carries the wrist
/// which orients the tip; of positions these slides alone. Whoever stands an arm on these means to say
/// where they are.
pub fn carriers(model: &Model, target: Target, joints: &[usize]) -> usize {
    let is_slide = |joint: &&Joint| joint.kind == JointKind::Prismatic;
    let slides = model.joints.iter().take_while(is_slide).count();
    let platform = slides + usize::from(slides == 2);
    let most = match target {
        Target::Orientation => joints.len(),
        Target::Position => platform,
        _ => platform.max(joints.len().saturating_sub(1)),
    };
    let from_first = joints.iter().zip(0..).take_while(|(joint, i)| *joint == i);
    from_first.take(most).count()
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
    // Of equals the last in the order of the joints comes first, as of those with a plan.
    rows.sort_by(|a, b| {
        let by_quality = a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal);
        by_quality.then_with(|| b.1.cmp(&a.1))
    });
    rows.sort_by_key(|(_, joints)| Reverse(carriers(model, Target::Pose, joints)));
    let weighed = rows.into_iter().map(|(_, joints)| Weighed {
        joints,
        weight: None,
    });
    weighed.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::Source;

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
        // Turntables, slides within, and what a rail carries.
        assert_eq!(carried_by("ttttttt", &[0]), 0);
        assert_eq!(carried_by("tstttttt", &[1]), 0);
        assert_eq!(carried_by("stttttt", &[1]), 0);
        assert_eq!(carried_by("tttttt", &[]), 0);
    }

    /// Whatever the wrist is given, the joints before it reach most positions; a wrist alone reaches
    /// few, though its plan takes no more.
    #[test]
    fn a_position_is_reached_by_the_joints_before_the_wrist() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
        let six = ["ur5e.urdf", "kr6_r900.yaml", "xarm6.yaml", "stanford.yaml"];
        let six = six.map(|file| (file, vec![3, 4, 5]));
        // The first joint would make the cheapest plan.
        for (file, wrist) in six.into_iter().chain([("planar_3r.yaml", vec![2])]) {
            let source = Source::read(file, &root).unwrap();
            let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
            let linkage = Linkage::for_target(&model, Target::Position);
            let asked = Asked::default();
            let found = solve_redundant(&model, &linkage, Target::Position, &asked);
            assert_eq!(found.unwrap().1.joints, wrist, "{file}");
        }
    }
}
