//! From joints that name links to a tree of them.

use super::{
    ArmSpec, Collector, Diagnostic, Joint, JointType, Limits, Link, Location, Mimic, Rating, Source,
};
use super::{bounds, list_names};
use kin_runtime::Pose;
use std::collections::{HashMap, HashSet};

/// A name, and where the file says it.
#[derive(Clone, Debug)]
pub(super) struct Name {
    pub text: String,
    pub at: Location,
}

/// What a file says before its names are looked up.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub name: String,
    pub links: Vec<Name>,
    pub joints: Vec<DraftJoint>,
    pub tip: Option<String>,
}

/// A [`Joint`] whose links are names.
#[derive(Clone, Debug)]
pub(super) struct DraftJoint {
    pub name: Name,
    pub kind: JointType,
    pub parent: Name,
    pub child: Name,
    pub origin: Pose,
    pub axis: [f64; 3],
    pub mount: Pose,
    pub limits: Limits,
    pub mimic: Option<DraftMimic>,
    pub rating: Rating,
    pub faults: Vec<Diagnostic>,
}

/// A [`Mimic`] whose joint is a name.
#[derive(Clone, Debug)]
pub(super) struct DraftMimic {
    pub joint: Name,
    pub multiplier: f64,
    pub offset: f64,
}

/// Looks up all names and checks that the joints form a tree, of which parts may be apart.
///
/// Whether there is one root is asked only if nothing was wrong before, since
/// a joint that could not be read leaves a hole in the tree.
pub(super) fn build(draft: Draft, source: &Source, diagnostics: &mut Collector) -> Option<ArmSpec> {
    if draft.links.is_empty() && !draft.joints.is_empty() && diagnostics.is_empty() {
        let ends = draft.joints.iter().flat_map(|j| [&j.parent, &j.child]);
        let mut names: Vec<&str> = ends.map(|name| name.text.as_str()).collect();
        let mut seen = HashSet::new();
        names.retain(|name| seen.insert(*name));
        diagnostics.whole(
            "the robot has joints and no links",
            format!(
                "add a <link name=\"...\"/> for each of {}",
                list_names(&names)
            ),
        );
        return None;
    }
    let mut joints = index("joint", draft.joints.iter().map(|j| &j.name), diagnostics);
    // Of what can be mimicked; the file may not even name the others.
    let mut kinds = draft.joints.iter().map(|joint| joint.kind);
    joints
        .names
        .retain(|_| kinds.next() != Some(JointType::Fixed));
    let links = index("link", draft.links.iter(), diagnostics);
    if draft.name.chars().count() > bounds::NAME {
        let reason = format!(
            "the name of the robot has more than {} characters",
            bounds::NAME
        );
        diagnostics.whole(reason, "give it a shorter name");
    }
    let mut resolved = Vec::new();
    let mut missing = Missing::default();
    let broken = !diagnostics.is_empty();
    for joint in &draft.joints {
        // What is wrong with a joint may follow from what is wrong elsewhere.
        if !broken || joint.faults.is_empty() {
            let ends = [(&joint.parent, &joint.child), (&joint.child, &joint.parent)];
            let [parent, child] = [0, 1].map(|end| {
                let found = links.by_name.get(ends[end].0.text.as_str());
                found.copied().unwrap_or_else(|| {
                    missing.report(
                        joint,
                        ["parent", "child"][end],
                        ends[end],
                        &links,
                        diagnostics,
                    )
                })
            });
            resolved.push(resolve(joint, [parent, child], &joints, diagnostics));
        }
    }
    if !diagnostics.is_empty() {
        // No chain will tell which faults matter: all are told.
        let faults = draft.joints.iter().flat_map(|joint| &joint.faults);
        diagnostics.put(faults.cloned());
        diagnostics.put(missing.faults);
        return None;
    }
    let introduced = draft.links.iter().chain(missing.links);
    let link = |name: &Name| Link {
        name: name.text.clone(),
        at: name.at,
    };
    let mut spec = ArmSpec {
        name: draft.name,
        links: introduced.map(link).collect(),
        joints: resolved,
        tip: draft.tip,
        warnings: Vec::new(),
        apart: missing.faults,
        source: source.clone(),
    };
    check_tree(&mut spec, diagnostics);
    check_mimics(&spec, diagnostics);
    if !diagnostics.is_empty() {
        spec.refuse_apart(diagnostics);
    }
    diagnostics.is_empty().then_some(spec)
}

/// Links that joints name and the file does not introduce.
#[derive(Default)]
struct Missing<'d> {
    links: Vec<&'d Name>,
    by_name: HashMap<&'d str, usize>,
    faults: Vec<Diagnostic>,
}

impl<'d> Missing<'d> {
    /// Reports the link at one end of a joint, and gives it a place behind the others.
    fn report(
        &mut self,
        joint: &DraftJoint,
        role: &str,
        (name, other): (&'d Name, &Name),
        links: &Index,
        diagnostics: &mut Collector,
    ) -> usize {
        let before = diagnostics.len();
        let reason = format!(
            "the {role} of joint `{}` is `{}`, and there is no such link",
            joint.name.text, name.text
        );
        // No joint has one link at both ends.
        let others = links.names.iter().copied().filter(|it| *it != other.text);
        let remedy = diagnostics.link_for(&name.text, &others.collect::<Vec<_>>());
        diagnostics.at(name.at, reason, remedy);
        self.faults.extend(diagnostics.take_since(before));
        let place = *self.by_name.entry(&name.text).or_insert(self.links.len());
        if place == self.links.len() {
            self.links.push(name);
        }
        links.names.len() + place
    }
}

impl ArmSpec {
    /// Reports that it is no one tree, if it is not.
    pub(crate) fn refuse_apart(&self, diagnostics: &mut Collector) {
        if self.apart.is_empty() {
            return;
        }
        // No chain will tell which faults matter: all are told.
        let faults = self.joints.iter().flat_map(|joint| &joint.faults);
        diagnostics.put(faults.chain(&self.apart).cloned());
    }
}

/// Names in the order of the file, and their places in it.
struct Index<'d> {
    names: Vec<&'d str>,
    by_name: HashMap<&'d str, usize>,
}

fn index<'d>(
    what: &str,
    names: impl Iterator<Item = &'d Name>,
    diagnostics: &mut Collector,
) -> Index<'d> {
    let mut index = Index {
        names: Vec::new(),
        by_name: HashMap::new(),
    };
    let mut first: HashMap<&str, Location> = HashMap::new();
    for name in names {
        let first = *first.entry(&name.text).or_insert(name.at);
        index.by_name.entry(&name.text).or_insert(index.names.len());
        index.names.push(&name.text);
        refuse_long(what, name, diagnostics);
        // A link named after its joint is no second mistake.
        if first != name.at && !diagnostics.mentions(name.at) {
            let reason = format!(
                "a second {what} is named `{}`; the first is in line {}",
                name.text, first.line
            );
            diagnostics.at(
                name.at,
                reason,
                format!("give every {what} a name of its own"),
            );
        }
    }
    index
}

fn refuse_long(what: &str, name: &Name, diagnostics: &mut Collector) {
    let length = name.text.chars().count();
    if length > bounds::NAME && !diagnostics.mentions(name.at) {
        let reason = format!(
            "the name of this {what} has {length} characters, and at most {} are read",
            bounds::NAME
        );
        diagnostics.at(name.at, reason, "give it a shorter name");
    }
}

fn resolve(
    joint: &DraftJoint,
    [parent, child]: [usize; 2],
    joints: &Index,
    diagnostics: &mut Collector,
) -> Joint {
    let before = diagnostics.len();
    let mimic = joint
        .mimic
        .as_ref()
        .and_then(|mimic| resolve_mimic(&joint.name.text, mimic, joints, diagnostics));
    let faults = [&joint.faults[..], &diagnostics.take_since(before)].concat();
    Joint {
        name: joint.name.text.clone(),
        kind: joint.kind,
        parent,
        child,
        origin: joint.origin,
        axis: joint.axis,
        mount: joint.mount,
        limits: joint.limits,
        mimic,
        rating: joint.rating,
        faults,
        at: joint.name.at,
    }
}

/// Refuses a joint of a mechanism that mimics another.
pub(super) fn refuse_mimic(joint: &str, at: Location, diagnostics: &mut Collector) {
    let reason =
        format!("joint `{joint}` mimics another, and in a mechanism the loops alone couple joints");
    let remedy = "remove `mimic` where the loops move the joint as it says; gears inside of loops are \
                  not solved";
    diagnostics.at(at, reason, remedy);
}

fn resolve_mimic(
    joint: &str,
    mimic: &DraftMimic,
    joints: &Index,
    diagnostics: &mut Collector,
) -> Option<Mimic> {
    let DraftMimic {
        joint: Name { text, at },
        multiplier,
        offset,
    } = mimic;
    let Some(&found) = joints.by_name.get(text.as_str()) else {
        let reason = format!("joint `{joint}` mimics `{text}`, and there is no such joint");
        let others = joints.names.iter().copied().filter(|it| *it != joint);
        let remedy = diagnostics.nearest_of(text, &others.collect::<Vec<_>>());
        diagnostics.at(*at, reason, remedy);
        return None;
    };
    Some(Mimic {
        joint: found,
        multiplier: *multiplier,
        offset: *offset,
        at: *at,
    })
}

/// Every link but one of each part has exactly one parent, and none is its own ancestor.
fn check_tree(spec: &mut ArmSpec, diagnostics: &mut Collector) {
    let mut above: Vec<Option<usize>> = vec![None; spec.links.len()];
    let mut hangs = vec![false; spec.links.len()];
    spec.joints.iter().for_each(|it| hangs[it.child] = true);
    let several = hangs.iter().filter(|hangs| !**hangs).count() > 1;
    for (i, joint) in spec.joints.iter().enumerate() {
        let child = &spec.links[joint.child].name;
        if joint.parent == joint.child {
            let reason = format!("joint `{}` joins link `{child}` to itself", joint.name);
            let remedy = "name the link that it moves as its child, and the one that carries it as its parent";
            diagnostics.at(joint.at, reason, remedy);
        } else if let Some(first) = above[joint.child] {
            let both = [&spec.joints[first], joint];
            let [first, second] = both.map(|joint| &joint.name);
            let reason = format!(
                "link `{child}` hangs on two joints, `{first}` and `{second}`: that closes a loop, and this robot must be a tree",
            );
            let is_root = |joint: &&Joint| several && !hangs[joint.parent];
            let mut turned = both.into_iter().filter(is_root);
            let swap = match (turned.next(), turned.next()) {
                (Some(joint), None) => format!(
                    "swap parent and child of `{}` if it moves `{}`, which hangs on none; or ",
                    joint.name, spec.links[joint.parent].name
                ),
                _ => String::new(),
            };
            let remedy = format!(
                "{swap}give each joint a child of its own; of a mechanism with loops, let a \
                 <loop_joint> join the two"
            );
            diagnostics.at(joint.at, reason, remedy);
        } else {
            above[joint.child] = Some(i);
        }
    }
    if diagnostics.is_empty() {
        check_root(spec, &above, diagnostics);
    }
}

fn check_root(spec: &mut ArmSpec, above: &[Option<usize>], diagnostics: &mut Collector) {
    let roots: Vec<usize> = (0..spec.links.len())
        .filter(|&l| above[l].is_none())
        .collect();
    if roots.is_empty() && spec.links.is_empty() {
        diagnostics.whole(
            "the robot has no links",
            "describe at least two links and a joint between them",
        );
    }
    if let Some(joint) = first_in_cycle(spec, above) {
        let child = &spec.links[spec.joints[joint].child].name;
        let reason = format!("the joints run in a circle: link `{child}` is its own ancestor");
        diagnostics.at(
            spec.joints[joint].at,
            reason,
            "swap parent and child of the joint that points back; of a mechanism with loops, let a \
             <loop_joint> join the two",
        );
    }
    // Links that are missing say why.
    if let (true, [_, second, ..]) = (spec.apart.is_empty(), &roots[..]) {
        let before = diagnostics.len();
        let names: Vec<&str> = roots.iter().map(|&l| spec.links[l].name.as_str()).collect();
        let reason = format!(
            "the robot falls apart: {} links have no parent: {}",
            roots.len(),
            list_names(&names)
        );
        let remedy = "connect them with joints (fixed ones, if nothing moves), or remove the ones not \
                      in use; or name two links of one of them (base, tip)";
        diagnostics.at(spec.links[*second].at, reason, remedy);
        spec.apart = diagnostics.take_since(before);
    }
}

/// The first joint whose child is an ancestor of itself.
fn first_in_cycle(spec: &ArmSpec, above: &[Option<usize>]) -> Option<usize> {
    let parent = |joint: &Option<usize>| joint.map(|joint| spec.joints[joint].parent);
    let parents: Vec<Option<usize>> = above.iter().map(parent).collect();
    let circles = on_cycles(&parents);
    (0..spec.joints.len()).find(|&j| circles[spec.joints[j].child])
}

fn check_mimics(spec: &ArmSpec, diagnostics: &mut Collector) {
    let leader = |joint: &Joint| joint.mimic.map(|mimic| mimic.joint);
    let leaders: Vec<Option<usize>> = spec.joints.iter().map(leader).collect();
    let circles = on_cycles(&leaders);
    for (joint, _) in spec
        .joints
        .iter()
        .zip(circles)
        .filter(|(_, circles)| *circles)
    {
        let Some(mimic) = joint.mimic else { continue };
        let reason = format!(
            "joint `{}` mimics itself, directly or through others: nothing sets its value",
            joint.name
        );
        diagnostics.at(mimic.at, reason, "remove the mimic of the joint that leads");
    }
}

/// Which of several things lead back to themselves, where each leads to one
/// other at most. Looks at each of them twice.
fn on_cycles(next: &[Option<usize>]) -> Vec<bool> {
    let mut circles = vec![false; next.len()];
    // The walk that came by first, by the thing at which it began.
    let mut walk: Vec<Option<usize>> = vec![None; next.len()];
    for start in 0..next.len() {
        let mut at = Some(start);
        while let Some(new) = at.filter(|&i| walk[i].is_none()) {
            walk[new] = Some(start);
            at = next[new];
        }
        // A walk that meets itself has gone round once.
        while let Some(i) = at.filter(|&i| walk[i] == Some(start) && !circles[i]) {
            circles[i] = true;
            at = next[i];
        }
    }
    circles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_leads_into_a_circle_is_not_on_it() {
        // 0 -> 1 -> 2 -> 1, 3 -> 3, 4 -> 0, 5 -> nothing, 6 -> 5
        let next = [Some(1), Some(2), Some(1), Some(3), Some(0), None, Some(5)];
        let circles = [false, true, true, true, false, false, false];
        assert_eq!(on_cycles(&next), circles);
    }

    #[test]
    fn a_long_line_is_walked_once() {
        // Each step from every start would be 10^12 of them.
        let line = |i: usize| (i < 999_999).then_some(i + 1);
        let forth: Vec<_> = (0..1_000_000).map(line).collect();
        assert!(!on_cycles(&forth).contains(&true));
        let back: Vec<_> = (0..1_000_000_usize).map(|i| i.checked_sub(1)).collect();
        assert!(!on_cycles(&back).contains(&true));
        let round: Vec<_> = (0..1_000_000).map(|i| Some((i + 1) % 1_000_000)).collect();
        assert!(!on_cycles(&round).contains(&false));
    }
}
