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
//! `fixed`, or `spherical`, which is three revolutes about the frame's axes.
//! Joints that some `<transmission>` names are actuated, as elsewhere in ROS.
//!
//! Tree and loop joints together have to be chains from the base to one
//! platform, which the options `base` and `tip` name; by default they are the
//! root, and the only other link at which more than two chains meet, or the one
//! leaf of the tree that is part of a loop. What hangs outside the loops does
//! not count.

use super::checks::{attribute, check_attributes, place, required};
use super::{elements, numbers, origin};
use crate::spec::tree::Name;
use crate::spec::{
    ChainSpec, Complaints, Diagnostics, Joint, JointType, Limits, Location, MechanismSpec, Source,
    Spec, did_you_mean, list_names, orientation,
};
use kin_runtime::Pose;
use roxmltree::{Document, Node};

/// Points of two links that are to be one, relative to the robot's extent.
const TOGETHER: f64 = 1e-6;

/// Whether a text has loop joints.
pub(in crate::spec) fn is_meant(text: &str) -> bool {
    text.contains("<loop_joint")
}

/// Reads a mechanism.
pub(in crate::spec) fn parse(
    source: &Source,
    base: Option<&str>,
    platform: Option<&str>,
) -> Result<MechanismSpec, Diagnostics> {
    let (blank, found) = match Document::parse(&source.text) {
        Ok(document) => (without_loops(source, &document), Found::of(&document)),
        // The reader of trees explains it.
        Err(_) => (source.clone(), Found::default()),
    };
    let mut spec = Spec::parse(&blank)?;
    spec.source = source.clone();
    let mut complaints = Complaints::new(source);
    let mechanism = read(spec, &found, base, platform, &mut complaints);
    complaints.unless_any(mechanism)
}

/// The text with blanks where the loop joints are: everything else keeps its
/// place.
fn without_loops(source: &Source, document: &Document) -> Source {
    let mut text = source.text.clone().into_bytes();
    for node in loop_joints(document) {
        for byte in &mut text[node.range()] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
    }
    Source {
        path: source.path.clone(),
        text: String::from_utf8_lossy(&text).into_owned(),
    }
}

fn loop_joints<'a, 'i>(document: &'a Document<'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    elements(document.root_element()).filter(|node| node.tag_name().name() == "loop_joint")
}

/// What else a URDF says.
#[derive(Default)]
struct Found {
    /// The joints that transmissions name.
    actuated: Vec<String>,
}

impl Found {
    fn of(document: &Document) -> Self {
        let named = |node: Node| node.tag_name().name() == "joint";
        let transmissions = elements(document.root_element())
            .filter(|node| node.tag_name().name() == "transmission");
        let joints = transmissions.flat_map(|node| node.children().filter(|n| named(*n)));
        Found {
            actuated: joints
                .filter_map(|joint| joint.attribute("name").map(str::to_owned))
                .collect(),
        }
    }
}

fn read(
    spec: Spec,
    found: &Found,
    base: Option<&str>,
    platform: Option<&str>,
    complaints: &mut Complaints,
) -> Option<MechanismSpec> {
    let source = spec.source.clone();
    let document = Document::parse(&source.text).ok()?;
    let at = loop_joints(&document)
        .next()
        .map(|node| place(node, complaints))?;
    let mut spec = spec;
    let hangs = |link: usize| spec.joints.iter().any(|joint| joint.child == link);
    let root = (0..spec.links.len()).find(|link| !hangs(*link))?;
    let homes = homes(&spec);
    let extent = homes
        .iter()
        .map(|pose| size(pose.translation))
        .fold(0.0, f64::max);
    let mut loops = Vec::new();
    for node in loop_joints(&document) {
        loops.push(loop_joint(node, &spec, &homes, extent, complaints));
    }
    let loops: Option<Vec<Vec<Joint>>> = loops.into_iter().collect();
    for (i, joints) in loops?.into_iter().enumerate() {
        add(&mut spec, joints, i);
    }
    refuse_repeated(&spec, complaints);
    refuse_mimics(&spec, complaints);
    if !complaints.is_empty() {
        return None;
    }
    let graph = Graph::of(&spec);
    let base = match base {
        Some(name) => find(&spec, "base", name, complaints)?,
        None => root,
    };
    let platform = match platform {
        Some(name) => find(&spec, "tip", name, complaints)?,
        None => graph.platform(base, at, complaints)?,
    };
    let paths = graph.paths(base, platform, at, complaints)?;
    let chains = paths
        .into_iter()
        .map(|path| chain(&spec, &path, found))
        .collect();
    Some(MechanismSpec {
        name: spec.name.clone(),
        base: spec.links[base].name.clone(),
        platform: spec.links[platform].name.clone(),
        chains,
        source,
        at,
    })
}

fn size(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Where the tree puts its links with all joint values 0.
fn homes(spec: &Spec) -> Vec<Pose> {
    let mut homes: Vec<Option<Pose>> = vec![None; spec.links.len()];
    for link in 0..spec.links.len() {
        if spec.joints.iter().all(|joint| joint.child != link) {
            homes[link] = Some(Pose::IDENTITY);
        }
    }
    // A tree is as deep as it has joints at most.
    for _ in &spec.joints {
        for joint in &spec.joints {
            if let Some(parent) = homes[joint.parent] {
                homes[joint.child] = Some(parent * joint.origin * joint.mount);
            }
        }
    }
    homes.into_iter().map(Option::unwrap_or_default).collect()
}

/// The joints in a row that a loop joint stands for; those in between connect
/// links that are still to be added, numbered from the end.
fn loop_joint(
    node: Node,
    spec: &Spec,
    homes: &[Pose],
    extent: f64,
    complaints: &mut Complaints,
) -> Option<Vec<Joint>> {
    check_attributes(node, complaints);
    let name = required(node, "name", complaints);
    let word = required(node, "type", complaints);
    let at = place(node, complaints);
    let child = |role: &str, complaints: &mut Complaints| {
        let found = elements(node).find(|child| child.tag_name().name() == role);
        if found.is_none() {
            let reason = format!("the loop joint has no <{role}>, so it closes nothing");
            complaints.at(
                at,
                reason,
                format!("add <{role} link=\"...\" xyz=\"0 0 0\"/>"),
            );
        }
        found.inspect(|child| check_attributes(*child, complaints))
    };
    let (one, two) = (child("link1", complaints), child("link2", complaints));
    let link = |node: Node, complaints: &mut Complaints| {
        let name = required(node, "link", complaints)?;
        let names: Vec<&str> = spec.links.iter().map(|link| link.name.as_str()).collect();
        let found = names.iter().position(|known| *known == name.text);
        if found.is_none() {
            let reason = format!("there is no link `{}`", name.text);
            complaints.at(name.at, reason, did_you_mean(&name.text, &names));
        }
        found
    };
    let (one, two) = (one?, two?);
    let (parent, other) = (link(one, complaints), link(two, complaints));
    let frame = origin::read(one, complaints);
    let point = match two.attribute_node("xyz") {
        Some(xyz) => numbers::read::<3>(&xyz, complaints),
        None => Some([0.0; 3]),
    };
    let axis = axis(node, complaints);
    let (name, word, parent, other, frame, point, axis) =
        (name?, word?, parent?, other?, frame?, point?, axis?);
    if parent == other {
        let reason = format!(
            "the loop joint `{}` joins the link `{}` to itself",
            name.text, spec.links[parent].name
        );
        complaints.at(
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
        complaints.at(at, reason, remedy);
        return None;
    }
    let home = there.inverse() * homes[other];
    joints_of(&name, &word, (parent, other), frame, axis, home, complaints)
}

fn axis(node: Node, complaints: &mut Complaints) -> Option<[f64; 3]> {
    let Some(element) = elements(node).find(|child| child.tag_name().name() == "axis") else {
        return Some([1.0, 0.0, 0.0]);
    };
    let xyz = attribute(element, "xyz", complaints)?;
    let axis = orientation::unit(numbers::read(&xyz, complaints)?);
    if axis.is_none() {
        let at = complaints.place(xyz.range_value().start);
        let reason = format!("the axis {} is no direction", xyz.value().trim());
        complaints.at(at, reason, "write a direction, for example xyz=\"0 0 1\"");
    }
    axis
}

fn joints_of(
    name: &Name,
    word: &Name,
    (parent, child): (usize, usize),
    frame: Pose,
    axis: [f64; 3],
    home: Pose,
    complaints: &mut Complaints,
) -> Option<Vec<Joint>> {
    let at = name.at;
    let joint = |name: String, kind: JointType, axis: [f64; 3]| Joint {
        name,
        kind,
        parent,
        child,
        origin: Pose::IDENTITY,
        axis,
        mount: Pose::IDENTITY,
        limits: Limits::Unlimited,
        mimic: None,
        at,
    };
    const AXES: [(&str, [f64; 3]); 3] = [
        ("z", [0.0, 0.0, 1.0]),
        ("y", [0.0, 1.0, 0.0]),
        ("x", [1.0, 0.0, 0.0]),
    ];
    let mut joints = match word.text.as_str() {
        "revolute" | "continuous" => vec![joint(name.text.clone(), JointType::Revolute, axis)],
        "prismatic" => vec![joint(name.text.clone(), JointType::Prismatic, axis)],
        "fixed" => vec![joint(name.text.clone(), JointType::Fixed, axis)],
        "spherical" | "ball" => AXES
            .map(|(letter, axis)| {
                joint(format!("{}_{letter}", name.text), JointType::Revolute, axis)
            })
            .to_vec(),
        other => {
            let known = ["revolute", "prismatic", "spherical", "fixed"];
            let reason = format!("`{other}` is no type of a loop joint");
            complaints.at(word.at, reason, did_you_mean(other, &known));
            return None;
        }
    };
    let last = joints.len() - 1;
    joints[0].origin = frame;
    joints[last].mount = home;
    Some(joints)
}

/// Adds the joints of a loop joint, with links between them.
fn add(spec: &mut Spec, joints: Vec<Joint>, number: usize) {
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

fn refuse_repeated(spec: &Spec, complaints: &mut Complaints) {
    for (i, joint) in spec.joints.iter().enumerate() {
        if spec.joints[..i]
            .iter()
            .any(|other| other.name == joint.name)
        {
            let reason = format!("a second joint is named `{}`", joint.name);
            complaints.at(joint.at, reason, "give every joint a name of its own");
        }
    }
}

fn refuse_mimics(spec: &Spec, complaints: &mut Complaints) {
    for joint in &spec.joints {
        if let Some(mimic) = joint.mimic {
            let reason = format!(
                "joint `{}` mimics another, and in a mechanism the loops alone couple joints",
                joint.name
            );
            complaints.at(mimic.at, reason, "remove <mimic>");
        }
    }
}

fn find(spec: &Spec, role: &str, name: &str, complaints: &mut Complaints) -> Option<usize> {
    let names: Vec<&str> = spec.links.iter().map(|link| link.name.as_str()).collect();
    let found = names.iter().position(|known| *known == name);
    if found.is_none() {
        let reason = format!("the {role} `{name}` is no link of this robot");
        complaints.whole(reason, did_you_mean(name, &names));
    }
    found
}

/// Links and the joints at each.
struct Graph<'s> {
    spec: &'s Spec,
    /// By link; without what hangs outside the loops.
    at: Vec<Vec<usize>>,
}

/// A joint on a path, and whether it is passed from parent to child.
type Passed = (usize, bool);

impl<'s> Graph<'s> {
    fn of(spec: &'s Spec) -> Self {
        let at = (0..spec.links.len())
            .map(|link| {
                let here =
                    |j: &usize| spec.joints[*j].parent == link || spec.joints[*j].child == link;
                (0..spec.joints.len()).filter(here).collect()
            })
            .collect();
        Graph { spec, at }
    }

    /// Without leaves but those to keep.
    fn pruned(&self, keep: &[usize]) -> Vec<Vec<usize>> {
        let mut at = self.at.clone();
        while let Some(leaf) = (0..at.len()).find(|l| at[*l].len() == 1 && !keep.contains(l)) {
            let joint = at[leaf][0];
            at.iter_mut()
                .for_each(|joints| joints.retain(|j| *j != joint));
        }
        at
    }

    /// The only link but the base at which three chains meet; or where there is
    /// none, and the base has but two, the tree's only leaf in the loop.
    fn platform(&self, base: usize, at: Location, complaints: &mut Complaints) -> Option<usize> {
        let pruned = self.pruned(&[base]);
        let meeting: Vec<usize> = (0..pruned.len())
            .filter(|l| *l != base && pruned[*l].len() > 2)
            .collect();
        let leaf = |l: &usize| {
            *l != base
                && pruned[*l].len() == 2
                && self.spec.joints.iter().any(|j| j.child == *l)
                && self.tree_children(*l) == 0
        };
        let leaves: Vec<usize> = (0..pruned.len()).filter(leaf).collect();
        match (&meeting[..], &leaves[..]) {
            ([only], _) | ([], [only]) => Some(*only),
            (several, leaves) => {
                let candidates = if several.is_empty() { leaves } else { several };
                let names: Vec<&str> = candidates
                    .iter()
                    .map(|l| self.spec.links[*l].name.as_str())
                    .collect();
                let reason = format!(
                    "{} links could be the platform at which the chains meet: {}",
                    names.len(),
                    list_names(&names)
                );
                complaints.at(at, reason, "name the one you mean (tip)");
                None
            }
        }
    }

    fn tree_children(&self, link: usize) -> usize {
        // Loop joints come last, and close at links that a tree joint holds.
        let held = |child: usize, before: usize| {
            self.spec.joints[..before].iter().any(|j| j.child == child)
        };
        let joints = self.spec.joints.iter().enumerate();
        joints
            .filter(|(i, j)| j.parent == link && !held(j.child, *i))
            .count()
    }

    /// Every chain from base to platform.
    fn paths(
        &self,
        base: usize,
        platform: usize,
        at: Location,
        complaints: &mut Complaints,
    ) -> Option<Vec<Vec<Passed>>> {
        let pruned = self.pruned(&[base, platform]);
        let name = |link: usize| &self.spec.links[link].name;
        let mut paths = Vec::new();
        let mut passed = 0;
        for &first in &pruned[base] {
            let (mut link, mut path) = (base, Vec::new());
            let mut next = first;
            loop {
                let joint = &self.spec.joints[next];
                path.push((next, joint.parent == link));
                link = if joint.parent == link {
                    joint.child
                } else {
                    joint.parent
                };
                if link == platform {
                    break;
                }
                match pruned[link][..] {
                    [a, b] if link != base => next = if a == next { b } else { a },
                    _ => {
                        let reason = format!(
                            "{} chains meet at link `{}`, which is neither base nor platform",
                            pruned[link].len(),
                            name(link)
                        );
                        let remedy = format!(
                            "choose base and tip such that every chain runs from one to the other; \
                             now they are `{}` and `{}`",
                            name(base),
                            name(platform)
                        );
                        complaints.at(at, reason, remedy);
                        return None;
                    }
                }
            }
            passed += path.len();
            paths.push(path);
        }
        let all: usize = pruned.iter().map(Vec::len).sum::<usize>() / 2;
        if paths.len() < 2 || passed < all {
            let reason = format!(
                "the loops do not run from `{}` to `{}`: {} of their {all} joints lie on chains \
                 between them",
                name(base),
                name(platform),
                passed
            );
            complaints.at(at, reason, "choose another base or tip");
            return None;
        }
        Some(paths)
    }
}

/// A path as a chain of its own; a joint passed backwards moves its parent.
fn chain(spec: &Spec, path: &[Passed], found: &Found) -> ChainSpec {
    let start = |(j, outwards): &Passed| {
        let joint = &spec.joints[*j];
        if *outwards { joint.parent } else { joint.child }
    };
    let end = |(j, outwards): &Passed| start(&(*j, !*outwards));
    let mut links = vec![spec.links[start(&path[0])].clone()];
    let mut joints = Vec::new();
    for (i, passed) in path.iter().enumerate() {
        links.push(spec.links[end(passed)].clone());
        let joint = &spec.joints[passed.0];
        let placed = if passed.1 {
            joint.clone()
        } else {
            Joint {
                origin: joint.mount.inverse(),
                axis: joint.axis.map(|x| 0.0 - x),
                mount: joint.origin.inverse(),
                ..joint.clone()
            }
        };
        joints.push(Joint {
            parent: i,
            child: i + 1,
            mimic: None,
            ..placed
        });
    }
    let names = joints.iter().map(|joint| joint.name.clone());
    let actuated = names.filter(|name| found.actuated.contains(name)).collect();
    ChainSpec {
        name: joints[0].name.clone(),
        at: joints[0].at,
        actuated,
        spec: Spec {
            name: spec.name.clone(),
            links,
            joints,
            source: spec.source.clone(),
        },
    }
}
