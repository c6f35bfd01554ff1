//! An individual arm: where the design is singular, it is nearly so.

use crate::Calibrated;
use crate::follow::{By, follow, pairs};
use crate::path::{circle, cross, line, unit};
use kinematics::Pose;

/// The joints of the design would be in line.
const STRAIGHT: [f64; 6] = [0.3, -0.6, 0.8, 0.4, 0.0, -0.9];

/// From where the design's wrist is a degree from straight, answers follow the
/// path as the Jacobian explains, on one branch.
fn approaches(path: impl Fn(f64) -> Pose) {
    for (step, to) in [(1e-3, -0.01), (1e-5, -0.01)] {
        let samples = follow(
            &Calibrated,
            STRAIGHT,
            &|s| path(s + to - 0.02),
            [step, 0.02, 0.0],
            By::Nearness,
        );
        assert!(samples.iter().all(Option::is_some));
        let samples: Vec<_> = samples.into_iter().flatten().collect();
        for pair in pairs(&samples) {
            assert!(pair.is_explained(step), "{:e}", pair.jump());
            assert!(!pair.changes_branch());
        }
    }
}

#[test]
fn towards_a_straight_wrist() {
    let pose = Calibrated.fk(&STRAIGHT);
    for along in [
        unit([0.5, 0.3, 0.8]),
        unit([-0.5, -0.3, -0.8]),
        [0.0, 1.0, 0.0],
    ] {
        let towards = unit(cross(along, [0.3, 0.0, 1.0]));
        approaches(line(pose, along));
        approaches(circle(pose, along, towards));
    }
}
