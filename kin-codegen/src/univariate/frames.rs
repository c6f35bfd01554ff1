//! An arm of six joints as constant motions between turns about z and slides along it.

use crate::geometry::{Carried, Linkage, norm};
use crate::model::{JointKind, Model};
use crate::random::Random;
use kin_runtime::__private::univariate::{Between, Frames};
use kin_runtime::{Pose, Twist};
use std::f64::consts::PI;

/// Values of joints that are given at which an arm is looked at.
const VALUES: usize = 24;

/// The frames of the joints that are solved for, and the joints that are given between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// With these at zero.
    pub frames: Frames,
    /// From the base to the tip.
    pub between: Vec<Between>,
}

impl Family {
    /// Of the joints of an arm that are not locked, and the linkage of these; the others may
    /// stand between them, or at the ends, where they [carry](Carried) the target. None if more
    /// than six are left, or some mimic others.
    pub fn of(model: &Model, linkage: &Linkage) -> Option<(Self, Linkage)> {
        let locked = &linkage.locked;
        if locked.is_empty() {
            return Some((frames(linkage)?.into(), linkage.clone()));
        }
        let left = Linkage::new(&model.locked(locked, &vec![0.0; locked.len()]));
        let frames = frames(&left)?;
        let unit = 2.0 / left.size;
        let between = locked[Carried::new(linkage).between()]
            .iter()
            .map(|&joint| {
                let behind = joint - locked.iter().filter(|&&other| other < joint).count();
                let twist = linkage.twist(joint);
                let twist = Twist {
                    linear: twist.linear.map(|x| unit * x),
                    ..twist
                };
                // At home.
                let in_front = (0..behind).fold(Pose::IDENTITY, |pose, i| pose * frames.fixed[i]);
                Between {
                    behind: behind as u8,
                    twist: in_front.adjoint_inverse(&twist),
                }
            });
        let between = between.collect();
        Some((Self { frames, between }, left))
    }

    /// At several values; at one where nothing is given.
    pub fn sampled(&self) -> Vec<Frames> {
        let mut random = Random(0x1656_67b1_9e37_79f9);
        let count = if self.between.is_empty() { 1 } else { VALUES };
        let mut anywhere = || {
            let value = |joint: &Between| match joint.twist.angular == [0.0; 3] {
                true => random.between(-1.0, 1.0) / norm(joint.twist.linear),
                false => random.between(-PI, PI),
            };
            let values: Vec<f64> = self.between.iter().map(value).collect();
            self.frames.at(&self.between, &values)
        };
        (0..count).map(|_| anywhere()).collect()
    }

    /// Whether what is behind so many joints depends on values that are given.
    pub fn moves(&self, behind: usize) -> bool {
        let mut between = self.between.iter();
        between.any(|joint| usize::from(joint.behind) == behind)
    }
}

impl From<Frames> for Family {
    /// Nothing is given.
    fn from(frames: Frames) -> Self {
        Self {
            frames,
            between: Vec::new(),
        }
    }
}

/// The frames of an arm, lengths in units of half its size; none if it has more than six
/// joints, or some mimic others. An arm of fewer joints gets others behind its tip, which is
/// where it was when these are at zero.
pub fn frames(linkage: &Linkage) -> Option<Frames> {
    let joints = linkage.links.len();
    if joints > 6 {
        return None;
    }
    let mut prismatic = 0;
    let mut frames = vec![linkage.base];
    for (i, link) in linkage.links.iter().enumerate() {
        if link.variable != i || link.gain.abs() != 1.0 {
            return None;
        }
        // A joint that moves the other way has its z axis pointing down.
        let along = link.direction.map(|x| x * link.gain);
        let upright = facing(along);
        if let Some(before) = frames.last_mut() {
            *before = *before * upright;
        }
        let offset = match link.kind {
            JointKind::Revolute => Pose::from_axis_angle(along, link.gain * link.offset, [0.0; 3]),
            JointKind::Prismatic => {
                prismatic |= 1 << i;
                Pose {
                    translation: along.map(|x| x * link.gain * link.offset),
                    ..Pose::IDENTITY
                }
            }
        };
        frames.push(upright.inverse() * offset * link.after);
    }
    let unit = 2.0 / linkage.size;
    let scaled = |pose: Pose| Pose {
        translation: pose.translation.map(|x| x * unit),
        ..pose
    };
    let mut frames: Vec<Pose> = frames.into_iter().map(scaled).collect();
    let mut back = Pose::IDENTITY;
    for joint in joints..6 {
        frames[joint] = frames[joint] * skew(joint);
        frames.push(Pose::IDENTITY);
        back = skew(joint).inverse() * back;
    }
    frames[6] = frames[6] * back;
    let fixed = frames.try_into().ok()?;
    Some(Frames { fixed, prismatic })
}

/// A rotation that takes z to a unit vector, and nothing that it need not.
fn facing(direction: [f64; 3]) -> Pose {
    let [x, y, z] = direction;
    let across = x.hypot(y);
    match across > 0.0 {
        true => Pose::from_axis_angle([-y / across, x / across, 0.0], across.atan2(z), [0.0; 3]),
        false if z < 0.0 => Pose::from_axis_angle([1.0, 0.0, 0.0], PI, [0.0; 3]),
        false => Pose::IDENTITY,
    }
}

/// To the axis of a joint behind the tip: no direction and no length is that of an arm.
fn skew(joint: usize) -> Pose {
    let irregular = |k: usize| (2.4 * (3 * joint + k) as f64 + 0.7).sin();
    let (x, y) = (irregular(0), irregular(1));
    let (axis, length) = ([0.8 * x.cos(), 0.8 * x.sin(), 0.6], 0.6);
    let shift = [length * y.cos(), length * y.sin(), 0.4 * length];
    Pose::from_axis_angle(axis, 1.3, shift)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{ArmSpec, Source};

    /// Of two neighbours among them one moves the other, and not the reverse.
    #[test]
    fn joints_between_move_what_is_behind_them() {
        let text = "\
robot: eight
units: {angle: rad, length: m}
screws:
  - {name: a, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: b, axis: [0, 0.6, 0.8], point: [0.1, 0, 0.3]}
  - {name: c, axis: [1, 0, 0], point: [0, 0.2, 0.5]}
  - {name: d, axis: [0.8, 0, 0.6], point: [0.3, 0.1, 0.4]}
  - {name: e, axis: [0, 1, 0], point: [0.4, 0, 0.7]}
  - {name: f, axis: [0, 0.8, -0.6], point: [0.5, 0.2, 0.6]}
  - {name: g, axis: [0.6, 0.8, 0], point: [0.6, 0, 0.9]}
  - {name: h, axis: [1, 0, 0], point: [0.7, 0.1, 0.8]}
home: {xyz: [0.9, 0.1, 1.0]}
";
        let source = Source {
            path: "eight.yaml".into(),
            text: text.into(),
        };
        let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
        let q = [0.3, -0.7, 1.1, 0.4, -1.3, 0.9, -0.2, 1.7];
        let target = model.chain().fk(&q);
        for locked in [[3, 4], [2, 5], [1, 6]] {
            let linkage = Linkage::new(&model).with_locked(&locked);
            let (family, left) = Family::of(&model, &linkage).unwrap();
            let at = family.frames.at(&family.between, &locked.map(|i| q[i]));
            let solved: Vec<f64> = (0..8)
                .filter(|i| !locked.contains(i))
                .map(|i| q[i])
                .collect();
            let pose = at.forward(&solved.try_into().unwrap());
            assert!(pose.rotation_distance(&target) < 1e-14, "{locked:?}");
            for (x, y) in pose.translation.iter().zip(target.translation) {
                assert!((0.5 * left.size * x - y).abs() < 1e-14, "{locked:?}");
            }
        }
    }
}
