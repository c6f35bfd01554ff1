//! Joints by screw axes: a direction and a point, in the base frame at home.

use super::fields::{Fields, Reader};
use super::joint::{self, Geometry, Row};
use super::node::Node;
use super::units::Units;
use super::{End, frames};
use crate::spec::tree::Draft;
use crate::spec::{JointType, orientation};
use kin_runtime::Pose;

/// The keys of a screw beside the common ones.
pub(super) const KEYS: [&str; 2] = ["axis", "point"];

/// Reads one screw. The link's frame coincides with the base frame at home: the
/// way to the axis and the way back cancel to the last digit.
pub(super) fn read(
    fields: &Fields,
    kind: JointType,
    units: &Units,
    reader: &mut Reader,
) -> Option<Geometry> {
    let axis = joint::axis(fields, reader);
    let point = match (fields.get("point"), kind) {
        (Some(node), _) => reader.exactly(node, |reader, node| units.length(node, reader)),
        (None, JointType::Prismatic) => Some([0.0; 3]),
        (None, _) => {
            fields.required("point", reader);
            None
        }
    };
    let point = point?;
    Some(Geometry {
        parent: None,
        origin: orientation::shift(point),
        axis: axis?,
        mount: orientation::shift(point.map(|x| -x)),
    })
}

/// Adds the chain and, at its end, the tip at its home pose.
pub(super) fn add(
    draft: &mut Draft,
    base: &End,
    tip: &End,
    home: Pose,
    rows: Vec<Row>,
    list: &Node,
    reader: &mut Reader,
) -> Option<()> {
    if let (Some(_), Some(name)) = (tip.pose, &tip.name) {
        let reason = format!(
            "the pose of `{}` is given twice, by `home` and by `tip`",
            name.text
        );
        reader
            .complaints
            .at(name.at, reason, "write the tip's name only: `tip: name`");
        return None;
    }
    let link = tip.link("tip", list, reader);
    let named = End {
        name: Some(link),
        pose: Some(home),
    };
    frames::add(draft, base, &named, rows, list, reader);
    Some(())
}
