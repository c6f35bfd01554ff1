//! Self-motion manifolds, traced, and their components.

use super::arms::*;
use super::differences::assert_close;
use super::random::Random;
use kinematics::{
    Jacobian, JointLimit, Kinematics, Pose, SelfMotion, SelfMotionError, SelfMotionOptions, Stop,
    Target, WithTool, self_motion, self_motions,
};
use std::f64::consts::{PI, TAU};

/// Every configuration of the path reaches the target, and steps are short.
fn assert_followed<K: Kinematics<N>, const N: usize>(
    arm: &K,
    motion: &SelfMotion<N>,
    options: &SelfMotionOptions<N>,
) {
    let target = arm.fk(&motion.path[0]);
    for q in &motion.path {
        assert!(options.target.distance(&arm.fk(q), &target, 1.0) < 1e-11);
    }
    for pair in motion.path.windows(2) {
        let step: f64 = (0..N).map(|i| (pair[1][i] - pair[0][i]).powi(2)).sum();
        assert!(step.sqrt() < 1.1 * options.step);
    }
    if motion.is_closed() {
        let (first, last) = (motion.path[0], motion.path[motion.path.len() - 1]);
        for i in 0..N {
            let turns = (last[i] - first[i]) / TAU;
            assert_close([turns], [turns.round()], 1e-12);
        }
    }
}

/// Two distances between which the two components meet in a crossing: their
/// necks are 1e-4 rad wide.
const NEAR: (f64, f64) = (0.3 - 1e-8, 0.3 + 1e-8);

/// A planar 3R arm that holds its tip is a four-bar linkage, whose motions are
/// one closed curve, or two if the shortest and the longest of its four bars
/// are together shorter than the other two (Grashof).
#[test]
fn components_of_a_planar_arm_are_those_of_a_four_bar() {
    let options = SelfMotionOptions {
        target: Target::Position,
        ..Default::default()
    };
    for distance in [
        0.12, 0.2, 0.29, NEAR.0, NEAR.1, 0.31, 0.5, 0.69, 0.71, 0.8, 0.88,
    ] {
        let mut bars = [0.5, 0.3, 0.1, distance];
        bars.sort_by(f64::total_cmp);
        let components = if bars[0] + bars[3] < bars[1] + bars[2] {
            2
        } else {
            1
        };
        // All postures with the last link at one of many angles.
        let target = |k: u32| {
            let turn = Pose::from_axis_angle([0.0, 0.0, 1.0], 0.1 + f64::from(k), [0.0; 3]);
            Pose {
                translation: [0.6 * distance, 0.8 * distance, 0.0],
                ..turn
            }
        };
        let answers = (0..60).map(|k| Planar3r.ik(&target(k)));
        let postures: Vec<[f64; 3]> = answers
            .flat_map(|answer| answer.into_iter().map(|solution| solution.q))
            .collect();
        let found = self_motions(&Planar3r, &postures, &options).unwrap();
        assert_eq!(found.components.len(), components, "at {distance}");
        for component in &found.components {
            assert!(component.is_closed(), "{distance} {:?}", component.stops);
            assert_followed(&Planar3r, component, &options);
        }
        // The bend of the elbow changes its side only if there is one component.
        for (q, &index) in postures.iter().zip(&found.component_of) {
            let mirrored = mirror(q);
            let same = found.components[index].contains(&Planar3r, &mirrored);
            assert_eq!(same, components == 1, "{q:?} at {distance}");
        }
    }
}

/// The mirror image in the line through the shoulder and the tip.
fn mirror(q: &[f64; 3]) -> [f64; 3] {
    let line = 2.0 * f64::atan2(0.8, 0.6);
    [line - q[0], -q[1], -q[2]]
}

/// The seven-joint arm by geometry: for a swivel of the elbow about the line
/// from shoulder to wrist, and the signs of joints 2, 4 and 6.
fn by_swivel(target: &Pose, swivel: f64, signs: [f64; 3]) -> [f64; 7] {
    let (upper, fore) = (0.42, 0.4);
    let vector = nalgebra::Vector3::from;
    let shoulder = vector([0.0, 0.0, 0.34]);
    let wrist = vector(target.transform_point([0.0, 0.0, -0.126]));
    let reach = (wrist - shoulder).norm();
    let line = (wrist - shoulder) / reach;
    let side = line.cross(&vector([0.0, 0.0, 1.0])).normalize();
    let around = side * swivel.cos() + line.cross(&side) * swivel.sin();
    let cosine = (upper * upper + reach * reach - fore * fore) / (2.0 * upper * reach);
    let a = line * cosine + around * (1.0 - cosine * cosine).sqrt();
    let f = (wrist - shoulder - a * upper) / fore;
    let [second, fourth, sixth] = signs;
    let q2 = second * a.z.acos();
    let q1 = (second * a.y).atan2(second * a.x);
    let q4 = fourth * a.dot(&f).acos();
    let turn = |axis: [f64; 3], angle: f64| Pose::from_axis_angle(axis, angle, [0.0; 3]);
    let (y, z) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let seen = (turn(z, q1) * turn(y, q2)).rotate_back(f.into());
    let q3 = (-fourth * seen[1]).atan2(-fourth * seen[0]);
    let elbow = turn(z, q1) * turn(y, q2) * turn(z, q3) * turn(y, -q4);
    let hand = (elbow.inverse() * *target).rotation;
    let q6 = sixth * hand[2][2].acos();
    let q5 = (sixth * hand[1][2]).atan2(sixth * hand[0][2]);
    let q7 = (sixth * hand[2][1]).atan2(-sixth * hand[2][0]);
    [q1, q2, q3, q4, q5, q6, q7]
}

const SIGNS: [[f64; 3]; 8] = [
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, 1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [-1.0, -1.0, -1.0],
];

/// An arm with a spherical shoulder and wrist swivels its elbow all around in
/// each of 2 × 2 × 2 ways.
#[test]
fn components_of_a_seven_joint_arm_are_its_eight_swivels() {
    let mut random = Random::new(7);
    let options = SelfMotionOptions::default();
    for _ in 0..3 {
        let q = [
            random.angle(),
            random.between(0.5, 1.2),
            random.angle(),
            random.between(0.8, 2.0),
            random.angle(),
            random.between(0.5, 1.2),
            random.angle(),
        ];
        let target = Seven.fk(&q);
        let mut solutions = Vec::new();
        for swivel in [0.3, 1.5, 2.9, 4.4, 6.0] {
            for signs in SIGNS {
                let solution = by_swivel(&target, swivel, signs);
                assert!(Seven.fk(&solution).translation_distance(&target) < 1e-12);
                assert!(Seven.fk(&solution).rotation_distance(&target) < 1e-12);
                solutions.push(solution);
            }
        }
        let found = self_motions(&Seven, &solutions, &options).unwrap();
        assert_eq!(found.components.len(), 8);
        for (i, &component) in found.component_of.iter().enumerate() {
            assert_eq!(component, i % 8);
        }
        for component in &found.components {
            assert!(component.is_closed());
            assert_followed(&Seven, component, &options);
        }
    }
}

/// Limits cut the closed curves into arcs, which end where a joint stands at
/// its limit, and part what is one component without them.
#[test]
fn limits_end_a_self_motion() {
    let target = Seven.fk(&[0.4, 0.9, -0.5, 1.2, 0.7, -0.8, 0.2]);
    let options = SelfMotionOptions {
        limits: Some(Seven::LIMITS),
        ..Default::default()
    };
    let mut arcs = 0;
    for signs in SIGNS {
        let postures: Vec<_> = (0..90)
            .map(|k| by_swivel(&target, f64::from(k) * TAU / 90.0, signs))
            .collect();
        let inside = |q: &[f64; 7]| {
            q.iter()
                .zip(Seven::LIMITS)
                .all(|(x, limit)| limit.lower() < *x && *x < limit.upper())
        };
        let allowed: Vec<_> = postures.iter().filter(|q| inside(q)).copied().collect();
        let found = self_motions(&Seven, &allowed, &options).unwrap();
        // A new arc begins wherever a posture outside lies between; the circle
        // of postures has as many arcs as steps from outside to inside.
        let runs = (0..90).filter(|&k| inside(&postures[k]) && !inside(&postures[(k + 89) % 90]));
        assert_eq!(found.components.len(), runs.count(), "{signs:?}");
        arcs += found.components.len();
        for arc in &found.components {
            assert_followed(&Seven, arc, &options);
            assert!(arc.path.iter().all(|q| {
                q.iter()
                    .zip(Seven::LIMITS)
                    .all(|(x, limit)| x.abs() <= limit.upper() + 1e-9)
            }));
            let ends = [arc.path[0], arc.path[arc.path.len() - 1]];
            for (stop, end) in arc.stops.unwrap().iter().zip(ends) {
                let Stop::Limit { joint } = stop else {
                    panic!("{stop:?}");
                };
                assert_close([end[*joint].abs()], [Seven::LIMITS[*joint].upper()], 1e-9);
            }
        }
    }
    assert!(arcs > 3, "{arcs}");
}

/// A torch may spin about its own axis, which is not that of the last joint:
/// all joints move, and the seam is held.
#[test]
fn an_arm_spins_its_torch() {
    let torch = Pose::from_axis_angle([1.0, 0.0, 0.0], 0.7, [0.0; 3])
        * Pose::from_translation([0.0, 0.05, 0.2]);
    let arm = WithTool {
        robot: Ur5e,
        tool: torch,
    };
    let options = SelfMotionOptions {
        target: Target::PositionAxis,
        ..Default::default()
    };
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let motion = self_motion(&arm, &q, &options).unwrap();
    assert_followed(&arm, &motion, &options);
    assert!(motion.is_closed(), "{:?}", motion.stops);
    let travel = |i: usize| {
        let values = motion.path.iter().map(|q| q[i]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    assert!(
        (0..6).all(|i| travel(i) > 0.1),
        "{:?}",
        [0, 1, 2, 3, 4, 5].map(travel)
    );
}

/// Where the four bars can lie in a line the components meet in a crossing. The
/// trace ends there and says so.
#[test]
fn a_crossing_is_reported() {
    let options = SelfMotionOptions {
        target: Target::Position,
        ..Default::default()
    };
    // 0.5 + 0.1 = 0.3 + 0.3: the forearm folds back, the last link forth.
    let target = Pose {
        translation: [0.0, 0.3, 0.0],
        ..Planar3r.fk(&[0.2, 1.0, 0.0])
    };
    let posture = Planar3r.ik(&target).iter().next().unwrap().q;
    let motion = self_motion(&Planar3r, &posture, &options).unwrap();
    assert_followed(&Planar3r, &motion, &options);
    assert_eq!(motion.stops, Some([Stop::Singular; 2]));
    let crossing = [PI / 2.0, PI, PI];
    for end in [motion.path[0], motion.path[motion.path.len() - 1]] {
        let apart = (0..3).map(|i| kinematics::__private::math::wrap(end[i] - crossing[i]));
        assert!(
            apart.fold(0.0, |a: f64, x| a.max(x.abs())) < 1e-6,
            "{end:?}"
        );
    }
    let refused = self_motion(&Planar3r, &crossing, &options).unwrap_err();
    assert_eq!(refused, SelfMotionError::Dimension(2));
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let options = SelfMotionOptions::default();
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let refused = self_motion(&Elbow, &q, &options).unwrap_err();
    assert_eq!(refused, SelfMotionError::Dimension(0));
    let position = SelfMotionOptions {
        target: Target::Position,
        ..Default::default()
    };
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7];
    let refused = self_motion(&Seven, &q, &position).unwrap_err();
    assert_eq!(refused, SelfMotionError::Dimension(4));
    let narrow = SelfMotionOptions {
        limits: Some(
            [JointLimit::Revolute {
                lower: -0.5,
                upper: 0.5,
            }; 7],
        ),
        ..Default::default()
    };
    let refused = self_motion(&Seven, &q, &narrow).unwrap_err();
    assert_eq!(refused, SelfMotionError::BeyondLimit { joint: 5 });
    let few = SelfMotionOptions {
        most_steps: 3,
        ..Default::default()
    };
    let motion = self_motion(&Seven, &q, &few).unwrap();
    assert_eq!(motion.stops, Some([Stop::Unfinished; 2]));
    assert_eq!(motion.path.len(), 7);
}

/// The planar arm in another size.
struct Small(f64);

impl Small {
    fn sized(&self, pose: Pose) -> Pose {
        let translation = pose.translation.map(|x| self.0 * x);
        Pose {
            translation,
            ..pose
        }
    }
}

impl Kinematics<3> for Small {
    const JOINT_NAMES: [&'static str; 3] = Planar3r::JOINT_NAMES;
    const LIMITS: [JointLimit; 3] = Planar3r::LIMITS;
    const BASE: &'static str = Planar3r::BASE;
    const TIP: &'static str = Planar3r::TIP;
    const BRANCHES: usize = 0;

    fn fk(&self, q: &[f64; 3]) -> Pose {
        self.sized(Planar3r.fk(q))
    }

    fn fk_links(&self, q: &[f64; 3]) -> [Pose; 3] {
        Planar3r.fk_links(q).map(|link| self.sized(link))
    }

    fn fk_jacobian(&self, q: &[f64; 3]) -> (Pose, Jacobian<3>) {
        let (pose, mut spatial) = Planar3r.fk_jacobian(q);
        let linear = spatial.rows[..3].as_flattened_mut();
        linear.iter_mut().for_each(|x| *x *= self.0);
        (self.sized(pose), spatial)
    }
}

/// An arm of a millimetre is as exact for its size: the same four-bars.
#[test]
fn components_of_a_small_arm_are_those_of_a_four_bar() {
    let options = SelfMotionOptions {
        target: Target::Position,
        ..Default::default()
    };
    for (distance, components) in [(0.2, 1), (0.3 - 1e-5, 1), (0.3 + 1e-5, 2), (0.5, 2)] {
        let target = |k: u32| Pose {
            translation: [0.6 * distance, 0.8 * distance, 0.0],
            ..Pose::from_axis_angle([0.0, 0.0, 1.0], 0.1 + f64::from(k), [0.0; 3])
        };
        let answers = (0..60).flat_map(|k| Planar3r.ik(&target(k)).to_vec());
        let postures: Vec<[f64; 3]> = answers.map(|solution| solution.q).collect();
        for size in [1.0, 1e-3, 1e-6] {
            let found = self_motions(&Small(size), &postures, &options).unwrap();
            assert_eq!(found.components.len(), components, "{distance} {size}");
            let reached = size * distance;
            for q in found
                .components
                .iter()
                .flat_map(|component| &component.path)
            {
                let [x, y, _] = Small(size).fk(q).translation;
                assert!(
                    (x.hypot(y) - reached).abs() < 1e-11 * size,
                    "{distance} {size}"
                );
            }
        }
    }
}
