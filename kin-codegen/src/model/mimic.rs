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
    /// The joint of each coordinate: those of the chain in its order, then those
    /// off the chain that some of the chain mimic.
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
    let moving: Vec<usize> = chain.joints.iter().copied().filter(moves).collect();
    let leads = |&j: &usize| spec.joints[j].mimic.is_none();
    let mut leaders: Vec<usize> = moving.iter().copied().filter(leads).collect();
    let numbered = leaders
        .iter()
        .enumerate()
        .map(|(variable, &j)| (j, variable));
    let mut variables: BTreeMap<usize, usize> = numbered.collect();
    let mut by_joint = BTreeMap::new();
    for j in moving {
        let (leader, multiplier, offset) = follow(spec, j);
        if spec.joints[leader].kind == JointType::Fixed {
            refuse_fixed_leader(&spec.joints[j], &spec.joints[leader], diagnostics);
        }
        refuse_standstill(&spec.joints[j], diagnostics);
        // Also a joint that is not on the chain may lead those that are.
        let variable = *variables.entry(leader).or_insert_with(|| {
            leaders.push(leader);
            leaders.len() - 1
        });
        by_joint.insert(
            j,
            Drive {
                variable,
                multiplier,
                offset,
            },
        );
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

fn refuse_fixed_leader(joint: &Joint, leader: &Joint, diagnostics: &mut Collector) {
    let Some(mimic) = joint.mimic else { return };
    let reason = format!(
        "joint `{}` mimics `{}`, which is fixed",
        joint.name, leader.name
    );
    diagnostics.at(
        mimic.at,
        reason,
        "make the joint fixed too, or let it mimic one that moves",
    );
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
