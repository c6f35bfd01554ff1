//! Arms by how each axis lies to the one before, with random dimensions.

use kin_codegen::geometry::rank;
use kin_codegen::model::{Joint, JointKind, Model, Variable};
use kin_codegen::spec::Rating;
use kin_runtime::{Pose, Target};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

/// A model that prints itself in a line for each joint.
#[derive(Clone)]
pub struct Arm(pub Model);

impl fmt::Debug for Arm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f)?;
        for Joint {
            kind, axis, point, ..
        } in &self.0.joints
        {
            writeln!(f, "  {kind:?} {axis:?} through {point:?}")?;
        }
        write!(f, "  home {:?}", self.0.home)
    }
}

/// How an axis lies to the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum To {
    /// Neither of the below; at a right angle or not.
    Skew,
    /// They meet.
    Meet,
    /// They meet where the axis before met its predecessor.
    MeetThere,
    /// The same way or the opposite one.
    Parallel,
    /// The same line.
    Same,
}

/// A joint, and how its axis lies to the one before. That of the first is not
/// read.
pub type Step = (JointKind, To);

pub const SKEW: Step = (JointKind::Revolute, To::Skew);
pub const MEET: Step = (JointKind::Revolute, To::Meet);
pub const MEET_THERE: Step = (JointKind::Revolute, To::MeetThere);
pub const PARALLEL: Step = (JointKind::Revolute, To::Parallel);
pub const SLIDE: Step = (JointKind::Prismatic, To::Skew);
pub const SLIDE_ALONG: Step = (JointKind::Prismatic, To::Parallel);

/// A length, of either sign.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![0.1..0.6, -0.6..-0.1]
}

/// The angle between two axes that are not parallel.
fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![Just(FRAC_PI_2), Just(-FRAC_PI_2), 0.4..2.7, -2.7..-0.4]
}

fn turn() -> impl Strategy<Value = f64> {
    -PI..PI
}

/// Joint values: any angle, half a metre to both sides.
fn configuration(steps: &[Step]) -> BoxedStrategy<Vec<f64>> {
    let value = |step: &Step| match step.0 {
        JointKind::Revolute => turn().boxed(),
        JointKind::Prismatic => (-0.5..0.5).boxed(),
    };
    steps.iter().map(value).collect::<Vec<_>>().boxed()
}

/// One to seven joints of any kind, anyhow.
pub fn structure() -> BoxedStrategy<Vec<Step>> {
    let kind = prop_oneof![4 => Just(JointKind::Revolute), 1 => Just(JointKind::Prismatic)];
    let to = prop_oneof![
        3 => Just(To::Skew),
        3 => Just(To::Meet),
        2 => Just(To::MeetThere),
        3 => Just(To::Parallel),
        1 => Just(To::Same),
    ];
    vec((kind, to), 1..=7).boxed()
}

/// Anywhere in space.
fn placement() -> BoxedStrategy<Pose> {
    let axis = prop_oneof![
        Just([0.0, 0.0, 1.0]),
        (0.0..PI, turn()).prop_map(|(a, b)| [a.sin() * b.cos(), a.sin() * b.sin(), a.cos()]),
    ];
    let point = prop_oneof![Just([0.0; 3]), [-1.0..1.0, -1.0..1.0, -1.0..1.0]];
    let pose = (axis, turn(), point).prop_map(|(axis, turn, point)| Pose {
        translation: point,
        ..Pose::from_axis_angle(axis, turn, [0.0; 3])
    });
    pose.boxed()
}

/// What lies between an axis and the next: modified Denavit-Hartenberg
/// parameters, the rotation about the axis and the shift along it first.
#[derive(Clone, Copy, Debug)]
struct Link {
    theta: f64,
    d: f64,
    a: f64,
    alpha: f64,
}

impl Link {
    fn pose(self) -> Pose {
        let about_z = Pose::from_axis_angle([0.0, 0.0, 1.0], self.theta, [0.0; 3]);
        let about_x = Pose::from_axis_angle([1.0, 0.0, 0.0], self.alpha, [0.0; 3]);
        let along_z = Pose::from_translation([0.0, 0.0, self.d]);
        let along_x = Pose::from_translation([self.a, 0.0, 0.0]);
        about_z * along_z * along_x * about_x
    }
}

fn link(to: To) -> BoxedStrategy<Link> {
    let theta = prop_oneof![Just(0.0), turn()];
    let shift = prop_oneof![Just(0.0), length()];
    let (d, a, alpha) = match to {
        To::Skew => (shift.boxed(), length().boxed(), angle().boxed()),
        To::Meet => (length().boxed(), Just(0.0).boxed(), angle().boxed()),
        To::MeetThere => (Just(0.0).boxed(), Just(0.0).boxed(), angle().boxed()),
        To::Parallel => {
            let flip = prop_oneof![Just(0.0), Just(PI)];
            (shift.boxed(), length().boxed(), flip.boxed())
        }
        To::Same => (shift.boxed(), Just(0.0).boxed(), Just(0.0).boxed()),
    };
    (theta, d, a, alpha)
        .prop_map(|(theta, d, a, alpha)| Link { theta, d, a, alpha })
        .boxed()
}

/// Arms of a structure, but for those that are singular in every
/// configuration.
pub fn arm(steps: &[Step]) -> BoxedStrategy<Arm> {
    let moves = |Arm(model): &Arm| rank(model, Target::Pose) == model.joints.len().min(6);
    any_arm(steps)
        .prop_filter("singular everywhere", moves)
        .boxed()
}

/// Arms of a structure. The points that are given on the axes are not those
/// where anything meets.
pub fn any_arm(steps: &[Step]) -> BoxedStrategy<Arm> {
    let kinds: Vec<JointKind> = steps.iter().map(|step| step.0).collect();
    let links: Vec<_> = steps[1..].iter().map(|step| link(step.1)).collect();
    let slides = vec(prop_oneof![Just(0.0), length()], steps.len());
    let arms =
        (placement(), links, slides, placement()).prop_map(move |(base, links, slides, tool)| {
            let mut frame = base;
            let mut joints = Vec::new();
            for (i, &kind) in kinds.iter().enumerate() {
                if i > 0 {
                    frame = frame * links[i - 1].pose();
                }
                joints.push(joint(i, kind, frame, slides[i]));
            }
            Arm(model(joints, frame * tool))
        });
    arms.boxed()
}

/// An arm of a structure in a configuration.
pub fn placed(arm: BoxedStrategy<Arm>, steps: &[Step]) -> BoxedStrategy<(Arm, Vec<f64>)> {
    (arm, configuration(steps)).boxed()
}

/// An arm of a structure in a configuration, half of them read from tip to base, and for some of them
/// that they are searched.
pub fn either_way(steps: &[Step]) -> BoxedStrategy<(Arm, Vec<f64>, bool)> {
    let backwards = (any::<bool>(), prop::bool::weighted(0.05));
    let either = |((arm, q), (backwards, searched))| {
        let arm = if backwards { mirrored(&arm) } else { arm };
        (arm, q, searched)
    };
    (placed(arm(steps), steps), backwards)
        .prop_map(either)
        .boxed()
}

/// A turn and a shift in [-1, 1]³.
type Flaw = [[f64; 3]; 2];

/// Arms of a structure whose axes are off it by up to one of the `levels`: an
/// angle, and a distance.
pub fn noisy_arm(steps: &[Step], levels: &[[f64; 2]]) -> BoxedStrategy<Arm> {
    let vector = || [-1.0..1.0, -1.0..1.0, -1.0..1.0];
    let flaws = vec([vector(), vector()], steps.len());
    let level = proptest::sample::select(levels.to_vec());
    (arm(steps), flaws, level)
        .prop_map(|(arm, flaws, level)| flawed(arm, &flaws, level))
        .boxed()
}

/// Turns and shifts the axes.
fn flawed(mut arm: Arm, flaws: &[Flaw], [angle, distance]: [f64; 2]) -> Arm {
    for (joint, [turn, shift]) in arm.0.joints.iter_mut().zip(flaws) {
        let turned: [f64; 3] = std::array::from_fn(|i| joint.axis[i] + angle * turn[i]);
        let length = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
        joint.axis = turned.map(|x| x / length);
        joint.point = std::array::from_fn(|i| joint.point[i] + distance * shift[i]);
    }
    arm
}

/// A joint about or along the z axis of a frame.
fn joint(i: usize, kind: JointKind, frame: Pose, slide: f64) -> Joint {
    Joint {
        name: format!("joint_{}", i + 1),
        link: format!("link_{}", i + 1),
        kind,
        axis: frame.rotate([0.0, 0.0, 1.0]),
        point: frame.transform_point([0.0, 0.0, slide]),
        frame,
        variable: i,
        multiplier: 1.0,
        offset: 0.0,
        gear: 1.0,
    }
}

fn model(joints: Vec<Joint>, home: Pose) -> Model {
    let variable = |joint: &Joint| Variable {
        name: joint.name.clone(),
        limits: None,
        rating: Rating::default(),
    };
    Model {
        name: "arm".into(),
        base: "base".into(),
        tip: "tip".into(),
        tool: None,
        variables: joints.iter().map(variable).collect(),
        joints,
        home,
        frames: Vec::new(),
        warnings: Vec::new(),
        scalar: kin_codegen::Scalar::F64,
    }
}

/// The same arm read from tip to base: its pose at (-qn, ..., -q1) is the
/// inverse of that of the arm at (q1, ..., qn).
pub fn mirrored(Arm(arm): &Arm) -> Arm {
    let back = arm.home.inverse();
    let reversed = arm.joints.iter().rev().enumerate();
    let joints = reversed.map(|(i, joint)| Joint {
        axis: back.rotate(joint.axis).map(|x| -x),
        point: back.transform_point(joint.point),
        frame: back * joint.frame,
        variable: i,
        ..joint.clone()
    });
    Arm(model(joints.collect(), back))
}
