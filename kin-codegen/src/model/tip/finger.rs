//! What tells the last joint of a chain from a joint of the arm.

use super::Below;
use crate::spec::{JointType, Limits};
use crate::vector::dot;

/// A joint of such a name, or one that moves a link of such a name other than
/// the first (which is often all that the wrist carries), belongs to a gripper.
const GRIPPERS: [&str; 6] = ["gripper", "finger", "jaw", "knuckle", "claw", "thumb"];

/// A joint of such a name turns what a jaw hangs on, whatever that is called.
const WRISTS: [&str; 4] = ["wrist", "roll", "rotat", "twist"];

/// A slide at the end of a chain that is shorter than this is a finger's, if
/// nothing makes it the arm's, metres.
const FINGER_STROKE: f64 = 0.12;

/// A SCARA has four joints, with a rail five.
const SCARA_JOINTS: usize = 5;
/// Axes with a greater cosine are parallel but for the digits of a file.
const PARALLEL: f64 = 0.999;

impl Below<'_> {
    /// Whether the last joint of a chain moves a finger.
    pub(super) fn is_finger(&self, chain: &[usize]) -> bool {
        let Some((&last, before)) = chain.split_last() else {
            return false;
        };
        let joint = &self.spec.joints[last];
        // The last joint of a palletizer mimics those of its arm.
        let mimics_finger = joint.mimic.is_some() && !before.contains(&self.followed[last].leader);
        let link = self.spec.links[joint.child].name.to_lowercase();
        let name = joint.name.to_lowercase();
        // What a gripper hangs on is often named so, and no finger carries the tool.
        let carries = joint.kind != JointType::Prismatic
            && joint.mimic.is_none()
            && (self.carries_tool(last) || WRISTS.iter().any(|word| name.contains(word)));
        mimics_finger
            || (name.contains(GRIPPERS[0]) && !carries)
            || GRIPPERS[1..]
                .iter()
                .any(|word| name.contains(word) || link.contains(word))
            || (self.is_short_slide(last) && !self.carries_tool(last) && !self.is_quill(chain))
    }

    /// Whether a joint that carries a jaw turns the wrist: it is named so, or not as a gripper's,
    /// which the link that it moves, the other jaw, may be.
    pub(super) fn is_wrist(&self, joint: usize) -> bool {
        let joint = &self.spec.joints[joint];
        let name = joint.name.to_lowercase();
        let is_named = |words: &[&str]| words.iter().any(|word| name.contains(word));
        let turns = joint.kind != JointType::Prismatic && joint.mimic.is_none();
        turns && (is_named(&WRISTS) || !is_named(&GRIPPERS))
    }

    fn is_short_slide(&self, joint: usize) -> bool {
        let joint = &self.spec.joints[joint];
        let stroke = match joint.limits {
            Limits::Range { lower, upper, .. } => (upper - lower).abs(),
            Limits::Missing | Limits::Unlimited => f64::INFINITY,
        };
        joint.kind == JointType::Prismatic && stroke < FINGER_STROKE
    }

    /// Whether a link that a joint moves has the name of a tip: no finger carries the tool.
    fn carries_tool(&self, joint: usize) -> bool {
        let moved = self.rigid(self.spec.joints[joint].child);
        self.named(&moved).is_some()
    }

    /// Whether the last joint of a chain is the slide of a SCARA: parallel, with all joints at
    /// zero, to the axes of all that turn before it, of two at least, and with nothing beside it
    /// that moves. Most fingers slide across these axes, and are two.
    fn is_quill(&self, chain: &[usize]) -> bool {
        let (&[.., carrier, last], 3..=SCARA_JOINTS) = (chain, chain.len()) else {
            return false;
        };
        let slide = &self.spec.joints[last];
        if self.moving_on(self.spec.joints[carrier].child) > 1 {
            return false;
        }
        let mut direction = slide.origin.rotate(slide.axis);
        let mut link = slide.parent;
        let mut turning = 0;
        // Up to the first of the chain, in whose frame and in those between the direction is.
        while let Some(j) = self.above[link].filter(|_| link != self.spec.joints[chain[0]].parent) {
            let joint = &self.spec.joints[j];
            direction = joint.mount.rotate(direction);
            match joint.kind {
                JointType::Fixed | JointType::Prismatic => {}
                JointType::Revolute if dot(joint.axis, direction).abs() > PARALLEL => turning += 1,
                _ => return false,
            }
            direction = joint.origin.rotate(direction);
            link = joint.parent;
        }
        turning >= 2
    }

    /// How many joints that move hang on a link, and on what moves with it.
    fn moving_on(&self, link: usize) -> usize {
        let hung = self
            .rigid(link)
            .into_iter()
            .flat_map(|it| &self.children[it]);
        hung.filter(|&&j| self.spec.joints[j].kind != JointType::Fixed)
            .count()
    }
}
