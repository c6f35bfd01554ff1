//! The manipulator Jacobian as expressions (MLS section 3.4).
//!
//! The columns are twists of the joint axes, and their cost depends on where
//! they are written down. They are built in a frame in the middle of the
//! chain, looking outwards to the later joints and back to the earlier ones,
//! and turned to the frame that is asked for. Every middle frame is tried and
//! the cheapest kept: on a UR5 the one behind the first joint, in which axes
//! 2 to 4 are constant.

use super::forward::{
    Outputs, Stage, Stance, cheapest, stages, tip, tip_by_splitting, tip_forwards,
};
use super::linear::{Motion, Vector, transpose};
use super::{Expr, Graph};
use crate::geometry::Linkage;
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
pub fn jacobian(g: &mut Graph, linkage: &Linkage, stance: &Stance, which: Which) -> Columns {
    cheapest(g, variants(linkage), |g, variant| {
        columns(g, linkage, stance, which, variant)
    })
}

/// The pose of the tip and the Jacobian together. The cheapest way to the pose
/// alone need not be the one whose frames the Jacobian can use.
pub fn tip_and_jacobian(
    g: &mut Graph,
    linkage: &Linkage,
    stance: &Stance,
    which: Which,
) -> TipAndColumns {
    let tips = [tip, tip_by_splitting, tip_forwards].map(|way| way(g, linkage, stance));
    let variants = variants(linkage);
    cheapest(g, tips.len() * variants, |g, variant| TipAndColumns {
        tip: tips[variant / variants],
        columns: columns(g, linkage, stance, which, variant % variants),
    })
}

/// The time derivative of the spatial Jacobian at the rates of q. Joints that
/// mimic others are told apart, which the Jacobian itself no longer can.
///
/// The axes are carried along as seen from the middle frame: a column changes
/// by its bracket with the velocity of the link before it.
pub fn jacobian_dot(g: &mut Graph, linkage: &Linkage, stance: &Stance, rates: &[Expr]) -> Columns {
    cheapest(g, variants(linkage), |g, variant| {
        let (middle, shift_last) = (variant / 2, variant % 2 == 1);
        let seen = look_around(g, linkage, stance, middle);
        let zero = g.vector([0.0; 3]);
        let late = g.rotate_back(&seen.base.rotation, seen.base.translation);
        let mut carrier = [zero; 2];
        let mut out = vec![[zero; 2]; linkage.variables()];
        for (joint, axis) in seen.axes.iter().enumerate() {
            let link = &linkage.links[joint];
            let gain = g.constant(link.gain);
            let (v, w) = match *axis {
                Axis::Turn { direction, point } => (g.cross(point, direction), direction),
                Axis::Slide { direction } => (direction, zero),
            };
            let (v, w) = (g.scale(gain, v), g.scale(gain, w));
            let [turned, moved] = [g.cross(carrier[1], v), g.cross(carrier[0], w)];
            let change = [g.plus(turned, moved), g.cross(carrier[1], w)];
            let (v_rate, w_rate) = (
                g.scale(rates[link.variable], v),
                g.scale(rates[link.variable], w),
            );
            carrier = [g.plus(carrier[0], v_rate), g.plus(carrier[1], w_rate)];
            // From the middle frame's origin to the base's, and to its axes.
            let turned_to = &seen.base.rotation;
            let w = g.rotate_back(turned_to, change[1]);
            let v = if shift_last {
                let v = g.rotate_back(turned_to, change[0]);
                let shift = g.cross(w, late);
                g.plus(v, shift)
            } else {
                let shift = g.cross(change[1], seen.base.translation);
                let v = g.plus(change[0], shift);
                g.rotate_back(turned_to, v)
            };
            let column = &mut out[link.variable];
            *column = [g.plus(column[0], v), g.plus(column[1], w)];
        }
        Columns(out)
    })
}

/// The base, every middle frame, and two places to shift the reference point.
fn variants(linkage: &Linkage) -> usize {
    2 * (linkage.runs.len() + 2)
}

/// An axis as seen from the middle frame.
enum Axis {
    Turn { direction: Vector, point: Vector },
    Slide { direction: Vector },
}

/// Everything as seen from the middle frame.
struct Middle {
    /// By joint.
    axes: Vec<Axis>,
    /// The base frame.
    base: Motion,
    /// The tip frame.
    tip: Motion,
}

fn columns(
    g: &mut Graph,
    linkage: &Linkage,
    stance: &Stance,
    which: Which,
    variant: usize,
) -> Columns {
    let (middle, shift_last) = (variant / 2, variant % 2 == 1);
    let seen = look_around(g, linkage, stance, middle);
    let reference = match which {
        Which::Spatial => seen.base.translation,
        Which::Body | Which::Geometric => seen.tip.translation,
    };
    let target = match which {
        Which::Spatial | Which::Geometric => seen.base.rotation,
        Which::Body => seen.tip.rotation,
    };
    let zero = g.vector([0.0; 3]);
    let mut out = vec![[zero; 2]; linkage.variables()];
    // Reference shifted after turning: v = R v₀ + R c × R ω.
    let late = g.rotate_back(&target, reference);
    for (joint, axis) in seen.axes.iter().enumerate() {
        let (v, w) = match *axis {
            Axis::Turn { direction, point } if shift_last => {
                let v = g.cross(point, direction);
                let v = g.rotate_back(&target, v);
                let w = g.rotate_back(&target, direction);
                let shift = g.cross(w, late);
                (g.plus(v, shift), w)
            }
            Axis::Turn { direction, point } => {
                let arm = g.minus(reference, point);
                let v = g.cross(direction, arm);
                (g.rotate_back(&target, v), g.rotate_back(&target, direction))
            }
            Axis::Slide { direction } => (g.rotate_back(&target, direction), zero),
        };
        let link = &linkage.links[joint];
        let gain = g.constant(link.gain);
        let (v, w) = (g.scale(gain, v), g.scale(gain, w));
        let column = &mut out[link.variable];
        *column = [g.plus(column[0], v), g.plus(column[1], w)];
    }
    Columns(out)
}

/// Looks at all axes from the frame before run number `middle`; one past the
/// frame behind the last is the base.
fn look_around(g: &mut Graph, linkage: &Linkage, stance: &Stance, middle: usize) -> Middle {
    let stages = stages(g, linkage, stance, linkage.links.len());
    let here = g.motion(&Pose::IDENTITY);
    if middle > stages.len() {
        let first = g.motion(&linkage.base);
        let (axes, tip) = look_out(g, &stages, first);
        return Middle {
            axes,
            base: here,
            tip,
        };
    }
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
    Middle { axes, base, tip }
}

/// Outwards from `frame`: the axes of later runs, and the frame behind the
/// last.
fn look_out(g: &mut Graph, outer: &[Stage], mut frame: Motion) -> (Vec<Axis>, Motion) {
    let mut axes = Vec::new();
    for stage in outer {
        push_axes(g, stage, frame, &mut axes);
        let travel = g.rotate(&frame.rotation, stage.travel);
        frame.translation = g.plus(frame.translation, travel);
        let behind = stage.spin(g, frame);
        frame = stage.leave(g, behind);
    }
    (axes, frame)
}

/// Backwards from `frame`: the axes of earlier runs, and the frame before the
/// first.
fn look_back(g: &mut Graph, inner: &[Stage], mut frame: Motion) -> (Vec<Axis>, Motion) {
    let mut groups = Vec::new();
    for stage in inner.iter().rev() {
        frame = stage.enter(g, frame);
        if let Some(turn) = stage.turn {
            let turn = g.rotation_z(turn);
            frame.rotation = g.product(&frame.rotation, &transpose(&turn));
        }
        let travel = g.rotate(&frame.rotation, stage.travel);
        frame.translation = g.minus(frame.translation, travel);
        let mut group = Vec::new();
        push_axes(g, stage, frame, &mut group);
        groups.push(group);
    }
    (groups.into_iter().rev().flatten().collect(), frame)
}

fn push_axes(g: &mut Graph, stage: &Stage, frame: Motion, axes: &mut Vec<Axis>) {
    let Motion {
        rotation,
        translation,
    } = frame;
    for member in &stage.members {
        axes.push(match member.slide {
            Some(slide) => Axis::Slide {
                direction: g.rotate(&rotation, slide),
            },
            None => {
                let point = g.rotate(&rotation, member.point);
                Axis::Turn {
                    direction: [0, 1, 2].map(|row| rotation[row][2]),
                    point: g.plus(translation, point),
                }
            }
        });
    }
}
