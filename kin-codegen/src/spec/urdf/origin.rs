//! A joint's `<origin>`.

use super::numbers;
use crate::spec::Complaints;
use crate::spec::orientation::{self, FULL_TURN, Rotation};
use kin_runtime::Pose;
use roxmltree::{Attribute, Node};

/// Reads a pose; what the element leaves out is zero.
pub(super) fn read(node: Node, complaints: &mut Complaints) -> Option<Pose> {
    let translation = match node.attribute_node("xyz") {
        Some(xyz) => numbers::read(&xyz, complaints),
        None => Some([0.0; 3]),
    };
    let rotation = rotation(node, complaints);
    Some(Pose {
        rotation: rotation?,
        translation: translation?,
    })
}

fn rotation(origin: Node, complaints: &mut Complaints) -> Option<Rotation> {
    match (
        origin.attribute_node("rpy"),
        origin.attribute_node("quat_xyzw"),
    ) {
        (None, None) => Some(Pose::IDENTITY.rotation),
        (Some(rpy), None) => angles(&rpy, complaints),
        (None, Some(quat)) => quaternion(&quat, complaints),
        (Some(_), Some(quat)) => {
            let reason = "the origin has both rpy and quat_xyzw: only one can hold";
            complaints.at(
                complaints.place(quat.range().start),
                reason,
                "remove one of them",
            );
            None
        }
    }
}

fn angles(rpy: &Attribute, complaints: &mut Complaints) -> Option<Rotation> {
    let angles: [f64; 3] = numbers::read(rpy, complaints)?;
    if angles.iter().any(|angle| angle.abs() > FULL_TURN) {
        let at = complaints.place(rpy.range_value().start);
        let reason = format!(
            "rpy=\"{}\" turns more than once around: this looks like degrees",
            rpy.value()
        );
        complaints.at(
            at,
            reason,
            "write radians: 90 degrees are 1.5707963267948966",
        );
        return None;
    }
    Some(orientation::from_rpy(angles))
}

/// URDF 1.1; older files that have it can mean nothing else.
fn quaternion(xyzw: &Attribute, complaints: &mut Complaints) -> Option<Rotation> {
    let quaternion: [f64; 4] = numbers::read(xyzw, complaints)?;
    if let Err(length) = orientation::check_quaternion(quaternion) {
        let at = complaints.place(xyzw.range_value().start);
        let reason = format!("the quaternion has the length {length}, and a rotation's has 1");
        complaints.at(at, reason, "normalise it; the order is x y z w");
        return None;
    }
    Some(orientation::from_quaternion(quaternion))
}
