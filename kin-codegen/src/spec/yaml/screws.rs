//! Joints by screw axes: a direction and a point, in the base frame at home.

use super::fields::{Fields, Reader};
use super::row::{self, Geometry};
use super::units::Units;
use crate::spec::{JointType, orientation};

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
    let axis = row::axis(fields, reader);
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
