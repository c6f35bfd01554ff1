//! Which coordinate moves which joint.

use crate::spec::{ArmSpec, Collector, Joint, JointType};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// A joint value as a function of the configuration:
/// `multiplier * q[variable] + offset`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drive {
    pub variable: usize,
    pub multiplier: f64,
    pub offset: f64,
}

impl Drive {
    /// That of the joint that is a coordinate.
    fn own(variable: usize) -> Self {
        Self {
            variable,
            multiplier: 1.0,
            offset: 0.0,
        }
    }
}

/// The drives of a chain.
pub(super) struct Drives {
    /// The joint of each coordinate: those of the chain in its order, then those
    /// off the chain that several of the chain mimic.
    pub leaders: Vec<usize>,
    by_joint: BTreeMap<usize, Drive>,
}

impl Drives {
    /// What moves a joint; `None` if nothing does.
    pub(super) fn of(&self, joint: usize) -> Option<Drive> {
        self.by_joint.get(&joint).copied()
    }

    /// Every moving joint, and those off the chain that some of it mimic; the leader of a
    /// coordinate before its followers only if the file has them in this order.
    pub(super) fn all(&self) -> impl Iterator<Item = (usize, Drive)> {
        self.by_joint.iter().map(|(&joint, &drive)| (joint, drive))
    }
}

/// Follows every mimic of a chain, the joints from base to tip, to the joint that
/// leads it. The one joint of the chain that mimics one off the chain is a coordinate
/// itself: for the chain it moves like any other.
pub(super) fn resolve(
    spec: &ArmSpec,
    chain: &[usize],
    diagnostics: &mut Collector,
) -> Option<Drives> {
    let moves = |&j: &usize| spec.joints[j].kind != JointType::Fixed;
    let moving: Vec<usize> = chain.iter().copied().filter(moves).collect();
    let followed = followed(spec);
    for &j in &moving {
        let leader = &spec.joints[followed[j].leader];
        if leader.kind == JointType::Fixed {
            refuse_fixed_leader(&spec.joints[j], leader, diagnostics);
        }
        refuse_standstill(spec, j, followed[j], diagnostics);
    }
    if !diagnostics.is_empty() {
        return None;
    }
    let led_by = |leader: usize| {
        moving
            .iter()
            .filter(|&&j| followed[j].leader == leader)
            .count()
    };
    let is_own = |&j: &usize| {
        let leader = followed[j].leader;
        leader == j || !moving.contains(&leader) && led_by(leader) == 1
    };
    let (mut leaders, followers): (Vec<usize>, Vec<usize>) =
        moving.iter().partition(|&j| is_own(j));
    let mut by_joint = BTreeMap::new();
    for (variable, &j) in leaders.iter().enumerate() {
        let Followed {
            leader,
            multiplier,
            offset,
        } = followed[j];
        by_joint.insert(j, Drive::own(variable));
        if leader != j {
            warn_of_leader(&spec.joints[j], &spec.joints[leader], diagnostics);
            let (multiplier, offset) = (1.0 / multiplier, -offset / multiplier);
            by_joint.insert(
                leader,
                Drive {
                    variable,
                    multiplier,
                    offset,
                },
            );
        }
    }
    for j in followers {
        let Followed {
            leader,
            multiplier,
            offset,
        } = followed[j];
        let drive = by_joint.entry(leader).or_insert_with(|| {
            leaders.push(leader);
            Drive::own(leaders.len() - 1)
        });
        let variable = drive.variable;
        by_joint.insert(
            j,
            Drive {
                variable,
                multiplier,
                offset,
            },
        );
    }
    Some(Drives { leaders, by_joint })
}

/// How far a joint may move for each radian or metre of its leader: a screw of 1 mm behind a gear of
/// 1:1000 slides 1.6e-7 m for each radian of its motor.
const GEARS: RangeInclusive<f64> = 1e-9..=1e9;

/// The joint that another one follows in the end, itself if it mimics none, and
/// its value as a function of that joint's: `multiplier * value + offset`.
#[derive(Clone, Copy)]
pub(super) struct Followed {
    pub leader: usize,
    pub multiplier: f64,
    pub offset: f64,
}

/// What every joint follows. The lines of mimics end: `ArmSpec` holds no cyclic
/// ones. Each is walked once.
pub(super) fn followed(spec: &ArmSpec) -> Vec<Followed> {
    let mut known: Vec<Option<Followed>> = vec![None; spec.joints.len()];
    let own = |leader| Followed {
        leader,
        multiplier: 1.0,
        offset: 0.0,
    };
    let mut line = Vec::new();
    let mut all = Vec::with_capacity(spec.joints.len());
    for start in 0..spec.joints.len() {
        let mut joint = start;
        while let (None, Some(mimic)) = (known[joint], spec.joints[joint].mimic) {
            line.push((joint, mimic));
            joint = mimic.joint;
        }
        let mut end = known[joint].unwrap_or(own(joint));
        while let Some((joint, mimic)) = line.pop() {
            end.offset = mimic.multiplier * end.offset + mimic.offset;
            end.multiplier *= mimic.multiplier;
            known[joint] = Some(end);
        }
        all.push(end);
    }
    all
}

/// Whoever drives the joint has to know which one that is.
fn warn_of_leader(joint: &Joint, leader: &Joint, diagnostics: &mut Collector) {
    let Some(mimic) = joint.mimic else { return };
    let reason = format!(
        "joint `{}` mimics `{}`, which is not on the chain",
        joint.name, leader.name
    );
    let remedy = format!(
        "the value of `{}` itself is a coordinate of this chain; let the file's mimic tell where `{}` has to be for it",
        joint.name, leader.name
    );
    diagnostics.warn(mimic.at, reason, remedy);
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

/// A joint that does not move with its leader, or by no gear that could be built.
fn refuse_standstill(spec: &ArmSpec, j: usize, followed: Followed, diagnostics: &mut Collector) {
    let joint = &spec.joints[j];
    let Some(mimic) = joint.mimic else { return };
    let multiplier = followed.multiplier;
    if GEARS.contains(&multiplier.abs()) {
        return;
    }
    let by = match multiplier == 0.0 {
        true => "0, so it never moves".to_owned(),
        false => format!("{multiplier:e}, which is no gear"),
    };
    let name = &joint.name;
    let leader = &spec.joints[followed.leader].name;
    let reason = match mimic.joint == followed.leader {
        true => format!("joint `{name}` mimics with multiplier {by}"),
        false => {
            format!("joint `{name}` mimics `{leader}` by way of others with multiplier {by}")
        }
    };
    diagnostics.at(
        mimic.at,
        reason,
        "make the joint fixed (of `dh`, `mdh` and `screws`, leave it out), or correct the multiplier",
    );
}
