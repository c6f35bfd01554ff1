//! What robots are asked: random and structured.

use crate::random::Random;
use kinematics::{JointLimit, Pose, Robot, Target};
use std::f64::consts::{FRAC_PI_2, PI};

/// Configurations: random ones, and those with joints at quarter turns, where many arms are
/// singular, and next to that; one joint that is far out; folded ones.
pub fn configurations(joints: usize) -> Vec<Vec<f64>> {
    let mut random = Random::new(7);
    let mut all: Vec<Vec<f64>> = (0..6)
        .map(|_| (0..joints).map(|_| random.angle()).collect())
        .collect();
    all.push(vec![0.0; joints]);
    all.push(vec![FRAC_PI_2; joints]);
    all.push(vec![PI; joints]);
    for _ in 0..12 {
        let value = |random: &mut Random| match random.between(0.0, 1.0) {
            ..0.7 => random.right_angle(),
            _ => random.angle(),
        };
        all.push((0..joints).map(|_| value(&mut random)).collect());
    }
    // Next to those, where rounding keeps some branches from their target.
    for k in 0..30 {
        let off = 10_f64.powi(-3 - k % 7);
        let near = all[6 + k as usize % 15].iter();
        let near = near.map(|q| q + random.between(-off, off)).collect();
        all.push(near);
    }
    let mut far = all[0].clone();
    far[0] += 6.0 * PI;
    all.push(far);
    for turn in [0.0, FRAC_PI_2, PI] {
        let folded = [turn, FRAC_PI_2, PI, FRAC_PI_2, 0.0, 0.0];
        all.push((0..joints).map(|joint| folded[joint % 6]).collect());
    }
    all
}

/// Configurations at the limits, a little beyond them, and so little that they count as inside: at 5e-10
/// both ends of a joint that may turn by 360° do, and rounding decides.
pub fn at_limits(limits: &[JointLimit]) -> Vec<Vec<f64>> {
    let beyond = |stop: fn(JointLimit) -> f64, by: f64| {
        let at = limits.iter().map(|it| stop(*it) + by);
        at.map(|q| if q.is_finite() { q } else { 0.3 }).collect()
    };
    vec![
        beyond(JointLimit::upper, 0.0),
        beyond(JointLimit::upper, 4e-10),
        beyond(JointLimit::upper, 2e-9),
        beyond(JointLimit::lower, -4e-10),
        beyond(JointLimit::lower, -2e-9),
    ]
}

/// So many configurations have a joint of which nothing is known.
const UNKNOWN: usize = 12;

/// Targets, with configurations to seed from: poses of these configurations, and what is no
/// pose or out of reach.
pub fn targets(robot: &Robot, configurations: &[Vec<f64>]) -> Vec<(Pose, Vec<f64>)> {
    let mut all: Vec<(Pose, Vec<f64>)> = configurations
        .iter()
        .map(|q| (robot.fk(q), q.clone()))
        .collect();
    let (pose, _) = all[0].clone();
    let off = configurations[1].clone();
    let mut add = |pose: Pose| all.push((pose, off.clone()));
    // Out of reach, and at 1e-7 of a metre from where it is reached.
    add(Pose {
        translation: pose.translation.map(|x| 50.0 * x + 3.0),
        ..pose
    });
    add(Pose {
        translation: pose.translation.map(|x| x + 1e-7),
        ..pose
    });
    // No rotations: by far, by what single precision leaves, and a reflection.
    add(Pose {
        rotation: pose.rotation.map(|row| row.map(|x| 1.1 * x)),
        ..pose
    });
    add(Pose {
        rotation: pose.rotation.map(|row| row.map(|x| f64::from(x as f32))),
        ..pose
    });
    add(Pose {
        rotation: pose.rotation.map(|[x, y, z]| [x, y, -z]),
        ..pose
    });
    add(Pose {
        rotation: [[0.0; 3]; 3],
        ..pose
    });
    // No numbers.
    for x in [f64::NAN, f64::INFINITY, 1e300] {
        let mut turned = pose;
        turned.rotation[2][2] = x;
        add(turned);
        let mut shifted = pose;
        shifted.translation[1] = x;
        add(shifted);
    }
    // Joints without a seed, at singular targets too, and parameters that are no numbers.
    let known = configurations.iter().take(UNKNOWN).enumerate();
    all.extend(known.map(|(i, q)| {
        let mut unknown = q.clone();
        unknown[i % q.len()] = f64::NAN;
        (robot.fk(q), unknown)
    }));
    // Stretched, from seeds that are off: where a free joint leaves a root none, it moves by as much.
    all.extend([-1e-4, -1e-9, 1e-9, 1e-4].map(|off| {
        let stretched = vec![0.0; robot.joints()];
        (robot.fk(&stretched), vec![off; robot.joints()])
    }));
    // Of a CRX next to where axes 1 and 4 are one line, which Newton's method does not reach.
    let lined_up = [FRAC_PI_2, 0.0, FRAC_PI_2, -FRAC_PI_2, PI, -FRAC_PI_2];
    let off = [1.8e-10, 4e-10, -1.9e-10, -9.5e-10, -7.8e-10, 3.8e-10];
    let joints = 0..robot.joints();
    let beside: Vec<f64> = joints.map(|i| lined_up[i % 6] + off[i % 6]).collect();
    all.push((robot.fk(&beside), vec![0.0; robot.joints()]));
    // Held where its axes line up twice, where Newton's method leads away.
    let home = [FRAC_PI_2, 0.0, FRAC_PI_2, 0.0, FRAC_PI_2, PI];
    let off = [
        [
            6.834e-8, 3.108e-8, -5.194e-8, -8.327e-8, -5.499e-8, 4.686e-8,
        ],
        [6.628e-5, 2.324e-5, 7.1e-5, -8.614e-5, -1.822e-5, -9.469e-5],
        [5.844e-7, 2.378e-7, -8.567e-7, -2.216e-7, 6.969e-7, 4.573e-7],
    ];
    all.extend(off.map(|off| {
        let joints = 0..robot.joints();
        let held: Vec<f64> = joints.clone().map(|i| home[i % 6]).collect();
        let seed = joints.map(|i| home[i % 6] + off[i % 6]);
        (robot.fk(&held), seed.collect())
    }));
    // At rest beside two singularities at once, of a UR5e and a Panda: what is left of an angle is rounding.
    let twice = match robot.joints() {
        7 => vec![0.4, 3e-9, -0.7, -1.9, FRAC_PI_2 + 2e-9, 1.2, 0.5],
        joints => {
            let twice = [1.06, -1.81, 2e-10, 0.8, -9.4e-10, 0.19];
            (0..joints).map(|i| twice[i % 6]).collect()
        }
    };
    all.push((robot.fk(&twice), twice));
    // Next to singularities that meet: of an elbow and a TX60 a joint that is free has to turn, of a UR10e
    // and a UR5e to move, and to stay where it is told.
    let meeting = [
        (
            [-1.0, 2.0, 2.0, 1.0, 1.0, 1.0],
            [
                -1.8099e-7, 1.1966e-7, 1.63e-9, 2.0535e-7, 6.172e-8, 8.029e-8,
            ],
        ),
        (
            [0.0, 2.0, 0.0, -1.0, 0.0, -1.0],
            [4.31e-9, 1.87e-9, -1.7e-9, 1.8e-10, 1.74e-9, 3.5e-10],
        ),
        (
            [1.0, -1.0, 0.0, -1.0, 0.0, 1.0],
            [8.1e-10, 6.61e-9, -3.65e-9, -5.32e-9, 4.92e-9, -6.72e-9],
        ),
        (
            [0.0, 1.0, 0.0, 2.0, 0.0, 1.0],
            [2.75e-9, 3.81e-9, -2.85e-9, -1.51e-9, 2.48e-9, 2.98e-9],
        ),
    ];
    all.extend(meeting.map(|(quarters, off)| {
        let joints = 0..robot.joints();
        let q = joints.map(|i| quarters[i % 6] * FRAC_PI_2 + off[i % 6]);
        let pose = robot.fk(&q.collect::<Vec<_>>());
        (pose, vec![0.0; robot.joints()])
    }));
    // Bent a little, towards where an iiwa's elbow is nearly straight.
    if robot.joints() == 7 {
        let straight = [0.4, 1.0, 0.7, 1e-8, -0.7, -0.4, 0.5];
        let off = [0.0, 3e-4, 0.0, 1e-3, 0.0, -2e-4, 0.0];
        let bent = straight.iter().zip(off).map(|(q, off)| q + off);
        all.push((robot.fk(&straight), bent.collect()));
    }
    // Just out of reach.
    all.extend(beyond_reach(robot, &pose).map(|pose| (pose, configurations[1].clone())));
    all
}

/// A pose without solutions so near to one that Newton's method all but reaches it: from a pose that is
/// reached on along a ray to where the last solutions meet, and by 1e-8 of a metre beyond. None of an
/// arm with joints to be given.
fn beyond_reach(robot: &Robot, pose: &Pose) -> Option<Pose> {
    let at = |t: f64| Pose {
        translation: pose.translation.map(|x| x * (1.0 + t)),
        ..*pose
    };
    let is_reached = |t: f64| !robot.ik_at(&at(t), &[]).is_empty();
    let is_isolated = robot.parameters() == 0 && robot.target() == Target::Pose;
    let (mut reached, mut beyond) = (0.0, 50.0);
    if !is_isolated || !is_reached(reached) || is_reached(beyond) {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (reached + beyond);
        match is_reached(middle) {
            true => reached = middle,
            false => beyond = middle,
        }
    }
    let beyond = beyond + 1e-8;
    (!is_reached(beyond)).then(|| at(beyond))
}

/// The arm of [`over_the_base`].
pub const OVER_THE_BASE: &str = "tests/robots/table/wrist_over_base.yaml";

/// Its wrist over its base, which leaves the first joint free, but not everywhere the elbow in reach.
pub fn over_the_base(robot: &Robot) -> Vec<(Pose, Vec<f64>)> {
    let mut random = Random::new(31);
    let mut all = Vec::new();
    while all.len() < 40 {
        let mut q: Vec<f64> = (0..6).map(|_| random.angle()).collect();
        let (sine, cosine) = (q[1] + q[2]).sin_cos();
        let reach = 0.35 * q[1].cos() + 0.22 * cosine + 0.07 * sine;
        if reach.abs() < 0.07 {
            q[3] = (-reach / 0.07).acos() - q[1] - q[2];
            all.push((robot.fk(&q), vec![0.0; 6]));
        }
    }
    all
}

/// The arm of [`upright`].
pub const UPRIGHT: &str = "tests/languages/upright.yaml";

/// Links in line, as they are straight up, and all else anywhere; to seed from, zeros.
pub fn upright(robot: &Robot) -> (Pose, Vec<f64>) {
    let upright = [0.4, 0.0, 0.0, 0.0, 0.9, 0.7];
    let q: Vec<f64> = (0..robot.joints())
        .map(|joint| upright[joint % 6])
        .collect();
    (robot.fk(&q), vec![0.0; robot.joints()])
}

/// The arm of [`next_to_axis_1`].
pub const NEXT_TO_AXIS_1: &str = "tests/robots/table/nearly_parallel.yaml";

/// Its wrist next to axis 1, where both roots of its quartic are lost to rounding, and out of reach.
pub fn next_to_axis_1(robot: &Robot) -> Vec<(Pose, Vec<f64>)> {
    let mut random = Random::new(61);
    let mut all = Vec::new();
    while all.len() < 40 {
        let mut q: Vec<f64> = (0..6).map(|_| random.angle()).collect();
        let mut aside = |angle: f64| {
            q[1] = angle;
            let [x, y, _] = robot.fk(&q).translation;
            x * q[0].cos() + y * q[0].sin()
        };
        let (mut from, mut to) = (0.0, PI);
        let low = aside(from);
        if low * aside(to) > 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (from + to);
            match aside(middle) * low > 0.0 {
                true => from = middle,
                false => to = middle,
            }
        }
        let off = 10_f64.powi([-7, -6][all.len() % 2]);
        q[1] = from + random.between(-off, off);
        q[2] += random.between(-off, off);
        // A root that rounding has parted from another is not compared.
        let pose = robot.fk(&q);
        if robot.ik(&pose).iter().all(|it| it.singular) {
            all.push((pose, vec![0.0; 6]));
        }
    }
    let far = |(pose, seed): &(Pose, Vec<f64>)| {
        let translation = pose.translation.map(|x| x + 0.3);
        (
            Pose {
                translation,
                ..*pose
            },
            seed.clone(),
        )
    };
    let far: Vec<_> = all.iter().take(6).map(far).collect();
    all.extend(far);
    all
}

/// The arm of [`folded`].
pub const FOLDED: &str = "tests/robots/crx3ia.yaml";

/// Folded, where it has families of solutions that no target beside has any near.
pub fn folded(robot: &Robot) -> Vec<(Pose, Vec<f64>)> {
    let mut random = Random::new(67);
    let mut target = || {
        let mut q: Vec<f64> = (0..6).map(|_| random.angle()).collect();
        q[2] = -FRAC_PI_2;
        (robot.fk(&q), vec![0.0; 6])
    };
    (0..15).map(|_| target()).collect()
}

/// The arm of [`along_rail`].
pub const ALONG_RAIL: &str = "tests/robots/along_rail.yaml";

/// In the plane of its rail, which leaves that free, where the arm does not reach from its middle; the
/// last ones are too high for any of it.
pub fn along_rail(robot: &Robot) -> Vec<(Pose, Vec<f64>)> {
    let mut random = Random::new(71);
    let mut all = Vec::new();
    while all.len() < 40 {
        let mut q: Vec<f64> = (0..6).map(|_| random.angle()).collect();
        q[0] += 1.2 * q[0].signum();
        q[1] = [0.0, PI][all.len() % 2];
        let mut pose = robot.fk(&q);
        pose.translation[2] += if all.len() < 35 { 0.0 } else { 2.0 };
        all.push((pose, vec![0.0; 6]));
    }
    all
}
