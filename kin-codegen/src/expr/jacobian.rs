//! The manipulator Jacobian as expressions (MLS section 3.4).
//!
//! The columns are twists of the joint axes, and their cost depends on where
//! they are written down. They are built in a frame in the middle of the chain
//! and turned to the frame that is asked for. Every frame is tried and the
//! cheapest kept: on a UR5 the one behind the first joint, in which axes 2 to 4
//! are constant. Angles are counted from that frame, or, on the way back to the
//! base, by runs of parallel joints from the base, as forward kinematics does,
//! which then has the same sines.

use super::axes::{AxesInFrame, by_coordinate, frames, look_out};
use super::forward::{
    JointTrig, Outputs, Stage, cheapest, compared, stages, tip, tip_by_splitting, tip_forwards,
};
use super::linear::{Motion, Vector, transpose};
use super::{Expr, Graph};
use crate::geometry::{Axis, Linkage};
use kin_runtime::Pose;

/// Which Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// Velocity of the base's origin point, base axes: V_s = J_s q′.
    Spatial,
    /// Velocity of the tip's origin, tip axes: V_b = J_b q′.
    Body,
    /// Velocity of the tip's origin, base axes: ROS's "geometric" Jacobian.
    Geometric,
}

/// Columns (v, ω), one per coordinate of q.
#[derive(Clone, Debug)]
pub struct Columns(pub Vec<[Vector; 2]>);

impl Outputs for Columns {
    fn expressions(&self) -> Vec<Expr> {
        self.0.iter().flatten().flatten().copied().collect()
    }
}

/// Forward kinematics and a Jacobian that share what they can.
#[derive(Clone, Debug)]
pub struct TipAndColumns {
    /// The pose of the tip.
    pub tip: Motion,
    /// The Jacobian.
    pub columns: Columns,
}

impl Outputs for TipAndColumns {
    fn expressions(&self) -> Vec<Expr> {
        [self.tip.expressions(), self.columns.expressions()].concat()
    }
}

/// The Jacobian alone.
pub fn jacobian(g: &mut Graph, linkage: &Linkage, q: &[Expr], which: Which) -> Columns {
    let trig = JointTrig::at(g, linkage, q);
    let variants = variants(linkage);
    cheapest(g, variants.len(), |g, variant| {
        let seen = Variant::new(g, linkage, &trig, q, variants[variant]);
        seen.columns(g, linkage, which)
    })
}

/// The pose of the tip and the Jacobian together. The cheapest way to the pose
/// alone need not be the one whose frames the Jacobian can use.
pub fn tip_and_jacobian(
    g: &mut Graph,
    linkage: &Linkage,
    q: &[Expr],
    which: Which,
) -> TipAndColumns {
    let trig = JointTrig::at(g, linkage, q);
    let tips = [tip, tip_by_splitting, tip_forwards].map(|build| build(g, linkage, &trig));
    let variants = variants(linkage);
    cheapest(g, tips.len() * variants.len(), |g, variant| {
        let seen = variants[variant % variants.len()];
        let seen = Variant::new(g, linkage, &trig, q, seen);
        TipAndColumns {
            tip: tips[variant / variants.len()],
            columns: seen.columns(g, linkage, which),
        }
    })
}

/// The time derivative of the spatial Jacobian at the rates of q. Joints that
/// mimic others are told apart, which the Jacobian itself no longer can.
///
/// The axes are moved along in the middle frame: a column changes by its
/// bracket with the velocity of the link before it.
pub fn jacobian_dot(g: &mut Graph, linkage: &Linkage, q: &[Expr], rates: &[Expr]) -> Columns {
    let trig = JointTrig::at(g, linkage, q);
    let variants = variants(linkage);
    cheapest(g, variants.len(), |g, variant| {
        let seen = Variant::new(g, linkage, &trig, q, variants[variant]);
        let changes = seen.changes(g, linkage, rates);
        let base = seen.axes.base;
        seen.moved(g, linkage, changes, &base.rotation, base.translation)
    })
}

/// Middle frames, in both ways to count angles, each with both places to shift the reference
/// point.
fn variants(linkage: &Linkage) -> Vec<(usize, bool)> {
    let frames = compared(linkage.runs.len() + 1 + frames(linkage));
    let both = |frame| [(frame, false), (frame, true)];
    frames.into_iter().flat_map(both).collect()
}

/// A frame in the middle of the chain in which columns are built.
struct Variant {
    axes: AxesInFrame,
    /// Whether the reference point is shifted after the columns are turned.
    shift_last: bool,
}

impl Variant {
    /// One of [`variants`].
    fn new(
        g: &mut Graph,
        linkage: &Linkage,
        trig: &JointTrig,
        q: &[Expr],
        (frame, shift_last): (usize, bool),
    ) -> Self {
        Self {
            axes: match frame.checked_sub(linkage.runs.len() + 1) {
                None => look_around(g, linkage, trig, frame),
                Some(frame) => AxesInFrame::new(g, linkage, q, frame),
            },
            shift_last,
        }
    }

    fn columns(&self, g: &mut Graph, linkage: &Linkage, which: Which) -> Columns {
        let AxesInFrame { base, tip, .. } = &self.axes;
        let reference = match which {
            Which::Spatial => base.translation,
            Which::Body | Which::Geometric => tip.translation,
        };
        let target = match which {
            Which::Spatial | Which::Geometric => base.rotation,
            Which::Body => tip.rotation,
        };
        if self.shift_last {
            let twists = self.axes.twists(g);
            return self.moved(g, linkage, twists, &target, reference);
        }
        let twists = self.axes.twists_about(g, reference);
        let origin = g.vector([0.0; 3]);
        self.moved(g, linkage, twists, &target, origin)
    }

    /// How the twists of the joints change at the rates of q.
    fn changes(&self, g: &mut Graph, linkage: &Linkage, rates: &[Expr]) -> Vec<[Vector; 2]> {
        let mut velocity = [g.vector([0.0; 3]); 2];
        let mut changes = Vec::new();
        for (link, [v, w]) in linkage.links.iter().zip(self.axes.twists(g)) {
            let [turned, shifted] = [g.cross(velocity[1], v), g.cross(velocity[0], w)];
            changes.push([g.plus(turned, shifted), g.cross(velocity[1], w)]);
            let gain = g.constant(link.gain);
            let rate = g.mul(gain, rates[link.variable]);
            let [v, w] = [v, w].map(|x| g.scale(rate, x));
            velocity = [g.plus(velocity[0], v), g.plus(velocity[1], w)];
        }
        changes
    }

    /// Columns for twists of the joints about the frame's origin, in the axes
    /// `target` and about the point `reference`.
    fn moved(
        &self,
        g: &mut Graph,
        linkage: &Linkage,
        twists: Vec<[Vector; 2]>,
        target: &[Vector; 3],
        reference: Vector,
    ) -> Columns {
        let late = g.rotate_back(target, reference);
        let moved = twists.into_iter().map(|[v, w]| {
            let turned = g.rotate_back(target, w);
            let v = if self.shift_last {
                let v = g.rotate_back(target, v);
                let shift = g.cross(turned, late);
                g.plus(v, shift)
            } else {
                let shift = g.cross(w, reference);
                let v = g.plus(v, shift);
                g.rotate_back(target, v)
            };
            [v, turned]
        });
        let moved: Vec<[Vector; 2]> = moved.collect();
        Columns(by_coordinate(g, linkage, moved))
    }
}

/// The axes in the frame before run number `middle`, with angles by runs; one
/// past the last is the tip's frame.
fn look_around(g: &mut Graph, linkage: &Linkage, trig: &JointTrig, middle: usize) -> AxesInFrame {
    let stages = stages(g, linkage, trig, linkage.links.len());
    let here = g.motion(&Pose::IDENTITY);
    let (inner, outer) = stages.split_at(middle);
    let (mut axes, before) = look_back(g, inner, here);
    let (later, tip) = look_out(g, outer, here);
    axes.extend(later);
    let to_base = g.motion(&linkage.base.inverse());
    let shift = g.rotate(&before.rotation, to_base.translation);
    let base = Motion {
        rotation: g.product(&before.rotation, &to_base.rotation),
        translation: g.plus(before.translation, shift),
    };
    AxesInFrame { axes, base, tip }
}

/// Backwards from `frame`: the axes of earlier runs, and the frame before the
/// first.
fn look_back(g: &mut Graph, inner: &[Stage], mut frame: Motion) -> (Vec<Axis<Vector>>, Motion) {
    let mut runs = Vec::new();
    for stage in inner.iter().rev() {
        frame = stage.enter(g, frame);
        if let Some(turn) = stage.turn {
            let turn = g.rotation_z(turn);
            frame.rotation = g.product(&frame.rotation, &transpose(&turn));
        }
        let travel = g.rotate(&frame.rotation, stage.travel);
        frame.translation = g.minus(frame.translation, travel);
        runs.push(stage.axes_from(g, frame));
    }
    (runs.into_iter().rev().flatten().collect(), frame)
}
