//! Two parameters: eight joints for whole poses, and seven where the tool may turn.

use crate::cached::cached;
use crate::follow::{jumps, next_to_a_stop};
use crate::random::Random;
use kinematics::{
    Criterion, FeasibleInterval, Follow, HighlyRedundantKinematics, JointLimit, Kinematics,
    Parameter, Pose, RedundantKinematics, Robot, RobotOptions, RobotSource, Target, kinematics,
};
use std::f64::consts::{FRAC_PI_2, PI};

kinematics!(
    "robots/redundant/gantry_iiwa.yaml",
    free = ["slide", "joint_a3"]
);
kinematics!("robots/redundant/mobile_panda.yaml");
kinematics!(
    "robots/redundant/rail.yaml",
    name = RailByWrist,
    free = "wrist_3"
);
kinematics!(
    "../robots/panda.yaml",
    name = PandaTool,
    target = position_axis
);
kinematics!(
    "../robots/sawyer.yaml",
    name = SawyerTool,
    target = position_axis
);

kinematics!(
    "../robots/ur10e.yaml",
    name = Ur10ePosition,
    target = position
);
kinematics!(
    "../robots/ur5e.urdf",
    name = Ur5eOrientation,
    target = orientation
);
kinematics!(
    "../robots/planar_3r.yaml",
    target = position,
    free = "shoulder"
);

/// Joints that are held stay where they are.
#[test]
fn along_one_a_jump_is_one_at_all_parameters_in_reach() {
    let random = &mut Random::new(92);
    let mut start = next_to_a_stop(GantryIiwa::LIMITS);
    let mut counts = [0, 0];
    for _ in 0..5 {
        let q = start(random);
        let given = GantryIiwa.redundancy(&q);
        let along = GantryIiwa.along::<1>(given);
        let of_one = jumps(&along, random, |_| q);
        counts = [counts[0] + of_one[0], counts[1] + of_one[1]];
    }
    assert!(counts[1] == 0 && counts[0] > 0, "{counts:?}");
}

fn apart<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let each = a.iter().zip(b).map(|(a, b)| {
        let d = (a - b).abs() % (2.0 * PI);
        d.min(2.0 * PI - d)
    });
    each.fold(0.0, f64::max)
}

#[test]
fn a_slide_and_the_elbow() {
    assert_eq!(
        GantryIiwa::PARAMETERS,
        [Parameter::Joint(0), Parameter::Joint(3)]
    );
    let mut random = Random::new(8);
    for _ in 0..200 {
        let q: [f64; 8] = std::array::from_fn(|i| match i {
            0 => random.between(-2.0, 2.0),
            _ => random.angle(),
        });
        let given = GantryIiwa.redundancy(&q);
        assert_eq!(given, [q[0], q[3]]);
        let target = GantryIiwa.fk(&q);
        let answers = GantryIiwa.ik_at(&target, &given);
        assert_eq!(answers.len(), GantryIiwa::BRANCHES_AT);
        assert!(
            answers.iter().any(|answer| apart(&answer.q, &q) < 1e-7),
            "{q:?}"
        );
        for answer in &answers {
            assert_eq!([answer.q[0], answer.q[3]], given);
            let found = GantryIiwa.fk(&answer.q);
            assert!(found.translation_distance(&target) < 1e-9, "{answer:?}");
            assert!(found.rotation_distance(&target) < 1e-9, "{answer:?}");
        }
    }
}

#[test]
fn the_last_joint_and_the_turn_of_the_tool() {
    assert_eq!(
        PandaTool::PARAMETERS,
        [Parameter::Joint(6), Parameter::Turn]
    );
    let mut random = Random::new(9);
    for _ in 0..200 {
        let q: [f64; 7] = std::array::from_fn(|_| random.angle());
        // The target has its x axis elsewhere: what counts is the axis of the tool.
        let target = PandaTool.fk(&q).turned(random.angle());
        let given = PandaTool.redundancy(&target, &q);
        let answers = PandaTool.ik_at(&target, &given);
        assert!(
            answers.iter().any(|answer| apart(&answer.q, &q) < 1e-7),
            "{q:?}"
        );
        let other = PandaTool.ik_at(&target, &[q[6], given[1] + 0.3]);
        for answer in &other {
            let found = PandaTool.fk(&answer.q);
            assert!(found.translation_distance(&target) < 1e-9, "{answer:?}");
            assert!((target.turn_to(&found) - given[1] - 0.3).sin().abs() < 1e-9);
        }
    }
}

/// Along one parameter with the other held: intervals against values evenly over a turn, the
/// best configuration, one step of a path.
fn along_one<K: RedundantKinematics<N>, const N: usize>(arm: &K, q: &[f64; N], target: &Pose) {
    let own = arm.parameter_of(target, q);
    let close = |x: &[f64; N]| apart(x, q) < 1e-6;
    assert!(
        arm.ik_at(target, own)
            .iter()
            .any(|solution| close(&solution.q))
    );
    intervals_hold(arm, q, target);
    let best = arm.ik_best(target, &Criterion::Nearest(*q)).unwrap();
    let ways = (0..N).map(|i| (best[i] - q[i]).powi(2)).sum::<f64>();
    assert!(ways.sqrt() < 1e-6, "{best:?} is not {q:?}");
    let step = arm
        .ik_follow(target, q, &Follow::new(&K::LIMITS, 1e-3))
        .unwrap();
    assert!(!step.jumps && apart(&step.solution.q, q) < 0.1);
    assert_eq!(arm.ik_sweep(target, 5).count(), 5);
    let nearest = arm.ik_nearest_at(target, own, q).unwrap();
    assert!(close(&nearest.q));
}

/// Where there is a solution, there is the interval of its branch, and nowhere else.
fn intervals_hold<K: RedundantKinematics<N>, const N: usize>(arm: &K, q: &[f64; N], target: &Pose) {
    let intervals = arm.feasible(target);
    let [lower, upper] = match K::PARAMETER {
        Parameter::Joint(joint) if !K::LIMITS[joint].is_revolute() => {
            [K::LIMITS[joint].lower(), K::LIMITS[joint].upper()]
        }
        _ => [-PI, PI],
    };
    for i in 0..100 {
        let value = lower + (upper - lower) * (f64::from(i) + 0.37) / 100.0;
        let ends = intervals
            .iter()
            .flat_map(|interval| [interval.from, interval.to]);
        if ends
            .map(|end| (end - value) / (2.0 * PI))
            .any(|d| (d - d.round()).abs() < 1e-6)
        {
            continue;
        }
        let held = intervals.iter().filter(|interval| interval.contains(value));
        let solutions = arm.ik_at(target, value).len();
        assert_eq!(held.count(), solutions, "{value} of {q:?}: {intervals:#?}");
    }
}

/// Of a position the second root does not depend on the sign of the first: its zeros end intervals
/// of all branches.
#[test]
fn roots_that_do_not_depend_on_others_end_all_branches() {
    let mut random = Random::new(0x10e);
    for _ in 0..20 {
        let q: [f64; 6] = std::array::from_fn(|_| random.angle());
        let target = Ur10ePosition.fk(&q);
        let given = Ur10ePosition.redundancy(&q);
        intervals_hold(&Ur10ePosition.along::<0>(given), &q, &target);
        intervals_hold(&Ur10ePosition.along::<1>(given), &q, &target);
        intervals_hold(&Ur10ePosition.along::<2>(given), &q, &target);
        let loaded = crate::at_run_time::ur10e_for_positions();
        let read = loaded.along(0, &given).feasible(&target);
        let ends: Vec<[f64; 2]> = read.iter().map(|it| [it.from, it.to]).collect();
        let own = Ur10ePosition.along::<0>(given).feasible(&target);
        assert_eq!(
            ends,
            own.iter().map(|it| [it.from, it.to]).collect::<Vec<_>>()
        );
    }
}

/// With the wrist straight two axes are one, whatever the others do: the branch has no end.
#[test]
fn an_angle_that_is_free_throughout_leaves_an_interval() {
    for bend in [0.0, 1e-12, 1e-9, 1e-7, PI] {
        let q = [0.4, -1.1, 0.8, 0.3, bend, -0.6];
        let target = Ur5eOrientation.fk(&q);
        let given = Ur5eOrientation.redundancy(&q);
        intervals_hold(&Ur5eOrientation.along::<1>(given), &q, &target);
        let best = Ur5eOrientation
            .along::<1>(given)
            .ik_best(&target, &Criterion::Nearest(q));
        assert!(best.is_some(), "{bend:e}");
    }
}

#[test]
fn what_is_no_pose_has_no_intervals() {
    let there = crate::Panda.fk(&[0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6]);
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let mut target = there;
        target.translation[0] = bad;
        assert!(crate::Panda.feasible(&target).is_empty());
        let limits = &crate::Panda::LIMITS;
        assert!(crate::Panda.feasible_within(&target, limits).is_empty());
        let best = crate::Panda.ik_best(&target, &Criterion::Manipulability);
        assert!(best.is_none());
    }
}

/// Of a target that the arm reaches nearly folded, an elbow turns back within a thousandth of the
/// parameter's turn: beside the end of what is replaced by a polynomial.
#[test]
fn a_limit_is_crossed_where_an_arm_is_nearly_folded() {
    let mut random = Random::new(0xf01d);
    let mut limits = [JointLimit::Continuous; 3];
    limits[1] = JointLimit::revolute(0.0, 2.0);
    for off in [1e-3, 1e-4, 1e-5].into_iter().cycle().take(90) {
        let mut near = |x: f64| x + random.between(-off, off);
        let q = [near(0.0), near(0.0), near(PI)];
        let q = [q[0] + random.between(-3.0, 3.0), q[1], q[2]];
        let target = Planar3r.fk(&q);
        let intervals = Planar3r.feasible_within(&target, &limits);
        for k in 0..100 {
            let value = PI * ((f64::from(k) + 0.37) / 50.0 - 1.0);
            let solutions = Planar3r.ik_at(&target, value);
            let inside = |by: f64| {
                let elbows = solutions.iter().map(|solution| solution.q[1]);
                elbows.filter(|q| (-by..2.0 + by).contains(q)).count()
            };
            let [least, most] = [-1e-3, 1e-3].map(inside);
            let held = intervals
                .iter()
                .filter(|it| it.from < it.to && it.contains(value));
            let held = held.count();
            assert!(
                (least..=most).contains(&held),
                "{value} of {q:?}: {intervals:#?}"
            );
        }
    }
}

/// Along the last joint the rail runs to infinity, next to which branches end.
#[test]
fn next_to_where_a_slide_runs_to_infinity_branches_end_where_they_do() {
    let q = [
        0.850_912_908_058_339_7,
        -2.541_134_185_295_925,
        1.703_118_198_342_693_7,
        2.828_887_681_121_983,
        -1.425_634_814_574_663_8,
        -1.152_955_971_625_215,
        -1.248_448_274_370_270_5,
    ];
    let target = RailByWrist.fk(&q);
    let all = RailByWrist.feasible(&target);
    let within = RailByWrist.feasible_within(&target, &RailByWrist::LIMITS);
    let mut none_between = false;
    for i in 0..200 {
        // Two branches end at 1.919 and begin again at 1.949.
        let value = 1.9 + 0.0005 * (f64::from(i) + 0.37);
        let solutions = RailByWrist.ik_at(&target, value);
        let held = all.iter().filter(|it| it.contains(value)).count();
        assert_eq!(held, solutions.len(), "{value}: {all:#?}");
        let inside = solutions.within_limits(&RailByWrist::LIMITS).len();
        let held = within.iter().filter(|it| it.contains(value)).count();
        assert_eq!(held, inside, "{value}: {within:#?}");
        none_between |= solutions.len() < RailByWrist::BRANCHES_AT;
    }
    assert!(none_between);
}

/// Metres do not come round.
#[test]
fn an_interval_of_a_slide_holds_what_is_between_its_ends() {
    let q = [0.2, 0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    for interval in crate::Rail.feasible(&crate::Rail.fk(&q)) {
        assert!(!interval.is_angle && interval.contains(0.5 * (interval.from + interval.to)));
        assert!(!interval.contains(interval.from + 2.0 * PI + 1e-9));
    }
    let turn = crate::Panda.feasible(&crate::Panda.fk(&[0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6]));
    assert!(turn[0].is_angle && turn[0].contains(turn[0].from + 2.0 * PI + 1e-9));
}

#[test]
fn with_the_others_held_one_parameter_has_its_intervals() {
    let q = [0.4, 0.3, 0.9, -0.4, 1.2, 0.5, -0.8, 0.6];
    let target = GantryIiwa.fk(&q);
    let given = GantryIiwa.redundancy(&q);
    // What is held in the place of the one that moves is not read.
    along_one(&GantryIiwa.along::<0>([9.9, given[1]]), &q, &target);
    along_one(&GantryIiwa.along::<1>([given[0], 9.9]), &q, &target);

    let q = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
    let target = PandaTool.fk(&q).turned(-0.7);
    let given = PandaTool.redundancy(&target, &q);
    along_one(&PandaTool.along::<0>([9.9, given[1]]), &q, &target);
    along_one(&PandaTool.along::<1>([given[0], 9.9]), &q, &target);
}

/// Ten joints, six of which move beside the one that is followed.
#[test]
fn with_three_others_held_one_parameter_has_its_intervals() {
    let slide = Parameter::Joint;
    assert_eq!(MobilePanda::PARAMETERS, [0, 1, 2, 9].map(slide));
    let mut random = Random::new(0x10);
    for _ in 0..8 {
        let q: [f64; 10] = std::array::from_fn(|i| match MobilePanda::LIMITS[i] {
            limit if limit.is_revolute() => {
                random.between(limit.lower().max(-PI), limit.upper().min(PI))
            }
            _ => random.between(-1.0, 1.0),
        });
        let target = MobilePanda.fk(&q);
        let [x, y, heading, last] = MobilePanda.redundancy(&q);
        along_one(
            &MobilePanda.along::<0>([9.9, y, heading, last]),
            &q,
            &target,
        );
        along_one(
            &MobilePanda.along::<1>([x, 9.9, heading, last]),
            &q,
            &target,
        );
        along_one(&MobilePanda.along::<2>([x, y, 9.9, last]), &q, &target);
        along_one(&MobilePanda.along::<3>([x, y, heading, 9.9]), &q, &target);
    }
}

/// What an arm computes in a form of its own is that of the arm with parameters held.
#[test]
fn with_the_others_held_an_arm_is_as_it_was() {
    let q = [0.4, 0.3, 0.9, -0.4, 1.2, 0.5, -0.8, 0.6, 0.2, -1.1];
    let held = MobilePanda.along::<0>([9.9, 0.3, 0.9, -1.1]);
    let rates = q.map(|q| 1.0 - q);
    assert_eq!(
        held.jacobian_dot(&q, &rates),
        MobilePanda.jacobian_dot(&q, &rates)
    );
    assert_eq!(held.body_jacobian(&q), MobilePanda.body_jacobian(&q));
    assert_eq!(
        held.geometric_jacobian(&q),
        MobilePanda.geometric_jacobian(&q)
    );
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let held = Ur10ePosition.along::<0>([9.9, 0.1, 0.2]);
    let own: Vec<_> = Ur10ePosition.singularities(&q).to_vec();
    assert!(!own.is_empty());
    assert_eq!(held.singularities(&q).to_vec(), own);
    assert_eq!(
        held.jacobian_determinant(&q),
        Some(Ur10ePosition.jacobian_determinant(&q))
    );
}

/// Without closed form, where branches begin and end is looked for along each of two parameters:
/// the last joint turns about the axis that the tool turns about.
#[test]
fn short_lived_branches_along_one_of_two_parameters_are_found() {
    let loaded = crate::at_run_time::sawyer_whose_tool_turns();
    for (q, _) in &crate::feasible::SHORT_LIVED[..2] {
        let target = SawyerTool.fk(q);
        let alone = crate::Sawyer.feasible(&target);
        assert_eq!(SawyerTool.along::<0>([9.9, 0.0]).feasible(&target), alone);
        let ends = |it: &FeasibleInterval<7>| [it.from, it.to];
        let read = loaded.along(0, &[9.9, 0.0]).feasible(&target);
        let read: Vec<[f64; 2]> = read.iter().map(|it| [it.from, it.to]).collect();
        assert_eq!(read, alone.iter().map(ends).collect::<Vec<_>>());
        let turned = SawyerTool.along::<1>([q[6], 9.9]).feasible(&target);
        let length =
            |all: &[FeasibleInterval<7>]| -> f64 { all.iter().map(|it| it.to - it.from).sum() };
        assert_eq!(turned.len(), alone.len());
        assert!((length(&turned) - length(&alone)).abs() < 1e-6);
    }
}

/// The wrist does not change where the tip is, and yet its values are in what is returned.
#[test]
fn parameters_that_are_no_numbers_have_no_solutions() {
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let (target, given) = (Ur10ePosition.fk(&q), Ur10ePosition.redundancy(&q));
    assert!(!Ur10ePosition.ik_at(&target, &given).is_empty());
    let options = RobotOptions {
        target: Some(Target::Position),
        ..RobotOptions::default()
    };
    let loaded = cached("../robots/ur10e.yaml", &options);
    for i in 0..given.len() {
        for value in [f64::NAN, f64::INFINITY] {
            let mut given = given;
            given[i] = value;
            assert!(
                Ur10ePosition.ik_at(&target, &given).is_empty(),
                "{i} {value}"
            );
            assert!(loaded.ik_at(&target, &given).is_empty(), "{i} {value}");
        }
    }
}

/// Where joint 4 of three that are given is a quarter turn away, the first step of the plan with fewest
/// operations leaves its joint free, and half of the targets had no answer.
#[test]
fn each_given_joint_may_be_at_a_quarter_turn() {
    let text = "
robot: arm
units: {angle: rad, length: m}
screws:
  - {name: j1, axis: [1, 0, 0], point: [0, 0, 0]}
  - {name: j2, axis: [0, 1, 0], point: [0, 0.18, 0.05]}
  - {name: j3, axis: [1, 0, 0], point: [0.42, 0.23, 0.02]}
  - {name: j4, axis: [0, 1, 0], point: [0.42, 0.23, 0.02]}
  - {name: j5, axis: [0, 1, 0], type: prismatic}
  - {name: j6, axis: [1, 0, 0], type: prismatic}
home: {xyz: [0.91, -0.2, -0.33]}
";
    let source = RobotSource {
        path: "arm.yaml".into(),
        text: text.into(),
    };
    let options = RobotOptions {
        target: Some(Target::Position),
        free: ["j1", "j4", "j6"].map(String::from).to_vec(),
        ..RobotOptions::default()
    };
    let robot = Robot::load(&source, &options).unwrap();
    let mut random = Random::new(43);
    for k in 0..400 {
        let mut q: [f64; 6] = std::array::from_fn(|_| random.angle());
        q[3] = [FRAC_PI_2, -FRAC_PI_2, PI, 0.0][k % 4];
        for slide in &mut q[4..] {
            *slide /= 6.0;
        }
        let target = robot.fk(&q);
        let given = robot.redundancy(&target, &q);
        let solutions = robot.ik_at(&target, &given);
        let near = |it: &[f64]| it.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(solutions.iter().any(|it| near(it.q)), "{q:?}");
    }
}
