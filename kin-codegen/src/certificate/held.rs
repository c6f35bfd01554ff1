//! The arm with its locked joints at some values, and the configurations to try on it.

use super::parameters::SOMEWHERE;
use super::{Failure, REGULAR, alignment, recovered};
use crate::closed_form::BranchSolution;
use crate::geometry::{self, Linkage};
use crate::model::{Model, RANDOM, anywhere, configurations};
use crate::plan::Target;
use crate::random::Random;
use crate::scalar::Scalar;
use kin_runtime::{Chain, Pose};
use std::rc::Rc;

/// Targets that no configuration made, on which only soundness is tried.
const ELSEWHERE: usize = 32;

/// Random configurations beside the few of all arms where digits are few: where a step is
/// ill-conditioned and the arm is not, that may be so in a hundredth of space.
const MORE_IN_SINGLE: usize = 500;

/// The arm with its locked joints at some values: what targets are solved for, and what
/// is singular, are the others.
pub(super) struct Held {
    /// What comes with targets that no configuration made.
    pub parameters: Vec<f64>,
    pub model: Model,
    pub chain: Chain,
    pub all: Vec<Rc<Trial>>,
}

#[derive(Clone)]
pub(super) struct Trial {
    pub q: Vec<f64>,
    /// What comes with the target.
    pub parameters: Vec<f64>,
    pub pose: Pose,
    /// How far from singular.
    pub conditioning: f64,
    /// Whether a step may degenerate: axes that are no neighbours are aligned, or what the plan divides
    /// by is nothing, or nearly.
    pub may_degenerate: bool,
    pub made: Made,
}

/// Where a configuration is.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Made {
    /// Anywhere, by chance.
    Random,
    /// Joints are at multiples of a right angle.
    Round,
    /// Next to such a one, or to a random one.
    Beside,
    /// Where a step of a plan may degenerate.
    Aligned,
}

impl Trial {
    /// Whether it is next to a round configuration, or a step may degenerate: on an idealized
    /// arm near singular it is not tried.
    pub fn is_attack(&self) -> bool {
        matches!(self.made, Made::Beside | Made::Aligned)
    }

    /// The same with a target that has been rounded again, as those that come by a quaternion: what
    /// is left of a sine in the sum that makes an entry is then no more than chance.
    pub fn rounded(&self, random: &mut Random) -> Rc<Self> {
        let mut rounded = |x: f64| x + f64::EPSILON * random.between(-1.0, 1.0);
        Rc::new(Self {
            pose: Pose {
                rotation: self.pose.rotation.map(|row| row.map(&mut rounded)),
                ..self.pose
            },
            ..self.clone()
        })
    }
}

impl Held {
    pub fn new(parameters: Vec<f64>, model: Model, linkage: &Linkage, target: Target) -> Self {
        let coordinates = |all: Vec<Vec<f64>>| -> Vec<Vec<f64>> {
            let all = all.into_iter();
            all.map(|joints| linkage.coordinates_at(joints)).collect()
        };
        let mut round = configurations(&model);
        if linkage.scalar == Scalar::F32 {
            let mut random = Random(0x3c6e_f372_fe94_f82b);
            round.extend((0..MORE_IN_SINGLE).map(|_| anywhere(&model, &mut random)));
        }
        let round = coordinates(round);
        let beside = alignment::neighbours(&round);
        let aligned = coordinates(alignment::aligned(&model, target));
        let nearly = alignment::neighbours(&aligned);
        let mut held = Self {
            parameters: match linkage.swivel {
                Some(_) => vec![SOMEWHERE],
                None => parameters,
            },
            chain: model.chain(),
            model,
            all: Vec::new(),
        };
        let trial = |q, made| held.trial(linkage, target, q, made);
        let first = |i| {
            if i < RANDOM {
                Made::Random
            } else {
                Made::Round
            }
        };
        let round = round.into_iter().enumerate();
        held.all = (round.map(|(i, q)| trial(q, first(i))))
            .chain(beside.into_iter().map(|q| trial(q, Made::Beside)))
            .chain(aligned.into_iter().map(|q| trial(q, Made::Aligned)))
            .chain(nearly.into_iter().map(|q| trial(q, Made::Aligned)))
            .collect();
        let mut random = Random(0x6c62_272e_07bb_0142);
        let exact = held.all.clone();
        let rounded = exact.iter().map(|trial| trial.rounded(&mut random));
        held.all.extend(rounded);
        held
    }

    pub fn trial(&self, linkage: &Linkage, target: Target, q: Vec<f64>, made: Made) -> Rc<Trial> {
        // The joints that are coupled may be singular as such where the coordinates are not.
        let may_degenerate = made == Made::Aligned
            || linkage.coupling.is_some() && {
                let joints = linkage.joints_at(&q);
                geometry::conditioning(&self.chain, &joints, linkage.size, target) < REGULAR
            };
        Rc::new(Trial {
            pose: linkage.scalar.target(self.fk(linkage, &q)),
            conditioning: linkage.conditioning(&self.chain, &q, target),
            parameters: self.parameters(linkage, &q),
            q,
            may_degenerate,
            made,
        })
    }

    /// The pose of the tip.
    pub fn fk(&self, linkage: &Linkage, q: &[f64]) -> Pose {
        self.chain.fk(&linkage.joints_at(q))
    }

    /// As [`recovered`], of configurations by the values of joints.
    pub fn recovered(
        &self,
        linkage: &Linkage,
        q: &[f64],
        solutions: &[BranchSolution],
        conditioning: f64,
    ) -> Result<(), Failure> {
        let solutions = solutions.iter().map(|solution| solution.by_joints(linkage));
        let solutions: Vec<BranchSolution> = solutions.collect();
        let joints = linkage.joints_at(q);
        let outcome = recovered(&self.model, &joints, &solutions, conditioning);
        outcome.map_err(|failure| match failure {
            Failure::Lost(_) => Failure::Lost(q.to_vec()),
            Failure::Doubled(_) => Failure::Doubled(q.to_vec()),
            other => other,
        })
    }

    /// What comes with the target of a configuration.
    pub fn parameters(&self, linkage: &Linkage, q: &[f64]) -> Vec<f64> {
        match linkage.swivel {
            Some(swivel) => {
                // With the arm stretched or folded it has no angle, and any will do.
                let angle = swivel.angle(&self.chain, q);
                vec![if angle.is_nan() { SOMEWHERE } else { angle }]
            }
            None => self.parameters.clone(),
        }
    }

    /// Targets that the arm was not seen to reach, and some that it cannot: the
    /// orientation of one configuration where another puts the tip, or farther.
    pub fn elsewhere(&self, target: Target) -> impl Iterator<Item = Pose> {
        let poses = self.all.iter().map(|trial| trial.pose);
        let farther = [0.9, 1.0, 1.1, 2.0].into_iter().cycle();
        let pairs = poses.clone().zip(poses.skip(1)).zip(farther);
        let whole = !target.is_projected();
        pairs
            .take(if whole { ELSEWHERE } else { 0 })
            .map(|((one, other), farther)| Pose {
                rotation: one.rotation,
                translation: other.translation.map(|x| farther * x),
            })
    }
}
