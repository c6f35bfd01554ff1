//! Loop joints beside the tree of a URDF.
//!
//! A URDF is a tree; what closes its loops is written beside its joints, in the
//! dialect that Drake's readers had:
//!
//! ```xml
//! <loop_joint name="rocker_pin" type="revolute">
//!   <link1 link="rocker" xyz="0 2 0" rpy="0 0 0"/>
//!   <link2 link="coupler" xyz="1.5 0 0"/>
//!   <axis xyz="0 0 1"/>
//! </loop_joint>
//! ```
//!
//! The joint's frame lies in `link1`; `axis` is a direction in it, along x by
//! default. `link2` says where the same point lies in the other link: with all
//! joint values 0 the two have to coincide. `type` is `revolute`, `prismatic`,
//! `fixed`, or `spherical`, which is three revolutes about the frame's axes; the
//! first two may have a `<limit>`. Joints that some `<transmission>` names are
//! actuated, as elsewhere in ROS.
//!
//! Which chains they make, and from where to where, is decided behind this
//! room.

use super::checks::{check_attributes, place, refuse_text, required};
use super::parts::Parts;
use super::{elements, numbers, origin, vocabulary};
use crate::spec::tree::{Name, refuse_mimic};
use crate::spec::{
    ArmSpec, Collector, Joint, JointType, Limits, Location, LoopedTree, MechanismSpec, Rating,
    Topology, bounds, did_you_mean,
};
use crate::vector::norm;
use kin_runtime::Pose;
use roxmltree::{Document, Node};
use std::collections::HashSet;

/// Points of two links that are to be one, relative to the robot's extent: to five digits or so.
const TOGETHER: f64 = 1e-4;

/// Children of `<loop_joint>` that are read.
const PARTS: [&str; 4] = ["link1", "link2", "axis", "limit"];

/// Whether a document has loop joints.
pub(super) fn is_looped(document: &Document) -> bool {
    loop_joints(document).next().is_some()
}

fn loop_joints<'a, 'i>(document: &'a Document<'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    elements(document.root_element()).filter(|node| node.tag_name().name() == "loop_joint")
}

/// The joints that transmissions name; one that there is not is reported.
fn actuated(document: &Document, spec: &ArmSpec, diagnostics: &mut Collector) -> Vec<String> {
    let joints: Vec<&str> = spec.joints.iter().map(|it| it.name.as_str()).collect();
    let named = |node: &Node| node.tag_name().name() == "joint";
    elements(document.root_element())
        .filter(|node| node.tag_name().name() == "transmission")
        .flat_map(|node| node.children().filter(named))
        .filter_map(|joint| {
            let name = required(joint, "name", diagnostics)?;
            if !joints.contains(&name.text.as_str()) {
                let reason = format!(
                    "a <transmission> drives `{}`, and there is no such joint",
                    name.text
                );
                diagnostics.at(name.at, reason, did_you_mean(&name.text, &joints));
            }
            Some(name.text)
        })
        .collect()
}

/// Reads the loop joints of a document whose tree has been read.
pub(super) fn read(
    document: &Document,
    mut links: ArmSpec,
    diagnostics: &mut Collector,
) -> Option<MechanismSpec> {
    let at = loop_joints(document)
        .next()
        .map(|node| place(node, diagnostics))?;
    let count = loop_joints(document).count();
    if count > bounds::CHAINS {
        let reason = format!(
            "the robot has {count} loop joints, and at most {} are read",
            bounds::CHAINS
        );
        diagnostics.at(at, reason, "remove some of them");
        return None;
    }
    let homes = homes(&links);
    let extent = homes
        .iter()
        .map(|pose| norm(pose.translation))
        .fold(0.0, f64::max);
    let loops: Vec<Option<Vec<Joint>>> = loop_joints(document)
        .map(|node| loop_joint(node, &links, &homes, extent, diagnostics))
        .collect();
    let loops: Option<Vec<Vec<Joint>>> = loops.into_iter().collect();
    let tree_joints = links.joints.len();
    for (i, joints) in loops?.into_iter().enumerate() {
        add(&mut links, joints, i);
    }
    refuse_repeated(&links, diagnostics);
    refuse_mimics(&links, diagnostics);
    let actuated = actuated(document, &links, diagnostics);
    Some(MechanismSpec {
        name: links.name.clone(),
        source: links.source.clone(),
        warnings: Vec::new(),
        at,
        topology: Topology::Looped(LoopedTree {
            links,
            tree_joints,
            actuated,
        }),
    })
}

/// Where the tree puts its links with all joint values 0.
fn homes(spec: &ArmSpec) -> Vec<Pose> {
    let (above, below) = (spec.above(), spec.below());
    let mut homes = vec![Pose::IDENTITY; spec.links.len()];
    let mut reached: Vec<usize> = (0..above.len()).filter(|&it| above[it].is_none()).collect();
    while let Some(link) = reached.pop() {
        for joint in below[link].iter().map(|&j| &spec.joints[j]) {
            homes[joint.child] = homes[link] * joint.origin * joint.mount;
            reached.push(joint.child);
        }
    }
    homes
}

/// The joints in a row that a loop joint stands for; those in between connect
/// links that are still to be added, numbered from the end.
fn loop_joint(
    node: Node,
    spec: &ArmSpec,
    homes: &[Pose],
    extent: f64,
    diagnostics: &mut Collector,
) -> Option<Vec<Joint>> {
    check_attributes(node, diagnostics);
    refuse_text(node, diagnostics);
    let name = required(node, "name", diagnostics);
    let word = required(node, "type", diagnostics);
    let kind = word.as_ref().and_then(|word| kind(word, diagnostics));
    let continuous = word.is_some_and(|word| word.text == "continuous");
    let parts = Parts::of(node, &PARTS, &vocabulary::IN_JOINT, diagnostics);
    let at = place(node, diagnostics);
    let child = |role: &str, diagnostics: &mut Collector| {
        let found = parts.find(role);
        if found.is_none() {
            let reason = format!("the loop joint has no <{role}>, so it closes nothing");
            diagnostics.at(
                at,
                reason,
                format!("add <{role} link=\"...\" xyz=\"0 0 0\"/>"),
            );
        }
        let inside = found.and_then(|it| elements(it).next());
        if let Some(inside) = inside {
            let name = inside.tag_name().name();
            let reason = format!("<{name}> in a <{role}>, which has none");
            let remedy =
                format!("write where it lies as attributes: <{role} link=\"...\" xyz=\"0 0 0\"/>");
            diagnostics.at(place(inside, diagnostics), reason, remedy);
            return None;
        }
        found
    };
    let (one, two) = (child("link1", diagnostics), child("link2", diagnostics));
    let link = |node: Node, diagnostics: &mut Collector| {
        let name = required(node, "link", diagnostics)?;
        let names: Vec<&str> = spec.links.iter().map(|link| link.name.as_str()).collect();
        let found = names.iter().position(|known| *known == name.text);
        if found.is_none() {
            let reason = format!("there is no link `{}`", name.text);
            diagnostics.at(name.at, reason, did_you_mean(&name.text, &names));
        }
        found
    };
    let (one, two) = (one?, two?);
    let (parent, other) = (link(one, diagnostics), link(two, diagnostics));
    let frame = origin::read(one, diagnostics);
    let point = match two.attribute_node("xyz") {
        Some(xyz) => numbers::read::<3>(&xyz, diagnostics),
        None => Some([0.0; 3]),
    };
    let motion = motion(&parts, kind, continuous, at, diagnostics);
    let (name, kind, parent, other, frame, point, motion) =
        (name?, kind?, parent?, other?, frame?, point?, motion?);
    if parent == other {
        let reason = format!(
            "the loop joint `{}` joins the link `{}` to itself",
            name.text, spec.links[parent].name
        );
        diagnostics.at(
            at,
            reason,
            "name two links that the tree does not join already",
        );
        return None;
    }
    let there = homes[parent] * frame;
    let apart = Pose::from_translation(homes[other].transform_point(point));
    let gap = there.translation_distance(&apart);
    if gap > TOGETHER * extent.max(gap * 1e-3) {
        let reason = format!(
            "with all joint values 0 the ends of the loop joint `{}` are {gap:.6} m apart: in \
             `{}` and in `{}` it lies at different places",
            name.text, spec.links[parent].name, spec.links[other].name
        );
        let remedy = "correct the points, or choose the zeros of the joints so that the loop is \
                      closed there";
        diagnostics.at(at, reason, remedy);
        return None;
    }
    let home = there.inverse() * homes[other];
    Some(joints_of(
        &name,
        kind,
        (parent, other),
        [frame, home],
        motion,
    ))
}

fn kind(word: &Name, diagnostics: &mut Collector) -> Option<JointType> {
    let kind = match word.text.as_str() {
        "revolute" | "continuous" => JointType::Revolute,
        "prismatic" => JointType::Prismatic,
        "fixed" => JointType::Fixed,
        "spherical" | "ball" => JointType::Spherical,
        other => {
            let known = ["revolute", "prismatic", "spherical", "fixed"];
            let reason = format!("`{other}` is no type of a loop joint");
            diagnostics.at(word.at, reason, did_you_mean(other, &known));
            return None;
        }
    };
    Some(kind)
}

/// What a loop joint turns about or slides along, and how far; without limits as far as it goes.
struct Motion {
    axis: [f64; 3],
    limits: Limits,
    rating: Rating,
}

fn motion(
    parts: &Parts,
    kind: Option<JointType>,
    continuous: bool,
    at: Location,
    diagnostics: &mut Collector,
) -> Option<Motion> {
    let axis = parts.axis(kind, diagnostics);
    let has_limit = parts.find("limit").is_some();
    let (limits, rating) = parts.limits(kind, continuous || !has_limit, diagnostics)?;
    if has_limit && matches!(kind, Some(JointType::Spherical | JointType::Fixed)) {
        let reason = "limits of a loop joint that is neither revolute nor prismatic are not read";
        diagnostics.at(at, reason, "remove <limit>");
    }
    Some(Motion {
        axis: axis?,
        limits,
        rating,
    })
}

/// With the joint's frame in its parent, and the child in that frame at home.
fn joints_of(
    name: &Name,
    kind: JointType,
    (parent, child): (usize, usize),
    [frame, home]: [Pose; 2],
    motion: Motion,
) -> Vec<Joint> {
    let at = name.at;
    let joint = |name: String, kind: JointType, axis: [f64; 3]| Joint {
        name,
        kind,
        parent,
        child,
        origin: Pose::IDENTITY,
        axis,
        mount: Pose::IDENTITY,
        limits: motion.limits,
        mimic: None,
        rating: motion.rating,
        faults: Vec::new(),
        at,
    };
    const AXES: [(&str, [f64; 3]); 3] = [
        ("z", [0.0, 0.0, 1.0]),
        ("y", [0.0, 1.0, 0.0]),
        ("x", [1.0, 0.0, 0.0]),
    ];
    let mut joints = match kind {
        JointType::Spherical => AXES
            .map(|(letter, axis)| {
                joint(format!("{}_{letter}", name.text), JointType::Revolute, axis)
            })
            .to_vec(),
        _ => vec![joint(name.text.clone(), kind, motion.axis)],
    };
    let last = joints.len() - 1;
    joints[0].origin = frame;
    joints[last].mount = home;
    joints
}

/// Adds the joints of a loop joint, with links between them.
fn add(spec: &mut ArmSpec, joints: Vec<Joint>, number: usize) {
    let last = joints.len() - 1;
    let mut before = joints[0].parent;
    for (i, mut joint) in joints.into_iter().enumerate() {
        joint.parent = before;
        if i < last {
            before = spec.links.len();
            joint.child = before;
            spec.links.push(crate::spec::Link {
                name: format!("loop{number}_{i}"),
                at: joint.at,
            });
        }
        spec.joints.push(joint);
    }
}

fn refuse_repeated(spec: &ArmSpec, diagnostics: &mut Collector) {
    let mut names = HashSet::new();
    for joint in &spec.joints {
        if !names.insert(&joint.name) {
            let reason = format!("a second joint is named `{}`", joint.name);
            diagnostics.at(joint.at, reason, "give every joint a name of its own");
        }
    }
}

fn refuse_mimics(spec: &ArmSpec, diagnostics: &mut Collector) {
    for joint in &spec.joints {
        if let Some(mimic) = joint.mimic {
            refuse_mimic(&joint.name, mimic.at, diagnostics);
        }
    }
}
