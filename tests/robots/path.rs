//! Paths whose targets are all known.

use crate::measure::largest;
use crate::subject::Subject;
use kinematics::{
    JointLimit, Kinematics, Nearest, NoSolution, Pose, Robot, Solution, ik_path, least_motion,
};
use std::f64::consts::TAU;

for_every_robot!(a_path_reaches_its_targets);
for_every_robot!(no_other_sequence_moves_less);

/// Poses along a straight line in joint space between two configurations.
fn line<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    [from, to]: [[f64; N]; 2],
    count: usize,
) -> Vec<Pose> {
    let at = |k: usize| {
        let s = k as f64 / (count - 1) as f64;
        std::array::from_fn::<f64, N, _>(|i| from[i] + s * (to[i] - from[i]))
    };
    (0..count).map(|k| robot.chain.fk(&at(k))).collect()
}

fn inside<K: Kinematics<N>, const N: usize>(q: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| q[i].clamp(K::LIMITS[i].lower(), K::LIMITS[i].upper()))
}

fn moved<const N: usize>(from: &[f64; N], to: &[f64; N]) -> f64 {
    let squares = (0..N).map(|i| (to[i] - from[i]).powi(2));
    squares.sum::<f64>().sqrt()
}

fn a_path_reaches_its_targets<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let ends = robot.random(21).map(inside::<K, N>).collect::<Vec<_>>();
    for pair in ends.windows(2) {
        let targets = line(robot, [pair[0], pair[1]], 12);
        let nearest = Nearest::new(pair[0], &K::LIMITS);
        let Ok(path) = ik_path(&robot.arm, &targets, &nearest) else {
            // Rounding may lose a target at a stop.
            continue;
        };
        assert_eq!(path.solutions.len(), targets.len());
        let mut motion = 0.0;
        let mut from = pair[0];
        for (solution, target) in path.solutions.iter().zip(&targets) {
            assert!(robot.miss(&solution.q, target) < 1e-9, "{solution:?}");
            let allowed = |i: usize| {
                let limit = K::LIMITS[i];
                (limit.lower()..=limit.upper()).contains(&solution.q[i])
            };
            assert!((0..N).all(allowed), "{solution:?}");
            motion += moved(&from, &solution.q);
            from = solution.q;
        }
        assert!((motion - path.motion).abs() < 1e-9, "{motion} {path:?}");
        // The way that the targets were made by is one.
        assert!(motion < moved(&pair[0], &pair[1]) + 1e-6, "{path:?}");
    }
}

/// Of three targets and all their solutions, in turn.
fn no_other_sequence_moves_less<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let all: Vec<[f64; N]> = robot.random(30).collect();
    for qs in all.chunks(3) {
        let targets: Vec<Pose> = qs.iter().map(|q| robot.chain.fk(q)).collect();
        let limits: [JointLimit; N] = std::array::from_fn(|i| match robot.turns(i) {
            true => JointLimit::revolute(-4.0, 4.0),
            false => K::LIMITS[i],
        });
        let nearest = Nearest::new([0.1; N], &limits);
        let solutions = |target: &Pose| robot.arm.ik_seeded(target, &nearest.seed).to_vec();
        let layers: Vec<Vec<Solution<N>>> = targets.iter().map(solutions).collect();
        // Of all solutions with full turns, the way to each.
        let mut ways = vec![(0.0, nearest.seed)];
        for target in &targets {
            let all = robot.arm.ik_seeded(target, &nearest.seed);
            let least = |q: &[f64; N]| {
                let sums = ways.iter().map(|(way, from)| way + moved(from, q));
                sums.fold(f64::INFINITY, f64::min)
            };
            let here = all.with_full_turns(&limits).map(|it| (least(&it.q), it.q));
            ways = here.collect();
        }
        let least = ways
            .iter()
            .fold(f64::INFINITY, |least, way| way.0.min(least));
        match least_motion(&layers, &nearest) {
            Ok((solutions, motion)) => {
                assert!((motion - least).abs() < 1e-12 * least, "{motion}, {least}");
                let inside = |s: &Solution<N>| s.q.iter().all(|x| x.is_finite());
                assert!(solutions.iter().all(inside));
            }
            Err(_) => assert_eq!(least, f64::INFINITY),
        }
    }
}

/// Through a wrist that is straight at one target, forearm and flange turning on the way: with the
/// values of a neighbour there they go on by steps. Likewise from there on without a seed.
#[test]
fn a_path_goes_on_through_a_straight_wrist() {
    let arm = crate::zoo::Puma560;
    let at = |k: usize| {
        let s = k as f64 / 20.0;
        [
            0.3 + 0.2 * s,
            -0.7 + 0.3 * s,
            0.4,
            0.2 + 1.9 * s,
            s - 0.5,
            1.0 - 1.7 * s,
        ]
    };
    let targets: Vec<Pose> = (0..=20).map(|k| arm.fk(&at(k))).collect();
    assert!(
        arm.ik(&targets[10])
            .iter()
            .any(|solution| solution.singular)
    );
    let limits = std::array::from_fn(|i| {
        let [from, to] = [at(0)[i], at(20)[i]];
        JointLimit::revolute(from.min(to) - 0.2, from.max(to) + 0.2)
    });
    let mut nearest = Nearest::new(at(0), &limits);
    nearest.step = [0.2; 6];
    let path = ik_path(&arm, &targets, &nearest).unwrap();
    for (k, solution) in path.solutions.iter().enumerate() {
        assert!(
            (0..6).all(|i| (solution.q[i] - at(k)[i]).abs() < 0.1),
            "{solution:?}"
        );
        assert!(crate::measure::entrywise(&arm.fk(&solution.q), &targets[k]) < 1e-12);
    }
    nearest.seed = [f64::NAN; 6];
    let path = ik_path(&arm, &targets[10..], &nearest).unwrap();
    assert_eq!(path.solutions.len(), 11);
}

/// A UR5e towards its stretched elbow and beyond its reach: all branches end.
#[test]
fn a_path_out_of_reach_tells_where_and_why() {
    let arm = crate::zoo::Ur5e;
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let start = arm.fk(&q);
    let out = |k: usize| {
        let mut pose = start;
        pose.translation[2] += 0.05 * k as f64;
        pose
    };
    let targets: Vec<Pose> = (0..40).map(out).collect();
    let nearest = Nearest::new(q, &crate::zoo::Ur5e::LIMITS);
    let lost = ik_path(&arm, &targets, &nearest).unwrap_err();
    let said = format!("target {} of the path: {}", lost.target, lost.reason);
    let error: Box<dyn std::error::Error> = lost.into();
    assert_eq!(error.to_string(), said);
    assert!(arm.ik(&targets[lost.target]).is_empty());
    assert!(!arm.ik(&targets[lost.target - 1]).is_empty());
    assert!(
        matches!(lost.reason, NoSolution::OutOfReach { .. }),
        "{lost:?}"
    );

    let path = ik_path(&arm, &targets[..lost.target], &nearest).unwrap();
    let last = path.solutions[lost.target - 1];
    assert!(last.q.iter().all(|x| x.is_finite()));
    for end in &path.ends {
        let here = arm.ik(&targets[end.target]);
        let next = arm.ik(&targets[end.target + 1]);
        assert!(here.iter().any(|s| s.branch == end.branch), "{end:?}");
        let goes_on = next.iter().any(|s| s.branch == end.branch);
        assert_eq!(goes_on, end.at_limits, "{end:?}");
    }
}

/// The nearest first target leads to a stop; to begin a full turn away does not.
/// A joint with one stop turns without end to the other side alone.
#[test]
fn a_path_keeps_to_a_single_stop() {
    let arm = crate::zoo::Ur5e;
    for [lower, upper] in [[0.0, f64::INFINITY], [f64::NEG_INFINITY, 0.0]] {
        let mut limits = crate::zoo::Ur5e::LIMITS;
        limits[5] = JointLimit::revolute(lower, upper);
        let at = |turn: f64| [0.3, -1.2, 1.5, -0.7, 1.1, turn];
        let targets = [0.4, 0.1, -0.2, -0.55].map(|turn| arm.fk(&at(turn)));
        let path = ik_path(&arm, &targets, &Nearest::new(at(0.5), &limits)).unwrap();
        let mut before = at(0.5);
        for solution in &path.solutions {
            assert!(
                (lower - 1e-9..=upper + 1e-9).contains(&solution.q[5]),
                "{path:?}"
            );
            let other = before[5] - solution.q[5];
            assert!(other.abs() < 2.0 * std::f64::consts::PI + 0.6, "{path:?}");
            before = solution.q;
        }
    }
}

#[test]
fn a_path_begins_where_it_can_end() {
    let arm = crate::zoo::Ur5e;
    let about = |turn: f64| arm.fk(&[turn, -1.2, 1.5, -0.7, 1.1, 0.4]);
    let targets: Vec<Pose> = (0..80).map(|k| about(4.0 + 0.1 * f64::from(k))).collect();
    let seed = [4.0, -1.2, 1.5, -0.7, 1.1, 0.4];
    let mut nearest = Nearest::new(seed, &crate::zoo::Ur5e::LIMITS);
    nearest.step = [0.2; 6];
    let path = ik_path(&arm, &targets, &nearest).unwrap();
    let turns = |path: &kinematics::Path<6>| {
        let steps = path.solutions.windows(2);
        largest(steps.map(|pair| pair[1].q[0] - pair[0].q[0]))
    };
    assert!(turns(&path) < 0.2, "{path:?}");
    assert!((path.solutions[0].q[0] - 4.0).abs() > 6.0, "{path:?}");
    // Two turns are more than there are between the stops.
    let targets: Vec<Pose> = (0..130).map(|k| about(4.0 + 0.1 * f64::from(k))).collect();
    let lost = ik_path(&arm, &targets, &nearest).unwrap_err();
    // The travel is 4π, and the branch that began here had 4 − 2π + 8.6 > 2π.
    assert!((86..126).contains(&lost.target), "{lost:?}");
    let NoSolution::BeyondStep { joint, .. } = lost.reason else {
        panic!("{lost:?}");
    };
    assert_eq!(joint, 0);
}

/// Stops of thousands of turns are as good as none, and no turn is listed that is of no use.
#[test]
fn a_path_inside_wide_limits_is_that_without() {
    let arm = crate::zoo::Ur5e;
    let at = |k: u32| {
        let s = f64::from(k) / 40.0;
        [
            0.3 + 9.0 * s,
            -1.2,
            1.5,
            -0.7 - 8.0 * s,
            1.1,
            0.4 + 30.0 * s,
        ]
    };
    let targets: Vec<Pose> = (0..=200).map(|k| arm.fk(&at(k))).collect();
    let motion = |stop: f64| {
        let limits = [JointLimit::revolute(-stop, stop); 6];
        let path = ik_path(&arm, &targets, &Nearest::new(at(0), &limits)).unwrap();
        let last = path.solutions[200].q;
        assert!(
            (0..6).all(|i| (last[i] - at(200)[i]).abs() < 1e-9),
            "{last:?}"
        );
        path.motion
    };
    let endless = motion(f64::INFINITY);
    assert!((motion(1e4) - endless).abs() < 1e-9 * endless);
    assert!((motion(151.0) - endless).abs() < 1e-9 * endless);
}

#[test]
fn a_joint_without_a_seed_begins_anywhere() {
    let arm = crate::zoo::Ur5e;
    let at = |turn: f64| [0.3, -1.2, 1.5, -0.7, 1.1, turn];
    let targets = [0.4, 0.3, 0.2].map(|turn| arm.fk(&at(turn)));
    for missing in [f64::NAN, f64::INFINITY] {
        let nearest = Nearest::new(at(missing), &crate::zoo::Ur5e::LIMITS);
        let path = ik_path(&arm, &targets, &nearest).unwrap();
        assert!((path.motion - 0.2).abs() < 1e-9, "{path:?}");
    }
}

/// A full turn away from a single stop, the motion is that of the values that are told.
#[test]
fn a_path_beyond_a_single_stop_is_as_long_as_it_is() {
    let arm = crate::zoo::Ur5e;
    let mut limits = crate::zoo::Ur5e::LIMITS;
    limits[5] = JointLimit::revolute(0.0, f64::INFINITY);
    let at = |turn: f64| [0.3, -1.2, 1.5, -0.7, 1.1, turn];
    let targets = [0.4, 0.1, -0.2, -0.55].map(|turn| arm.fk(&at(turn)));
    let mut nearest = Nearest::new(at(0.5 + TAU), &limits);
    nearest.step = [0.5; 6];
    let path = ik_path(&arm, &targets, &nearest).unwrap();
    assert!((path.motion - 1.05).abs() < 1e-9, "{path:?}");
}

/// A joint without a seed begins in the turn from which the others take least.
#[test]
fn without_a_seed_all_turns_are_beginnings() {
    let limits = [JointLimit::revolute(3.0, 15.7), JointLimit::Continuous];
    let solution = |q| Solution {
        q,
        residual: 0.0,
        branch: 0,
        singular: false,
    };
    // From 3.1 the next turn of 2.95 is 6.1 away; from 9.4 it is 0.15.
    let layers = [vec![solution([3.1, 0.0])], vec![solution([2.95, 0.1])]];
    let mut nearest = Nearest::new([f64::NAN, 0.0], &limits);
    let (found, motion) = least_motion(&layers, &nearest).unwrap();
    assert!((motion - 0.15_f64.hypot(0.1)).abs() < 1e-9, "{found:?}");
    nearest.step = [0.2, f64::NAN];
    assert!(least_motion(&layers, &nearest).is_ok());
    nearest.step[0] = 0.1;
    assert!(least_motion(&layers, &nearest).is_err());
}

/// With its arm in the plane of the rail the rail is free, and stays where the seed has it or moves no
/// further than the arm reaches from: the path goes on along it.
#[test]
fn a_path_crosses_where_a_slide_is_free() {
    let arm: Robot = include_str!("along_rail.yaml").parse().unwrap();
    let pans = (-10..10).map(|k| 0.03 * f64::from(k));
    let target = |pan| arm.fk(&[0.9, pan, -0.5, 1.0, 0.3, 0.2]);
    let targets: Vec<Pose> = pans.map(target).collect();
    let seed = [-1.0, -0.3, -0.5, 1.0, 0.3, 0.2];
    let seeded = arm.ik_seeded(&targets[10], &seed);
    assert!(!seeded.is_empty() && seeded.iter().all(|it| (it.q[0] - 0.9).abs() > 0.01));
    let nearest = Nearest::<6>::new(seed, arm.limits().try_into().unwrap());
    let path = arm.ik_path(&targets, &nearest).unwrap();
    for (solution, target) in path.solutions.iter().zip(&targets) {
        assert!(arm.fk(&solution.q).translation_distance(target) < 1e-9);
        assert!((solution.q[0] - 0.9).abs() < 1e-6, "{solution:?}");
    }
}

/// Of six joints without a seed one has to begin in its lowest turn: the others do not begin in all of
/// theirs, which would be as many ways as all turns together.
#[test]
fn one_joint_of_those_without_a_seed_begins_elsewhere() {
    let turns = 3.0 * TAU;
    let limits = [JointLimit::revolute(-turns, turns); 6];
    let sweep = |k: usize| -turns + 0.1 + 0.2 * k as f64;
    let layers: Vec<Vec<Solution<6>>> = (0..180)
        .map(|k| {
            let q = [sweep(k), 0.1, 0.2, 0.3, 0.4, 0.5];
            let q = q.map(|x: f64| x - TAU * (x / TAU).round());
            vec![Solution {
                q,
                residual: 0.0,
                branch: 0,
                singular: false,
            }]
        })
        .collect();
    let nearest = Nearest::new([f64::NAN; 6], &limits);
    let (found, motion) = least_motion(&layers, &nearest).unwrap();
    assert!((motion - 0.2 * 179.0).abs() < 1e-9, "{motion}");
    for (k, solution) in found.iter().enumerate() {
        assert!((solution.q[0] - sweep(k)).abs() < 1e-9, "{k}: {solution:?}");
    }
}

#[test]
fn weights_that_are_not_finite_have_no_path() {
    let arm = crate::zoo::Ur5e;
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    for weight in [f64::NAN, f64::INFINITY] {
        let mut nearest = Nearest::new(q, &crate::zoo::Ur5e::LIMITS);
        nearest.weights[2] = weight;
        let none = ik_path(&arm, &[arm.fk(&q)], &nearest).unwrap_err();
        assert_eq!(none.reason, NoSolution::NotFinite);
        let told = "target 0 of the path: an entry of the target, the parameter, or a weight is not a \
                    finite number";
        assert_eq!(none.to_string(), told);
    }
}
