//! Arms whose joints mimic each other, against the product of exponentials of the joints that the
//! file has, and against the numerical search of the chain whose joints move by themselves.

use kin_codegen::arm::CompiledArm;
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::geometry::{
    Linkage, by_coordinates, cross, dot, natural_target, size, solved_chain, uncoupled,
};
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_codegen::solver::{Certified, solve};
use kin_codegen::spec::{ArmSpec, Source};
use kin_codegen::{Options, compile};
use kin_runtime::{Chain, Pose, SearchOptions, Target};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write as _;

const PARALLELOGRAM: &str = include_str!("../../tests/robots/coupled/parallelogram.yaml");
const PALLETIZER: &str = include_str!("../../tests/robots/coupled/palletizer.yaml");
const TELESCOPE: &str = include_str!("../../tests/robots/coupled/telescope.yaml");
const FINGER: &str = include_str!("../../tests/robots/coupled/finger.yaml");
const RACK: &str = include_str!("../../tests/robots/coupled/rack.yaml");
const REMOTE_CENTRE: &str = include_str!("../../tests/robots/coupled/remote_centre.yaml");

const BALL_SCREW: &str = include_str!("../../tests/robots/coupled/ball_screw.yaml");

const ARMS: [&str; 7] = [
    PARALLELOGRAM,
    PALLETIZER,
    TELESCOPE,
    FINGER,
    RACK,
    REMOTE_CENTRE,
    BALL_SCREW,
];

fn source(text: &str) -> Source {
    Source {
        path: "arm.yaml".into(),
        text: text.into(),
    }
}

fn model(text: &str) -> Model {
    Model::new(&ArmSpec::parse(&source(text)).unwrap(), None, None).unwrap()
}

struct Arm {
    model: Model,
    /// Of the joints that the file has.
    chain: Chain,
    /// Of those that move by themselves.
    uncoupled: Model,
    linkage: Linkage,
    target: Target,
    found: Certified,
}

impl Arm {
    fn new(text: &str, target: Option<Target>) -> Result<Self, String> {
        let model = model(text);
        let target = target.unwrap_or_else(|| natural_target(&model));
        let options = Options {
            target: Some(target),
            ..Options::default()
        };
        if let Err(refused) = compile(&source(text), &options) {
            return Err(refused.to_string());
        }
        let found = solve(&model, &Linkage::new(&model), target).unwrap();
        let (uncoupled, linkage) = uncoupled(&model).unwrap();
        Ok(Self {
            chain: model.chain(),
            model,
            uncoupled,
            linkage,
            target,
            found,
        })
    }

    fn form(&self) -> &ClosedForm {
        &self.found.form
    }

    fn fk(&self, q: &[f64]) -> Pose {
        let joints = self.model.joints.iter();
        let values = joints.map(|joint| joint.multiplier * q[joint.variable] + joint.offset);
        self.chain.fk(&values.collect::<Vec<_>>())
    }

    fn conditioning(&self, q: &[f64]) -> f64 {
        let chain = self.uncoupled.chain();
        self.linkage.conditioning(&chain, q, self.target)
    }

    /// Somewhere within the limits, at quarter turns now and then.
    fn configuration(&self, k: usize, random: &mut Random) -> Vec<f64> {
        let place = |limits: Option<[f64; 2]>| {
            let [lower, upper] = limits.unwrap_or([-PI, PI]);
            let special = [0.0, FRAC_PI_2, -FRAC_PI_2, PI][random.below(4)];
            let near = special + [0.0, 1e-12, 1e-9, 1e-6, 1e-4][random.below(5)];
            let anywhere = random.between(lower, upper);
            let is_near = k.is_multiple_of(3) && random.below(2) == 0;
            if is_near {
                near.clamp(lower, upper)
            } else {
                anywhere
            }
        };
        let variables = self.model.variables.iter();
        variables
            .map(|variable| variable.limits)
            .map(place)
            .collect()
    }

    /// Whether two configurations are one: full turns of some change nothing.
    fn is_same(&self, a: &[f64], b: &[f64], tolerance: f64) -> bool {
        let apart = |i: usize| {
            let d = (a[i] - b[i]).abs();
            match self.model.repeats(i) {
                true => (d % TAU).min(TAU - d % TAU),
                false => d,
            }
        };
        (0..a.len()).all(|i| apart(i) < tolerance)
    }

    /// Sound, recovered and complete on so many configurations; how many of them were regular.
    fn is_right(&self, count: usize) -> usize {
        let length = size(&self.model);
        let options = SearchOptions {
            target: self.target,
            ..SearchOptions::default()
        };
        let mut random = Random(0x51de);
        let mut regular = 0;
        for k in 0..count {
            let q = self.configuration(k, &mut random);
            let pose = self.fk(&q);
            let merged = self.uncoupled.chain().fk(&self.linkage.joints_at(&q));
            let apart = Target::Pose.distance(&merged, &pose, length);
            assert!(apart < 1e-13 * length, "{q:?}: {apart:e}");
            let solutions = self.form().solutions(&pose);
            for (i, solution) in solutions.iter().enumerate() {
                let miss = self.target.distance(&self.fk(&solution.q), &pose, length);
                assert!(miss < 1e-9 * length, "{q:?}: {miss:e}");
                let turns = (0..q.len()).filter(|&i| self.model.repeats(i));
                let turns = turns.map(|i| solution.q[i]).collect::<Vec<_>>();
                assert!(turns.iter().all(|x| (-PI..=PI).contains(x)), "{turns:?}");
                let same = |other: &&_| self.is_same(&solution.q, other, 1e-9);
                let before = solutions[..i].iter().map(|other| &other.q);
                assert_eq!(
                    before.filter(|it| same(&&it[..])).count(),
                    0,
                    "{q:?} doubled"
                );
            }
            let is_among = |q: &[f64], tolerance: f64| {
                solutions.iter().any(|it| self.is_same(&it.q, q, tolerance))
            };
            let conditioning = self.conditioning(&q);
            if conditioning < 1e-4 {
                continue;
            }
            regular += 1;
            let tolerance = (1e-13 / conditioning.powi(2)).clamp(1e-9, 1e-3);
            if self.found.certificate.lost == 0 {
                assert!(is_among(&q, tolerance), "{q:?} is lost: {solutions:?}");
            }
            if k % 10 != 0 || conditioning < 1e-2 || self.found.certificate.lost > 0 {
                continue;
            }
            for found in self.uncoupled.chain().ik_all(&pose, &options) {
                let found = self.linkage.coordinates_at(found.q);
                let back = self.target.distance(&self.fk(&found), &pose, length);
                let reached = self.conditioning(&found) > 1e-2 && back < 1e-9 * length;
                if reached {
                    assert!(is_among(&found, 1e-6), "{q:?}: {found:?} is missing");
                }
            }
        }
        regular
    }
}

#[test]
fn arms_are_solved_whose_joints_mimic_each_other() {
    for text in ARMS {
        let arm = Arm::new(text, None).unwrap();
        assert_eq!(arm.found.certificate.lost, 0, "{}", arm.model.name);
        let regular = arm.is_right(300);
        assert!(regular > 200, "{}: {regular}", arm.model.name);
    }
}

/// Links of one length that belts fold: on the fold a plan of joints that move by themselves leaves one
/// free where the arm is regular, and there alone it loses solutions. It is refused if it does so anywhere.
#[test]
fn arms_that_belts_fold_are_solved_off_the_fold() {
    for (rows, fold) in [
        (
            "{name: t, a: 0, limits: [-170, 170]}, {name: r, a: 180, limits: [5, 175]}, {name: b, a: 180, \
          mimic: {joint: r, multiplier: -2}}, {name: c, a: 120, mimic: {joint: r}}",
            FRAC_PI_2,
        ),
        (
            "{name: t, a: 250, limits: [-170, 170]}, {name: r, a: 250, limits: [-170, 170]}, {name: b, \
          a: 80, mimic: {joint: r, multiplier: -1}}",
            PI,
        ),
    ] {
        let text = format!(
            "robot: wafers\nunits: {{angle: deg, length: mm}}\ndh: [{}]\n",
            rows.replace("{name", "{d: 0, alpha: 0, name")
        );
        let arm = Arm::new(&text, None).unwrap();
        let certificate = &arm.found.certificate;
        assert!(certificate.lost > 0 && certificate.lost_anywhere == 0);
        let mut random = Random(0x3afe);
        for k in 0..2000 {
            let mut q = vec![random.between(-2.9, 2.9), random.between(0.1, 2.9)];
            if k % 4 == 0 {
                q[1] = fold - 10_f64.powf(random.between(-7.0, -2.0));
            }
            let pose = arm.fk(&q);
            let solutions = arm.form().solutions(&pose);
            let found = solutions.iter().any(|it| arm.is_same(&it.q, &q, 1e-6));
            assert!(found, "{q:?}: {solutions:?}");
            for solution in &solutions {
                let off = arm.fk(&solution.q).translation_distance(&pose);
                assert!(off < 1e-9, "{q:?}: {off:e}");
            }
        }
    }
}

/// A thumb behind a wrist: with the wrist straight the chain whose joints move by themselves is singular and
/// tells them to the square root of rounding, by links of two centimetres. The arm is regular there.
#[test]
fn chains_may_be_singular_where_coupled_arms_are_regular() {
    let text = "\
robot: thumb
units: {angle: rad, length: m}
joints:
  - {name: pitch, xyz: [0, 0, 0.08], axis: [1, 0, 0], limits: [-0.4, 0.4]}
  - {name: yaw, axis: [0, -1, 0], limits: [-0.4, 0.4]}
  - {name: thumb, xyz: [0.021, 0.015, 0.03], axis: [0, 0, -1], limits: [-1.3, 0]}
  - {name: near, xyz: [0.011, 0.003, -0.001], axis: [-0.28, 0.96, 0], limits: [-0.5, 0]}
  - {name: middle, xyz: [0.038, 0.011, 0.039], axis: [-0.28, 0.96, 0], mimic: {joint: near, multiplier: 1.3333, offset: -0.08}}
  - {name: far, xyz: [0.017, 0.005, 0.013], axis: [-0.28, 0.96, 0], mimic: {joint: near, multiplier: 0.6667, offset: -0.04}}
tip: {xyz: [0.018, 0.005, 0.015]}
";
    let arm = Arm::new(text, None).unwrap();
    let limits = arm.model.variables.iter().map(|it| it.limits.unwrap());
    let limits: Vec<[f64; 2]> = limits.collect();
    let mut random = Random(0x7413);
    for k in 0..4000 {
        let mut q: Vec<f64> = limits
            .iter()
            .map(|it| random.between(it[0], it[1]))
            .collect();
        if k % 8 != 0 {
            q[1] = 10_f64.powf(random.between(-12.0, -4.0)) * [1.0, -1.0][k % 2];
        }
        assert!(arm.conditioning(&q) > 0.01, "{q:?}");
        let solutions = arm.form().solutions(&arm.fk(&q));
        let found = solutions.iter().any(|it| arm.is_same(&it.q, &q, 1e-7));
        assert!(found, "{q:?}: {solutions:?}");
    }
}

/// Axes of joints that are coupled, parallel to ten digits as half turns are written: a plan that
/// tells them apart by the rest is nowhere regular, and not one that finds nothing.
#[test]
fn half_turns_in_ten_digits() {
    let text = "\
robot: half_turns
units: {angle: rad, length: m}
joints:
  - {name: one, xyz: [0, 0, 0.109], axis: [0, 0, 1]}
  - {name: two, xyz: [0.0435, 0, 0.119], rpy: [-1.5707963268, 0, 0], axis: [0, 0, 1]}
  - {name: rod, xyz: [0, -0.175, 0], rpy: [3.1415926536, 0, 0], axis: [0, 0, -1], mimic: {joint: two, multiplier: -1}}
  - {name: three, rpy: [0, 3.1415926536, 0], axis: [0, 0, 1]}
  - {name: level, xyz: [0.175, 0, 0], axis: [0, 0, 1], mimic: {joint: three, multiplier: -1}}
  - {name: four, xyz: [0.066, 0, 0], rpy: [1.5707963268, 0, 0], axis: [0, 0, 1]}
tip: tool0
";
    let arm = Arm::new(text, None).unwrap();
    assert_eq!(arm.found.certificate.lost_anywhere, 0);
    let mut random = Random(0x7e2d);
    for _ in 0..1000 {
        let q: Vec<f64> = (0..4).map(|_| random.between(-PI, PI)).collect();
        let solutions = arm.form().solutions(&arm.fk(&q));
        let found = solutions.iter().any(|it| arm.is_same(&it.q, &q, 1e-6));
        assert!(found || arm.conditioning(&q) < 1e-4, "{q:?}: {solutions:?}");
    }
}

/// Dependent joints, and what is left of a target's six numbers, agree to rounding alone.
#[test]
fn no_answer_is_lost_to_a_digit() {
    for text in ARMS {
        let arm = Arm::new(text, None).unwrap();
        let mut random = Random(0xd161);
        for k in 0..600 {
            let q = arm.configuration(k, &mut random);
            let by = [1e-12, 1e-11, 1e-10][k % 3];
            let mut small = |length: f64| [(); 3].map(|()| by * length * random.between(-1.0, 1.0));
            let nudge = Pose::from_rpy(small(1.0), small(size(&arm.model)));
            let pose = arm.fk(&q) * nudge;
            let solutions = arm.form().solutions(&pose);
            assert!(!solutions.is_empty(), "{}: {q:?} by {by:e}", arm.model.name);
        }
    }
}

/// Three joints about parallel axes, by θ, −θ and θ, are one about a fourth axis.
#[test]
fn a_remote_centre_is_one_joint() {
    let arm = Arm::new(REMOTE_CENTRE, None).unwrap();
    let joints = [&arm.model, &arm.uncoupled].map(|model| model.joints.len());
    assert_eq!(joints, [8, 6]);
    // The first axis goes through it.
    let [yaw, pitch] = [0, 1].map(|i| &arm.uncoupled.joints[i]);
    let between = [0, 1, 2].map(|i| pitch.point[i] - yaw.point[i]);
    let across = cross(yaw.axis, pitch.axis);
    let distance = dot(across, between);
    assert!(distance.abs() < 1e-15, "{distance}");
    // About the opposite axis the same angle is the other one.
    let backwards = REMOTE_CENTRE.replace(
        "axis: [-1, 0, 0], mimic: {joint: pitch, multiplier: -1}",
        "axis: [1, 0, 0], mimic: {joint: pitch}",
    );
    let arm = Arm::new(&backwards, None).unwrap();
    assert_eq!(arm.uncoupled.joints.len(), 6);
    assert!(arm.is_right(60) > 40);
    // An angle that is another one at home turns what is carried about no axis.
    let tilted = REMOTE_CENTRE.replace("multiplier: -1", "multiplier: -1, offset: 10");
    let said = Arm::new(&tilted, None).err().unwrap();
    assert!(
        said.contains("of up to 6 joints, those that mimic others counted, and those that do the same once: this has 8"),
        "{said}"
    );
    // Of other angles three are no one.
    let other = REMOTE_CENTRE.replace("multiplier: -1", "multiplier: -1.5");
    let said = Arm::new(&other, None).err().unwrap();
    assert!(
        said.contains("of up to 6 joints, those that mimic others counted, and those that do the same once: this has 8"),
        "{said}"
    );
}

#[test]
fn a_level_tool_has_four_configurations() {
    let arm = Arm::new(PALLETIZER, None).unwrap();
    let most = arm.found.certificate.most_solutions;
    assert_eq!((arm.uncoupled.joints.len(), most), (5, 4));
    // What is not level is not reached, and there is no solution to it.
    let mut pose = arm.fk(&[0.3, 0.2, 0.4, 0.5]);
    assert!(!arm.form().solutions(&pose).is_empty());
    pose = pose * Pose::from_rpy([1e-4, 0.0, 0.0], [0.0; 3]);
    assert!(arm.form().solutions(&pose).is_empty());
}

/// What is said of an arm of these joints; angles in degrees.
fn refused(joints: &[&str]) -> String {
    let rows = joints.iter().map(|row| format!("  - {{{row}}}\n"));
    let rows: String = rows.collect();
    let text = format!("robot: arm\nunits: {{angle: deg, length: m}}\njoints:\n{rows}tip: tip\n");
    Arm::new(&text, None).err().unwrap()
}

#[test]
fn refusals_say_why() {
    let one = "name: one, axis: [0, 0, 1], limits: [-200, 200]";
    // Two joints about one line undo each other.
    let undone = "name: two, axis: [0, 0, -1], mimic: {joint: one}";
    let said = refused(&[one, undone]);
    let why = "joint `two` mimics `one`, which couples their angles, and no joint tells the value of \
               `one` from a target";
    assert!(said.contains(why), "{said}");
    // A full turn of the first is not one of the second.
    let more = "name: two, xyz: [1, 0, 0], axis: [0, 1, 0], mimic: {joint: one, multiplier: 1.5}";
    let said = refused(&[one, more]);
    let why =
        "and the limits of `one` are so wide that several values of it are one angle of a joint";
    assert!(said.contains(why), "{said}");
    assert!(
        said.contains("give it limits that are less than a full turn"),
        "{said}"
    );
    let snake = [
        one,
        "name: two, xyz: [1, 0, 0], axis: [0, 0, 1], mimic: {joint: one}",
        "name: three, xyz: [1, 0, 0], axis: [0, 1, 0], limits: [-90, 90]",
        "name: four, xyz: [0, 1, 0], axis: [1, 0, 0], limits: [-90, 90]",
        "name: five, xyz: [1, 0, 0], axis: [0, 1, 0], limits: [-90, 90]",
        "name: six, xyz: [0, 1, 0], axis: [0, 0, 1], limits: [-90, 90]",
        "name: seven, xyz: [1, 0, 1], axis: [0, 1, 0], limits: [-90, 90]",
        "name: eight, xyz: [0, 1, 0], axis: [1, 0, 0], limits: [-90, 90]",
    ];
    let said = refused(&snake[..7]);
    let why = "such chains are solved of up to 6 joints, those that mimic others counted, and those that do the same once: this has 7";
    assert!(said.contains(why), "{said}");
    assert!(
        said.contains("in front of the joints that mimic others"),
        "{said}"
    );
    let said = refused(&snake);
    let why = "of a redundant arm only joints in front of all that mimic others or are mimicked can stay free";
    assert!(said.contains(why), "{said}");
    let rail = "name: rail, axis: [0, 1, 0], type: prismatic, limits: [0, 3]";
    let said = refused(&[&[rail], &snake[..7]].concat());
    assert!(
        said.contains("those that do the same once: this has 7"),
        "{said}"
    );
    let said = refused(&snake[..6]);
    let why = "as a chain whose joints move by themselves, no sequence of the subproblems";
    assert!(said.contains(why), "{said}");
}

/// What is left without the first joint moves the tip in fewer ways, and it is the last that is to spare.
#[test]
fn no_other_joint_than_one_in_front_can_be_given() {
    let joints = "\
robot: palletizer
units: {angle: rad, length: m}
screws:
  - {name: j1, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: j2, axis: [0, 1, 0], point: [0.2, 0, 0.3]}
  - {name: j3, axis: [0, 1, 0], point: [0.2, 0, 0.9]}
  - {name: j4, axis: [0, 1, 0], point: [0.2, 0, 0.9], mimic: {joint: j2, multiplier: -1}}
  - {name: j5, axis: [0, 1, 0], point: [0.8, 0, 0.9], mimic: {joint: j3, multiplier: -1}}
  - {name: j6, axis: [0, 0, 1], point: [0.9, 0, 0.9]}
home: {xyz: [0.9, 0, 0.7], rpy: [3.141592653589793, 0, 0]}
";
    let said = Arm::new(joints, Some(Target::PositionAxis)).err().unwrap();
    let why = "only joints in front of all that mimic others or are mimicked can stay free";
    assert!(said.contains(why), "{said}");
    assert!(!said.contains("at most"), "{said}");
}

/// How high the tip is over the plane across one of its axes tells a joint by the fifth digit of the
/// angle between them, and next to where that is stationary not at all: distances tell it.
#[test]
fn a_finger_of_axes_that_are_nearly_parallel_has_all_its_solutions() {
    let arm = Arm::new(
        "robot: finger\nunits: {angle: rad, length: m}\njoints:\n  \
         - {name: knuckle, xyz: [-0.1, 0.03, 0], rpy: [-0.087, -0.01, -0.118], axis: [0, 1, 0], limits: [-1, 0.3]}\n  \
         - {name: middle, xyz: [-0.03, 0, -0.012], rpy: [-0.00002, 0, 0], axis: [0, 1, 0], \
         mimic: {joint: knuckle, multiplier: 1.15, offset: 0.002}}\n\
         tip: {link: tip, xyz: [-0.018, 0, -0.031]}\n",
        Some(Target::Position),
    )
    .unwrap();
    for k in 0..=2000 {
        let q = -1.0 + 1.3 * f64::from(k) / 2000.0;
        let mut pose = arm.fk(&[q]);
        for digits in [0.0, 1e-12] {
            pose.translation[k as usize % 3] += digits;
            let found = arm.form().solutions(&pose);
            assert!(
                found.iter().any(|it| (it.q[0] - q).abs() < 1e-9),
                "{q}: {found:?}"
            );
        }
    }
}

/// With a slide in front of its first joint.
fn on_a_rail(text: &str) -> String {
    let rail = "joints:\n  - {name: rail, link: carriage, rpy: [0.3, 0.2, -0.5], axis: [0, 1, 0], \
                type: prismatic, limits: [0, 3]}\n";
    text.replace("joints:\n", rail)
}

/// Sound, and recovered wherever the joints behind the first, which is given, are regular.
fn is_right_with_the_first_given(arm: &CompiledArm) {
    let (model, form) = (&arm.model, arm.form().unwrap());
    let (chain, length) = (model.chain(), size(model));
    let (own, _) = solved_chain(model, Some(1)).unwrap();
    let mut random = Random(0x0ca2_21ed);
    let mut regular = 0;
    for k in 0..200 {
        let place = |limits: [f64; 2]| match (k % 2, random.below(2)) {
            (0, 0) => [0.0, FRAC_PI_2, -FRAC_PI_2][random.below(3)].clamp(limits[0], limits[1]),
            _ => random.between(limits[0], limits[1]),
        };
        let limits = model.variables.iter().map(|it| it.limits.unwrap());
        let q: Vec<f64> = limits.map(place).collect();
        let pose = chain.fk(&model.joint_values(&q));
        let mut recovered = false;
        for solution in form.solutions_at(&pose, &q[..1]) {
            let whole = form.whole(&solution.q, &q[..1]);
            let reached = chain.fk(&model.joint_values(&whole));
            let miss = Target::Pose.distance(&reached, &pose, length);
            assert!(miss < 1e-9 * length, "{q:?}: {miss:e}");
            recovered |= (0..q.len()).all(|i| model.joint_distance(i, whole[i], q[i]) < 1e-6);
        }
        let held = own.chain().locked(0, q[0]);
        let is_regular = form.given.conditioning(&held, &q[1..], Target::Pose) > 1e-4;
        assert!(recovered || !is_regular, "{q:?} is lost");
        regular += usize::from(is_regular);
    }
    assert!(regular > 120, "{regular}");
}

/// The height of the remote centre over a plane of the wrist does not depend on how the roll is turned,
/// and where that stands at zero not on the rail either, which is along the first axis.
#[test]
fn a_remote_centre_on_a_rail_is_solved_by_subproblems() {
    let text = on_a_rail(REMOTE_CENTRE).replace("rpy: [0.3, 0.2, -0.5], ", "");
    let compiled = compile(&source(&text), &Options::default()).unwrap();
    let arm = compiled.arm().unwrap();
    assert_eq!(
        arm.form().unwrap().plan.to_string(),
        "SP4(q7) SP4(q6) slide(q4) SP2(q2,q3) SP1(q5)"
    );
    is_right_with_the_first_given(arm);
}

/// What carries an arm is given, and the rest is coupled as it is without.
#[test]
fn what_carries_a_coupled_arm_is_given() {
    for (text, branches) in [(PARALLELOGRAM, 8), (PALLETIZER, 4)] {
        let compiled = compile(&source(&on_a_rail(text)), &Options::default()).unwrap();
        let arm = compiled.arm().unwrap();
        assert_eq!(arm.free_joints(), ["rail"]);
        assert_eq!(arm.form().unwrap().plan.branches(), branches);
        is_right_with_the_first_given(arm);
    }
}

/// The first stage of a column may follow the second, slide by another gear and back along its axis,
/// and begin anywhere.
#[test]
fn the_stages_of_a_column_are_one_slide_whichever_leads() {
    let text = "robot: column\nunits: {angle: rad, length: m}\njoints:\n  \
        - {name: one, rpy: [0.3, -0.4, 1.1], xyz: [0, 0, 0.3], axis: [0, 0, -1], type: prismatic, \
        limits: [-0.5, 0], mimic: {joint: two, multiplier: -0.8, offset: -0.01}}\n  \
        - {name: two, xyz: [0, 0, 0.04], axis: [0, 0, 1], type: prismatic, limits: [0, 0.5]}\n  \
        - {name: pan, xyz: [0.1, 0, 0.2], axis: [0, 1, 0], limits: [-3, 3]}\n  \
        - {name: tilt, xyz: [0.2, 0, 0], axis: [0, 0, 1], limits: [-3, 3]}\ntip: tool0\n";
    for text in [
        text.to_owned(),
        text.replace("-0.8", "0.3").replace("-0.01", "-0.4"),
    ] {
        let model = model(&text);
        let column = by_coordinates(&model).unwrap();
        let gears: Vec<f64> = column.joints.iter().map(|joint| joint.gear).collect();
        assert_eq!(gears.len(), 3);
        assert!(gears[0] != 1.0 && gears[1..] == [1.0, 1.0], "{gears:?}");
        let mut random = Random(0xc01a);
        for _ in 0..20 {
            let q = [
                random.between(0.0, 0.5),
                random.between(-3.0, 3.0),
                random.between(-3.0, 3.0),
            ];
            let wanted = model.chain().fk(&model.joint_values(&q));
            let apart = Target::Pose.distance(&column.chain().fk(&q), &wanted, 1.0);
            assert!(apart < 1e-14, "{q:?}: {apart:e}");
        }
    }
}

/// Joints along and across the axes, some of which mimic others.
fn random_arm(random: &mut Random) -> String {
    let mut text = String::from("robot: random\nunits: {angle: rad, length: m}\njoints:\n");
    let count = 2 + random.below(6);
    let mut own: Vec<(usize, bool)> = Vec::new();
    for j in 0..count {
        let slides = random.below(5) == 0;
        let axis = ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]", "[0, -1, 0]"];
        let axis = axis[random.below(4)];
        let mut place = || [0.0, 0.1, 0.25, 0.4][random.below(4)];
        let xyz = [place(), place(), place()];
        let rpy = match j {
            0 => [0.3, -0.7, 1.9],
            _ => [0.0; 3],
        };
        let kind = if slides { ", type: prismatic" } else { "" };
        let follows = j > 0 && random.below(5) < 2;
        let more = match own.get(random.below(own.len().max(1) as u64)) {
            Some((leader, _)) if follows => {
                let rate = [1.0, -1.0, -1.0, 2.0, 0.5, -0.7, 1.13][random.below(7)];
                let offset = [0.0, 0.0, 0.3][random.below(3)];
                format!("mimic: {{joint: j{leader}, multiplier: {rate}, offset: {offset}}}")
            }
            _ => {
                own.push((j, slides));
                let limit = if slides { 0.5 } else { 2.9 };
                format!("limits: [-{limit}, {limit}]")
            }
        };
        writeln!(
            text,
            "  - {{name: j{j}, xyz: {xyz:?}, rpy: {rpy:?}, axis: {axis}{kind}, {more}}}"
        )
        .unwrap();
    }
    text + "tip: {link: tip, xyz: [0.1, 0.05, 0.2]}\n"
}

fn attack(seeds: std::ops::Range<u64>) -> [usize; 3] {
    let (mut solved, mut refused, mut others) = (0, 0, 0);
    for seed in seeds {
        let mut random = Random(0xc0de + 977 * seed);
        let text = random_arm(&mut random);
        if !text.contains("mimic") {
            continue;
        }
        match Arm::new(&text, None) {
            Ok(arm) => {
                solved += 1;
                arm.is_right(60);
            }
            Err(said) if said.contains("mimic") => refused += 1,
            Err(_) => others += 1,
        }
    }
    [solved, refused, others]
}

#[test]
fn random_arms_whose_joints_mimic_each_other_are_right_or_refused() {
    let [solved, refused, others] = attack(0..60);
    assert!(solved > 10 && refused > 5, "{solved} {refused} {others}");
}
