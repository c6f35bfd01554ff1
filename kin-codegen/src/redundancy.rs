//! Arms with more joints than their targets have coordinates: which joints are given
//! with the target, so that the others have isolated solutions.

mod choices;
mod named;
mod weighed;

use crate::geometry::{
    Linkage, Swivel, by_coordinates, coupled_rank, rank, uncoupled, uncoupled_behind,
};
use crate::model::Model;
use crate::plan::Target;
use crate::solver::{Certified, Coupled, NoClosedForm, alike, solve, solve_uncoupled};
use choices::{all, choices};
use kin_runtime::__private::Completion;
pub use named::{SWIVEL, named};
use weighed::weigh;
pub use weighed::{Weighed, carriers, costs_as_much};

/// Of so many singular targets one may be without a solution where the swivel angle is given: one at which
/// the elbow is off the line of shoulder and wrist by no more than their axes are off meeting.
const SELDOM: usize = 100;
/// Choices that are solved in search of one that has a solution at every singular target.
const SOLVED: usize = 8;

/// What the option `free` asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Asked {
    /// Joints, by the coordinates that they are, ascending.
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
    /// The coordinates that they are, ascending; one parameter for each.
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

/// How many coordinates of its targets an arm can choose at once: as many as there are independent
/// ways in which the joints change them. One at least: joints that change nothing are refused for
/// that, and not given one and all.
fn coordinates(model: &Model, target: Target) -> usize {
    let all = target.coordinates();
    if !model.is_coupled() {
        return rank(model, target).clamp(1, all);
    }
    if let Some(own) = by_coordinates(model) {
        return coordinates(&own, target);
    }
    let uncoupled = uncoupled(model).ok();
    let rank = uncoupled.and_then(|(model, linkage)| {
        let coupling = linkage.coupling?;
        Some(coupled_rank(&model, &coupling, target))
    });
    rank.unwrap_or(all).clamp(1, all)
}

/// Whether joints are given beside a target: because they are asked for, or because fewer can choose
/// as much. Two neighbours that turn about one line are rather a slip in the file, and not passed
/// over unless they have to be.
pub fn is_redundant(model: &Model, target: Target, asked: &Asked) -> bool {
    if model.is_coupled()
        && let Some(model) = by_coordinates(model)
    {
        return is_redundant(&model, target, asked);
    }
    let n = model.variables.len();
    let turns_twice = || !model.is_coupled() && alike(model).any(|i| model.joints[i].is_revolute());
    asked.count() > 0
        || n > target.coordinates()
        || n > coordinates(model, target) && !turns_twice()
}

/// Finds and verifies a closed form of an arm with more joints than its targets have
/// coordinates. Of the joints that may stay free, those are taken that leave joints which sweep much
/// of the space of targets, of an arm off its design first those at the ends of the chain, and of these
/// those whose plan needs the fewest operations, and the last; where no others have a plan,
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
        let Some(model) = by_coordinates(model) else {
            return solve_carried(model, target, asked);
        };
        let linkage = Linkage::new(&model);
        let asked = with_geared(&model, target, asked)?;
        return solve_redundant(&model, &linkage, target, &asked);
    }
    let wanted = Wanted::new(model, target, asked);
    match wanted.by_swivel(model, linkage, asked) {
        Some(found) => found,
        None => wanted.by_joints(model, linkage, &asked.joints),
    }
}

/// The same of an arm whose joints mimic others, as many in front as are to spare: these are given.
fn solve_carried(
    model: &Model,
    target: Target,
    asked: &Asked,
) -> Result<(Certified, Redundancy), NoClosedForm> {
    let refused = NoClosedForm::Mimic(Coupled::Redundant);
    let count = model.variables.len() - coordinates(model, target);
    let is_in_front = |i: &usize| *i < count;
    if count > carrying(model) || asked.swivel.is_some() || !asked.joints.iter().all(is_in_front) {
        return Err(refused);
    }
    let uncoupled = uncoupled_behind(model, count);
    let (model, linkage) = uncoupled.map_err(|reason| NoClosedForm::Mimic(reason.into()))?;
    // Where those behind do not move by themselves all that is left, others are to spare.
    let certified = solve_uncoupled(&model, &linkage, target).map_err(|reason| match reason {
        NoClosedForm::Singular { .. } => refused,
        other => other,
    })?;
    let redundancy = Redundancy {
        joints: (0..count).collect(),
        swivel: None,
        turn: false,
        target,
        weighed: Vec::new(),
    };
    Ok((certified, redundancy))
}

/// How many joints in front mimic none and are mimicked by none.
fn carrying(model: &Model) -> usize {
    let is_alone = |i: &usize| {
        let others = model.joints.iter().filter(|it| it.variable == *i);
        model.joints[*i].is_coordinate(*i) && others.count() == 1
    };
    (0..model.joints.len()).take_while(is_alone).count()
}

/// What is asked for, and slides that are never solved for.
fn with_geared(model: &Model, target: Target, asked: &Asked) -> Result<Asked, NoClosedForm> {
    let mut all = asked.clone();
    let most = Wanted::new(model, target, asked).count;
    for (i, joint) in model.joints.iter().enumerate() {
        if joint.gear != 1.0 && !asked.joints.contains(&i) {
            if all.count() == most {
                return Err(NoClosedForm::Mimic(Coupled::Geared(joint.name.clone())));
            }
            all.joints.push(i);
        }
    }
    all.joints.sort_unstable();
    Ok(all)
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
        let is_good = |found: &Certified| {
            let certificate = &found.certificate;
            found.form.is_exact()
                && certificate.lost == 0
                && SELDOM * certificate.unanswered <= certificate.singular
        };
        match solve(model, &linkage, self.target) {
            Ok(found) if is_asked || is_good(&found) => {
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
