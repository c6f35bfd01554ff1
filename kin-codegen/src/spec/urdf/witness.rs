//! The second reading, by urdf-rs, and the proof that both are the same.

use super::{elements, vocabulary};
use crate::spec::tree::{Draft, DraftJoint};
use crate::spec::{Complaints, JointType, Limits, orientation};
use roxmltree::{Attribute, Document, Node};
use urdf_rs::JointType as Theirs;

/// Has urdf-rs read the kinematics of the document, and complains about every
/// joint that it reads differently.
///
/// It sees only what [`super::strict`] reads, as it stands in the file: urdf-rs
/// insists on complete meshes and inertias, which mean nothing here.
pub(super) fn agree(document: &Document, draft: &Draft, complaints: &mut Complaints) {
    let remedy = "write the file plainly: no XML entities, one notation per number";
    let robot = match urdf_rs::read_from_string(&skeleton(document.root_element())) {
        Ok(robot) => robot,
        Err(error) => {
            return complaints.whole(format!("urdf-rs cannot read the joints: {error}"), remedy);
        }
    };
    if robot.links.len() != draft.links.len() || robot.joints.len() != draft.joints.len() {
        return complaints.whole(
            "urdf-rs counts other links and joints than the strict reader",
            remedy,
        );
    }
    let joints = elements(document.root_element()).filter(|node| node.tag_name().name() == "joint");
    for ((ours, theirs), node) in draft.joints.iter().zip(&robot.joints).zip(joints) {
        if let Some(difference) = difference(ours, theirs, has_quaternion(node)) {
            let reason = format!(
                "two readers disagree about the {difference} of joint `{}`",
                ours.name.text
            );
            complaints.at(ours.name.at, reason, remedy);
        }
    }
}

fn has_quaternion(joint: Node) -> bool {
    elements(joint).any(|part| part.has_attribute("quat_xyzw"))
}

/// The document with nothing but links, joints and what a joint's kinematics
/// is made of; attributes verbatim.
fn skeleton(robot: Node) -> String {
    let mut xml = String::from("<robot>");
    for node in elements(robot) {
        match node.tag_name().name() {
            "link" => element(&mut xml, node, "/"),
            "joint" => {
                element(&mut xml, node, "");
                elements(node)
                    .filter(|part| vocabulary::KINEMATIC.contains(&part.tag_name().name()))
                    .for_each(|part| element(&mut xml, part, "/"));
                xml.push_str("</joint>");
            }
            _ => {}
        }
    }
    xml + "</robot>"
}

fn element(xml: &mut String, node: Node, close: &str) {
    let text = node.document().input_text();
    let name = node.tag_name().name();
    xml.push('<');
    xml.push_str(name);
    for attribute in node.attributes().filter(|a| witnessed(name, a)) {
        xml.push(' ');
        xml.push_str(&text[attribute.range()]);
    }
    if name == "limit" {
        // urdf-rs insists on one; it says nothing about geometry.
        xml.push_str(" velocity=\"0\"");
    }
    xml.push_str(close);
    xml.push('>');
}

/// Whether urdf-rs is shown an attribute: those that say something about
/// kinematics, except quaternions, which it converts to angles at a loss.
fn witnessed(element: &str, attribute: &Attribute) -> bool {
    let name = attribute.name();
    let known = vocabulary::attributes(element).contains(&name);
    attribute.namespace().is_none() && known && name != "quat_xyzw"
}

/// What urdf-rs reads differently.
fn difference(
    ours: &DraftJoint,
    theirs: &urdf_rs::Joint,
    quaternion: bool,
) -> Option<&'static str> {
    let same_limits = match ours.limits {
        Limits::Range { lower, upper, .. } => {
            lower == theirs.limit.lower && upper == theirs.limit.upper
        }
        Limits::Missing | Limits::Unlimited => true,
    };
    let rotation = orientation::from_rpy(*theirs.origin.rpy);
    let direction = orientation::unit(*theirs.axis.xyz).unwrap_or([1.0, 0.0, 0.0]);
    let checks = [
        ("name", ours.name.text == theirs.name),
        ("type", ours.kind == kind(&theirs.joint_type)),
        ("parent", ours.parent.text == theirs.parent.link),
        ("child", ours.child.text == theirs.child.link),
        ("position", ours.origin.translation == *theirs.origin.xyz),
        (
            "orientation",
            quaternion || ours.origin.rotation == rotation,
        ),
        ("axis", ours.axis == direction),
        ("limits", same_limits),
        ("mimic", same_mimic(ours, theirs)),
    ];
    checks.iter().find(|(_, same)| !same).map(|(what, _)| *what)
}

fn kind(theirs: &Theirs) -> JointType {
    match theirs {
        Theirs::Revolute | Theirs::Continuous => JointType::Revolute,
        Theirs::Prismatic => JointType::Prismatic,
        Theirs::Fixed => JointType::Fixed,
        Theirs::Floating => JointType::Floating,
        Theirs::Planar => JointType::Planar,
        Theirs::Spherical => JointType::Spherical,
    }
}

fn same_mimic(ours: &DraftJoint, theirs: &urdf_rs::Joint) -> bool {
    match (&ours.mimic, &theirs.mimic) {
        (Some(ours), Some(theirs)) => {
            ours.joint.text == theirs.joint
                && ours.multiplier == theirs.multiplier.unwrap_or(1.0)
                && ours.offset == theirs.offset.unwrap_or(0.0)
        }
        (None, theirs) => theirs.is_none() || ours.kind == JointType::Fixed,
        (Some(_), None) => false,
    }
}
