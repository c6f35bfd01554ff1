//! Where the polynomial vanishes whatever the target.

use kin_runtime::__private::univariate::{Elimination, Frames};
use kin_runtime::Pose;

/// Axes that are nearer than this, in radians and units of half the arm's size, are one.
const ONE: f64 = 1e-9;

/// The value of the kept joint at which the axes of the joints beside it coincide: there the
/// equations depend on each other, and the determinant has a double root. None if no value
/// does that, or the kept joint is at an end of the arm.
pub fn fold(elimination: &Elimination, frames: &Frames) -> Option<f64> {
    let joint = usize::from(elimination.joints[0]);
    let beside = [joint.checked_sub(1)?, joint + 1];
    if joint == 5 || beside.into_iter().any(|joint| frames.slides(joint)) {
        return None;
    }
    let before = line(&frames.fixed[joint].inverse());
    let behind = line(&frames.fixed[joint + 1]);
    let at = [1.0, -1.0].into_iter().find_map(|way| {
        let there = [before[0].map(|x| way * x), before[1]];
        let pairs = || behind.iter().zip(&there);
        let sine: f64 = pairs().map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
        let cosine: f64 = pairs().map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum();
        let angle = sine.atan2(cosine);
        let turn = Pose::from_axis_angle([0.0, 0.0, 1.0], angle, [0.0; 3]);
        let apart = |(a, b): (&[f64; 3], &[f64; 3])| {
            let turned = turn.rotate(*a);
            (0..3).map(|i| (turned[i] - b[i]).abs()).fold(0.0, f64::max)
        };
        pairs().all(|pair| apart(pair) < ONE).then_some(angle)
    })?;
    Some(if elimination.backwards { -at } else { at })
}

/// The z axis of a frame: its direction, and the point next to the origin.
fn line(frame: &Pose) -> [[f64; 3]; 2] {
    let (l, p) = (frame.rotation.map(|row| row[2]), frame.translation);
    let along: f64 = (0..3).map(|i| l[i] * p[i]).sum();
    [l, [0, 1, 2].map(|i| p[i] - along * l[i])]
}
