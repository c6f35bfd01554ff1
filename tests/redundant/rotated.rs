//! Arms whose base, tool and frames between them stand anywhere, so that no constant of the file
//! is a round number: what comes out, at configurations with right angles and next to them.

use crate::random::Random;
use kin_codegen::Target;
use kinematics::{Chain, Interval, Parameter, Pose, Robot, RobotOptions, RobotSource, Twist};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

/// How far joint values are off right angles, radians.
const OFF: [f64; 6] = [0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4];
/// Below this conditioning a configuration may be one of a family.
const SINGULAR: f64 = 1e-5;
/// Of a target by forward kinematics, which conditioning magnifies.
const ROUNDING: f64 = 1e-10;

#[test]
fn an_iiwa() {
    recovers("../robots/iiwa14.yaml", Target::Pose);
}

#[test]
fn a_panda() {
    recovers("../robots/panda.yaml", Target::Pose);
}

#[test]
fn a_ur5e_whose_tool_turns() {
    recovers("../robots/ur5e.urdf", Target::PositionAxis);
}

fn recovers(path: &str, target: Target) {
    let options = RobotOptions {
        target: Some(target),
        ..RobotOptions::default()
    };
    let source = RobotSource::read(path, Path::new("")).unwrap();
    let plain = Robot::load(&source, &options).unwrap();
    let mut random = Random::new(23);
    let source = RobotSource {
        path: "rotated.urdf".into(),
        text: rotated(&plain, target, &mut random),
    };
    let robot = Robot::load(&source, &options).unwrap();
    assert_eq!(robot.branches_at(), plain.branches_at());
    let (mut regular, mut held_at_all) = (0, 0);
    for off in OFF {
        for _ in 0..30 {
            let q: Vec<f64> = (0..robot.joints())
                .map(|_| match random.between(0.0, 1.0) < 0.6 {
                    true => random.right_angle() + off * random.between(-1.0, 1.0),
                    false => random.angle(),
                })
                .collect();
            regular += usize::from(comes_back(&robot, &q));
            held_at_all += has_its_intervals(&robot, &q);
        }
    }
    assert!(
        regular > 20 && held_at_all > 1000,
        "{regular} {held_at_all}"
    );
}

/// Whether a configuration is regular, and then is among the solutions for its target.
fn comes_back(robot: &Robot, q: &[f64]) -> bool {
    let conditioning = conditioning(robot, q);
    let target = robot.fk(q);
    let answers = robot.ik_at(&target, &robot.redundancy(&target, q));
    let apart = |a: &[f64]| {
        let each = a.iter().zip(q).map(|(a, b)| {
            let d = (a - b).rem_euclid(TAU);
            d.min(TAU - d)
        });
        each.fold(0.0, f64::max)
    };
    let nearest = answers.iter().map(|answer| apart(answer.q));
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    let is_regular = conditioning > SINGULAR;
    assert!(
        !is_regular || nearest < ROUNDING / conditioning,
        "{q:?} of conditioning {conditioning:e} is {nearest:e} from {answers:?}"
    );
    is_regular
}

/// As many branches exist at a value of the parameter as there are solutions; how many.
fn has_its_intervals(robot: &Robot, q: &[f64]) -> usize {
    let target = robot.fk(q);
    let along = robot.along_parameter();
    let intervals = along.feasible(&target);
    let mut held_at_all = 0;
    for i in 0..12 {
        let value = TAU * f64::from(i) / 12.0 + 0.0123;
        if intervals.iter().any(|interval| ends_near(interval, value)) {
            continue;
        }
        let held = intervals.iter().filter(|interval| interval.contains(value));
        let (held, solutions) = (held.count(), along.ik_at(&target, value).len());
        assert_eq!(held, solutions, "at {value} of {q:?}: {intervals:#?}");
        held_at_all += held;
    }
    held_at_all
}

/// With the fifth joint given, four solutions share a value of the kept joint in a plane, where the
/// root of the elimination is known to a quarter of its digits.
#[test]
fn four_solutions_that_share_a_joint_come_back() {
    let path = "../robots/panda.yaml";
    let options = RobotOptions {
        free: vec!["joint5".into()],
        ..RobotOptions::default()
    };
    let source = RobotSource::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let robot = Robot::load(&source, &options).unwrap();
    let mut regular = 0;
    for (k, off) in (0..4096).flat_map(|k| [0.0, 1e-9].map(|off| (k, off))) {
        let turn = |i: i32| f64::from(k >> (2 * i) & 3) * (TAU / 4.0) + off * f64::from(i - 3);
        let q: Vec<f64> = [0.0].into_iter().chain((0..6).map(turn)).collect();
        if conditioning(&robot, &q) < 1e-3 {
            continue;
        }
        regular += 1;
        let target = robot.fk(&q);
        let parameters = robot.redundancy(&target, &q);
        let solutions = robot.ik_at(&target, &parameters);
        let off = |p: &[f64]| {
            let off = p.iter().zip(&q);
            off.fold(0.0, |most: f64, (a, b)| {
                let d = (a - b).rem_euclid(TAU);
                most.max(d.min(TAU - d))
            })
        };
        let found = solutions.iter().filter(|it| off(it.q) < 1e-5).count();
        assert_eq!(found, 1, "{q:?} among {}", solutions.len());
    }
    assert!(regular > 2000, "{regular}");
}

/// Whether rounding may keep a branch for so long, or end it: longer where it exists at a value
/// alone.
fn ends_near(interval: &Interval, value: f64) -> bool {
    let by = if interval.from == interval.to {
        0.05
    } else {
        1e-4
    };
    let near = |end: f64| {
        let d = (value - end).rem_euclid(TAU);
        d.min(TAU - d) < by
    };
    !interval.is_closed && (near(interval.from) || near(interval.to))
}

/// The least singular value by the largest, of the Jacobian of what a parameter leaves.
fn conditioning(robot: &Robot, q: &[f64]) -> f64 {
    let columns = match robot.parameter(0) {
        // The swivel angle takes a motion of all joints: at right angles of the elbow to the
        // shoulder it is none.
        Some(Parameter::Swivel(_)) => return swivel_conditioning(robot, q),
        Some(Parameter::Joint(joint)) => {
            let mut columns = robot.geometric_jacobian(q);
            columns.remove(joint);
            columns
        }
        _ => robot.geometric_jacobian(q),
    };
    let column = |twist: &Twist| {
        let ([a, b, c], [d, e, f]) = (twist.linear, twist.angular);
        [a, b, c, d, e, f]
    };
    let columns: Vec<[f64; 6]> = columns.iter().map(column).collect();
    least_by_largest(
        6,
        &columns.iter().map(|column| &column[..]).collect::<Vec<_>>(),
    )
}

fn least_by_largest(rows: usize, columns: &[&[f64]]) -> f64 {
    let matrix = nalgebra::DMatrix::from_fn(rows, columns.len(), |i, j| columns[j][i]);
    let values = singular_values::of(matrix);
    values[values.len() - 1] / values[0]
}

/// With the swivel angle by differences as a seventh row.
fn swivel_conditioning(robot: &Robot, q: &[f64]) -> f64 {
    let target = robot.fk(q);
    let angle = |joint: usize, by: f64| {
        let mut moved = q.to_vec();
        moved[joint] += by;
        robot.redundancy(&target, &moved)[0]
    };
    let step = 1e-6;
    let jacobian = robot.geometric_jacobian(q);
    let columns: Vec<[f64; 7]> = (0..q.len())
        .map(|joint| {
            let turned = angle(joint, step) - angle(joint, -step);
            let rate = (turned - TAU * (turned / TAU).round()) / (2.0 * step);
            let ([a, b, c], [d, e, f]) = (jacobian[joint].linear, jacobian[joint].angular);
            [a, b, c, d, e, f, rate]
        })
        .collect();
    // Where the elbow has no side, no rate is a number, or it is as large as its step is short.
    if columns
        .iter()
        .any(|column| column[6].is_nan() || column[6].abs() >= 1e3)
    {
        return 0.0;
    }
    least_by_largest(
        7,
        &columns.iter().map(|column| &column[..]).collect::<Vec<_>>(),
    )
}

/// The same arm as a URDF in which every frame is turned and moved at random: joints stay on
/// their axes, and the tool turns about its own axis only where that is all that counts.
fn rotated(robot: &Robot, target: Target, random: &mut Random) -> String {
    let chain = robot.chain();
    let base = anywhere(random);
    let mut text = String::from("<robot name=\"rotated\"><link name=\"l0\"/>");
    let mut before = Pose::IDENTITY;
    let mut link = |before: Pose, frame: Pose, i: usize, kind: &str, axis: &str| {
        let [x, y, z] = (before.inverse() * frame).translation;
        let [roll, pitch, yaw] = roll_pitch_yaw(&(before.inverse() * frame).rotation);
        write!(
            text,
            "<link name=\"l{}\"/><joint name=\"j{i}\" type=\"{kind}\"><parent link=\"l{}\"/>\
             <child link=\"l{i}\"/><origin xyz=\"{x:?} {y:?} {z:?}\" rpy=\"{roll:?} {pitch:?} \
             {yaw:?}\"/>{axis}</joint>",
            i,
            i - 1,
        )
        .unwrap();
    };
    for (i, twist) in chain.twists().iter().enumerate() {
        let (w, v) = (twist.angular, twist.linear);
        let along = random.between(-0.3, 0.3);
        let foot = [
            w[1] * v[2] - w[2] * v[1],
            w[2] * v[0] - w[0] * v[2],
            w[0] * v[1] - w[1] * v[0],
        ];
        let on_axis = Pose::from_translation(std::array::from_fn(|k| foot[k] + along * w[k]));
        let turned = Pose {
            translation: [0.0; 3],
            ..anywhere(random)
        };
        let frame = base * on_axis * turned;
        let axis = Pose {
            translation: [0.0; 3],
            ..turned.inverse()
        };
        let [x, y, z] = (axis * Pose::from_translation(w)).translation;
        let axis = format!("<axis xyz=\"{x:?} {y:?} {z:?}\"/>");
        link(before, frame, i + 1, "continuous", &axis);
        before = frame;
    }
    let tool = match target {
        Target::PositionAxis => turn(2, random.angle()) * Pose::from_translation([0.0, 0.0, 0.1]),
        _ => anywhere(random),
    };
    let tip = base * *chain.home() * tool;
    link(before, tip, chain.twists().len() + 1, "fixed", "");
    text + "</robot>"
}

/// A pose anywhere.
fn anywhere(random: &mut Random) -> Pose {
    let moved = Pose::from_translation(random.unit_cube());
    (0..3).fold(moved, |pose, axis| pose * turn(axis, random.angle()))
}

/// A turn about an axis of coordinates.
fn turn(axis: usize, angle: f64) -> Pose {
    let unit = std::array::from_fn(|i| f64::from(u8::from(i == axis)));
    Chain::new(vec![Twist::revolute(unit, [0.0; 3])], Pose::IDENTITY).fk(&[angle])
}

/// The angles of a URDF's `rpy`.
fn roll_pitch_yaw(r: &[[f64; 3]; 3]) -> [f64; 3] {
    let pitch = (-r[2][0]).atan2(r[0][0].hypot(r[1][0]));
    [r[2][1].atan2(r[2][2]), pitch, r[1][0].atan2(r[0][0])]
}
