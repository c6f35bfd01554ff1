//! Joints by frames relative to the parent link, and the chain of rows that
//! the other conventions are turned into as well.

use super::fields::{Fields, Reader};
use super::node::Node;
use super::row::{self, Geometry, Row};
use super::units::Units;
use super::{End, fix_tip, pose};
use crate::spec::JointType;
use crate::spec::tree::{Draft, DraftJoint};
use kin_runtime::Pose;

/// The keys of a joint beside the common ones.
pub(super) const KEYS: [&str; 6] = ["parent", "axis", "xyz", "rpy", "quat_xyzw", "matrix"];

/// Reads one joint.
pub(super) fn read(
    fields: &Fields,
    kind: JointType,
    units: &Units,
    reader: &mut Reader,
) -> Option<Geometry> {
    let origin = pose::read(fields, units, reader);
    let axis = match kind {
        JointType::Fixed => Some([0.0, 0.0, 1.0]),
        _ => row::axis(fields, reader),
    };
    let parent = match fields.get("parent") {
        Some(node) => Some(reader.name(node)?),
        None => None,
    };
    Some(Geometry {
        parent,
        origin: origin?,
        axis: axis?,
        mount: Pose::IDENTITY,
    })
}

/// Adds rows, each on the link of the one before unless it says otherwise, and
/// the tip if the file has one.
pub(super) fn add(
    draft: &mut Draft,
    base: &End,
    tip: &End,
    rows: Vec<Row>,
    list: &Node,
    reader: &Reader,
) {
    let root = base.link("base", list, reader);
    let mut previous = root.clone();
    for row in rows {
        let parent = row.geometry.parent.unwrap_or(previous);
        let on_base = parent.text == root.text;
        draft.links.push(row.link.clone());
        draft.joints.push(DraftJoint {
            name: row.name,
            kind: row.kind,
            origin: if on_base {
                base.pose() * row.geometry.origin
            } else {
                row.geometry.origin
            },
            parent,
            child: row.link.clone(),
            axis: row.geometry.axis,
            mount: row.geometry.mount,
            limits: row.limits,
            mimic: row.mimic,
            rating: row.rating,
            faults: Vec::new(),
        });
        previous = row.link;
    }
    if tip.name.is_some() || tip.pose.is_some() {
        fix_tip(draft, tip.link("tip", list, reader), previous, tip.pose());
    }
}
