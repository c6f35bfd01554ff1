//! What of a target counts, as the generic chain sees it.

use kin_codegen::Target;
use kinematics::{Chain, Pose, Twist};
use std::f64::consts::{FRAC_PI_2, PI};

/// The chain with joints at its tip for what does not count: it reaches a whole
/// pose where the chain reaches the part that counts. Positions are a goal of
/// the search itself.
pub fn freed(chain: &Chain, counts: Target) -> Chain {
    let tip = chain.home();
    let spin = Twist::revolute(tip.rotate([0.0, 0.0, 1.0]), tip.translation);
    let slides = [0, 1, 2].map(|i| {
        let unit = std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
        Twist::prismatic(unit)
    });
    let mut twists = chain.twists().to_vec();
    match counts {
        Target::PositionAxis => twists.push(spin),
        Target::Orientation => twists.extend(slides),
        Target::Direction => {
            twists.push(spin);
            twists.extend(slides);
        }
        Target::Pose | Target::Position | Target::PositionYaw | Target::Planar => {}
    }
    Chain::new(twists, *tip)
}

/// The whole pose that a target stands for. An arm whose axes are all parallel
/// turns home about them by the angle that comes nearest to the target's
/// orientation; in a plane, it stays as high as at home.
pub fn projected(chain: &Chain, counts: Target, target: &Pose) -> Pose {
    if !matches!(counts, Target::PositionYaw | Target::Planar) {
        return *target;
    }
    let (axis, home) = (chain.twists()[0].angular, chain.home());
    let turned = |angle: f64| Pose::from_axis_angle(axis, angle, [0.0; 3]) * *home;
    // The cosine of the angle between orientations is a constant and a sine
    // wave of the turn.
    let likeness = |angle: f64| {
        let rows = turned(angle).rotation.into_iter().zip(target.rotation);
        rows.flat_map(|(a, b)| a.into_iter().zip(b))
            .map(|(a, b)| a * b)
            .sum::<f64>()
    };
    let sine = likeness(FRAC_PI_2) - likeness(-FRAC_PI_2);
    let cosine = likeness(0.0) - likeness(PI);
    let height = |point: [f64; 3]| (0..3).map(|i| axis[i] * point[i]).sum::<f64>();
    let rise = match counts {
        Target::Planar => height(home.translation) - height(target.translation),
        _ => 0.0,
    };
    Pose {
        translation: std::array::from_fn(|i| target.translation[i] + rise * axis[i]),
        ..turned(sine.atan2(cosine))
    }
}

/// What of a motion of the tip a target sees: turns about the axes alone where these are all parallel,
/// and in a plane shifts across them.
pub fn seen(chain: &Chain, counts: Target, motion: &Twist) -> Twist {
    let axis = chain.twists()[0].angular;
    let along = |v: [f64; 3]| -> [f64; 3] {
        let length: f64 = (0..3).map(|i| axis[i] * v[i]).sum();
        axis.map(|x| x * length)
    };
    let lifted = along(motion.linear);
    match counts {
        Target::PositionYaw => Twist {
            angular: along(motion.angular),
            ..*motion
        },
        Target::Planar => Twist {
            linear: std::array::from_fn(|i| motion.linear[i] - lifted[i]),
            angular: along(motion.angular),
        },
        _ => *motion,
    }
}
