//! Which joints lead from base to tip.

use super::tip::default_tip;
use crate::spec::{ArmSpec, Collector, JointType, did_you_mean};
use std::collections::HashSet;

/// A path down the tree.
pub(super) struct Chain {
    /// Index into the links.
    pub base: usize,
    /// Index into the links; differs from `base`.
    pub tip: usize,
    /// Indices into the joints, from base to tip; not empty.
    pub joints: Vec<usize>,
}

/// The chain between two links named by the user, or found.
pub(super) fn choose(
    spec: &ArmSpec,
    base: Option<&str>,
    tip: Option<&str>,
    diagnostics: &mut Collector,
) -> Option<Chain> {
    if spec.joints.iter().all(|it| it.kind == JointType::Fixed) {
        diagnostics.whole(
            "no joint of this robot moves, so it is no arm",
            "give a robot with a revolute, continuous or prismatic joint",
        );
        return None;
    }
    let tree = Tree::new(spec);
    let base_link = match base {
        Some(name) => find(spec, "base", name, diagnostics),
        None => tree.root(),
    };
    let tip_link = match tip {
        Some(name) => find(spec, "tip", name, diagnostics),
        None => Some(default_tip(spec, base_link?, diagnostics)?),
    };
    let (base, tip) = (base_link?, tip_link?);
    match tree.path(base, tip) {
        Some(joints) if joints.is_empty() => {
            let name = &spec.links[base].name;
            diagnostics.whole(
                format!("base and tip are both `{name}`, so there is no chain"),
                "choose a tip further out",
            );
            None
        }
        Some(joints) => Some(Chain { base, tip, joints }),
        None => {
            explain_no_path(&tree, base, tip, diagnostics);
            None
        }
    }
}

fn find(spec: &ArmSpec, role: &str, name: &str, diagnostics: &mut Collector) -> Option<usize> {
    let found = spec.links.iter().position(|link| link.name == name);
    if found.is_none() {
        let names: Vec<&str> = spec.links.iter().map(|link| link.name.as_str()).collect();
        diagnostics.whole(
            format!("the {role} `{name}` is no link of this robot"),
            did_you_mean(name, &names),
        );
    }
    found
}

fn explain_no_path(tree: &Tree, base: usize, tip: usize, diagnostics: &mut Collector) {
    let name = |link: usize| &tree.spec.links[link].name;
    let reason = format!(
        "the tip `{}` is not below the base `{}`",
        name(tip),
        name(base)
    );
    if tree.path(tip, base).is_some() {
        let remedy = format!(
            "swap them: base = \"{}\", tip = \"{}\"",
            name(tip),
            name(base)
        );
        diagnostics.whole(format!("{reason}, but above it"), remedy);
    } else {
        let parting = tree.common_ancestor(base, tip);
        let remedy = format!(
            "choose a base above both, such as `{}` where their branches part",
            name(parting)
        );
        diagnostics.whole(reason, remedy);
    }
}

/// The robot with links that know the joint above them.
struct Tree<'s> {
    spec: &'s ArmSpec,
    above: Vec<Option<usize>>,
}

impl<'s> Tree<'s> {
    fn new(spec: &'s ArmSpec) -> Self {
        let mut above = vec![None; spec.links.len()];
        for (j, joint) in spec.joints.iter().enumerate() {
            above[joint.child] = Some(j);
        }
        Tree { spec, above }
    }

    fn root(&self) -> Option<usize> {
        self.above.iter().position(Option::is_none)
    }

    /// The joints from a link down to another one.
    fn path(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let mut joints = Vec::new();
        let mut link = to;
        while link != from {
            let joint = self.above[link]?;
            joints.push(joint);
            link = self.spec.joints[joint].parent;
        }
        joints.reverse();
        Some(joints)
    }

    /// A link, its parent, and so on up to the root.
    fn ancestors(&self, link: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(link), |&link| {
            self.above[link].map(|joint| self.spec.joints[joint].parent)
        })
    }

    fn common_ancestor(&self, a: usize, b: usize) -> usize {
        let above_a: HashSet<usize> = self.ancestors(a).collect();
        self.ancestors(b)
            .find(|link| above_a.contains(link))
            .unwrap_or(a)
    }
}
