//! The strict pass: every element and attribute that can carry kinematics.

use super::{numbers, vocabulary};
use crate::spec::orientation::{self, FULL_TURN, Rotation};
use crate::spec::tree::{Draft, DraftJoint, DraftMimic, Name};
use crate::spec::{Complaints, JointType, Limits, Location, Source, did_you_mean, suggest};
use kin_runtime::Pose;
use roxmltree::{Document, Node};
use std::path::Path;

/// Reads links and joints; `None` if this is no robot at all.
pub(super) fn read(
    document: &Document,
    source: &Source,
    complaints: &mut Complaints,
) -> Option<Draft> {
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        let reason = format!(
            "the root element is <{}>, and a URDF's is <robot>",
            robot.tag_name().name()
        );
        complaints.at(
            place(robot, complaints),
            reason,
            "convert the robot to URDF",
        );
        return None;
    }
    let mut draft = Draft {
        name: robot_name(robot, source),
        links: Vec::new(),
        joints: Vec::new(),
    };
    for child in plain_elements(robot) {
        match child.tag_name().name() {
            "link" => draft.links.extend(link(child, complaints)),
            "joint" => draft.joints.extend(joint(child, complaints)),
            other => refuse_misspelt_structure(child, other, complaints),
        }
    }
    Some(draft)
}

fn robot_name(robot: Node, source: &Source) -> String {
    let stem = || Path::new(&source.path).file_stem().and_then(|s| s.to_str());
    let name = robot
        .attribute("name")
        .map(str::trim)
        .filter(|name| !name.is_empty());
    name.or_else(stem).unwrap_or("robot").to_string()
}

/// Children outside any namespace: declared prefixes are extensions.
fn plain_elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children()
        .filter(|child| child.is_element() && child.tag_name().namespace().is_none())
}

fn place(node: Node, complaints: &Complaints) -> Location {
    complaints.place(node.range().start)
}

/// Other elements beside links and joints belong to simulators and drivers,
/// unless they are links and joints with a slip of the pen.
fn refuse_misspelt_structure(node: Node, name: &str, complaints: &mut Complaints) {
    if vocabulary::LOOPS.contains(&name) {
        let reason = format!("<{name}> closes a kinematic loop, and a URDF is read as a tree");
        complaints.at(
            place(node, complaints),
            reason,
            "remove the loop, or give its open chain",
        );
    } else if !vocabulary::NOT_STRUCTURE.contains(&name) {
        let Some(meant) = suggest::nearest(name, vocabulary::STRUCTURE) else {
            return;
        };
        let reason = format!("unknown element <{name}>: skipping it might lose a {meant}");
        complaints.at(
            place(node, complaints),
            reason,
            format!("did you mean <{meant}>?"),
        );
    }
}

fn link(node: Node, complaints: &mut Complaints) -> Option<Name> {
    check_attributes(node, complaints);
    for child in plain_elements(node) {
        refuse_unknown(child, "link", &vocabulary::IN_LINK, complaints);
    }
    required(node, "name", complaints)
}

/// Complains about a child that is not in the vocabulary of its parent.
fn refuse_unknown(child: Node, parent: &str, known: &[&str], complaints: &mut Complaints) {
    let name = child.tag_name().name();
    if known.contains(&name) {
        return;
    }
    let remedy = if vocabulary::STRUCTURE.contains(&name) {
        format!("move it out, next to the <{parent}>")
    } else {
        match suggest::nearest(name, known.iter().copied()) {
            Some(meant) => format!("did you mean <{meant}>?"),
            None => "remove it, or give it an XML namespace of its own if another program needs it"
                .into(),
        }
    };
    let reason = format!("unknown element <{name}> in a <{parent}>");
    complaints.at(place(child, complaints), reason, remedy);
}

fn joint(node: Node, complaints: &mut Complaints) -> Option<DraftJoint> {
    check_attributes(node, complaints);
    refuse_text(node, complaints);
    let name = required(node, "name", complaints);
    let word = required(node, "type", complaints);
    let parts = Parts::of(node, complaints);
    let parent = parts.link("parent", node, complaints);
    let child = parts.link("child", node, complaints);
    let kind = word.as_ref().and_then(|word| kind(word, complaints));
    // Every part is read before the first missing one ends it.
    let origin = parts.origin(complaints);
    let axis = parts.axis(kind, complaints);
    let limits = parts.limits(
        kind,
        word.as_ref().is_some_and(|word| word.text == "continuous"),
        complaints,
    );
    let mimic = parts.mimic(kind, complaints);
    Some(DraftJoint {
        name: name?,
        kind: kind?,
        parent: parent?,
        child: child?,
        origin: origin?,
        axis: axis?,
        mount: Pose::IDENTITY,
        limits: limits?,
        mimic: mimic?,
    })
}

fn kind(word: &Name, complaints: &mut Complaints) -> Option<JointType> {
    let kind = vocabulary::joint_type(&word.text);
    if kind.is_none() {
        let reason = format!("`{}` is no joint type", word.text);
        complaints.at(
            word.at,
            reason,
            did_you_mean(&word.text, &vocabulary::JOINT_TYPES),
        );
    }
    kind
}

/// The children of a joint that carry kinematics, each at most once.
struct Parts<'a, 'i>(Vec<Node<'a, 'i>>);

impl<'a, 'i> Parts<'a, 'i> {
    fn of(joint: Node<'a, 'i>, complaints: &mut Complaints) -> Self {
        let known = [&vocabulary::KINEMATIC[..], &vocabulary::IN_JOINT].concat();
        let mut parts = Parts(Vec::new());
        for child in plain_elements(joint) {
            let name = child.tag_name().name();
            refuse_unknown(child, "joint", &known, complaints);
            if !vocabulary::KINEMATIC.contains(&name) {
                continue;
            }
            if parts.find(name).is_some() {
                let reason = format!("a second <{name}> in the same joint: only one can hold");
                complaints.at(place(child, complaints), reason, "remove one of them");
                continue;
            }
            check_attributes(child, complaints);
            refuse_text(child, complaints);
            parts.0.push(child);
        }
        parts
    }

    fn find(&self, name: &str) -> Option<Node<'a, 'i>> {
        self.0
            .iter()
            .copied()
            .find(|node| node.tag_name().name() == name)
    }

    fn link(&self, role: &str, joint: Node, complaints: &mut Complaints) -> Option<Name> {
        match self.find(role) {
            Some(node) => required(node, "link", complaints),
            None => {
                let reason = format!("the joint has no <{role}>, so it connects nothing");
                complaints.at(
                    place(joint, complaints),
                    reason,
                    format!("add <{role} link=\"...\"/>"),
                );
                None
            }
        }
    }

    fn origin(&self, complaints: &mut Complaints) -> Option<Pose> {
        let Some(node) = self.find("origin") else {
            return Some(Pose::IDENTITY);
        };
        let translation = match node.attribute_node("xyz") {
            Some(xyz) => numbers::read(&xyz, complaints)?,
            None => [0.0; 3],
        };
        Some(Pose {
            rotation: rotation(node, complaints)?,
            translation,
        })
    }

    /// Unit length; along x where the joint does not say, as URDF has it.
    fn axis(&self, kind: Option<JointType>, complaints: &mut Complaints) -> Option<[f64; 3]> {
        const X: [f64; 3] = [1.0, 0.0, 0.0];
        let Some(node) = self.find("axis") else {
            return Some(X);
        };
        let xyz = attribute(node, "xyz", complaints)?;
        let axis = numbers::read(&xyz, complaints)?;
        let moves_along_it = matches!(
            kind,
            Some(JointType::Revolute | JointType::Prismatic | JointType::Planar)
        );
        let direction = orientation::unit(axis);
        if direction.is_none() && moves_along_it {
            let reason = format!("the axis {} is no direction", xyz.value().trim());
            let at = complaints.place(xyz.range_value().start);
            complaints.at(
                at,
                reason,
                "write the direction of the joint's axis, for example xyz=\"0 0 1\"",
            );
            return None;
        }
        Some(direction.unwrap_or(X))
    }

    fn limits(
        &self,
        kind: Option<JointType>,
        continuous: bool,
        complaints: &mut Complaints,
    ) -> Option<Limits> {
        let Some(node) = self.find("limit") else {
            let needs_them =
                matches!(kind, Some(JointType::Revolute | JointType::Prismatic)) && !continuous;
            return Some(if needs_them {
                Limits::Missing
            } else {
                Limits::Unlimited
            });
        };
        let bound = |name, complaints: &mut Complaints| match node.attribute_node(name) {
            Some(attribute) => numbers::read::<1>(&attribute, complaints).map(|[x]| x),
            None => Some(0.0),
        };
        let (lower, upper) = (bound("lower", complaints), bound("upper", complaints));
        let (lower, upper) = (lower?, upper?);
        let at = place(node, complaints);
        Some(if continuous {
            Limits::Unlimited
        } else {
            Limits::Range { lower, upper, at }
        })
    }

    /// What a joint that cannot move mimics has no effect.
    fn mimic(
        &self,
        kind: Option<JointType>,
        complaints: &mut Complaints,
    ) -> Option<Option<DraftMimic>> {
        let Some(node) = self
            .find("mimic")
            .filter(|_| kind != Some(JointType::Fixed))
        else {
            return Some(None);
        };
        let number = |name, default, complaints: &mut Complaints| match node.attribute_node(name) {
            Some(attribute) => numbers::read::<1>(&attribute, complaints).map(|[x]| x),
            None => Some(default),
        };
        let joint = required(node, "joint", complaints);
        let multiplier = number("multiplier", 1.0, complaints);
        let offset = number("offset", 0.0, complaints);
        Some(Some(DraftMimic {
            joint: joint?,
            multiplier: multiplier?,
            offset: offset?,
        }))
    }
}

fn rotation(origin: Node, complaints: &mut Complaints) -> Option<Rotation> {
    match (
        origin.attribute_node("rpy"),
        origin.attribute_node("quat_xyzw"),
    ) {
        (None, None) => Some(Pose::IDENTITY.rotation),
        (Some(_), Some(quaternion)) => {
            let at = complaints.place(quaternion.range().start);
            complaints.at(
                at,
                "the origin has both rpy and quat_xyzw: only one can hold",
                "remove one of them",
            );
            None
        }
        (Some(rpy), None) => {
            let angles: [f64; 3] = numbers::read(&rpy, complaints)?;
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
        (None, Some(attribute)) => {
            let quaternion: [f64; 4] = numbers::read(&attribute, complaints)?;
            if let Err(length) = orientation::check_quaternion(quaternion) {
                let at = complaints.place(attribute.range_value().start);
                let reason =
                    format!("the quaternion has the length {length}, and a rotation's has 1");
                complaints.at(at, reason, "normalise it; the order is x y z w");
                return None;
            }
            Some(orientation::from_quaternion(quaternion))
        }
    }
}

/// A name in an attribute that must be there.
fn required(node: Node, name: &str, complaints: &mut Complaints) -> Option<Name> {
    let attribute = attribute(node, name, complaints)?;
    let at = complaints.place(attribute.range_value().start);
    let text = attribute.value();
    if text.trim().is_empty() {
        let reason = format!("{name}=\"{text}\" is empty");
        complaints.at(
            at,
            reason,
            format!("give the <{}> a {name}", node.tag_name().name()),
        );
        return None;
    }
    Some(Name {
        text: text.to_string(),
        at,
    })
}

fn attribute<'a, 'i>(
    node: Node<'a, 'i>,
    name: &str,
    complaints: &mut Complaints,
) -> Option<roxmltree::Attribute<'a, 'i>> {
    let found = node.attribute_node(name);
    if found.is_none() {
        let element = node.tag_name().name();
        let reason = format!("<{element}> has no `{name}`");
        complaints.at(
            place(node, complaints),
            reason,
            format!("add {name}=\"...\""),
        );
    }
    found
}

/// Complains about attributes that the element does not have, or that look
/// like misspellings of those it has.
fn check_attributes(node: Node, complaints: &mut Complaints) {
    let element = node.tag_name().name();
    let known = vocabulary::attributes(element);
    for attribute in node
        .attributes()
        .filter(|a| a.namespace().is_none() && !known.contains(&a.name()))
    {
        let meant = suggest::nearest(attribute.name(), known.iter().copied());
        if meant.is_none() && vocabulary::tolerates_attributes(element) {
            continue;
        }
        let at = complaints.place(attribute.range().start);
        let reason = format!("unknown attribute `{}` in <{element}>", attribute.name());
        complaints.at(at, reason, did_you_mean(attribute.name(), known));
    }
}

/// Joints consist of elements; text there is something lost.
fn refuse_text(node: Node, complaints: &mut Complaints) {
    let text = node
        .children()
        .find(|c| c.is_text() && c.text().is_some_and(|t| !t.trim().is_empty()));
    if let Some(text) = text {
        let content = text.text().unwrap_or("");
        let blank = content.len() - content.trim_start().len();
        let at = complaints.place(text.range().start + blank);
        let reason = format!("text in a <{}> has no meaning", node.tag_name().name());
        complaints.at(at, reason, "write it as an attribute, or in a comment");
    }
}
