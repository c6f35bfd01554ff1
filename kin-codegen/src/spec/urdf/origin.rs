//! A joint's `<origin>`.

use super::numbers;
use crate::spec::Collector;
use crate::spec::orientation::{self, FULL_TURN, Rotation};
use kin_runtime::Pose;
use roxmltree::{Attribute, Node};

/// Reads a pose; what the element leaves out is zero.
pub(super) fn read(node: Node, diagnostics: &mut Collector) -> Option<Pose> {
    let translation = match node.attribute_node("xyz") {
        Some(xyz) => numbers::read(&xyz, diagnostics),
        None => Some([0.0; 3]),
    };
    let rotation = rotation(node, diagnostics);
    Some(Pose {
        rotation: rotation?,
        translation: translation?,
    })
}

fn rotation(origin: Node, diagnostics: &mut Collector) -> Option<Rotation> {
    match (
        origin.attribute_node("rpy"),
        origin.attribute_node("quat_xyzw"),
    ) {
        (None, None) => Some(Pose::IDENTITY.rotation),
        (Some(rpy), None) => angles(&rpy, diagnostics),
        (None, Some(quat)) => quaternion(&quat, origin.document().root_element(), diagnostics),
        (Some(_), Some(quat)) => {
            let reason = "the origin has both rpy and quat_xyzw: only one can hold";
            diagnostics.at(
                diagnostics.place(quat.range().start),
                reason,
                "remove one of them",
            );
            None
        }
    }
}

fn angles(rpy: &Attribute, diagnostics: &mut Collector) -> Option<Rotation> {
    let angles: [f64; 3] = numbers::read(rpy, diagnostics)?;
    if angles.iter().any(|angle| angle.abs() > FULL_TURN) {
        let at = diagnostics.place(rpy.range_value().start);
        let reason = format!(
            "rpy=\"{}\" turns more than once around: this looks like degrees",
            rpy.value()
        );
        diagnostics.at(
            at,
            reason,
            "write radians: 90 degrees are 1.5707963267948966",
        );
        return None;
    }
    Some(orientation::from_rpy(angles))
}

/// What the file says which URDF it is.
pub(super) fn version<'a>(root: Node<'a, '_>) -> &'a str {
    root.attribute("version").unwrap_or("1.0").trim()
}

/// A version's parts, to be compared.
pub(super) fn number(version: &str) -> Vec<u32> {
    version.split('.').map_while(|it| it.parse().ok()).collect()
}

/// URDF 1.1. In files of an older version urdfdom and Pinocchio do not read it.
fn quaternion(xyzw: &Attribute, root: Node, diagnostics: &mut Collector) -> Option<Rotation> {
    let quaternion: [f64; 4] = numbers::read(xyzw, diagnostics)?;
    let version = version(root);
    if number(version) < vec![1, 1] {
        let at = diagnostics.place(xyzw.range().start);
        let reason = format!(
            "quat_xyzw in a URDF of version {version}: it came with version 1.1, and other \
             programs ignore it here"
        );
        let remedy = "write <robot version=\"1.1\" ...> if it is meant, or the rotation as rpy";
        diagnostics.at(at, reason, remedy);
        return None;
    }
    if let Err(length) = orientation::check_quaternion(quaternion) {
        let at = diagnostics.place(xyzw.range_value().start);
        let reason = format!("the quaternion has the length {length}, and a rotation's has 1");
        diagnostics.at(at, reason, "normalise it; the order is x y z w");
        return None;
    }
    Some(orientation::from_quaternion(quaternion))
}
