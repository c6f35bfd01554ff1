//! What is left of a chain and its target when parameters are given.

use alloc::vec::Vec;

use super::chain::{exponential, is_prismatic};
use super::half_plane::HalfPlane;
use crate::{Chain, ChainSolution, Parameter, Pose, Target, math};

/// A chain with joints held, and what it is to reach.
pub(super) struct Given {
    /// The joints that are held, ascending, with their values.
    held: Vec<(usize, f64)>,
    /// That of the other joints.
    pub(super) chain: Chain,
    pub(super) target: Pose,
    pub(super) counts: Target,
    /// Where the elbow has to be, if a swivel angle is given.
    pub(super) elbow: Option<HalfPlane>,
}

impl Given {
    pub(super) fn new(
        chain: &Chain,
        target: &Pose,
        counts: Target,
        parameters: &[(Parameter, f64)],
    ) -> Given {
        let mut given = Given {
            held: Vec::new(),
            chain: chain.clone(),
            target: *target,
            counts,
            elbow: None,
        };
        for &(parameter, value) in parameters {
            match parameter {
                Parameter::Joint(joint) => given.held.push((joint, value)),
                Parameter::Turn => {
                    given.target = given.target.turned(value);
                    given.counts = Target::Pose;
                }
                Parameter::Swivel(_) => {}
            }
        }
        // The wrist is where the target has it when it is turned.
        for &(parameter, angle) in parameters {
            if let Parameter::Swivel(swivel) = parameter {
                let half_plane = HalfPlane::new(&swivel, chain.links(), &given.target, angle);
                given.elbow = Some(half_plane);
            }
        }
        given.held.sort_by_key(|&(joint, _)| joint);
        // From the last on, so that the places of the others stay.
        for &(joint, value) in given.held.iter().rev() {
            let twist = given.chain.twists()[joint];
            let moved = exponential(&twist, value);
            given.elbow = given.elbow.map(|elbow| elbow.locked(joint, &moved));
            given.chain = given.chain.locked(joint, value);
        }
        for (joint, value) in &mut given.held {
            if !is_prismatic(&chain.twists()[*joint]) {
                *value = math::wrap(*value);
            }
        }
        given
    }

    /// The values of the joints that are not held.
    pub(super) fn others(&self, q: &[f64]) -> Vec<f64> {
        let is_held = |i: usize| self.held.iter().any(|&(joint, _)| joint == i);
        (0..q.len())
            .filter(|&i| !is_held(i))
            .map(|i| q[i])
            .collect()
    }

    /// A solution for the others, with the values that are held.
    pub(super) fn completed(&self, mut found: ChainSolution) -> ChainSolution {
        for &(joint, value) in &self.held {
            found.q.insert(joint, value);
        }
        found
    }
}
