//! A joint as the file lists it: the same for the four conventions.

use super::fields::{Fields, Reader};
use super::pose;
use crate::spec::tree::{DraftMimic, Name};
use crate::spec::{JointType, Limits, Rating, orientation};
use kin_runtime::Pose;

/// One entry of the list.
pub(super) struct Row {
    pub name: Name,
    pub kind: JointType,
    pub limits: Limits,
    pub rating: Rating,
    /// The link that the joint moves.
    pub link: Name,
    pub mimic: Option<DraftMimic>,
    /// Whether a joint of a mechanism is driven.
    pub actuated: bool,
    pub geometry: Geometry,
}

/// Where the joint is: see [`Joint`](crate::spec::Joint).
pub(super) struct Geometry {
    /// The link to hang on; by default that of the row before.
    pub parent: Option<Name>,
    pub origin: Pose,
    pub axis: [f64; 3],
    pub mount: Pose,
}

/// A direction of any length but 0.
pub(super) fn axis(fields: &Fields, reader: &mut Reader) -> Option<[f64; 3]> {
    let node = fields.required("axis", reader)?;
    let axis = orientation::unit(reader.exactly(node, pose::plain)?);
    if axis.is_none() {
        reader.at(
            node.at,
            "this axis is zero, which is no direction",
            "write the direction of the joint's axis, such as [0, 0, 1]",
        );
    }
    axis
}
