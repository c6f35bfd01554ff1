//! Which link is the tip, where the user does not say.
//!
//! 1. The joints that move decide: the chain ends with the last of them. Bases,
//!    cameras and collision links that hang on the way do not count, nor do
//!    struts whose joints mimic those of the chain.
//! 2. Fingers are left out: what moves behind a link at which a longer chain
//!    forks, joints that mimic others than those before them, short slides and
//!    joints that are named as a gripper's at the end of the chain, and a last
//!    joint beside which a link hangs under one of the [`NAMES`]. A warning says
//!    so. A wrist that carries a jaw may move a link named as one, and what two
//!    jaws slide on, or slides far itself, may be named so; a short slide is the
//!    arm's if it moves a link under one of the [`NAMES`] or is the quill of a
//!    SCARA; of a robot that is a finger nothing is left out.
//! 3. Of the links that the last joint moves, the first of the [`NAMES`] is the
//!    tip; without any, the only leaf; otherwise the link that the joint moves,
//!    or on which the fingers hang. Cameras and the like, by their [names](ASIDE), are no tips;
//!    where two links have the same name behind different prefixes, a warning says so.
//!
//! Chains that fork otherwise (two arms in one file) are ambiguous; what is listed of them are the
//! arms, fingers left out, those of most joints first. But beside wheels and casters, by their names,
//! one of three joints or more is the arm; and where one has five joints or more, and
//! every other no more than two of its own, and three in all or as many as leave that one five of its
//! own, that one is the arm, and the others are wheels, casters and heads: a warning says so.

mod finger;

use super::mimic::{Followed, followed};
use crate::spec::{ArmSpec, Collector, JointType};
use std::cmp::Reverse;
use std::collections::{BTreeSet, HashMap};

/// What the field calls the tip, the first choice first: as a whole name, or
/// behind a prefix (`panda_hand_tcp`).
const NAMES: [&str; 28] = [
    "tool0",
    "tcp",
    "tcp_link",
    "tool",
    "tool_link",
    "tool_frame",
    "flange",
    "flange_link",
    "ee_link",
    "ee",
    "ee_frame",
    "eef",
    "eef_link",
    "end_effector",
    "end_effector_link",
    "grasp_link",
    "grasp_frame",
    "gripper_frame_link",
    "gripper_frame",
    "end_link",
    "tool_tip",
    "tool_tip_link",
    "gripper_center",
    "gripper_center_link",
    "grasp_point",
    "grasping_point",
    "grasp_center",
    "grasping_frame",
];

/// A link with such a word in its name hangs beside the tip.
const ASIDE: [&str; 14] = [
    "camera",
    "optical",
    "realsense",
    "collision",
    "visual",
    "inertia",
    "inertial",
    "com",
    "imu",
    "lidar",
    "laser",
    "cable",
    "led",
    "light",
];

/// A joint of such a name, or that moves a link of such a name, drives.
const WHEELS: [&str; 3] = ["wheel", "caster", "castor"];

/// A finger has no more joints,
const FINGER_JOINTS: usize = 4;
/// unless it is one of a hand, of which the thumb often has one more, and the little finger.
const HAND_JOINTS: usize = 5;
/// Fewer fingers are no hand.
const HAND: usize = 3;
/// As many are one, whose joints may be told with those that its tendons move,
const WHOLE_HAND: usize = 5;
/// and are no more.
const TENDON_JOINTS: usize = 7;
/// A joint of such a name, or that moves a link of such a name, is a limb's, and no finger's.
const LIMBS: [&str; 7] = [
    "shoulder",
    "elbow",
    "forearm",
    "upper_arm",
    "upperarm",
    "thigh",
    "knee",
];
/// Of a robot with more ends than this no arm is the one that is meant.
const MOST_ENDS: usize = 100;
/// An arm that carries fingers, or is the only one beside wheels, has no fewer joints.
const ARM_JOINTS: usize = 3;
/// An arm that is the only one on what drives and looks has no fewer joints,
const CARRIED_JOINTS: usize = 5;
/// and a wheel, a caster or a head, with what lifts it, no more,
const OTHER_JOINTS: usize = 3;
/// nor more of its own: three carry a point anywhere, as arms and legs do.
const OWN_JOINTS: usize = 2;

/// Links below a base, each with the moving joints that lead to it.
struct Below<'s> {
    spec: &'s ArmSpec,
    /// By link: its joints towards the tips.
    children: Vec<Vec<usize>>,
    /// By link: the joint that moves it, or holds it.
    above: Vec<Option<usize>>,
    /// By joint: what it follows.
    followed: Vec<Followed>,
}

/// Whether a name, in small letters, has one of these words in it.
fn has_any(name: &str, words: &[&str]) -> bool {
    words.iter().any(|word| name.contains(word))
}

/// What may be meant by the arm.
struct Limb {
    /// The link that it stands on.
    base: usize,
    /// The joints that move, from that link on; not empty.
    joints: Vec<usize>,
    /// The joints that are left out behind them, in the order of the file.
    fingers: Vec<usize>,
}

/// The tip of the arm on `base`; none after reporting why.
pub(super) fn default_tip(
    spec: &ArmSpec,
    base: usize,
    diagnostics: &mut Collector,
) -> Option<usize> {
    let below = Below {
        spec,
        children: spec.below(),
        above: spec.above(),
        followed: followed(spec),
    };
    let ends = below.without_followers(below.ends(base));
    if ends.is_empty() {
        return Some(below.rigid_tip(base, false, diagnostics));
    }
    let arms = below.arms(base, &ends);
    let or_more = ends.len() >= MOST_ENDS;
    match &arms[..] {
        [arm] => Some(below.tip(base, arm, diagnostics)),
        [arm, others @ ..] if !or_more && below.is_carried(base, arm, others) => {
            let tip = below.tip(base, arm, diagnostics);
            below.warn_of_others(base, tip, others, diagnostics);
            Some(tip)
        }
        _ => {
            below.report_ambiguous(base, &arms, or_more, diagnostics);
            None
        }
    }
}

impl Below<'_> {
    /// The moving joints down to every joint behind which nothing moves.
    fn ends(&self, base: usize) -> Vec<Vec<usize>> {
        // Whether something moves below a link, from the leaves up.
        let order = self.order(base);
        let mut moves_below = vec![false; self.spec.links.len()];
        for &link in order.iter().rev() {
            moves_below[link] = self.children[link].iter().any(|&j| {
                let joint = &self.spec.joints[j];
                joint.kind != JointType::Fixed || moves_below[joint.child]
            });
        }
        let mut ends: Vec<Vec<usize>> = Vec::new();
        let mut path = Vec::new();
        let mut open: Vec<(usize, usize)> = self.children[base].iter().map(|&j| (j, 0)).collect();
        while let Some((joint, depth)) = open.pop().filter(|_| ends.len() < MOST_ENDS) {
            // The path to the joint's parent.
            path.truncate(depth);
            let link = &self.spec.joints[joint];
            if link.kind != JointType::Fixed {
                path.push(joint);
                if !moves_below[link.child] {
                    ends.push(path.clone());
                }
            }
            if moves_below[link.child] {
                open.extend(self.children[link.child].iter().map(|&j| (j, path.len())));
            }
        }
        ends.sort();
        ends
    }

    /// Without ends that are moved by some of the joints that move another one:
    /// struts and pistons beside an arm, whose joints mimic those of the arm.
    fn without_followers(&self, ends: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
        let leaders: Vec<BTreeSet<usize>> = ends
            .iter()
            .map(|end| end.iter().map(|&j| self.followed[j].leader).collect())
            .collect();
        let follows = |own: &BTreeSet<usize>| {
            let mut others = leaders.iter();
            others.any(|other| own.len() < other.len() && own.is_subset(other))
        };
        let ends = ends.into_iter().zip(&leaders);
        ends.filter(|(_, own)| !follows(own))
            .map(|(end, _)| end)
            .collect()
    }

    /// All links below one, parents first.
    fn order(&self, base: usize) -> Vec<usize> {
        let mut order = vec![base];
        let mut next = 0;
        while let Some(&link) = order.get(next) {
            let children = self.children[link].iter();
            order.extend(children.map(|&j| self.spec.joints[j].child));
            next += 1;
        }
        order
    }

    /// The links that move with one, itself first, and which of them are
    /// leaves.
    fn rigid(&self, link: usize) -> Vec<usize> {
        let mut rigid = vec![link];
        let mut next = 0;
        while let Some(&link) = rigid.get(next) {
            let fixed = self.children[link].iter().map(|&j| &self.spec.joints[j]);
            let fixed = fixed.filter(|joint| joint.kind == JointType::Fixed);
            rigid.extend(fixed.map(|joint| joint.child));
            next += 1;
        }
        rigid
    }

    fn named(&self, links: &[usize]) -> Option<usize> {
        self.all_named(links).first().copied()
    }

    /// All that have the first of the names that any has, those first that hang beside nothing, and
    /// of these the one that has no prefix.
    fn all_named(&self, links: &[usize]) -> Vec<usize> {
        let called = |name: &&str| {
            let called = |&link: &usize| is_called(&self.spec.links[link].name, name);
            let mut called: Vec<usize> = links.iter().copied().filter(called).collect();
            let is_whole = |link: usize| self.spec.links[link].name.eq_ignore_ascii_case(name);
            called.sort_by_key(|&link| (self.is_aside(link), !is_whole(link)));
            called
        };
        let all: Vec<Vec<usize>> = NAMES.iter().map(called).collect();
        let is_tip = |called: &&Vec<usize>| called.first().is_some_and(|&it| !self.is_aside(it));
        let first = all.iter().find(is_tip);
        let any = first.or_else(|| all.iter().find(|called| !called.is_empty()));
        any.cloned().unwrap_or_default()
    }

    /// Whether a link hangs beside the tip, by its name; not of a head, which carries a camera as its
    /// tool.
    fn is_aside(&self, link: usize) -> bool {
        let name = &self.spec.links[link].name;
        let parent = |&link: &usize| self.above[link].map(|j| self.spec.joints[j].parent);
        let above = std::iter::successors(Some(link), parent);
        let joints = above.filter_map(|link| self.above[link]);
        let moving = joints.filter(|&j| self.spec.joints[j].kind != JointType::Fixed);
        if self.spec.tip.as_ref() == Some(name) || moving.count() <= OTHER_JOINTS {
            return false;
        }
        let name = name.to_lowercase();
        // Of two or more, each has its number.
        let mut words = name.split(|c: char| !c.is_alphabetic());
        words.any(|word| ASIDE.contains(&word))
    }

    /// How many joints of a line are the arm's.
    fn without_fingers(&self, end: &[usize]) -> usize {
        let mut arm = end.len();
        while arm > 1
            && self.is_finger(&end[..arm])
            && !(arm < end.len() && self.is_wrist(end[arm - 1]))
        {
            arm -= 1;
        }
        // A robot that is a finger.
        let is_finger = arm == 1 && (end.len() > 2 || self.is_finger(&end[..1]));
        if is_finger || end.len() <= FINGER_JOINTS && self.ends_in_fingertip(end) {
            return end.len();
        }
        // The only finger that nothing else tells from a joint of the arm.
        if arm == end.len() && arm > ARM_JOINTS {
            let last = &self.spec.joints[end[arm - 1]];
            let beside = self.named(&self.rigid(last.parent)).is_some();
            if beside && self.named(&self.rigid(last.child)).is_none() {
                arm -= 1;
            }
        }
        arm
    }

    /// How many of the joints that all these lines begin with are an arm's, if the rest are
    /// fingers on it.
    fn hand(&self, ends: &[Vec<usize>]) -> Option<usize> {
        let common = |k: usize| ends.iter().all(|end| end.get(k) == ends[0].get(k));
        let mut arm = (0..ends[0].len()).take_while(|&k| common(k)).count();
        // A finger may be one joint that drives the others.
        while arm > 1 && self.is_finger(&ends[0][..arm]) {
            arm -= 1;
        }
        let most = match ends.len() {
            WHOLE_HAND.. => TENDON_JOINTS,
            HAND.. => HAND_JOINTS,
            _ => FINGER_JOINTS,
        };
        let most = most.min(arm);
        let fingers = ends.iter().all(|end| {
            end.len() - arm <= most && !end[arm..].iter().any(|&j| self.is_called(j, &LIMBS))
        });
        (arm >= ARM_JOINTS && fingers).then_some(arm)
    }

    /// How many joints of one of several lines are the arm's: all, where what it is without its fingers
    /// is shorter than an arm and other lines go on from there, as those of a hand beside its thumb.
    fn own_joints(&self, end: &[usize], ends: &[Vec<usize>]) -> usize {
        let arm = self.without_fingers(end);
        let goes_on = |other: &Vec<usize>| {
            other.starts_with(&end[..arm]) && self.without_fingers(other) > arm
        };
        match arm < ARM_JOINTS && ends.iter().any(goes_on) {
            true => end.len(),
            false => arm,
        }
    }

    /// The arms among lines of moving joints, each once, those of most joints first, and wheels
    /// last. Of lines that begin alike, the most that are fingers on one arm are that arm.
    fn arms(&self, base: usize, ends: &[Vec<usize>]) -> Vec<Limb> {
        let mut arms: Vec<Limb> = Vec::new();
        let mut rest = ends;
        while let Some(first) = rest.first() {
            // Sorted, those that begin alike stand together.
            let alike = |depth: usize| {
                let begin = &first[..depth];
                rest.iter().take_while(|end| end.starts_with(begin)).count()
            };
            let groups = (ARM_JOINTS..=first.len()).map(|depth| &rest[..alike(depth)]);
            let hand = groups
                .take_while(|group| group.len() > 1)
                .filter_map(|group| Some((group, self.hand(group)?)))
                .next();
            let (group, arm) = hand.unwrap_or_else(|| (&rest[..1], self.own_joints(first, ends)));
            let (base, joints) = self.standing(base, &first[..arm]);
            let fingers = fingers(group, arm);
            // Lines may differ in their fingers alone.
            match arms.iter_mut().find(|arm| arm.joints == joints) {
                Some(arm) => arm.fingers = sorted([&arm.fingers[..], &fingers].concat()),
                None => arms.push(Limb {
                    base,
                    joints: joints.to_vec(),
                    fingers,
                }),
            }
            rest = &rest[group.len()..];
        }
        arms.sort_by_key(|arm| (self.is_wheel(arm), Reverse(arm.joints.len())));
        arms
    }

    /// Where joints begin of which a chain can be made, and these. What a robot stands on may go
    /// anywhere: no chain has such joints.
    fn standing<'j>(&self, base: usize, joints: &'j [usize]) -> (usize, &'j [usize]) {
        let roams = |&j: &usize| {
            let kind = self.spec.joints[j].kind;
            matches!(kind, JointType::Floating | JointType::Planar)
        };
        let below = joints.iter().rposition(roams);
        match below.map(|place| joints.split_at(place + 1)) {
            Some(([.., last], joints)) if !joints.is_empty() => {
                (self.spec.joints[*last].child, joints)
            }
            _ => (base, joints),
        }
    }

    /// Whether the first of several arms is the only one: the others drive, as wheels and casters,
    /// or look. The longest finger of a hand is no arm.
    fn is_carried(&self, base: usize, arm: &Limb, others: &[Limb]) -> bool {
        let is_no_limb = |other: &Limb| {
            let shared = other.joints.iter().filter(|j| arm.joints.contains(j));
            let shared = shared.count();
            // What carries both may have any number of joints, if the arm has enough of its own.
            let is_short =
                other.joints.len() <= OTHER_JOINTS || arm.joints.len() - shared >= CARRIED_JOINTS;
            is_short && other.joints.len() - shared <= OWN_JOINTS || self.is_wheel(other)
        };
        let fewest = match others.iter().all(|other| self.is_wheel(other)) {
            true => ARM_JOINTS,
            false => CARRIED_JOINTS,
        };
        arm.base == base
            && arm.joints.len() >= fewest
            && others.iter().all(is_no_limb)
            && !self.is_finger(&arm.joints)
            && !self.is_wheel(arm)
    }

    /// Whether a limb ends with a wheel, by name.
    fn is_wheel(&self, limb: &Limb) -> bool {
        let last = limb.joints.last();
        last.is_some_and(|&last| self.is_called(last, &WHEELS))
    }

    /// Whether a joint, or the link that it moves, has a name with one of these words in it.
    fn is_called(&self, joint: usize, words: &[&str]) -> bool {
        let joint = &self.spec.joints[joint];
        let names = [&joint.name, &self.spec.links[joint.child].name];
        let mut names = names.iter().map(|name| name.to_lowercase());
        names.any(|name| has_any(&name, words))
    }

    /// The link that an arm ends with: what its last joint moves, or what carries the fingers.
    fn last(&self, arm: &Limb) -> usize {
        match (&arm.fingers[..], &arm.joints[..]) {
            ([], [.., joint]) => self.spec.joints[*joint].child,
            (fingers, _) => self.carrier(fingers),
        }
    }

    /// The tip of an arm, with a warning of what is left out behind it.
    fn tip(&self, base: usize, arm: &Limb, diagnostics: &mut Collector) -> usize {
        let has_fingers = !arm.fingers.is_empty();
        let tip = self.rigid_tip(self.last(arm), has_fingers, diagnostics);
        if has_fingers {
            self.warn_of_fingers(base, tip, arm, diagnostics);
        }
        tip
    }

    /// The link on which all of some joints hang, the first that is above all.
    fn carrier(&self, fingers: &[usize]) -> usize {
        let parent = |&link: &usize| self.above[link].map(|j| self.spec.joints[j].parent);
        let ancestors = |link: usize| std::iter::successors(Some(link), parent);
        let first = self.spec.joints[fingers[0]].parent;
        let line: Vec<usize> = ancestors(first).collect();
        let places: HashMap<usize, usize> = line.iter().copied().zip(0..).collect();
        let meets = |&j: &usize| {
            let mut above = ancestors(self.spec.joints[j].parent);
            above.find_map(|link| places.get(&link).copied())
        };
        let highest = fingers.iter().filter_map(meets).max();
        line[highest.unwrap_or(0)]
    }

    /// The tip among the links that move with one. Where fingers hang on it,
    /// a leaf is no better than the link itself.
    fn rigid_tip(&self, link: usize, fingers: bool, diagnostics: &mut Collector) -> usize {
        let (tip, doubt) = self.end(link, fingers);
        if let Some(doubt) = doubt {
            diagnostics.warn_whole(doubt, "name another one if you mean it (tip)");
        }
        tip
    }

    /// The only one of links that move together on which nothing hangs that is no camera or the
    /// like.
    fn only_leaf(&self, rigid: &[usize]) -> Option<usize> {
        match self.leaves(rigid)[..] {
            [leaf] => Some(leaf),
            _ => None,
        }
    }

    fn leaves(&self, rigid: &[usize]) -> Vec<usize> {
        let is_aside = |&j: &usize| self.is_aside(self.spec.joints[j].child);
        let is_leaf =
            |link: &&usize| self.children[**link].iter().all(is_aside) && !self.is_aside(**link);
        rigid.iter().filter(is_leaf).copied().collect()
    }

    /// The same, and what else may be meant.
    fn end(&self, link: usize, fingers: bool) -> (usize, Option<String>) {
        let rigid = self.rigid(link);
        let name = |link: usize| self.spec.links[link].name.as_str();
        let named = self.all_named(&rigid);
        if let [first, ..] = named[..] {
            let others = named[1..].iter().filter(|&&it| !self.is_aside(it));
            let others: Vec<&str> = others.map(|&link| name(link)).collect();
            let has_prefix = !NAMES.contains(&name(first).to_lowercase().as_str());
            let doubt = (has_prefix && !others.is_empty()).then(|| {
                let (first, others) = (name(first), crate::spec::list_names(&others));
                format!("the tip is `{first}`: {others}, which moves with it, may be meant too")
            });
            return (first, doubt);
        }
        if fingers {
            return (link, None);
        }
        let leaves = self.leaves(&rigid);
        match leaves[..] {
            [] => return (link, None),
            [leaf] => return (leaf, None),
            _ => {}
        }
        let names: Vec<&str> = leaves.iter().map(|&leaf| name(leaf)).collect();
        let reason = format!(
            "the tip is `{}`, which the last joint moves: {} links hang on it, {}",
            name(link),
            names.len(),
            crate::spec::list_names(&names)
        );
        (link, Some(reason))
    }

    fn warn_of_fingers(&self, base: usize, tip: usize, arm: &Limb, diagnostics: &mut Collector) {
        let fingers = arm.fingers.iter().map(|&j| &self.spec.joints[j]);
        let names: Vec<&str> = fingers.map(|joint| joint.name.as_str()).collect();
        let moved = arm.joints.last().map(|&j| self.spec.joints[j].child);
        let beside = moved.and_then(|link| {
            let rigid = self.rigid(link);
            self.named(&rigid).or_else(|| self.only_leaf(&rigid))
        });
        let name = |link: usize| self.spec.links[link].name.as_str();
        let remedy = match beside.filter(|link| *link != tip) {
            Some(beside) => format!(
                "name the tip if you mean another one, such as `{}` (tip)",
                name(beside)
            ),
            None => "name the tip if you mean another one (tip)".into(),
        };
        let [base, tip] = [base, tip].map(name);
        let (subject, verb) = match names.len() {
            1 => ("joint", "looks like that of a gripper and is"),
            _ => ("joints", "look like those of a gripper and are"),
        };
        let reason = format!(
            "the arm is taken from `{base}` to `{tip}`: the {subject} {} {verb} left out",
            crate::spec::list_names(&names)
        );
        diagnostics.warn_whole(reason, remedy);
    }

    /// The name of the tip of an arm that is not taken.
    fn listed_tip(&self, arm: &Limb) -> &str {
        let (tip, _) = self.end(self.last(arm), !arm.fingers.is_empty());
        &self.spec.links[tip].name
    }

    fn warn_of_others(
        &self,
        base: usize,
        tip: usize,
        others: &[Limb],
        diagnostics: &mut Collector,
    ) {
        let names: Vec<&str> = others.iter().map(|arm| self.listed_tip(arm)).collect();
        let [base, tip] = [base, tip].map(|link| &self.spec.links[link].name);
        let (subject, verb) = match names.len() {
            1 => ("that", "is"),
            _ => ("those", "are"),
        };
        let reason = format!(
            "the arm is taken from `{base}` to `{tip}`, the longest chain: {subject} to {} {verb} passed \
             over",
            crate::spec::list_names(&names)
        );
        let remedy = "name the end of another one if you mean it (tip), and where it begins (base)";
        diagnostics.warn_whole(reason, remedy);
    }

    fn report_ambiguous(
        &self,
        base: usize,
        arms: &[Limb],
        or_more: bool,
        diagnostics: &mut Collector,
    ) {
        /// More are no help.
        const SHOWN: usize = 8;
        let name = |link: usize| self.spec.links[link].name.as_str();
        let line = |arm: &Limb| {
            let joints: Vec<&str> = arm
                .joints
                .iter()
                .map(|&j| self.spec.joints[j].name.as_str())
                .collect();
            format!(
                "base `{}`, tip `{}`: {} moving {}, {}",
                name(arm.base),
                self.listed_tip(arm),
                joints.len(),
                if joints.len() == 1 { "joint" } else { "joints" },
                crate::spec::list_names(&joints)
            )
        };
        let mut listed: Vec<String> = arms.iter().take(SHOWN).map(line).collect();
        if arms.len() > SHOWN {
            listed.push(match or_more {
                false => format!("and {} more", arms.len() - SHOWN),
                true => "and more".into(),
            });
        }
        diagnostics.choice(
            format!(
                "{}{} chains of joints begin at `{}`, and any could be the arm:",
                arms.len(),
                if or_more { " or more" } else { "" },
                name(base)
            ),
            listed,
            "name the end of the one you mean (tip), and where it begins (base)",
        );
    }
}

/// The joints behind so many of each line, in the order of the file.
fn fingers(ends: &[Vec<usize>], arm: usize) -> Vec<usize> {
    sorted(ends.iter().flat_map(|end| end[arm..].to_vec()).collect())
}

/// In the order of the file, each once.
fn sorted(mut joints: Vec<usize>) -> Vec<usize> {
    joints.sort_unstable();
    joints.dedup();
    joints
}

/// Whether a link has a name, perhaps behind a prefix.
fn is_called(link: &str, name: &str) -> bool {
    let link = link.to_lowercase();
    let prefix = link.strip_suffix(name);
    prefix.is_some_and(|prefix| prefix.is_empty() || prefix.ends_with(['_', '-', '/', '.', ':']))
}
