//! How a mechanism can move, and whether its actuators make it.

use super::Mechanism;
use crate::spec::{Diagnostic, Diagnostics, MechanismSpec, Source};

/// How a mechanism can move.
#[derive(Clone, Debug, PartialEq)]
pub struct Freedom {
    /// The dimension of the smallest group that holds all joints' motions: 3
    /// in a plane or about a point, 6 in general.
    pub dimension: usize,
    /// By Grübler's formula for motions of that dimension.
    pub gruebler: isize,
    /// By the rank of the structure equation's Jacobian.
    pub mobility: usize,
    /// Of these, motions of the platform; the others are idle.
    pub platform: usize,
    /// Closed configurations: home, some near it, and some on the ways that
    /// the actuators drive it. Of a platform that translates, those at which it is not turned:
    /// there may be others close by, in modes in which it turns.
    pub samples: Vec<Vec<f64>>,
    /// Whether the platform does not turn while the actuators drive it from home.
    pub translates: bool,
    /// By how much the platform turns, radians, where that is so little that it is not meant to.
    pub barely_turns: Option<f64>,
    /// By how much a motion is lost at home, relative to what constrains the joints, where that is so
    /// little that it is not meant to be.
    pub barely_lost: Option<f64>,
}

/// Steps of a drive away from home, and how many drives.
const STEPS: usize = 6;
const DRIVES: usize = 16;

/// This part of a drive away from home, by how far home is from an actuator singularity, does not
/// lead into another mode.
const NEAR: f64 = 0.1;

/// Below this the actuators are not in charge.
const SINGULAR: f64 = 1e-3;

/// A platform that turns by less, radians, does not.
const UPRIGHT: f64 = 1e-9;

/// What is rounded to few digits turns by less, radians, where it would not.
const NOISE: f64 = 1e-4;

/// Motions that are lost by so little, relative to the rest, are lost to few digits; by less they are
/// not.
const BARELY: f64 = 1e-4;
const EXACT: f64 = 1e-13;

impl Freedom {
    /// Counts freedoms at home and nearby.
    pub fn of(mechanism: &Mechanism) -> Self {
        let generic = mechanism.generic();
        let home = vec![0.0; generic.joints()];
        let mut samples = generic.neighbours();
        samples.push(home.clone());
        for k in 0..DRIVES {
            samples.extend(drive(&generic, &home, k));
        }
        let is_upright = |q: &Vec<f64>| is_upright(mechanism, q);
        // What is so next to home, a regular configuration, is so in all of its mode, which is
        // analytic.
        let regular = generic.actuator_singularity(&home);
        let near = |k: usize| generic.fk_near(&goal(&generic, &home, k, NEAR * regular), &home);
        let near = (0..DRIVES).map(|k| near(k).map_or(f64::INFINITY, |q| turned(mechanism, &q)));
        let all = samples.iter().map(|q| turned(mechanism, q));
        let most = match regular > SINGULAR {
            true => near.fold(0.0, f64::max),
            false => all.clone().fold(0.0, f64::max),
        };
        // Elsewhere it may be in a mode in which it turns, but not by as little as rounding.
        let barely = all.filter(|turned| *turned < NOISE).fold(0.0, f64::max);
        let translates = most.max(barely) < UPRIGHT;
        let barely_turns = (!translates && most < NOISE).then_some(most.max(barely));
        if translates {
            samples.retain(is_upright);
        }
        // A chain that is singular, as home may have one, holds the platform the more.
        let mobilities: Vec<usize> = samples.iter().map(|q| generic.mobility_at(q)).collect();
        let mobility = mobilities.iter().copied().min().unwrap_or(0);
        let regular = samples.iter().zip(&mobilities);
        let regular = regular.filter(|(_, here)| **here == mobility);
        let freedoms = regular.map(|(q, _)| generic.platform_freedom(q));
        let platform = freedoms.max().unwrap_or(0);
        let dimension = generic.motion_dimension();
        Freedom {
            dimension,
            gruebler: generic.gruebler(dimension),
            mobility,
            platform,
            samples,
            translates,
            barely_turns,
            barely_lost: barely_lost(&generic),
        }
    }

    /// Whether nothing is to be refused, and neither a motion nor an orientation is lost to rounding.
    pub(super) fn is_sound(&self, mechanism: &Mechanism, spec: &MechanismSpec) -> bool {
        let is_rounded = self.barely_turns.is_some() || self.barely_lost.is_some();
        !is_rounded && self.check(mechanism, spec).is_ok()
    }

    /// Refuses what cannot move, or not as its actuators want.
    ///
    /// # Errors
    ///
    /// The mechanism is immobile, redundant, under-actuated or over-actuated.
    pub fn check(&self, mechanism: &Mechanism, spec: &MechanismSpec) -> Result<(), Diagnostics> {
        let generic = mechanism.generic();
        let actuated = mechanism.actuated().len();
        let moves = |n: usize| {
            if n == 1 {
                "1 way".into()
            } else {
                format!("{n} ways")
            }
        };
        let (reason, remedy) = if self.mobility == 0 || !generic.is_mobile() {
            (
                format!(
                    "the mechanism is immobile: its {} joints lose all their freedom to the loops \
                     (Grübler's formula gives {})",
                    mechanism.joints(),
                    self.gruebler
                ),
                self.precisely()
                    .unwrap_or_else(|| "check axes and points; a joint may be missing".to_owned()),
            )
        } else if self.platform == 0 {
            (
                "the platform cannot move: all that the joints can do is idle".to_owned(),
                "choose as platform the link that is to be moved".to_owned(),
            )
        } else if actuated < self.platform {
            (
                format!(
                    "the mechanism is under-actuated: the platform can move in {}, and {actuated} \
                     of its joints {} actuated",
                    moves(self.platform),
                    if actuated == 1 { "is" } else { "are" }
                ),
                spec.topology.actuate(&joints(self.platform)),
            )
        } else if actuated > self.platform && actuated <= self.mobility {
            (
                format!(
                    "the mechanism is redundant: it moves in {}, of which {} the platform at rest, \
                     and such mechanisms are not solved",
                    moves(self.mobility),
                    match self.mobility - self.platform {
                        1 => "1 leaves".into(),
                        n => format!("{n} leave"),
                    }
                ),
                self.precisely().unwrap_or_else(|| {
                    format!(
                        "leave out {} that can move while the platform rests, and {}",
                        joints(self.mobility - self.platform),
                        spec.topology.actuate(&joints(self.platform))
                    )
                }),
            )
        } else if actuated > self.platform {
            (
                format!(
                    "the mechanism is over-actuated: the platform can move in {}, and {actuated} \
                     joints are actuated, whose values cannot be chosen independently",
                    moves(self.platform)
                ),
                spec.topology.actuate(&joints(self.platform)),
            )
        } else if self
            .samples
            .iter()
            .all(|q| generic.actuator_singularity(q) < 1e-6)
        {
            (
                "the mechanism is under-actuated: with the actuated joints locked the platform can \
                 still move, everywhere"
                    .to_owned(),
                "actuate other joints; those that are marked do not determine the platform"
                    .to_owned(),
            )
        } else {
            return Ok(());
        };
        Err(refuse(mechanism, &spec.source, reason, remedy))
    }

    /// What to do where a motion is lost to rounding.
    fn precisely(&self) -> Option<String> {
        let lost = self.barely_lost?;
        Some(format!(
            "a motion is lost by {lost:.0e}, as where axes that are meant to be parallel or to meet \
             are so but for rounding: give axes and points with all digits, twelve behind the point"
        ))
    }

    /// What is told of a platform that turns by so little that it is not meant to.
    pub(super) fn warning(&self, mechanism: &Mechanism, source: &Source) -> Option<Diagnostic> {
        let turned = self.barely_turns?;
        let reason = format!(
            "the platform turns by {turned:.0e} rad, as where rounding turns one that is not meant \
             to: it is not solved as one that keeps its orientation"
        );
        let remedy = "give axes and points with all digits, twelve behind the point, if it is to \
                      keep its orientation";
        Some(Diagnostic::at(mechanism.at, source, reason, remedy).warning())
    }
}

fn joints(n: usize) -> String {
    match n {
        1 => "one joint".into(),
        n => format!("{n} joints"),
    }
}

/// A diagnostic about the mechanism as a whole, where the file introduces it.
fn refuse(
    mechanism: &Mechanism,
    source: &Source,
    reason: impl Into<String>,
    remedy: impl Into<String>,
) -> Diagnostics {
    let diagnostic = Diagnostic::at(mechanism.at, source, reason, remedy);
    Diagnostics::one(&source.path, diagnostic)
}

/// Whether the platform is turned as it is at home.
pub(super) fn is_upright(mechanism: &Mechanism, q: &[f64]) -> bool {
    turned(mechanism, q) < UPRIGHT
}

/// By how much the platform is turned from home, radians.
fn turned(mechanism: &Mechanism, q: &[f64]) -> f64 {
    let poses = mechanism.generic().poses(q);
    poses[0].rotation_distance(&mechanism.home())
}

/// By how much a motion is lost at home that is not meant to be.
fn barely_lost(generic: &kin_runtime::Mechanism) -> Option<f64> {
    let values = generic.structure(&vec![0.0; generic.joints()]);
    let largest = values.first()?;
    let mut lost = values.iter().map(|value| value / largest);
    lost.find(|lost| (EXACT..BARELY).contains(lost))
}

/// The actuators' values a part of the way to where a drive ends.
fn goal(generic: &kin_runtime::Mechanism, home: &[f64], k: usize, part: f64) -> Vec<f64> {
    let twists = generic.twists(home);
    let actuated = generic.actuated().iter().enumerate();
    let value = |(i, &joint): (usize, &usize)| {
        let slides = twists[joint].angular == [0.0; 3];
        let reach = if slides { 0.15 * generic.length() } else { 0.6 };
        part * reach * (1.3 + 2.1 * k as f64 + 4.7 * i as f64).sin()
    };
    actuated.map(value).collect()
}

/// Closed configurations while the actuators go from home to some values, as
/// far as the loops stay closed and the actuators in charge.
fn drive(generic: &kin_runtime::Mechanism, home: &[f64], k: usize) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    let mut q = home.to_vec();
    for step in 1..=STEPS {
        let values = goal(generic, home, k, step as f64 / STEPS as f64);
        match generic.fk_near(&values, &q) {
            Some(next) if generic.actuator_singularity(&next) > SINGULAR => q = next,
            _ => break,
        }
        found.push(q.clone());
    }
    found
}
