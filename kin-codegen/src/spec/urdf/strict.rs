//! The strict pass: every element and attribute that can carry kinematics.

use super::checks::{check_attributes, place, refuse_unknown, required};
use super::{elements, joint, origin, vocabulary};
use crate::spec::stem;
use crate::spec::tree::{Draft, Name};
use crate::spec::{Collector, Source, suggest};
use kin_runtime::Pose;
use roxmltree::{Document, Node};

/// Reads links and joints; `None` if this is no robot at all.
pub(super) fn read(
    document: &Document,
    source: &Source,
    diagnostics: &mut Collector,
) -> Option<Draft> {
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        refuse_root(robot, diagnostics);
        return None;
    }
    if refuse_srdf(robot, diagnostics) {
        return None;
    }
    let mut draft = Draft {
        name: robot_name(robot, source),
        links: Vec::new(),
        joints: Vec::new(),
        tip: None,
    };
    for child in elements(robot) {
        match child.tag_name().name() {
            "link" => draft.links.extend(link(child, diagnostics)),
            "joint" => draft.joints.extend(joint::read(child, diagnostics)),
            // Read when the tree stands.
            "loop_joint" => {}
            other => {
                // Joints that hang on a misspelt link are not wrong themselves.
                if refuse_misspelt_structure(child, other, diagnostics) == Some("link") {
                    draft.links.extend(name_if_any(child, diagnostics));
                }
            }
        }
    }
    Some(draft)
}

fn refuse_root(root: Node, diagnostics: &mut Collector) {
    let name = root.tag_name().name();
    let reason = match vocabulary::other_format(name) {
        Some(format) => format!("this is {format}: its root is <{name}>, and a URDF's is <robot>"),
        None => format!("the root element is <{name}>, and a URDF's is <robot>"),
    };
    let remedy = match suggest::nearest(name, ["robot"]) {
        Some(_) => "write <robot>",
        None => "convert the robot to URDF, or write it down in YAML",
    };
    diagnostics.at(place(root, diagnostics), reason, remedy);
}

/// A file without links that has what an SRDF has.
fn refuse_srdf(robot: Node, diagnostics: &mut Collector) -> bool {
    let name = |node: &Node| node.tag_name().name().to_owned();
    let foreign = elements(robot).find(|it| vocabulary::OF_SRDF.contains(&name(it).as_str()));
    let Some(foreign) = foreign.filter(|_| elements(robot).all(|it| name(&it) != "link")) else {
        return false;
    };
    let reason = format!(
        "this is SRDF, which tells MoveIt about a robot: it has a <{}> and no links",
        name(&foreign)
    );
    let at = place(foreign, diagnostics);
    diagnostics.at(at, reason, "name the URDF that it belongs to");
    true
}

fn name_if_any(node: Node, diagnostics: &Collector) -> Option<Name> {
    let name = node.attribute_node("name")?;
    let at = diagnostics.place(name.range_value().start);
    Some(Name {
        text: name.value().to_string(),
        at,
    })
}

fn robot_name(robot: Node, source: &Source) -> String {
    let name = robot.attribute("name").map(str::trim);
    let mut names = name.into_iter().chain([stem(&source.path), "robot"]);
    names
        .find(|name| !name.is_empty())
        .unwrap_or_default()
        .to_string()
}

/// Other elements beside links and joints belong to simulators and drivers,
/// unless they are links and joints with a slip of the pen. Returns which.
fn refuse_misspelt_structure(
    node: Node,
    name: &str,
    diagnostics: &mut Collector,
) -> Option<&'static str> {
    let at = place(node, diagnostics);
    if name == "loop" {
        let reason = format!("<{name}> closes a kinematic loop, and a URDF is read as a tree");
        diagnostics.at(
            at,
            reason,
            "close it with a <loop_joint>, or give its open chain",
        );
    }
    if vocabulary::KINEMATIC.contains(&name) {
        let reason =
            format!("<{name}> stands beside the joints: ROS passes over it, and so is done here");
        diagnostics.warn(
            at,
            reason,
            "move it into the <joint> that it is of, or remove it",
        );
        return None;
    }
    let [link, joint] = vocabulary::STRUCTURE;
    let meant = suggest::nearest(name, [link, joint, "loop_joint"])?;
    let reason = format!("unknown element <{name}>: skipping it might lose a {meant}");
    diagnostics.at(at, reason, format!("did you mean <{meant}>?"));
    Some(meant)
}

fn link(node: Node, diagnostics: &mut Collector) -> Option<Name> {
    check_attributes(node, diagnostics);
    for child in elements(node) {
        match child.tag_name().name() {
            "origin" => refuse_origin(child, diagnostics),
            _ => refuse_unknown(child, "link", &vocabulary::IN_LINK, diagnostics),
        }
    }
    required(node, "name", diagnostics)
}

/// A link's frame is that of its joint: an origin of its own could only move
/// it if someone read it.
fn refuse_origin(node: Node, diagnostics: &mut Collector) {
    let at = place(node, diagnostics);
    let reason = "an <origin> in a <link>: a link's frame is that of the joint above it";
    match origin::read(node, diagnostics) {
        Some(pose) if pose == Pose::IDENTITY => {
            diagnostics.warn(at, reason, "remove it: it is the identity, and not read");
        }
        _ => diagnostics.at(
            at,
            reason,
            "move it into the <joint>, or into the link's <visual>, <collision> or <inertial>",
        ),
    }
}
