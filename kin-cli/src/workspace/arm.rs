//! Serial arms on the map.

use super::map::{Robot, Sampling, slices};
use crate::arguments;
use kin_codegen::Target;
use kin_codegen::arm::CompiledArm;
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::expr::Graph;
use kin_codegen::geometry::{Line, axes, size};
use kin_codegen::model::{JointKind, Model};
use kin_codegen::singularity::Singular;
use kin_runtime::{JointLimit, Pose, scattered_rotations};
use std::f64::consts::TAU;

/// An arm with its closed form.
struct Arm<'a> {
    form: &'a ClosedForm,
    singular: Option<&'a Singular>,
    limits: Vec<JointLimit>,
    limited: bool,
}

/// Through the shoulder; none if targets have no position, or are poses that the arm cannot choose.
/// An arm that has joints to spare is `redundant`.
pub fn sampling<'a>(
    compiled: &'a CompiledArm,
    redundant: Option<Box<dyn Robot>>,
    arguments: &arguments::Workspace,
) -> Option<Sampling<'a>> {
    let form = compiled.form()?;
    let model = &compiled.model;
    let axes = axes(model);
    let planar = is_planar(model, &axes);
    let orientations = match compiled.target() {
        Target::Orientation | Target::Direction => return None,
        Target::Pose if reaches_few(compiled, planar) => return None,
        Target::Position => vec![Pose::IDENTITY],
        Target::PositionYaw | Target::Planar => turns(model, &axes[0], arguments.samples),
        Target::Pose | Target::PositionAxis if planar => turns(model, &axes[0], arguments.samples),
        Target::Pose | Target::PositionAxis => scattered_rotations(arguments.samples).collect(),
    };
    let centre = centre(model, &axes, planar);
    let limited = arguments.limits;
    let arm = || Arm {
        form,
        singular: compiled.singular(),
        limits: model.limits(),
        limited,
    };
    Some(Sampling {
        robot: redundant.unwrap_or_else(|| Box::new(arm())),
        slices: slices(centre),
        cells: arguments.cells,
        step: 2.0 * reach(model, centre) / arguments.cells as f64,
        orientations,
        limited,
    })
}

/// Whether none of the poses that are tried would be among those that so few joints reach: of an arm
/// that turns its tip about one direction all are, but not where noise tilts it.
fn reaches_few(compiled: &CompiledArm, planar: bool) -> bool {
    let tilts = !planar || compiled.fitting() == Some(Target::Position);
    tilts && compiled.model.variables.len() < 6
}

impl Robot for Arm<'_> {
    fn try_pose(&self, target: &Pose, values: &mut Vec<f64>) -> Option<f64> {
        let solutions = self.form.solutions(target);
        let within = (solutions.iter())
            .filter(|solution| !self.limited || is_within(&self.limits, &solution.q));
        within
            .map(|solution| self.determinant(&solution.q, values))
            .reduce(f64::max)
    }

    fn measure(&self) -> [&'static str; 2] {
        [
            "manipulability",
            "absolute value of det J of the best branch",
        ]
    }

    fn choice(&self) -> String {
        "all that the target tells apart, evenly".into()
    }
}

impl Arm<'_> {
    fn determinant(&self, q: &[f64], values: &mut Vec<f64>) -> f64 {
        let Some(singular) = self.singular else {
            return 0.0;
        };
        let graph: &Graph = &singular.graph;
        graph.evaluate(q, 0, values);
        values[singular.determinant.product.index()].abs()
    }
}

/// Whether joint values are within limits, full turns apart or not.
pub fn is_within(limits: &[JointLimit], q: &[f64]) -> bool {
    let mut joints = limits.iter().zip(q);
    joints.all(|(limit, &value)| limit.nearest(value, value).is_some())
}

/// All turning joints about parallel axes.
fn is_planar(model: &Model, axes: &[Line]) -> bool {
    let turning = (model.joints.iter().zip(axes))
        .filter(|(joint, _)| joint.kind == JointKind::Revolute)
        .map(|(_, axis)| axis.direction);
    let along = |d: [f64; 3]| {
        let first = axes[0].direction;
        let cosine: f64 = (0..3).map(|i| d[i] * first[i]).sum();
        cosine.abs() > 1.0 - 1e-6
    };
    turning.into_iter().all(along)
}

/// The tip's orientation at home, turned about the first axis.
fn turns(model: &Model, first: &Line, count: usize) -> Vec<Pose> {
    let turn = |k: usize| {
        let angle = TAU * k as f64 / count as f64;
        let home = Pose {
            translation: [0.0; 3],
            ..model.home
        };
        Pose::from_axis_angle(first.direction, angle, [0.0; 3]) * home
    };
    (0..count).map(turn).collect()
}

/// The shoulder: where the second axis is nearest to the first, or at the
/// height of the tip if all are parallel.
fn centre(model: &Model, axes: &[Line], planar: bool) -> [f64; 3] {
    match axes {
        _ if planar => axes[0].nearest(model.home.translation),
        [first, second, ..] if first.distance(second).is_finite() => {
            first.nearest(second.nearest(first.nearest(second.point)))
        }
        _ => axes[0].nearest(model.home.translation),
    }
}

/// How far from the middle the tip can be, and a little more. In the angle of
/// one joint, the squared distance is a sine wave, whose crest three values
/// give; joint after joint from several starts, the farthest point is found.
pub fn reach(model: &Model, centre: [f64; 3]) -> f64 {
    const STARTS: usize = 12;
    const ROUNDS: usize = 40;
    let chain = model.chain();
    let n = model.variables.len();
    let squared = |q: &[f64]| {
        let tip = chain.fk(&model.joint_values(q)).translation;
        (0..3).map(|i| (tip[i] - centre[i]).powi(2)).sum::<f64>()
    };
    let farthest = |start: usize| {
        let mut q: Vec<f64> = (0..n)
            .map(|i| (1.3 * start as f64 + 0.7 * i as f64) % TAU)
            .collect();
        for joint in (0..n).cycle().take(ROUNDS * n) {
            let mut at = |value: f64| {
                q[joint] = value;
                squared(&q)
            };
            q[joint] = if model.turns(joint) {
                let [zero, quarter, half] = [0.0, TAU / 4.0, TAU / 2.0].map(&mut at);
                let mean = 0.5 * (zero + half);
                (quarter - mean).atan2(zero - mean)
            } else {
                let [low, high] = travel(model, joint);
                if at(low) > at(high) { low } else { high }
            };
        }
        squared(&q).sqrt()
    };
    1.04 * (0..STARTS).map(farthest).fold(0.0, f64::max)
}

/// How far a joint slides; half the arm's size both ways if nothing stops it.
fn travel(model: &Model, joint: usize) -> [f64; 2] {
    let half = 0.5 * size(model);
    model.variables[joint].travel().unwrap_or([-half, half])
}
