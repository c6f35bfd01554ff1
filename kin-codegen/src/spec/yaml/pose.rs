//! Poses: a position, and an orientation in one of three notations.

use super::fields::{Fields, Reader};
use super::node::Node;
use super::units::Units;
use crate::spec::orientation::{self, Rotation};
use kin_runtime::Pose;

/// The keys of a pose.
pub(super) const KEYS: [&str; 4] = ["xyz", "rpy", "quat_xyzw", "matrix"];

/// Reads a pose from a mapping that may have other keys too.
pub(super) fn read(fields: &Fields, units: &Units, reader: &mut Reader) -> Option<Pose> {
    let translation = match fields.get("xyz") {
        Some(node) => reader.exactly(node, |reader, node| units.length(node, reader)),
        None => Some([0.0; 3]),
    };
    let rotation = rotation(fields, units, reader);
    Some(Pose {
        rotation: rotation?,
        translation: translation?,
    })
}

fn rotation(fields: &Fields, units: &Units, reader: &mut Reader) -> Option<Rotation> {
    let mut given = KEYS[1..]
        .iter()
        .filter_map(|&key| Some((key, fields.get(key)?)));
    let Some((key, node)) = given.next() else {
        return Some(Pose::IDENTITY.rotation);
    };
    if let Some((second, _)) = given.next() {
        let reason = format!("the orientation is given twice, by `{key}` and by `{second}`");
        reader.at(fields.key(second), reason, "keep one of the two");
        return None;
    }
    match key {
        "rpy" => {
            let rpy = reader.exactly(node, |reader, node| units.placing_angle(node, reader))?;
            Some(orientation::from_rpy(rpy))
        }
        "quat_xyzw" => quaternion(node, reader),
        _ => matrix(node, reader),
    }
}

fn quaternion(node: &Node, reader: &mut Reader) -> Option<Rotation> {
    let quaternion = reader.exactly(node, plain)?;
    if let Err(length) = orientation::check_quaternion(quaternion) {
        let reason = format!("the quaternion has the length {length}, and a rotation's has 1");
        let remedy = match quaternion == [0.0; 4] {
            true => "leave it out where nothing is turned: that is `[0, 0, 0, 1]`",
            false => "normalise it; the order is x, y, z, w",
        };
        reader.at(node.at, reason, remedy);
        return None;
    }
    Some(orientation::from_quaternion(quaternion))
}

fn matrix(node: &Node, reader: &mut Reader) -> Option<Rotation> {
    let rows = reader.exactly(node, |reader, row| reader.exactly::<3, f64>(row, plain))?;
    let rotation = orientation::from_matrix(rows);
    if rotation.is_none() {
        let reason = "this matrix is no rotation: its rows must have length 1, be at right angles, and right-handed";
        reader.at(
            node.at,
            reason,
            "write the rows of a rotation matrix, whose determinant is 1, with at least 5 digits",
        );
    }
    rotation
}

/// A number without a unit.
pub(super) fn plain(reader: &mut Reader, node: &Node) -> Option<f64> {
    reader.number(node).map(|(number, _)| number)
}
