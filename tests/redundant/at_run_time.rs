//! The same robots read while the program runs: what generated code computes, to the last bit.

use crate::cached::cached;
use crate::random::Random;
use crate::several::{GantryIiwa, MobilePanda, PandaTool};
use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{
    Answers, Criterion, Follow, HighlyRedundantKinematics, Ik, Nearest, Parameter, Pose,
    RedundantKinematics, Robot, RobotOptions, RobotSource, Solutions,
};
use std::mem::discriminant;

for_every_robot!(answers_and_intervals_are_the_same);

/// Of two parameters, the last joint and the turn of the tool.
pub fn sawyer_whose_tool_turns() -> Robot {
    let options = RobotOptions {
        target: Some(Target::PositionAxis),
        ..RobotOptions::default()
    };
    cached("../robots/sawyer.yaml", &options)
}

/// Of three parameters.
pub fn ur10e_for_positions() -> Robot {
    let options = RobotOptions {
        target: Some(Target::Position),
        ..RobotOptions::default()
    };
    cached("../robots/ur10e.yaml", &options)
}

fn loaded<K: RedundantKinematics<N>, const N: usize>(robot: &Subject<K, N>) -> Robot {
    let free = match K::PARAMETER {
        Parameter::Joint(joint) => vec![K::JOINT_NAMES[joint].to_owned()],
        Parameter::Swivel(_) => vec!["swivel".to_owned()],
        Parameter::Turn => Vec::new(),
    };
    let options = RobotOptions {
        target: Some(K::TARGET),
        free,
        ..RobotOptions::default()
    };
    cached(robot.path, &options)
}

/// Why there is no solution is not that a target is out of reach.
#[test]
fn a_robot_with_parameters_has_no_solution_without_them() {
    let load = |options: &RobotOptions| cached("../robots/panda.yaml", options);
    let (panda, bare) = (
        load(&RobotOptions::default()),
        load(&RobotOptions {
            ik: Ik::None,
            ..RobotOptions::default()
        }),
    );
    let q = [0.3, -0.5, 0.2, -1.9, 0.4, 1.8, 0.6];
    let nearest = Nearest::new(q, panda.limits().try_into().unwrap());
    let reason = |robot: &Robot| robot.try_ik_nearest(&panda.fk(&q), &nearest).unwrap_err();
    let path = |robot: &Robot| robot.ik_path(&[panda.fk(&q)], &nearest).unwrap_err();
    assert_eq!(
        reason(&panda).to_string(),
        "a target leaves so many parameters of the robot open: 1; `ik_nearest_at` takes them"
    );
    assert_eq!(path(&panda).reason, reason(&panda));
    assert_eq!(path(&bare).reason, reason(&bare));
    assert_eq!(
        reason(&bare).to_string(),
        "the robot was loaded without inverse kinematics: leave out `ik = none`"
    );
}

/// Arms off their design are refined by other operations of forward kinematics.
fn rounding(path: &str) -> f64 {
    if path.contains("stray") { 1e-9 } else { 0.0 }
}

fn assert_same<const N: usize>(there: &Answers, here: &Solutions<N>, rounding: f64) {
    assert_eq!(there.len(), here.len(), "{there:?} {here:?}");
    for (there, here) in there.iter().zip(here) {
        assert_eq!((there.branch, there.singular), (here.branch, here.singular));
        assert_close(there.q, &here.q, rounding);
    }
}

fn assert_close(there: &[f64], here: &[f64], rounding: f64) {
    assert_eq!(there.len(), here.len());
    for (a, b) in there.iter().zip(here) {
        assert!((a - b).abs() <= rounding, "{there:?} {here:?}");
    }
}

fn answers_and_intervals_are_the_same<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    let loaded = loaded(robot);
    answers_are_the_same(robot, &loaded);
    intervals_are_the_same(robot, &loaded);
}

fn answers_are_the_same<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    loaded: &Robot,
) {
    let arm = &robot.arm;
    let rounding = rounding(robot.path);
    assert_eq!(loaded.parameters(), 1);
    assert_eq!(
        discriminant(&loaded.parameter(0).unwrap()),
        discriminant(&K::PARAMETER)
    );
    assert_eq!(
        (loaded.branches(), loaded.branches_at()),
        (K::BRANCHES, K::BRANCHES_AT)
    );
    let along = loaded.along_parameter();
    let limits = K::LIMITS;
    let mut compared = 0;
    for q in robot.random(40) {
        let target = arm.fk(&q);
        let parameter = arm.parameter_of(&target, &q);
        assert_close(&loaded.redundancy(&target, &q), &[parameter], 1e-14);
        let here = arm.ik_at(&target, parameter);
        let there = loaded.ik_at(&target, &[parameter]);
        assert_same(&there, &here, rounding);
        assert_eq!(along.ik_at(&target, parameter), there);
        compared += here.len();
        let nearest = Nearest::new(q, &limits);
        let [there, here] = [
            loaded.try_ik_nearest_at(&target, &[parameter], &nearest),
            arm.try_ik_nearest_at(&target, parameter, &nearest),
        ];
        match (&there, &here) {
            (Ok(there), Ok(here)) => assert_close(&there.q, &here.q, rounding),
            (Err(there), Err(here)) => assert_eq!(discriminant(there), discriminant(here)),
            _ => panic!("{there:?} {here:?}"),
        }
        let how = Follow::new(&limits, 0.05);
        let [there, here] = [
            along.ik_follow(&target, &q, &how),
            arm.ik_follow(&target, &q, &how),
        ];
        assert_eq!(there.is_some(), here.is_some());
        if let (Some(there), Some(here)) = (there, here) {
            assert_close(&there.solution.q, &here.solution.q, 10.0 * rounding);
            assert_eq!(there.jumps, here.jumps);
        }
    }
    assert!(compared > 40, "{compared}");
    assert!(
        loaded.ik(&Pose::IDENTITY).is_empty() && loaded.ik_approximate(&Pose::IDENTITY).is_none()
    );
}

fn intervals_are_the_same<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    loaded: &Robot,
) {
    let arm = &robot.arm;
    let rounding = 10.0 * rounding(robot.path);
    let along = loaded.along_parameter();
    let mut compared = 0;
    for q in robot.random(1) {
        let target = arm.fk(&q);
        let pairs = [
            (along.feasible(&target), arm.feasible(&target)),
            (
                along.feasible_within(&target, loaded.limits()),
                arm.feasible_within(&target, &K::LIMITS),
            ),
        ];
        for (there, here) in pairs {
            assert_eq!(there.len(), here.len(), "{there:?} {here:?}");
            for (there, here) in there.iter().zip(&here) {
                assert_close(&[there.from, there.to], &[here.from, here.to], rounding);
                assert_close(&there.middle, &here.middle, rounding.sqrt());
                assert_eq!(there.is_closed, here.is_closed);
                compared += 1;
            }
        }
        let swept = along
            .ik_sweep(&target, 12)
            .into_iter()
            .zip(arm.ik_sweep(&target, 12));
        swept.for_each(|(there, here)| assert_same(&there, &here, rounding));
        let criterion = Criterion::FarthestFromLimits;
        let [there, here] = [
            along.ik_best(&target, &criterion),
            arm.ik_best(&target, &criterion),
        ];
        assert_eq!(there.is_some(), here.is_some());
        if let (Some(there), Some(here)) = (there, here) {
            assert_close(&there, &here, rounding.sqrt());
        }
    }
    assert!(compared > 0);
}

#[test]
fn two_parameters_are_the_same() {
    let options = RobotOptions {
        free: vec!["slide".into(), "joint_a3".into()],
        ..RobotOptions::default()
    };
    let loaded = cached("robots/redundant/gantry_iiwa.yaml", &options);
    assert_eq!(loaded.parameter_names(), ["slide", "joint_a3"]);
    let q = [0.4, 0.3, -0.7, 0.5, -1.2, 0.8, 0.6, -0.2];
    let target = GantryIiwa.fk(&q);
    let held = [0.4, 0.5];
    assert_eq!(loaded.redundancy(&target, &q), held);
    assert_same(
        &loaded.ik_at(&target, &held),
        &GantryIiwa.ik_at(&target, &held),
        0.0,
    );
    let pairs = [
        (
            loaded.along(0, &held).feasible(&target),
            GantryIiwa.along::<0>(held).feasible(&target),
        ),
        (
            loaded.along(1, &held).feasible(&target),
            GantryIiwa.along::<1>(held).feasible(&target),
        ),
    ];
    for (there, here) in pairs {
        assert!(!here.is_empty());
        let ends = |from: f64, to: f64| [from, to];
        let there: Vec<_> = there.iter().map(|it| ends(it.from, it.to)).collect();
        assert_eq!(
            there,
            here.iter()
                .map(|it| ends(it.from, it.to))
                .collect::<Vec<_>>()
        );
    }
}

/// Of more joints than have code of their own.
#[test]
fn four_parameters_are_the_same() {
    let loaded = cached(
        "robots/redundant/mobile_panda.yaml",
        &RobotOptions::default(),
    );
    let q = [0.4, 0.3, 0.9, -0.4, 1.2, 0.5, -0.8, 0.6, 0.2, -1.1];
    let target = MobilePanda.fk(&q);
    let held = loaded.redundancy(&target, &q);
    let intervals = [
        MobilePanda
            .along::<0>([0.4, 0.3, 0.9, -1.1])
            .feasible(&target),
        MobilePanda
            .along::<3>([0.4, 0.3, 0.9, -1.1])
            .feasible(&target),
    ];
    for (place, here) in [0, 3].into_iter().zip(intervals) {
        let along = loaded.along(place, &held);
        let there = along.feasible(&target);
        assert!(!here.is_empty());
        assert_eq!(there.len(), here.len());
        for (there, here) in there.iter().zip(&here) {
            assert_eq!([there.from, there.to], [here.from, here.to]);
            assert_eq!(there.middle, here.middle);
        }
        let limits = loaded.limits();
        let within = along.feasible_within(&target, limits);
        assert!(!within.is_empty());
        let best = along
            .ik_best(&target, &Criterion::Nearest(q))
            .expect("one within limits");
        assert!((0..10).all(|i| (best[i] - q[i]).abs() < 1e-6), "{best:?}");
    }
}

/// Held, the tool turns the target.
#[test]
fn a_held_turn_is_the_same() {
    let options = RobotOptions {
        target: Some(Target::PositionAxis),
        ..RobotOptions::default()
    };
    let loaded = cached("../robots/panda.yaml", &options);
    let q = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
    let target = PandaTool.fk(&[0.1, 0.6, -0.3, -1.7, 0.2, 1.8, 0.1]);
    let held = [q[6], 0.7];
    let [there, here] = [
        loaded.along(0, &held).feasible(&target).len(),
        PandaTool.along::<0>(held).feasible(&target).len(),
    ];
    assert!(here > 0);
    assert_eq!(there, here);
    let swept = loaded.along(0, &held).ik_sweep(&target, 9);
    let own = PandaTool.along::<0>(held);
    for (there, here) in swept.into_iter().zip(own.ik_sweep(&target, 9)) {
        // Turned before the joints are solved for, not with them.
        assert_same(&there, &here, 1e-9);
    }
}

/// Eight joints and the turn of the tool are nine coordinates.
#[test]
fn a_turn_behind_eight_joints_has_its_intervals() {
    let options = RobotOptions {
        target: Some(Target::PositionAxis),
        ..RobotOptions::default()
    };
    let loaded = cached("robots/redundant/gantry_iiwa.yaml", &options);
    assert_eq!(loaded.parameters(), 3);
    let q = [0.4, 0.3, -0.7, 0.5, -1.2, 0.8, 0.6, -0.2];
    let target = loaded.fk(&q);
    let given = loaded.redundancy(&target, &q);
    for place in 0..3 {
        let along = loaded.along(place, &given);
        let intervals = along.feasible(&target);
        let holds = |it: &kinematics::Interval| it.contains(given[place]);
        assert!(intervals.iter().any(holds), "{place}: {intervals:?}");
    }
}

/// Arms in series: what bounds the rotations that a step sees was computed anew on every way to every
/// part of them, as many as powers of two.
#[test]
fn long_chains_are_read() {
    const ARMS: usize = 7;
    let arm = "0.1625, 0, pi/2; 0, -0.425, 0; 0, -0.3922, 0; 0.1333, 0, pi/2; 0.0997, 0, -pi/2; \
               0.0996, 0, 0";
    let mut text = "robot: series\nunits: {angle: rad, length: m}\ndh:\n".to_owned();
    for k in 0..ARMS {
        for (i, row) in arm.split(';').enumerate() {
            let [d, a, alpha] = row.split(',').map(str::trim).collect::<Vec<_>>()[..] else {
                panic!("three numbers");
            };
            let row = format!("theta: 0, d: {d}, a: {a}, alpha: {alpha}");
            text += &format!("  - {{name: j{}, {row}}}\n", 6 * k + i);
        }
    }
    let path = "series.yaml".to_owned();
    let robot = Robot::load(&RobotSource { path, text }, &RobotOptions::default()).unwrap();
    let joints = 6 * ARMS;
    assert_eq!((robot.joints(), robot.parameters()), (joints, joints - 6));
    let mut random = Random::new(52);
    for _ in 0..10 {
        let q: Vec<f64> = (0..joints).map(|_| random.angle()).collect();
        let pose = robot.fk(&q);
        let solutions = robot.ik_at(&pose, &robot.redundancy(&pose, &q));
        let apart = |it: &[f64]| {
            let each = it
                .iter()
                .zip(&q)
                .map(|(a, b)| (a - b).sin().hypot((a - b).cos() - 1.0));
            each.fold(0.0, f64::max)
        };
        assert!(solutions.iter().any(|it| apart(it.q) < 1e-6));
    }
}
