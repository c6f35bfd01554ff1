//! An arm of six joints as constant motions between turns about z and slides along it.

use crate::geometry::Linkage;
use crate::model::JointKind;
use kin_runtime::__private::univariate::Frames;
use kin_runtime::Pose;
use std::f64::consts::PI;

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
