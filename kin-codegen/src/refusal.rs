//! Why a sound robot file has no inverse kinematics, and what its owner can do.

use crate::certificate::Failure;
use crate::compiled::Compiled;
use crate::geometry::{Undetermined, in_words, rank, structure};
use crate::mechanism::{ChainRefusal, UnsolvedChain};
use crate::model::{Joint, JointKind, Model};
use crate::plan::Target;
use crate::solver::{Coupled, Lack, NoClosedForm};
use crate::spec::{Diagnostic, Source, list_names, one_line};
use std::fmt;

/// A robot without closed-form inverse kinematics.
#[derive(Clone, Debug)]
pub struct Refusal {
    /// The robot with what it has: forward kinematics and Jacobians.
    pub robot: Compiled,
    /// Why there is no more.
    pub reason: Reason,
    /// What was compiled.
    pub(crate) source: Source,
}

/// Why there is no inverse kinematics.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// Of an arm.
    Arm(NoClosedForm),
    /// A chain of a mechanism cannot be solved.
    Chain(UnsolvedChain),
}

impl Refusal {
    /// As a compiler's message.
    pub fn diagnostic(&self) -> Diagnostic {
        let noisy = "write right angles and half turns with all their digits (1.5707963267948966), or \
                     leave out `target`; `ik = none` generates forward kinematics and Jacobians alone";
        let remedy = match &self.reason {
            Reason::Arm(NoClosedForm::Singular { .. }) => {
                "check axes and origins; a joint that repeats another must be fixed, left out of \
                 the chain by another base or tip, or stay free (`free`). `ik = none` generates \
                 forward kinematics and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Mimic(Coupled::Undetermined(Undetermined::Range(_)))) => {
                "give it limits that are less than a full turn of the joints apart; `ik = none` generates forward \
                 kinematics and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Mimic(Coupled::Geared(_))) => {
                "name it in `free`, or leave that out; `ik = none` generates forward kinematics and \
                 Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Mimic(_)) => {
                "name a link in front of the joints that mimic others as the tip, or one behind them as \
                 the base, if the arm ends there; `ik = none` generates forward kinematics and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Tilted { .. }) => {
                "leave out `target`, or choose `position` or `position_axis`; `ik = none` \
                 generates forward kinematics and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Unturned(_)) => {
                "leave out `target`, or choose `position`; `ik = none` generates forward kinematics \
                 and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Lifting { .. }) => {
                "leave out `target`, or choose `position`; `ik = none` generates forward kinematics and \
                 Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Noisy) => noisy,
            Reason::Arm(NoClosedForm::Free { reason, .. }) if **reason == NoClosedForm::Noisy => {
                noisy
            }
            Reason::Arm(NoClosedForm::Uncertified {
                failure: Failure::NearSingular(_),
                ..
            }) => {
                "write right angles and half turns with all their digits (1.5707963267948966), if the file \
                 rounds them; `ik = none` generates forward kinematics and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Redundant(_)) => {
                "name joints that stay free, one for each coordinate too many, with `free`"
            }
            Reason::Arm(NoClosedForm::OnlyInDouble(_)) => {
                "leave out `scalar = f32`; with it, `ik = none` generates forward kinematics and \
                 Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Free { reason, .. }) if self.moves_nothing(reason) => {
                "choose another `target`: no joint of this chain changes what counts of this one. `ik = \
                 none` generates forward kinematics and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Free { reason, .. }) if self.takes_a_turn(reason) => {
                "name one joint less by `free`: the turn of the tool about its axis is given in its \
                 place; or let others stay free, those at an end of the chain first. `ik = none` \
                 generates forward kinematics and Jacobians alone"
            }
            Reason::Arm(NoClosedForm::Free { .. }) => {
                "let other joints stay free by `free`, those at an end of the chain first; `ik = none` \
                 generates forward kinematics and Jacobians alone"
            }
            _ => "`ik = none` generates forward kinematics and Jacobians alone",
        };
        match (&self.robot, &self.reason) {
            (Compiled::Mechanism(compiled), _) => {
                let at = compiled.mechanism.at;
                Diagnostic::at(at, &self.source, self.text(), remedy)
            }
            (Compiled::Arm(_), _) => Diagnostic::whole(self.text(), remedy),
        }
    }

    /// Whether none of the arm's joints, given ones with them, changes what counts of a target.
    fn moves_nothing(&self, reason: &NoClosedForm) -> bool {
        let NoClosedForm::Singular { target, .. } = reason else {
            return false;
        };
        let arm = self.robot.arm().filter(|arm| !arm.model.is_coupled());
        arm.is_some_and(|arm| rank(&arm.model, *target) == 0)
    }

    /// Whether the turn of the tool could be given in place of one of the joints that are.
    fn takes_a_turn(&self, reason: &NoClosedForm) -> bool {
        let (NoClosedForm::NoPlan(target) | NoClosedForm::Singular { target, .. }) = reason else {
            return false;
        };
        let arm = self.robot.arm().filter(|arm| !arm.model.is_coupled());
        let turns = |model| rank(model, Target::Pose) > rank(model, Target::PositionAxis);
        *target == Target::PositionAxis && arm.is_some_and(|arm| turns(&arm.model))
    }

    /// Why, in a sentence.
    pub fn text(&self) -> String {
        one_line(&self.sentence())
    }

    fn sentence(&self) -> String {
        match (&self.robot, &self.reason) {
            (Compiled::Arm(arm), Reason::Arm(reason)) => no_closed_form(&arm.model, reason),
            (Compiled::Mechanism(compiled), Reason::Chain(UnsolvedChain { number, reason })) => {
                let leg = &compiled.mechanism.legs[*number];
                let why = match reason {
                    ChainRefusal::NoClosedForm(reason) => no_closed_form(&leg.model, reason),
                    ChainRefusal::Lost(q) => {
                        format!("its configuration {q:.4?} is not among the solutions")
                    }
                };
                format!("the chain `{}` cannot be solved: {why}", leg.name)
            }
            (_, reason) => unreachable!("{reason:?} is of another robot"),
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostic().write(&self.source.path, f)
    }
}

fn no_closed_form(model: &Model, reason: &NoClosedForm) -> String {
    let n = model.joints.len();
    let why = why(model, reason);
    let joints = if n == 1 { "joint" } else { "joints" };
    format!(
        "no closed-form inverse kinematics for the {n} {joints} from `{}` to `{}`: {why}",
        model.base, model.tip
    )
}

fn why(model: &Model, reason: &NoClosedForm) -> String {
    let n = model.joints.len();
    match reason {
        NoClosedForm::Free { joints, reason } => {
            let joints: Vec<&str> = joints.iter().map(String::as_str).collect();
            format!("with {} free, {}", list_names(&joints), why(model, reason))
        }
        NoClosedForm::OnlyInDouble(lack) => only_in_double(*lack).to_owned(),
        NoClosedForm::Mimic(coupled) => {
            format!("{}{}", mimics(model), why_coupled(model, coupled))
        }
        NoClosedForm::Singular {
            rank,
            target,
            alike,
        } => {
            let alike = alike.as_ref().map_or_else(String::new, |([a, b], kind)| {
                let what = match kind {
                    JointKind::Revolute => "turn about one line",
                    JointKind::Prismatic => "slide along one direction",
                };
                format!("; joints `{a}` and `{b}` {what}")
            });
            let change = match target {
                Target::Pose => "move the tip".to_owned(),
                _ => format!("change {}", target.phrase()),
            };
            format!(
                "they {change} in {} at most, so that the chain is singular in every \
                 configuration{alike}",
                in_words(*rank)
            )
        }
        NoClosedForm::Redundant(target) => format!(
            "{n} joints reach {} in infinitely many ways, and no joint was chosen to stay free",
            target.phrase()
        ),
        NoClosedForm::Noisy => "its axes are off exact relations by the noise of the file, and a \
                                projected target (position_yaw, planar) with joints given beside \
                                it needs them exact"
            .to_owned(),
        NoClosedForm::Tilted {
            target,
            joints: [first, other],
            angle,
        } => format!(
            "`{}` is for arms all of whose joints turn about parallel axes, and those of \
             `{first}` and `{other}` are {:.2}° apart",
            target.word(),
            angle.to_degrees()
        ),
        NoClosedForm::Unturned(target) => format!(
            "`{}` has a turn about the joints' axes, and no joint turns",
            target.word()
        ),
        NoClosedForm::Lifting { joint, angle } => format!(
            "`planar` targets leave the height to an arm whose slides go across its axes, and `{joint}` \
             is {:.2}° from that",
            angle.to_degrees()
        ),
        NoClosedForm::NoPlan(target) => format!(
            "no sequence of the subproblems SP1 to SP6 solves the chain{}: {}",
            aimed_at(*target),
            structure(model)
        ),
        NoClosedForm::Uncertified { plan, failure } => {
            format!("the best plan, {plan}, failed its verification: {failure}")
        }
    }
}

/// Which joints mimic which, as far as one names them.
fn mimics(model: &Model) -> String {
    let followed = |joint: &Joint| model.variables[joint.variable].name.as_str();
    let mut mimics = model.joints.iter().filter(|it| it.name != followed(it));
    let first = mimics.next().map_or_else(String::new, |joint| {
        format!("`{}` mimics `{}`", joint.name, followed(joint))
    });
    match mimics.count() {
        0 => format!("joint {first}, which couples their angles"),
        more => format!("joint {first}, and {more} more mimic others, which couples their angles"),
    }
}

/// Why a chain whose joints mimic each other is not solved.
fn why_coupled(model: &Model, coupled: &Coupled) -> String {
    match coupled {
        Coupled::Undetermined(Undetermined::Coordinate(name)) => {
            format!(", and no joint tells the value of `{name}` from a target")
        }
        Coupled::Undetermined(Undetermined::Range(name)) => format!(
            ", and the limits of `{name}` are so wide that several values of it are one angle of a joint"
        ),
        Coupled::Joints { joints, target } => {
            let coordinates = target.coordinates();
            format!(
                ", and such chains are solved of up to {coordinates} joints, those that mimic others \
                 counted, and those that do the same once: this has {joints}"
            )
        }
        Coupled::Redundant => ", and of a redundant arm only joints in front of all that mimic others or are mimicked can \
             stay free then"
                .into(),
        Coupled::Geared(name) => {
            format!(
                ", and `{name}`, which others slide along with, has to be one of those that stay free"
            )
        }
        Coupled::Unsolved(reason) => {
            format!(
                "; as a chain whose joints move by themselves, {}",
                why(model, reason)
            )
        }
    }
}

/// What the arm asks for that `f32` has not.
fn only_in_double(lack: Lack) -> &'static str {
    match lack {
        Lack::Refinement => {
            "its axes are off exact relations by more than the digits of f32 leave, and branches \
             are refined onto such an arm in f64 alone"
        }
        Lack::Polynomial => {
            "the subproblems do not solve it, and the polynomial that does is for f64 alone: its \
             coefficients take more digits than f32 has"
        }
        Lack::Quartic => "its plan asks for the roots of a quartic, which are there in f64 alone",
        Lack::Parameter => "it is redundant, and what is given beside a target is for f64 alone",
        Lack::Digits => {
            "a step of its plan is ill-conditioned where the arm is regular, and with the digits of \
             f32 solutions are lost there"
        }
    }
}

/// What targets are, unless they are whole poses.
fn aimed_at(target: Target) -> String {
    match target {
        Target::Pose => String::new(),
        other => format!(" for {}", other.phrase()),
    }
}
