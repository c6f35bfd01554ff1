//! Arms with a parameter that carry a tool, or stand somewhere.

use crate::random::Random;
use crate::several::PandaTool;
use crate::{Iiwa14, Panda, Rail, StrayIiwa, Ur5e};
use kinematics::{
    Criterion, HighlyRedundantKinematics, JointLimit, Kinematics, Pose, RedundantKinematics, Robot,
    RobotOptions, Target, WithBase, WithTool, kinematics,
};

kinematics!("../robots/kr6_r900.yaml", name = Flange);
kinematics!(
    "../robots/kr6_r900.yaml",
    name = Gun,
    tool = [0.08, 0, 0.31, 0, -0.6, 2.5e-1],
    target = position_axis,
);

const GUN: [f64; 6] = [0.08, 0.0, 0.31, 0.0, -0.6, 0.25];

/// A configuration comes back at its parameter, intervals are those of the tip's target, and the
/// best configuration reaches the tool's.
fn is_the_arm<const N: usize>(robot: impl RedundantKinematics<N> + Copy, tool: Pose) {
    let base = Pose::from_rpy([0.3, -2.0, 1.1], [0.5, -0.2, 1.0]);
    let placed = WithBase {
        robot: WithTool { robot, tool },
        base,
    };
    let mut random = Random::new(0x70a1);
    let within = |limit: &JointLimit, random: &mut Random| {
        random.between(limit.lower().max(-3.0), limit.upper().min(3.0))
    };
    for _ in 0..20 {
        let q = robot.own_limits().map(|limit| within(&limit, &mut random));
        let target = base * robot.fk(&q) * tool;
        assert!(placed.fk(&q).rotation_distance(&target) < 1e-13);
        let parameter = placed.parameter_of(&target, &q);
        let solutions = placed.ik_at(&target, parameter);
        let is_same = |a: &[f64; N]| a.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(
            solutions.iter().any(|solution| is_same(&solution.q)),
            "{q:?}: {solutions:?}"
        );
        for solution in &solutions {
            let reached = placed.fk(&solution.q);
            assert!(robot.own_target().distance(&reached, &target, 1.0) < 1e-8);
        }
        let (all, of_tip) = (placed.feasible(&target), robot.feasible(&robot.fk(&q)));
        assert_eq!(all.len(), of_tip.len());
        let best = placed.ik_best(&target, &Criterion::Nearest(q)).unwrap();
        assert!(
            best.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-5),
            "{best:?} {q:?}"
        );
    }
}

#[test]
fn any_tool_of_an_arm_for_whole_poses() {
    let tool = Pose::from_rpy([0.4, 1.2, -0.7], [0.05, -0.1, 0.2]);
    is_the_arm(Iiwa14, tool);
    is_the_arm(Panda, tool);
    is_the_arm(Rail, tool);
}

#[test]
fn a_tool_on_the_axis_that_turns() {
    is_the_arm(Ur5e, Pose::from_rpy([0.0, 0.0, 0.6], [0.0, 0.0, 0.15]));
}

#[test]
#[should_panic(
    expected = "targets that are positions of the tip with the direction of its z axis leave open \
                where this tool puts the tip: compile the robot with the option `tool`, or solve \
                for whole poses"
)]
fn a_tool_beside_that_axis_is_refused() {
    let tool = Pose::from_translation([0.1, 0.0, 0.15]);
    WithTool { robot: Ur5e, tool }.ik_at(&Ur5e.fk(&[0.3; 6]), 0.0);
}

/// Turned about what is left open, tools that are allowed stay where the target has them.
#[test]
fn what_does_not_count_moves_no_tip() {
    let targets = [Target::Position, Target::PositionAxis, Target::Direction];
    let tools = [
        Pose::from_rpy([0.0, 0.0, 0.6], [0.0; 3]),
        Pose::from_rpy([0.0, 0.0, 0.6], [0.0, 0.0, 0.3]),
        Pose::from_rpy([0.0, 0.0, 0.6], [0.2, 0.0, 0.3]),
        Pose::from_rpy([0.1, 0.0, 0.6], [0.0; 3]),
    ];
    let allowed = [
        [true, false, false, true],
        [true, true, false, false],
        [true, true, true, false],
    ];
    for (target, allowed) in targets.into_iter().zip(allowed) {
        for (tool, allowed) in tools.iter().zip(allowed) {
            assert_eq!(target.allows_tool(tool), allowed, "{target:?} {tool:?}");
            let here = Pose::from_rpy([0.5, -0.3, 0.2], [1.0, 2.0, 3.0]);
            let turn = match target {
                Target::Position => Pose::from_rpy([1.0, 0.7, -0.4], [0.0; 3]),
                Target::PositionAxis => Pose::from_rpy([0.0, 0.0, 1.0], [0.0; 3]),
                _ => Pose::from_rpy([0.0, 0.0, 1.0], [0.3, 0.1, -0.8]),
            };
            let at_tip = [here, here * turn].map(|at| at * tool.inverse());
            let moved = target.distance(&at_tip[0], &at_tip[1], 1.0);
            assert_eq!(moved < 1e-9, allowed, "{target:?} {tool:?}: {moved}");
        }
    }
}

/// Off its design, intervals are followed by the equations of the placed arm.
#[test]
fn an_arm_off_its_design_whose_swivel_is_given() {
    let tool = Pose::from_rpy([0.4, 1.2, -0.7], [0.05, -0.1, 0.2]);
    let base = Pose::from_rpy([0.3, -2.0, 1.1], [0.5, -0.2, 1.0]);
    let robot = WithTool {
        robot: StrayIiwa,
        tool,
    };
    let placed = WithBase { robot, base };
    let q = [0.3, 0.6, -0.4, -1.3, 0.5, 0.9, 0.2];
    let (own, target) = (StrayIiwa.fk(&q), placed.fk(&q));
    let [intervals, expected] = [placed.feasible(&target), StrayIiwa.feasible(&own)];
    assert_eq!(intervals.len(), expected.len());
    for (interval, expected) in intervals.iter().zip(&expected) {
        let ends = [interval.from - expected.from, interval.to - expected.to];
        assert!(
            ends.iter().all(|end| end.abs() < 1e-8),
            "{interval:?} {expected:?}"
        );
        let reached = placed.fk(&interval.middle);
        assert!(
            Target::Pose.distance(&reached, &target, 1.0) < 1e-8,
            "{interval:?}"
        );
    }
}

/// A tool that is held turned is as much beside the axis.
#[test]
#[should_panic(expected = "leave open where this tool puts the tip")]
fn a_tool_beside_the_axis_is_refused_where_the_turn_is_held() {
    let tool = Pose::from_translation([0.1, 0.0, 0.15]);
    let arm = PandaTool.along::<0>([0.0, 0.3]);
    WithTool { robot: arm, tool }.ik_at(&Pose::IDENTITY, 0.6);
}

#[test]
fn a_tool_on_the_axis_of_an_arm_whose_turn_is_held() {
    let tool = Pose::from_rpy([0.0, 0.0, 0.6], [0.0, 0.0, 0.15]);
    let q = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
    let target = PandaTool.fk(&q) * tool;
    let turn = 0.3;
    let arm = WithTool {
        robot: PandaTool.along::<0>([0.0, turn]),
        tool,
    };
    let intervals = arm.feasible(&target.turned(-turn));
    assert!(
        intervals.iter().any(|interval| interval.contains(q[6])),
        "{intervals:?}"
    );
    for interval in &intervals {
        let reached = arm.fk(&interval.middle);
        assert!(
            Target::Pose.distance(&reached, &target, 1.0) < 1e-8,
            "{interval:?}"
        );
    }
}

/// A welding gun at an angle to the flange, which may turn about its own axis: what the flange is
/// solved for with the gun turned so far.
#[test]
fn a_tool_that_is_compiled_in() {
    let options = RobotOptions {
        tool: Some(GUN),
        target: Some(Target::PositionAxis),
        ..RobotOptions::default()
    };
    let loaded = crate::cached::cached("../robots/kr6_r900.yaml", &options);
    let [x, y, z, roll, pitch, yaw] = GUN;
    let tool = Pose::from_rpy([roll, pitch, yaw], [x, y, z]);
    let robot = WithTool {
        robot: Flange,
        tool,
    };
    let mut random = Random::new(0x9a7);
    for _ in 0..200 {
        let q: [f64; 6] = std::array::from_fn(|_| random.angle());
        let target = Gun.fk(&q);
        assert!(Target::Pose.distance(&target, &robot.fk(&q), 1.0) < 1e-13);
        assert!(Target::Pose.distance(&target, &loaded.fk(&q), 1.0) < 1e-13);
        let turn = random.angle();
        let turned = target * Pose::from_rpy([0.0, 0.0, turn], [0.0; 3]);
        let [found, expected] = [Gun.ik_at(&target, turn), robot.ik(&turned)];
        assert_eq!(found.len(), expected.len(), "{q:?} {turn}");
        let at_run_time = loaded.ik_at(&target, &[turn]);
        let at_run_time: Vec<f64> = at_run_time.iter().flat_map(|it| it.q.to_vec()).collect();
        let compiled: Vec<f64> = found.iter().flat_map(|it| it.q).collect();
        assert_eq!(compiled, at_run_time, "{q:?} {turn}");
        for solution in &found {
            let is_same = |a: f64, b: f64| (a - b).sin().abs() < 1e-8 && (a - b).cos() > 0.0;
            let is_it =
                |other: &[f64; 6]| solution.q.iter().zip(other).all(|(a, b)| is_same(*a, *b));
            assert!(expected.iter().any(|other| is_it(&other.q)), "{q:?} {turn}");
        }
        assert!(Gun.redundancy(&target, &q).abs() < 1e-12);
        // Its links are where they were.
        for (frame, without) in Gun::FRAMES.iter().zip(Flange::FRAMES) {
            assert_eq!(frame.name, without.name);
            let [at, expected] = [Gun.fk_frame(&q, frame), Flange.fk_frame(&q, without)];
            assert!(Target::Pose.distance(&at, &expected, 1.0) < 1e-13);
        }
        let at = Gun.fk_frame(&q, &Gun.frame("tool0").unwrap());
        let on_gun = [at * tool, loaded.fk_frame(&q, "tool0").unwrap() * tool];
        for at in on_gun {
            assert!(Target::Pose.distance(&at, &target, 1.0) < 1e-13);
        }
    }
}

#[test]
fn a_tool_that_cannot_be_meant() {
    let refused = |tool: [f64; 6]| {
        let options = RobotOptions {
            tool: Some(tool),
            ..RobotOptions::default()
        };
        let path = "../robots/kr6_r900.yaml";
        let text = std::fs::read_to_string(path).unwrap();
        let source = kinematics::RobotSource {
            path: path.into(),
            text,
        };
        Robot::load(&source, &options).unwrap_err().to_string()
    };
    let expect = [
        (
            [0.0, 0.0, 150.0, 0.0, 0.0, 0.0],
            "the tool [0.0, 0.0, 150.0, 0.0, 0.0, 0.0] is longer than 10 m: this looks like \
             millimetres\nhelp: give x, y and z in metres",
        ),
        (
            [0.0, 0.0, 0.1, 0.0, -45.0, 0.0],
            "the tool [0.0, 0.0, 0.1, 0.0, -45.0, 0.0] turns by more than a full turn: this looks \
             like degrees\nhelp: give roll, pitch and yaw in radians",
        ),
        (
            [0.0, f64::NAN, 0.1, 0.0, 0.0, 0.0],
            "the tool [0.0, NaN, 0.1, 0.0, 0.0, 0.0] has a number that is not finite\nhelp: give \
             six finite numbers",
        ),
    ];
    for (tool, text) in expect {
        let refused = refused(tool);
        let (file, said) = refused.split_once(": ").unwrap();
        assert!(file.ends_with("kr6_r900.yaml"), "{file}");
        assert_eq!(said.replace("\n       help", "\nhelp"), text);
    }
}
