//! Which coordinate moves which joint.

use super::chain::Chain;
use crate::spec::{ArmSpec, Collector, Joint, JointType};
use std::collections::BTreeMap;

/// A joint value as a function of the configuration:
/// `multiplier * q[variable] + offset`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drive {
    pub variable: usize,
    pub multiplier: f64,
    pub offset: f64,
}

/// The drives of a chain.
pub(super) struct Drives {
    /// The joint of each coordinate, in the order of the chain.
    pub leaders: Vec<usize>,
    by_joint: BTreeMap<usize, Drive>,
}

impl Drives {
    /// What moves a joint; `None` if nothing does.
    pub(super) fn of(&self, joint: usize) -> Option<Drive> {
        self.by_joint.get(&joint).copied()
    }

    /// Every moving joint, the leader of a coordinate before its followers
    /// only if the file has them in this order.
    pub(super) fn all(&self) -> impl Iterator<Item = (usize, Drive)> {
        self.by_joint.iter().map(|(&joint, &drive)| (joint, drive))
    }
}

/// Follows every mimic to the joint that leads it.
pub(super) fn resolve(
    spec: &ArmSpec,
    chain: &Chain,
    diagnostics: &mut Collector,
) -> Option<Drives> {
    let moves = |&j: &usize| spec.joints[j].kind != JointType::Fixed;
    let leads = |&j: &usize| spec.joints[j].mimic.is_none();
    let moving: Vec<usize> = chain.joints.iter().copied().filter(moves).collect();
    let leaders: Vec<usize> = moving.iter().copied().filter(leads).collect();
    let mut by_joint = BTreeMap::new();
    for &j in &moving {
        let (leader, multiplier, offset) = follow(spec, j);
        match leaders.iter().position(|&l| l == leader) {
            Some(variable) => {
                by_joint.insert(
                    j,
                    Drive {
                        variable,
                        multiplier,
                        offset,
                    },
                );
            }
            None => explain_leader(&spec.joints[j], &spec.joints[leader], diagnostics),
        }
        refuse_standstill(&spec.joints[j], diagnostics);
    }
    diagnostics
        .is_empty()
        .then_some(Drives { leaders, by_joint })
}

/// The joint at the end of a line of mimics, and the value as a function of
/// that joint's. The line ends: `ArmSpec` holds no cyclic mimics.
fn follow(spec: &ArmSpec, joint: usize) -> (usize, f64, f64) {
    let (mut joint, mut multiplier, mut offset) = (joint, 1.0, 0.0);
    while let Some(mimic) = spec.joints[joint].mimic {
        offset += multiplier * mimic.offset;
        multiplier *= mimic.multiplier;
        joint = mimic.joint;
    }
    (joint, multiplier, offset)
}

fn explain_leader(joint: &Joint, leader: &Joint, diagnostics: &mut Collector) {
    let Some(mimic) = joint.mimic else { return };
    if leader.kind == JointType::Fixed {
        let reason = format!(
            "joint `{}` mimics `{}`, which is fixed",
            joint.name, leader.name
        );
        diagnostics.at(
            mimic.at,
            reason,
            "make the joint fixed too, or let it mimic one that moves",
        );
    } else {
        let reason = format!(
            "joint `{}` mimics `{}`, which is not between base and tip: its value is no function of this chain's coordinates",
            joint.name, leader.name
        );
        diagnostics.at(
            mimic.at,
            reason,
            "choose base and tip so that the chain has both joints, or remove the mimic",
        );
    }
}

fn refuse_standstill(joint: &Joint, diagnostics: &mut Collector) {
    if let Some(mimic) = joint.mimic.filter(|mimic| mimic.multiplier == 0.0) {
        let reason = format!(
            "joint `{}` mimics with multiplier 0, so it never moves",
            joint.name
        );
        diagnostics.at(
            mimic.at,
            reason,
            "make the joint fixed, or correct the multiplier",
        );
    }
}
