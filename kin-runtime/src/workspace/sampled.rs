//! Arms about which nothing is known: by descending.

use core::f64::consts::TAU;

use crate::{Chain, Pose, SearchOptions, Target};

/// Orientations tried at a point.
const ORIENTATIONS: usize = 60;

fn is_found(chain: &Chain, target: &Pose, counts: Target, max_starts: usize) -> bool {
    let options = SearchOptions {
        target: counts,
        max_starts,
        max_solutions: 1,
        ..SearchOptions::default()
    };
    !chain.ik_all(target, &options).is_empty()
}

pub(super) fn is_reachable(chain: &Chain, point: [f64; 3]) -> bool {
    is_found(chain, &Pose::from_translation(point), Target::Position, 256)
}

pub(super) fn is_dextrous(chain: &Chain, point: [f64; 3]) -> bool {
    let reaches = |rotation: Pose| {
        let target = Pose {
            translation: point,
            ..rotation
        };
        is_found(chain, &target, Target::Pose, 128)
    };
    chain.twists().len() >= 6 && scattered_rotations(ORIENTATIONS).all(reaches)
}

/// So many rotations that fill all orientations evenly, always the same: unit
/// quaternions on a spiral (M. Alexa, "Super-Fibonacci spirals: fast,
/// low-discrepancy sampling of SO(3)", 2022).
///
/// ```
/// let all = kin_runtime::scattered_rotations(200);
/// let mean_of_xx = all.map(|pose| pose.rotation[0][0]).sum::<f64>() / 200.0;
/// assert!(mean_of_xx.abs() < 0.01);
/// ```
pub fn scattered_rotations(count: usize) -> impl Iterator<Item = Pose> {
    // The two numbers of the spiral: √2, and the positive root of x⁴ = x + 4.
    const PHI: f64 = core::f64::consts::SQRT_2;
    const PSI: f64 = 1.533_751_168_755_204_4;
    (0..count).map(move |i| {
        let s = i as f64 + 0.5;
        let t = s / count as f64;
        let (r, rest) = (libm::sqrt(t), libm::sqrt(1.0 - t));
        let ((sa, ca), (sb, cb)) = (libm::sincos(TAU * s / PHI), libm::sincos(TAU * s / PSI));
        Pose::from_quaternion([r * sa, r * ca, rest * sb, rest * cb], [0.0; 3])
    })
}
