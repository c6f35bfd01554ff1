//! The axes of an arm in a frame of one of its links.
//!
//! From a frame between two joints an arm goes on in two directions, back to
//! the base and outwards to the tip, and both are chains that begin there.
//! Angles are counted from the frame: the angle between two parallel links
//! appears as the joint between them, and not as a difference of sums. That is
//! what determinants need to fall apart into factors, and what makes a body
//! Jacobian cheap.

use super::forward::{JointTrig, Stage, stages};
use super::linear::{Motion, Vector};
use super::{Expr, Graph};
use crate::geometry::{Axis, Link, Linkage, Run, Vec3};
use kin_runtime::Pose;

/// The axes of all joints in one frame, with the frames at both ends.
pub(super) struct AxesInFrame {
    /// By joint.
    pub axes: Vec<Axis<Vector>>,
    /// The base frame.
    pub base: Motion,
    /// The tip frame.
    pub tip: Motion,
}

/// How many frames there are. Every gap between two joints has two: one square
/// to the joint before it, one to the joint behind it; one is before the first
/// joint, one at the tip, and the base comes last.
pub(super) fn frames(linkage: &Linkage) -> usize {
    2 * linkage.links.len() + 2
}

/// The number of the frame before the first joint.
pub(super) const FIRST: usize = 0;

/// The number of the tip's frame.
pub(super) fn tip_frame(linkage: &Linkage) -> usize {
    2 * linkage.links.len()
}

impl AxesInFrame {
    /// In frame number `frame`, one of [`frames`].
    pub(super) fn new(g: &mut Graph, linkage: &Linkage, q: &[Expr], frame: usize) -> Self {
        let [inner, outer] = halves(linkage, frame).map(|half| {
            let trig = JointTrig::at(g, &half, q);
            let stages = stages(g, &half, &trig, half.links.len());
            let first = g.motion(&half.base);
            look_out(g, &stages, first)
        });
        Self {
            axes: inner.0.into_iter().rev().chain(outer.0).collect(),
            base: inner.1,
            tip: outer.1,
        }
    }

    /// A point of every axis of rotation, and last the tip.
    pub(super) fn points(&self) -> Vec<Vector> {
        let points = self.axes.iter().filter_map(|axis| match *axis {
            Axis::Revolute { point, .. } => Some(point),
            Axis::Prismatic { .. } => None,
        });
        points.chain([self.tip.translation]).collect()
    }

    /// The twists (v, ω) of the joints; v is the velocity of what is in the
    /// frame's origin.
    pub(super) fn twists(&self, g: &mut Graph) -> Vec<[Vector; 2]> {
        self.twists_by(g, |g, direction, point| g.cross(point, direction))
    }

    /// The same with the velocity of what is at `reference`.
    pub(super) fn twists_about(&self, g: &mut Graph, reference: Vector) -> Vec<[Vector; 2]> {
        self.twists_by(g, |g, direction, point| {
            let arm = g.minus(reference, point);
            g.cross(direction, arm)
        })
    }

    fn twists_by(
        &self,
        g: &mut Graph,
        velocity: impl Fn(&mut Graph, Vector, Vector) -> Vector,
    ) -> Vec<[Vector; 2]> {
        let zero = g.vector([0.0; 3]);
        let twists = self.axes.iter().map(|axis| match *axis {
            Axis::Revolute { direction, point } => [velocity(g, direction, point), direction],
            Axis::Prismatic { direction } => [direction, zero],
        });
        twists.collect()
    }

    /// The columns of the Jacobian in the frame's axes, one for each coordinate
    /// of q.
    pub(super) fn columns(
        &self,
        g: &mut Graph,
        linkage: &Linkage,
        reference: Vector,
    ) -> Vec<[Expr; 6]> {
        let twists = self.twists_about(g, reference);
        let flat = |[v, w]: [Vector; 2]| [v[0], v[1], v[2], w[0], w[1], w[2]];
        let columns = by_coordinate(g, linkage, twists);
        columns.into_iter().map(flat).collect()
    }
}

/// The columns of the coordinates of q from those of the joints.
pub(super) fn by_coordinate(
    g: &mut Graph,
    linkage: &Linkage,
    joints: impl IntoIterator<Item = [Vector; 2]>,
) -> Vec<[Vector; 2]> {
    let zero = g.vector([0.0; 3]);
    let mut columns = vec![[zero; 2]; linkage.variables()];
    for (link, [v, w]) in linkage.links.iter().zip(joints) {
        let gain = g.constant(link.gain);
        let (v, w) = (g.scale(gain, v), g.scale(gain, w));
        let column = &mut columns[link.variable];
        *column = [g.plus(column[0], v), g.plus(column[1], w)];
    }
    columns
}

/// Outwards from `frame`: the axes of all joints, and the frame at the end.
pub(super) fn look_out(
    g: &mut Graph,
    stages: &[Stage],
    mut frame: Motion,
) -> (Vec<Axis<Vector>>, Motion) {
    let mut axes = Vec::new();
    for stage in stages {
        axes.extend(stage.axes_from(g, frame));
        let travel = g.rotate(&frame.rotation, stage.travel);
        frame.translation = g.plus(frame.translation, travel);
        let behind = stage.spin(g, frame);
        frame = stage.leave(g, behind);
    }
    (axes, frame)
}

/// The chain from a frame back to the base, and that outwards to the tip. Their
/// links' frames at home are those of the whole arm.
fn halves(linkage: &Linkage, frame: usize) -> [Linkage; 2] {
    let n = linkage.links.len();
    if frame > tip_frame(linkage) {
        return [part(linkage, Pose::IDENTITY, 0..0), linkage.clone()];
    }
    // How many joints lie towards the base, and whether the frame is before
    // their constant motion or behind it.
    let (inner, before_constant) = (frame.div_ceil(2), frame % 2 == 1);
    let constant = |inner: usize| match inner.checked_sub(1) {
        Some(last) => (linkage.links[last].after, linkage.links[last].advance),
        None => (
            linkage.base,
            linkage.base.rotate_back(linkage.base.translation),
        ),
    };
    let (to_inner, to_outer) = match before_constant {
        true => (Pose::IDENTITY, constant(inner).0),
        false => (inverse(constant(inner)).0, Pose::IDENTITY),
    };
    let mut back = part(linkage, to_inner, 0..inner);
    back.links.reverse();
    for (i, link) in back.links.iter_mut().enumerate() {
        let (after, advance) = inverse(constant(inner - 1 - i));
        *link = Link {
            gain: -link.gain,
            offset: -link.offset,
            after,
            advance,
            ..link.clone()
        };
    }
    back.runs.reverse();
    for run in &mut back.runs {
        run.joints = inner - run.joints.end..inner - run.joints.start;
    }
    [back, part(linkage, to_outer, inner..n)]
}

/// Some joints of a chain, behind a constant motion.
fn part(linkage: &Linkage, base: Pose, joints: std::ops::Range<usize>) -> Linkage {
    let within = |i: usize| i.clamp(joints.start, joints.end) - joints.start;
    let runs = linkage.runs.iter().map(|run| Run {
        joints: within(run.joints.start)..within(run.joints.end),
    });
    Linkage {
        base,
        links: linkage.links[joints.clone()].to_vec(),
        runs: runs.filter(|run| !run.joints.is_empty()).collect(),
        size: linkage.size,
        scalar: linkage.scalar,
        has_free_turn: false,
        locked: Vec::new(),
        swivel: None,
        coupling: None,
    }
}

/// The inverse of a constant motion whose translation is given in both axes,
/// with the digits that these have.
fn inverse((motion, advance): (Pose, Vec3)) -> (Pose, Vec3) {
    let rotation = motion.inverse().rotation;
    let translation = advance.map(|x| -x);
    let advance = motion.translation.map(|x| -x);
    (
        Pose {
            rotation,
            translation,
        },
        advance,
    )
}
