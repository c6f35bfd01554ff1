//! All axes of an arm as they are seen from one of its links.
//!
//! Unlike forward kinematics, which counts angles from the base, an outlook
//! counts them from where it stands: the angle between two parallel links
//! appears as the joint between them, and not as a difference of sums. That is
//! what determinants need to fall apart into factors.

use super::forward::{joint_value, subscript};
use super::linear::{Trig, Vector};
use super::{Expr, Graph};
use crate::geometry::{Linkage, Travel, Vec3};
use kin_runtime::Pose;

/// The axis of a joint, seen from the chosen link.
pub(super) enum Axis {
    Turn { direction: Vector, point: Vector },
    Slide { direction: Vector },
}

/// What is seen from one link.
pub(super) struct Outlook {
    /// By joint.
    pub axes: Vec<Axis>,
    /// Where the frames of the joints lie, and last the tip.
    pub points: Vec<Vector>,
}

/// Every gap between two joints has two frames: one square to the joint before
/// it, one to the joint behind it; and there is one before the first joint and
/// one at the tip, which is the last.
pub(super) fn standpoints(linkage: &Linkage) -> usize {
    2 * linkage.links.len() + 1
}

/// The standpoint before the first joint.
pub(super) const FIRST: usize = 0;

impl Outlook {
    /// From standpoint number `standpoint`, one of [`standpoints`].
    pub(super) fn new(g: &mut Graph, linkage: &Linkage, q: &[Expr], standpoint: usize) -> Self {
        // Joints inside of the standpoint, and whether it is before their
        // constant motion or behind it.
        let (inner, before_constant) = (standpoint.div_ceil(2), standpoint % 2 == 1);
        let gap = match inner {
            0 => Pose::IDENTITY,
            inner => linkage.links[inner - 1].after,
        };
        let (to_inner, to_outer) = if before_constant {
            (Pose::IDENTITY, gap)
        } else {
            (gap.inverse(), Pose::IDENTITY)
        };
        let n = linkage.links.len();
        let mut seen = Self {
            axes: Vec::with_capacity(n),
            points: Vec::with_capacity(n + 1),
        };
        let mut walk = Walk::new(g, linkage, q, &to_inner);
        for joint in (0..inner).rev() {
            walk.back(g, joint, &mut seen);
        }
        seen.axes.reverse();
        seen.points.reverse();
        let mut walk = Walk::new(g, linkage, q, &to_outer);
        for joint in inner..n {
            walk.out(g, joint, &mut seen);
        }
        seen.points.push(walk.point);
        seen
    }
}

/// A frame on its way along the chain: `rotation` Rz(`angle`), at `point`.
struct Walk<'a> {
    linkage: &'a Linkage,
    q: &'a [Expr],
    rotation: [Vector; 3],
    /// Gathered within a run of parallel joints.
    angle: Expr,
    symbol: String,
    point: Vector,
}

impl<'a> Walk<'a> {
    fn new(g: &mut Graph, linkage: &'a Linkage, q: &'a [Expr], from: &Pose) -> Self {
        let from = g.motion(from);
        Self {
            linkage,
            q,
            rotation: from.rotation,
            angle: g.zero(),
            symbol: String::new(),
            point: from.translation,
        }
    }

    /// From before a joint to before the next.
    fn out(&mut self, g: &mut Graph, joint: usize, seen: &mut Outlook) {
        let link = &self.linkage.links[joint];
        let value = joint_value(g, link.gain, link.offset, self.q[link.variable]);
        let axis = self.axis(g, link.travel);
        seen.points.push(self.point);
        match axis {
            Axis::Turn { .. } => {
                self.angle = g.add(self.angle, value);
                self.symbol.push_str(&subscript(link.variable));
            }
            Axis::Slide { direction } => {
                let way = g.scale(value, direction);
                self.point = g.plus(self.point, way);
            }
        }
        seen.axes.push(axis);
        let ends = self.ends_run(joint);
        let here = self.turned(g);
        let behind = match ends {
            true => self.constant(g, &here, &link.after.rotation),
            false => here,
        };
        let shift = shift(g, link.after.translation, link.advance, &here, &behind);
        self.point = g.plus(self.point, shift);
        if ends {
            self.restart(g, behind);
        }
    }

    /// From behind a joint to behind the one before it.
    fn back(&mut self, g: &mut Graph, joint: usize, seen: &mut Outlook) {
        let link = &self.linkage.links[joint];
        let value = joint_value(g, link.gain, link.offset, self.q[link.variable]);
        let axis = self.axis(g, link.travel);
        match axis {
            Axis::Turn { .. } => {
                self.angle = g.sub(self.angle, value);
                self.symbol.insert_str(0, &subscript(link.variable));
            }
            Axis::Slide { direction } => {
                let way = g.scale(value, direction);
                self.point = g.minus(self.point, way);
            }
        }
        seen.axes.push(axis);
        seen.points.push(self.point);
        let Some(before) = joint.checked_sub(1) else {
            return;
        };
        let constant = &self.linkage.links[before];
        let ends = self.ends_run(before);
        let here = self.turned(g);
        let behind = match ends {
            true => self.constant(g, &here, &constant.after.inverse().rotation),
            false => here,
        };
        let after = &constant.after;
        let shift = shift(g, after.translation, constant.advance, &behind, &here);
        self.point = g.minus(self.point, shift);
        if ends {
            self.restart(g, behind);
        }
    }

    /// Whether a joint is the last of its run.
    fn ends_run(&self, joint: usize) -> bool {
        let runs = &self.linkage.runs;
        runs.iter().any(|run| run.joints.end == joint + 1)
    }

    fn restart(&mut self, g: &mut Graph, rotation: [Vector; 3]) {
        self.rotation = rotation;
        self.angle = g.zero();
        self.symbol.clear();
    }

    fn axis(&self, g: &mut Graph, travel: Travel) -> Axis {
        match travel {
            Travel::Turn => Axis::Turn {
                direction: [0, 1, 2].map(|row| self.rotation[row][2]),
                point: self.point,
            },
            Travel::Slide(v) => {
                let v = g.vector(v);
                let here = self.turned(g);
                Axis::Slide {
                    direction: g.rotate(&here, v),
                }
            }
        }
    }

    fn turned(&self, g: &mut Graph) -> [Vector; 3] {
        let (sin, cos) = g.sin_cos(self.angle);
        // The sine of a negative angle is that of the angle, negated.
        let [sin, cos] = [(sin, 's'), (cos, 'c')].map(|(e, letter)| {
            let plain = g.negated(e).unwrap_or(e);
            g.named(plain, format!("{letter}{}", self.symbol));
            e
        });
        let turn = g.rotation_z(Trig { sin, cos });
        g.product(&self.rotation, &turn)
    }

    fn constant(&self, g: &mut Graph, r: &[Vector; 3], constant: &[Vec3; 3]) -> [Vector; 3] {
        let constant = g.rotation(constant);
        g.product(r, &constant)
    }
}

/// A constant translation in the axes of the outlook, from those before its
/// rotation or behind it, where it has more zeros.
fn shift(
    g: &mut Graph,
    translation: Vec3,
    advance: Vec3,
    before: &[Vector; 3],
    behind: &[Vector; 3],
) -> Vector {
    let entries = |v: &Vec3| v.iter().filter(|x| **x != 0.0).count();
    let (v, rotation) = if entries(&advance) < entries(&translation) {
        (advance, behind)
    } else {
        (translation, before)
    };
    let v = g.vector(v);
    g.rotate(rotation, v)
}

/// The columns (v, ω) of the Jacobian, one for each coordinate of q, where v is
/// the velocity of what is at `reference`.
pub(super) fn columns(
    g: &mut Graph,
    linkage: &Linkage,
    seen: &Outlook,
    reference: Vector,
) -> Vec<[Expr; 6]> {
    let zero = g.vector([0.0; 3]);
    let mut out = vec![[zero; 2]; linkage.variables()];
    for (link, axis) in linkage.links.iter().zip(&seen.axes) {
        let (v, w) = match *axis {
            Axis::Turn { direction, point } => {
                let arm = g.minus(reference, point);
                (g.cross(direction, arm), direction)
            }
            Axis::Slide { direction } => (direction, zero),
        };
        let gain = g.constant(link.gain);
        let (v, w) = (g.scale(gain, v), g.scale(gain, w));
        let column = &mut out[link.variable];
        *column = [g.plus(column[0], v), g.plus(column[1], w)];
    }
    let flat = |[v, w]: [Vector; 2]| [v[0], v[1], v[2], w[0], w[1], w[2]];
    out.into_iter().map(flat).collect()
}
