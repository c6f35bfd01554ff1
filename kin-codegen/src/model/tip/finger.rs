//! What tells the last joint of a chain from a joint of the arm.

use super::{Below, has_any};
use crate::spec::{JointType, Limits};
use crate::vector::dot;

/// A joint of such a name, or one that moves a link of such a name other than
/// the first (which is often all that the wrist carries), belongs to a gripper.
const GRIPPERS: [&str; 7] = [
    "gripper", "finger", "fngr", "jaw", "knuckle", "claw", "thumb",
];

/// A joint of such a name turns what a jaw hangs on, whatever that is called.
const WRISTS: [&str; 4] = ["wrist", "roll", "rotat", "twist"];

/// So does one that is called a gripper's with such a word: fingers have others.
const TURNS: [&str; 4] = ["tilt", "turn", "pitch", "yaw"];

/// A slide at the end of a chain that is shorter than this is a finger's, if
/// nothing makes it the arm's, metres.
const FINGER_STROKE: f64 = 0.12;

/// A jaw opens from near zero to one side, by no more than this, radians.
const SHUT: f64 = 0.15;
const OPEN: f64 = 2.1;

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
            && (self.carries_tool(last) || has_any(&name, &WRISTS) || has_any(&name, &TURNS));
        // What hangs on a wrist may be a jaw that does not move.
        let is_wrist = carries && has_any(&name, &WRISTS) && !self.opens(last);
        let is_named = (name.contains(GRIPPERS[0]) && !carries)
            || (link.contains(GRIPPERS[0]) && !carries && self.opens(last))
            || has_any(&name, &GRIPPERS[1..])
            || (has_any(&link, &GRIPPERS[1..]) && !is_wrist);
        let stroke = self.stroke(last);
        // A hoist may carry a gripper, and have its name.
        let is_long = stroke.is_some_and(|stroke| stroke >= FINGER_STROKE);
        let is_short = stroke.is_some_and(|stroke| stroke < FINGER_STROKE);
        mimics_finger
            || (is_named && !is_long && !self.turns_jaws(last))
            || (is_short && !self.carries_tool(last) && !self.is_quill(chain))
    }

    /// Whether a joint that carries a jaw turns the wrist: it is named so, or not as a gripper's,
    /// which the link that it moves, the other jaw, may be.
    pub(super) fn is_wrist(&self, joint: usize) -> bool {
        let joint = &self.spec.joints[joint];
        let name = joint.name.to_lowercase();
        let turns = joint.kind != JointType::Prismatic && joint.mimic.is_none();
        turns && (has_any(&name, &WRISTS) || !has_any(&name, &GRIPPERS))
    }

    /// Whether the limits of a turn are those of a jaw.
    fn opens(&self, joint: usize) -> bool {
        let joint = &self.spec.joints[joint];
        match joint.limits {
            Limits::Range { lower, upper, .. } if joint.kind == JointType::Revolute => {
                let [shut, open] = if -lower < upper {
                    [lower, upper]
                } else {
                    [upper, lower]
                };
                shut.abs() <= SHUT && (SHUT..=OPEN).contains(&open.abs())
            }
            _ => false,
        }
    }

    /// Whether the last joint of a chain moves the tip of a finger: no jaw is called so.
    pub(super) fn ends_in_fingertip(&self, chain: &[usize]) -> bool {
        chain.last().is_some_and(|&last| {
            let link = &self.spec.links[self.spec.joints[last].child].name;
            let letters = link.chars().filter(|c| c.is_alphabetic());
            let letters: String = letters.flat_map(char::to_lowercase).collect();
            letters.contains("fingertip")
        })
    }

    /// How far a slide goes, metres, if it has limits.
    fn stroke(&self, joint: usize) -> Option<f64> {
        let joint = &self.spec.joints[joint];
        match joint.limits {
            Limits::Range { lower, upper, .. } if joint.kind == JointType::Prismatic => {
                Some((upper - lower).abs())
            }
            _ => None,
        }
    }

    /// Whether a joint turns what several jaws move on, none of which it drives: those that slide,
    /// and behind a joint that is not named as a gripper's those that are.
    fn turns_jaws(&self, joint: usize) -> bool {
        let turning = &self.spec.joints[joint];
        let is_named = |name: &str| has_any(&name.to_lowercase(), &GRIPPERS);
        let is_jaw = |&j: &usize| {
            let moving = &self.spec.joints[j];
            let moved = &self.spec.links[moving.child].name;
            moving.kind == JointType::Prismatic
                || !is_named(&turning.name) && (is_named(&moving.name) || is_named(moved))
        };
        let jaws = self.hanging_on(turning.child).filter(is_jaw);
        let leaders: Vec<usize> = jaws.map(|j| self.followed[j].leader).collect();
        turning.kind != JointType::Prismatic
            && turning.mimic.is_none()
            && leaders.len() > 1
            && !leaders.contains(&joint)
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
        let moving = self.hanging_on(self.spec.joints[carrier].child);
        if moving.count() > 1 {
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

    /// The joints that move and hang on a link, or on what moves with it.
    fn hanging_on(&self, link: usize) -> impl Iterator<Item = usize> {
        let links = self.rigid(link).into_iter();
        let hung = links.flat_map(|it| self.children[it].iter().copied());
        hung.filter(|&j| self.spec.joints[j].kind != JointType::Fixed)
    }
}
