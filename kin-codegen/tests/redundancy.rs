//! Which joints are given beside a target, or whether it is the swivel angle.

use kin_codegen::Target;
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::redundancy::{Asked, Redundancy, solve_redundant};
use kin_codegen::spec::{ArmSpec, Source};
use std::f64::consts::{FRAC_PI_2, PI};

/// Angles of six digits, and of four.
const RAIL: &str = "\
robot: arm
units: {angle: rad, length: m}
joints:
  - {name: rail, axis: [0, 1, 0], type: prismatic, limits: [0, 0.9]}
  - {name: pan, xyz: [0, 0, 0.2807], rpy: [0, 0, 1.5708], axis: [0, 0, 1]}
  - {name: lift, rpy: [1.570796, 0, 0], axis: [0, 0, 1]}
  - {name: elbow, xyz: [-0.6127, 0, 0], axis: [0, 0, 1]}
  - {name: wrist_1, xyz: [-0.57155, 0, 0.17415], axis: [0, 0, 1]}
  - {name: wrist_2, xyz: [0, -0.11985, 0], rpy: [1.570796, 0, 0], axis: [0, 0, 1]}
  - {name: wrist_3, xyz: [0, 0.11655, 0], rpy: [1.570796, 3.141593, 3.141593], axis: [0, 0, 1]}
tip: tool0
";

/// A turntable under an arm, with noise of 1e-8.
const TABLE: &str = "\
robot: arm
units: {angle: rad, length: m}
dh:
  - {name: table, a: 0.400000004, alpha: 1.570796328, d: 0.199999993, theta: 0.000000023}
  - {name: q1, a: 0.149999996, alpha: -1.570796334, d: 0.524999986, theta: 0.000000008}
  - {name: q2, a: 0.789999995, alpha: 3.141592651, d: -0.000000008, theta: -1.570796338}
  - {name: q3, a: 0.249999995, alpha: -1.570796359, d: 0.000000004, theta: -0.000000009}
  - {name: q4, a: -0.000000007, alpha: 1.570796329, d: -0.835000004, theta: 0.000000012}
  - {name: q5, a: -0.000000009, alpha: -1.570796325, d: 0.000000001, theta: 0.000000002}
  - {name: q6, a: -0.000000013, alpha: 3.141592652, d: -0.099999986, theta: -0.000000015}
";

/// Where it stands is given, though another joint would leave a plan of axes that are told to more
/// digits, or the only plan.
#[test]
fn what_an_arm_stands_on_is_given() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |file: &str| std::fs::read_to_string(root.join(file)).unwrap();
    let column = "mdh:\n  - {name: column, link: carriage, alpha: 0, a: 0, theta: 0, d: 0, \
                  type: prismatic, limits: [0, 1000]}\n";
    let lifted = read("robots/xarm6.yaml").replace("mdh:\n", column);
    for text in [RAIL.to_owned(), TABLE.to_owned(), lifted] {
        assert_eq!(solved(text.clone()).joints, [0], "{text}");
    }
}

/// Where two axes are aligned, the cheap plans of these arms lose solutions, whatever their
/// telescopes are given: only plans made for the configurations that were lost stand.
#[test]
fn a_telescope_is_given_where_cheap_plans_degenerate() {
    let turn = |axis: &str, point: &str| format!("axis: [{axis}], point: [{point}]");
    let slide = |axis: &str| format!("axis: [{axis}], type: prismatic");
    let [x, y, z] = ["1, 0, 0", "0, 1, 0", "0, 0, 1"];
    let upright = [
        turn(y, "0, 0, 0"),
        turn(z, "0, 0, 0"),
        slide(z),
        slide(z),
        turn(z, "0, 0.75, 0"),
        turn(y, "0, 0.75, 0.1"),
    ];
    let level = [
        turn(y, "0.1, 0, 0"),
        turn(x, "0.1, 0, 0.1"),
        turn(y, "0.1, 0, 0.4"),
        slide(y),
        slide(y),
        turn(y, "0.55, 0.3, 0.4"),
    ];
    for (joints, telescope) in [(upright, 2..4), (level, 3..5)] {
        let joints = joints.iter().enumerate();
        let joints = joints.map(|(i, joint)| format!("  - {{name: q{i}, {joint}}}\n"));
        let joints: String = joints.collect();
        let found = solved(format!(
            "robot: arm\nunits: {{angle: rad, length: m}}\nscrews:\n{joints}\
             home: {{xyz: [0.5, 0.8, 0.3]}}\n"
        ));
        assert!(matches!(found.joints[..], [joint] if telescope.contains(&joint)));
    }
}

/// A spherical wrist behind a shoulder that is none, as a Fetch has. At a pose its elbow hardly
/// moves: few of its values have solutions.
#[test]
fn an_elbow_is_not_given() {
    let joint = |name: &str, x: f64, z: f64, axis: &str| {
        format!("  - {{name: {name}, xyz: [{x}, 0, {z}], axis: [{axis}]}}\n")
    };
    let (roll, flex) = ("1, 0, 0", "0, 1, 0");
    let arm = [
        joint("pan", 0.119525, 0.34858, "0, 0, 1"),
        joint("lift", 0.117, 0.06, flex),
        joint("upperarm_roll", 0.219, 0.0, roll),
        joint("elbow", 0.133, 0.0, flex),
        joint("forearm_roll", 0.197, 0.0, roll),
        joint("wrist_flex", 0.1245, 0.0, flex),
        joint("wrist_roll", 0.1385, 0.0, roll),
    ];
    let torso = "  - {name: torso, axis: [0, 0, 1], type: prismatic, limits: [0, 0.4]}\n";
    for (carrier, given) in [("", vec![0]), (torso, vec![0, 1])] {
        let found = solved(format!(
            "robot: arm\nunits: {{angle: rad, length: m}}\njoints:\n{carrier}{}tip: tool0\n",
            arm.concat()
        ));
        assert_eq!(found.joints, given);
    }
}

const IIWA: [[f64; 6]; 7] = [
    [0.0, 0.0, 0.15, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.19, FRAC_PI_2, 0.0, PI],
    [0.0, 0.21, 0.0, FRAC_PI_2, 0.0, PI],
    [0.0, 0.0, 0.19, FRAC_PI_2, 0.0, 0.0],
    [0.0, 0.21, 0.0, -FRAC_PI_2, PI, 0.0],
    [0.0, 0.0607, 0.19, FRAC_PI_2, 0.0, 0.0],
    [0.0, 0.081, 0.0607, -FRAC_PI_2, PI, 0.0],
];

/// Whatever tool it has. Where the arm is folded, at which the samples are few, the swivel has no
/// angle: that once decided whether an iiwa 7 was given it.
#[test]
fn the_swivel_angle_is_given_whatever_the_tool() {
    for tool in [0.0, 0.045, 0.05, 0.09, 0.3] {
        let found = solved(iiwa(tool, |angle| format!("{angle:?}")));
        assert!(found.swivel.is_some(), "{tool}: {found:?}");
    }
}

/// However many digits its right angles have, as long as axes meet to a tenth of a nanometre: what
/// is given beside a pose is the meaning of a number. Its links are of one length, which that of
/// others is not to the last digit.
#[test]
fn the_swivel_angle_is_given_whatever_the_digits() {
    for digits in 10..14 {
        let found = solved(iiwa(0.045, |angle| format!("{angle:.digits$}")));
        assert!(found.swivel.is_some(), "{digits}: {found:?}");
    }
    for digits in 4..14 {
        for forearm in [0.4, 0.45] {
            let row = |(i, d): (usize, f64)| {
                let turn = [-1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 0.0][i] * FRAC_PI_2;
                format!("  - {{name: q{i}, a: 0, alpha: {turn:.digits$}, d: {d}, theta: 0}}\n")
            };
            let lengths = [0.34, 0.0, 0.4, 0.0, forearm, 0.0, 0.126];
            let rows: String = lengths.into_iter().enumerate().map(row).collect();
            let head = "robot: iiwa\nunits: {angle: rad, length: m}\ndh:\n";
            let found = solved(format!("{head}{rows}"));
            assert!(found.swivel.is_some(), "{digits}, {forearm}: {found:?}");
        }
    }
}

/// An iiwa 7 with a tool of this length, its angles written so.
fn iiwa(tool: f64, written: impl Fn(f64) -> String) -> String {
    let joints = IIWA.iter().enumerate();
    let joints = joints.map(|(i, [x, y, z, roll, pitch, yaw])| {
        let [roll, pitch, yaw] = [roll, pitch, yaw].map(|&angle| written(angle));
        format!(
            "  - {{name: q{i}, xyz: [{x}, {y}, {z}], rpy: [{roll}, {pitch}, {yaw}], \
             axis: [0, 0, 1]}}\n"
        )
    });
    let joints: String = joints.collect();
    format!(
        "robot: iiwa\nunits: {{angle: rad, length: m}}\njoints:\n{joints}  \
         - {{name: tool, type: fixed, xyz: [0, 0, {tool}]}}\n"
    )
}

/// Where the digits of a file take axes off each other by 1e-11, roots are double and angles are
/// free to that: no elbow is straight, no shoulder singular, to the last digit.
#[test]
fn twelve_digits_hide_no_singular_arm() {
    // Folded, it does not have its wrist in its shoulder.
    let text = iiwa(0.05, |angle| format!("{angle:.11}"));
    let model = model(text.replace("[0, 0.21, 0], rpy: [-", "[0, 0.2, 0], rpy: [-"));
    let linkage = Linkage::new(&model);
    let (solved, found) =
        solve_redundant(&model, &linkage, Target::Pose, &Asked::default()).unwrap();
    assert!(solved.form.is_exact() && solved.form.tip_shift > 1e-13);
    let swivel = found.swivel.unwrap();
    let (chain, mut random) = (model.chain(), Random(29));
    for k in 0..200 {
        let mut q: [f64; 7] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        q[if k % 2 == 0 { 3 } else { 1 }] = 0.0;
        let pose = chain.fk(&q);
        let angle = swivel.angle(&chain, &q);
        let angle = if angle.is_nan() { 0.4 } else { angle };
        let found = solved.form.solutions_at(&pose, &[angle]);
        assert!(!found.is_empty(), "{k}: {q:?}");
        for (i, solution) in found.iter().enumerate() {
            assert!(solution.singular, "{q:?}: {solution:?}");
            for other in &found[..i] {
                let apart = solution.q.iter().zip(&other.q);
                let apart = apart.map(|(a, b)| (0.5 * (a - b)).sin().abs());
                assert!(apart.fold(0.0, f64::max) > 1e-6, "{q:?}: {found:?}");
            }
        }
    }
}

fn model(text: String) -> Model {
    let source = Source {
        path: "arm.yaml".into(),
        text,
    };
    Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap()
}

/// What is given beside a pose to the arm of a file.
fn solved(text: String) -> Redundancy {
    let model = model(text);
    let linkage = Linkage::new(&model);
    let (_, found) = solve_redundant(&model, &linkage, Target::Pose, &Asked::default()).unwrap();
    found
}

/// Whatever the wrist is given, the joints before it reach most positions; a wrist alone reaches
/// few, though its plan takes no more.
#[test]
fn a_position_is_reached_by_the_joints_before_the_wrist() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    let six = ["ur5e.urdf", "kr6_r900.yaml", "xarm6.yaml", "stanford.yaml"];
    let six = six.map(|file| (file, vec![3, 4, 5]));
    // The first joint would make the cheapest plan.
    for (file, wrist) in six.into_iter().chain([("planar_3r.yaml", vec![2])]) {
        let source = Source::read(file, &root).unwrap();
        let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
        let linkage = Linkage::for_target(&model, Target::Position);
        let asked = Asked::default();
        let found = solve_redundant(&model, &linkage, Target::Position, &asked);
        assert_eq!(found.unwrap().1.joints, wrist, "{file}");
    }
}
