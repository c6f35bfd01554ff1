//! An arm of six revolute joints as constant motions between turns about z.

use crate::geometry::Linkage;
use kin_runtime::Pose;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A₀ … A₆ of the arm A₀ Rz(q₁) A₁ … Rz(q₆) A₆, lengths in units of half its
/// size; none if it is no such arm.
pub fn frames(linkage: &Linkage) -> Option<[Pose; 7]> {
    if linkage.links.len() != 6 || !(0..6).all(|joint| linkage.is_revolute(joint)) {
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
    frames
        .into_iter()
        .map(scaled)
        .collect::<Vec<_>>()
        .try_into()
        .ok()
}

/// The pose of the tip, lengths as in `frames`.
pub fn forward(frames: &[Pose; 7], q: &[f64; 6]) -> Pose {
    (0..6).fold(frames[0], |pose, i| {
        pose * Pose::from_axis_angle(Z, q[i], [0.0; 3]) * frames[i + 1]
    })
}
