//! Which joints lead from base to tip.

use super::tip::default_tip;
use crate::spec::{ArmSpec, Collector, Joint, JointType};
use std::borrow::Cow;

/// Fewer joints are no robot that a base carries: what floats may be the arm itself.
const CARRIED: usize = 3;

/// A path down the tree, of a robot that hangs on its base.
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
    match base {
        None => spec.refuse_apart(diagnostics),
        Some(_) => diagnostics.put_warnings(&spec.apart),
    }
    if !diagnostics.is_empty() {
        return None;
    }
    if spec.joints.iter().all(|it| it.kind == JointType::Fixed) {
        diagnostics.whole(
            "no joint of this robot moves, so it is no arm",
            "give a robot with a revolute, continuous or prismatic joint",
        );
        return None;
    }
    let tree = Tree::new(spec);
    let base_link = match base {
        Some(name) => spec.find("base", name, diagnostics),
        None => tree.root().map(|root| tree.standing(root, diagnostics)),
    };
    let tip_link = match tip {
        Some(name) => spec.find("tip", name, diagnostics),
        None => Some(default_tip(spec, base_link?, diagnostics)?),
    };
    let (base, tip) = (base_link?, tip_link?);
    if !tree.ancestors(tip).any(|link| link == base) {
        let [base, tip] = [base, tip].map(|link| &spec.links[link].name);
        diagnostics.whole(
            format!("no joints lead from `{base}` to `{tip}`: the robot falls apart"),
            "name two links of one part (base, tip), or connect the parts",
        );
        spec.refuse_apart(diagnostics);
        return None;
    }
    let joints = tree.path(base, tip);
    if joints.is_empty() {
        let name = &spec.links[base].name;
        diagnostics.whole(
            format!("base and tip are both `{name}`, so there is no chain"),
            "choose a tip further out",
        );
        return None;
    }
    Some(Chain { base, tip, joints })
}

/// The robot as it hangs on the base, for a tip that is not below that link: every joint from there
/// up to the root is passed from its child to its parent.
pub(super) fn hung_on_base<'s>(
    spec: &'s ArmSpec,
    base: Option<&str>,
    tip: Option<&str>,
) -> Cow<'s, ArmSpec> {
    let place = |name: &str| spec.links.iter().position(|link| link.name == name);
    let (Some(base), Some(tip)) = (base.and_then(place), tip.and_then(place)) else {
        return Cow::Borrowed(spec);
    };
    let tree = Tree::new(spec);
    if tree.ancestors(tip).any(|link| link == base) {
        return Cow::Borrowed(spec);
    }
    let mut hung = spec.clone();
    for joint in tree.joints_above(base) {
        hung.joints[joint] = spec.joints[joint].reversed();
    }
    Cow::Owned(hung)
}

/// The robot with links that know the joint above them.
struct Tree<'s> {
    spec: &'s ArmSpec,
    above: Vec<Option<usize>>,
}

impl<'s> Tree<'s> {
    fn new(spec: &'s ArmSpec) -> Self {
        let above = spec.above();
        Tree { spec, above }
    }

    fn root(&self) -> Option<usize> {
        self.above.iter().position(Option::is_none)
    }

    /// The link that an arm stands on: the root, or what carries the arm where a joint that may go
    /// anywhere carries all of the robot.
    fn standing(&self, root: usize, diagnostics: &mut Collector) -> usize {
        let joints = &self.spec.joints;
        let below = self.spec.below();
        let moving_from = |link: usize| -> Vec<usize> {
            let mut open = below[link].clone();
            let mut moving = Vec::new();
            while let Some(j) = open.pop() {
                match joints[j].kind {
                    JointType::Fixed => open.extend(&below[joints[j].child]),
                    _ => moving.push(j),
                }
            }
            moving
        };
        let moves = |it: &&Joint| matches!(it.kind, JointType::Revolute | JointType::Prismatic);
        if joints.iter().filter(moves).count() < CARRIED {
            return root;
        }
        let mut base = root;
        while let [joint] = moving_from(base)[..] {
            let joint = &joints[joint];
            let motion = match joint.kind {
                JointType::Floating => "floats",
                JointType::Planar => "is planar",
                _ => break,
            };
            base = joint.child;
            let reason = format!(
                "the base is `{}`: joint `{}`, which {motion}, carries all of the robot",
                self.spec.links[base].name, joint.name
            );
            let remedy = "poses are those in its frame; name another base if you mean it (base)";
            diagnostics.warn(joint.at, reason, remedy);
        }
        base
    }

    /// The joints from a link up to the root.
    fn joints_above(&self, link: usize) -> impl Iterator<Item = usize> {
        let next = |&joint: &usize| self.above[self.spec.joints[joint].parent];
        std::iter::successors(self.above[link], next)
    }

    /// A link, its parent, and so on up to the root.
    fn ancestors(&self, link: usize) -> impl Iterator<Item = usize> {
        let parents = self.joints_above(link);
        std::iter::once(link).chain(parents.map(|joint| self.spec.joints[joint].parent))
    }

    /// The joints from a link down to one below it.
    fn path(&self, from: usize, to: usize) -> Vec<usize> {
        let count = self.ancestors(to).take_while(|&link| link != from).count();
        let mut joints: Vec<usize> = self.joints_above(to).take(count).collect();
        joints.reverse();
        joints
    }
}
