//! An arm of six revolute joints as constant motions between turns about z.

use crate::geometry::Linkage;
use kin_runtime::Pose;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A₀ … A₆ of the arm A₀ Rz(q₁) A₁ … Rz(q₆) A₆, lengths in units of half its
/// size; none if it is no such arm. An arm of fewer joints gets others behind its tip,
/// which is where it was when these are at zero.
pub fn frames(linkage: &Linkage) -> Option<[Pose; 7]> {
    let joints = linkage.links.len();
    if joints > 6 || !(0..joints).all(|joint| linkage.is_revolute(joint)) {
        return None;
    }
    let mut frames = vec![linkage.base];
    for (i, link) in linkage.links.iter().enumerate() {
        if link.variable != i || link.gain.abs() != 1.0 {
            return None;
        }
        // A joint that turns the other way has its z axis pointing down.
        let upright = match link.gain < 0.0 {
            true => Pose::from_axis_angle([1.0, 0.0, 0.0], std::f64::consts::PI, [0.0; 3]),
            false => Pose::IDENTITY,
        };
        if let Some(before) = frames.last_mut() {
            *before = *before * upright;
        }
        let offset = Pose::from_axis_angle(Z, link.offset, [0.0; 3]);
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
    frames.try_into().ok()
}

/// To the axis of a joint behind the tip: no direction and no length is that of an arm.
fn skew(joint: usize) -> Pose {
    let irregular = |k: usize| (2.4 * (3 * joint + k) as f64 + 0.7).sin();
    let (x, y) = (irregular(0), irregular(1));
    let (axis, length) = ([0.8 * x.cos(), 0.8 * x.sin(), 0.6], 0.6);
    let shift = [length * y.cos(), length * y.sin(), 0.4 * length];
    Pose::from_axis_angle(axis, 1.3, shift)
}

/// The pose of the tip, lengths as in `frames`.
pub fn forward(frames: &[Pose; 7], q: &[f64; 6]) -> Pose {
    (0..6).fold(frames[0], |pose, i| {
        pose * Pose::from_axis_angle(Z, q[i], [0.0; 3]) * frames[i + 1]
    })
}
