//! The second reading, by urdf-rs, and the proof that both are the same.

use super::vocabulary;
use crate::spec::tree::{Draft, DraftJoint};
use crate::spec::{Complaints, JointType, Limits, orientation};
use roxmltree::{Document, Node};
use std::fmt::Write;
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
    for ((ours, theirs), node) in draft.joints.iter().zip(&robot.joints).zip(joints(document)) {
        if let Some(difference) = difference(ours, theirs, has_quaternion(node)) {
            let reason = format!(
                "two readers disagree about the {difference} of joint `{}`",
                ours.name.text
            );
            complaints.at(ours.name.at, reason, remedy);
        }
    }
}

fn joints<'a, 'i>(document: &'a Document<'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    document
        .root_element()
        .children()
        .filter(|node| node.has_tag_name("joint"))
}

fn has_quaternion(joint: Node) -> bool {
    joint
        .children()
        .any(|part| part.has_tag_name("origin") && part.has_attribute("quat_xyzw"))
}

/// The document with nothing but links, joints and what a joint's kinematics
/// is made of; attributes verbatim.
fn skeleton(robot: Node) -> String {
    let mut xml = String::from("<robot>");
    let plain = |node: &Node| node.is_element() && node.tag_name().namespace().is_none();
    for node in robot.children().filter(plain) {
        match node.tag_name().name() {
            "link" => element(&mut xml, node, "/"),
            "joint" => {
                element(&mut xml, node, "");
                let read = |part: &Node| {
                    plain(part) && vocabulary::KINEMATIC.contains(&part.tag_name().name())
                };
                node.children()
                    .filter(read)
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
    let known = vocabulary::attributes(name);
    xml.push('<');
    xml.push_str(name);
    // urdf-rs converts quaternions to angles and back, at a loss.
    for attribute in node
        .attributes()
        .filter(|a| known.contains(&a.name()) && a.name() != "quat_xyzw")
    {
        xml.push(' ');
        xml.push_str(&text[attribute.range()]);
    }
    if name == "limit" && node.attribute("velocity").is_none() {
        // urdf-rs requires it; it says nothing about geometry.
        let _ = write!(xml, " velocity=\"0\"");
    }
    xml.push_str(close);
    xml.push('>');
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
