//! Files are not exact: right angles of few digits, axes that nearly meet,
//! calibrated arms. No branch is lost, and all reach the target on the literal
//! arm.

use crate::arm::{self, Arm, MEET, MEET_THERE, PARALLEL, SKEW, noisy_arm, placed};
use crate::check::Solved;
use crate::settings::in_cases;
use kin_codegen::geometry::Linkage;
use kin_codegen::model::Model;
use kin_codegen::plan::{Plans, Step, Subproblem, Target};
use kin_codegen::spec::{ArmSpec, Source};
use proptest::prop_assume;

const SPHERICAL_WRIST: &[arm::Step] = &[SKEW, MEET, PARALLEL, MEET, MEET, MEET_THERE];
const THREE_PARALLEL: &[arm::Step] = &[SKEW, MEET, PARALLEL, PARALLEL, MEET, MEET];

/// The last digit of a file, right angles of 6 and 4 digits, stray offsets, a
/// calibrated arm.
const LEVELS: &[[f64; 2]] = &[
    [1e-9, 0.0],
    [1e-9, 1e-9],
    [4e-6, 0.0],
    [4e-6, 1e-6],
    [0.0, 8.8e-5],
    [2e-4, 0.0],
    [2e-4, 2e-4],
];

#[test]
fn spherical_wrist() {
    away_from_singularities(SPHERICAL_WRIST);
}

#[test]
fn three_parallel() {
    away_from_singularities(THREE_PARALLEL);
}

/// Where all answers are many times farther from singular ones than the noise.
fn away_from_singularities(steps: &[arm::Step]) {
    in_cases(16, placed(noisy_arm(steps, LEVELS), steps), &|(arm, q)| {
        let solved = Solved::new(&arm)?;
        prop_assume!(solved.least_conditioning(&q) > 0.01);
        solved.check(&q)
    });
}

/// The axes of shoulder, elbow and wrist are meant to be parallel. Elbow and wrist are, the shoulder is
/// 2.7e-6 radians off them: more than the tolerance of right angles of seven digits.
const STRADDLED: &str = "
robot: straddled
units: {angle: rad, length: m}
screws:
  - {name: waist,    axis: [0, 0, 1],             point: [0, 0, 0]}
  - {name: shoulder, axis: [3.65e-6, 1, -3.7e-7], point: [0.005, 0, 0.14]}
  - {name: elbow,    axis: [6.31e-6, 1, -3.8e-7], point: [0.004, 0, 0.32]}
  - {name: wrist,    axis: [6.31e-6, 1, -3.8e-7], point: [0.07, 0, 0.33]}
home: {xyz: [0.07, 0, 0.33]}
";

/// Read so, it was solved, and its certificate clean: of 100,000 random targets 324 were lost, these
/// among them.
#[test]
fn noise_on_both_sides_of_a_tolerance() {
    let solved = Solved::new(&read(STRADDLED)).unwrap();
    for q in [
        [1.1713, -2.9869, -1.4488, -2.4057],
        [2.0418, -0.0778, 1.5596, 1.0295],
        [0.1379, -0.3797, 1.5853, 0.8823],
        [0.2193, -2.9024, 1.7369, 0.3961],
        [-1.1962, 0.2245, -1.0699, 2.5012],
    ] {
        solved.check_quickly(&q).unwrap();
    }
}

/// A SCARA whose column is parallel to the others to single precision.
const NEARLY_PARALLEL: &str = "
robot: nearly_parallel
units: {angle: rad, length: m}
screws:
  - {name: column,   axis: [0, 0, -1], point: [0, 0, 0]}
  - {name: lift,     type: prismatic, axis: [0, 2.1e-13, 1]}
  - {name: elbow,    axis: [-7.494203e-8, 4.501614e-8, 1], point: [0, 0.25, 0]}
  - {name: shoulder, axis: [-7.494203e-8, 4.501593e-8, 1], point: [0, 0.55, 0.02]}
home: {xyz: [0, 0.55, 0.32]}
";

/// Of turns about axes that are parallel but for noise a vector tells the sum, and each to half of
/// the digits: 1.9 % of the targets of such an arm were lost.
#[test]
fn turns_about_one_direction_are_no_pair() {
    let Arm(model) = read(NEARLY_PARALLEL);
    let linkage = Linkage::new(&model);
    let mut plans = Plans::new(&linkage, Target::Pose).take(100).peekable();
    assert!(plans.peek().is_some());
    let is_pair = |step: &Step| step.subproblem == Subproblem::Sp2;
    assert!(plans.all(|plan| !plan.steps.iter().any(is_pair)));
}

/// Right angles of eleven digits: the elbow is 4e-11 radians off, and taken for parallel to the others.
const NEARLY_EXACT: &str = "
robot: nearly_exact
units: {angle: rad, length: m}
screws:
  - {name: waist,    axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: shoulder, axis: [0, 1, 0], point: [0.115, 0, 0.463]}
  - {name: elbow,    axis: [-3.63e-11, 1, -1.36e-11], point: [0.11499999997, -2.0e-11, 0.65899999998]}
  - {name: wrist,    axis: [0, 1, 0], point: [0.314, 0, 0.659]}
  - {name: roll,     axis: [1, 0, 0], point: [0.416, 0, 0.65983]}
home: {xyz: [0.416, 0.05, 0.65983]}
";

/// What reaches a target to 1e-9 with the arm that it is taken for reached it to 1.05e-9.
#[test]
fn the_arm_as_given_reaches_the_target() {
    let solved = Solved::for_target(&read(NEARLY_EXACT), Target::PositionAxis).unwrap();
    for q in [
        [
            0.5614191697080493,
            -0.7317388548557293,
            1.7858606302811328,
            1.2690621239491107,
            1.5707963268469125,
        ],
        [
            -2.49217173550291,
            -2.266266777604649,
            1.570796328480371,
            0.14607676183218654,
            1.5707959055707772,
        ],
        [
            -1.0687247276493004,
            0.46493059249077584,
            2.67573752895809,
            2.516039798847335,
            1.5707965436054714,
        ],
        [
            1.7702331134085365,
            1.5707963267805265,
            1.0613547520940592,
            -2.0638973979187343,
            1.5707963256260549,
        ],
        [
            -2.1531661165536278,
            0.9792333487103067,
            -3.1185469340002214,
            2.7925826866726178,
            1.570796205644628,
        ],
        [
            1.5255038784931414,
            0.050275961474231856,
            2.177406293966298,
            2.453631223491149,
            -1.570796466217989,
        ],
        [
            0.3848140664723245,
            3.1415926523108806,
            -2.234708250043438,
            -2.619754163213492,
            1.5707963258414326,
        ],
    ] {
        solved.check_quickly(&q).unwrap();
    }
}

/// The arm of a robot file.
fn read(text: &str) -> Arm {
    let source = Source {
        path: "arm.yaml".into(),
        text: text.into(),
    };
    let spec = ArmSpec::parse(&source).unwrap();
    Arm(Model::new(&spec, None, None).unwrap())
}
