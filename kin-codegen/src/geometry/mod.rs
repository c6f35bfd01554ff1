//! Geometry of the chain: lines and how they lie, the frames in which
//! constants vanish, and the idealization of noisy files.

mod carried;
mod conditioning;
mod coupling;
mod idealize;
mod linkage;
mod relation;
mod singular;
mod structure;
mod swivel;

pub use crate::vector::{Vec3, angle, cross, dot, norm};
pub(crate) use crate::vector::{along, sub, unit};
pub use carried::Carried;
pub(crate) use conditioning::in_words;
pub use conditioning::{
    SINGULAR, conditioning, coupled_rank, natural_target, rank, volume, weak_motion,
};
pub use coupling::{
    Combination, Coupling, InverseRow, Undetermined, by_coordinates, solved_chain, uncoupled,
    uncoupled_behind,
};
pub use idealize::{Idealized, Moved, idealize};
pub(crate) use idealize::{NOISIEST, idealizations};
pub(crate) use linkage::without_noise;
pub use linkage::{Link, Linkage, Run};
pub use relation::{PairRelation, concurrency, relate};
pub use singular::{Condition, conditions};
pub use structure::{Axes, Neighbours, Row, RowRelation, numbers, structure};
pub use swivel::Swivel;

use crate::model::{Joint, Model};
use kin_runtime::{Pose, Twist};

/// A directed line: a unit direction through a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Unit direction.
    pub direction: Vec3,
    /// Any point of the line.
    pub point: Vec3,
}

/// How a joint moves, as it is in some frame; the vectors are numbers or
/// expressions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axis<V> {
    /// The joint turns about a line.
    Revolute {
        /// Unit direction.
        direction: V,
        /// A point of the line, metres.
        point: V,
    },
    /// The joint slides.
    Prismatic {
        /// Unit direction.
        direction: V,
    },
}

impl Line {
    /// A joint's axis at home, base coordinates.
    pub fn of(joint: &Joint) -> Self {
        Self {
            direction: joint.axis,
            point: joint.point,
        }
    }

    /// The axis of a unit twist; none of one that slides.
    pub fn of_twist(twist: &Twist) -> Option<Self> {
        let direction = twist.angular;
        (norm(direction) > 0.5).then(|| Self {
            direction,
            point: cross(direction, twist.linear),
        })
    }

    /// Where a motion takes the line.
    pub fn moved(&self, motion: &Pose) -> Self {
        Self {
            direction: motion.rotate(self.direction),
            point: motion.transform_point(self.point),
        }
    }

    /// The vector from the line's nearest point to `p`.
    pub fn offset_of(&self, p: Vec3) -> Vec3 {
        let d = sub(p, self.point);
        along(d, -dot(d, self.direction), self.direction)
    }

    /// The part of a vector that is perpendicular to the line.
    pub fn across(&self, v: Vec3) -> Vec3 {
        along(v, -dot(v, self.direction), self.direction)
    }

    /// The point of this line nearest to another that is not parallel to it:
    /// the foot of the common normal.
    pub fn foot(&self, other: &Line) -> Vec3 {
        let normal = cross(self.direction, other.direction);
        let d = sub(other.point, self.point);
        let t = dot(cross(d, other.direction), normal) / dot(normal, normal);
        along(self.point, t, self.direction)
    }

    /// The point of this line nearest to `p`.
    pub fn nearest(&self, p: Vec3) -> Vec3 {
        let t = dot(sub(p, self.point), self.direction);
        along(self.point, t, self.direction)
    }

    /// The distance between two lines.
    pub fn distance(&self, other: &Line) -> f64 {
        let normal = cross(self.direction, other.direction);
        let sine = norm(normal);
        // Nearly parallel lines have no stable common normal.
        if sine < 1e-9 {
            return norm(self.offset_of(other.point));
        }
        dot(sub(other.point, self.point), normal).abs() / sine
    }
}

/// The joint axes of a model as lines, at home, in base coordinates.
pub fn axes(model: &Model) -> Vec<Line> {
    model.joints.iter().map(Line::of).collect()
}

/// The arm's size, metres: how far the tip can be from the first axis if
/// every link were stretched. Lengths are judged relative to it. What an angle is
/// worth beside a length is another number: see the runtime's characteristic length.
///
/// Offsets along an axis of rotation count once, however they are split
/// between the links that share the axis.
pub fn size(model: &Model) -> f64 {
    let mut length = 0.0;
    let mut here = model.joints[0].point;
    let revolute = model.joints.iter().filter(|joint| joint.is_revolute());
    for joint in revolute.skip(1) {
        let next = Line::of(joint).nearest(here);
        length += norm(sub(next, here));
        here = next;
    }
    length += norm(sub(model.home.translation, here));
    // Axes that all meet in the tip leave rounding; then any length will do.
    let far = model.joints.iter().map(|joint| norm(joint.point));
    let extent = far.fold(norm(model.home.translation), f64::max);
    match (length > 1e-9 * extent, extent > 0.0) {
        (true, _) => length,
        (false, true) => extent,
        (false, false) => 1.0,
    }
}
