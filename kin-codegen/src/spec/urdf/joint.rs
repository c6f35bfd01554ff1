//! A joint: its name, its type, and the parts that carry kinematics.

use super::checks::{check_attributes, place, refuse_text, required};
use super::parts::Parts;
use super::{elements, numbers, origin, vocabulary};
use crate::spec::tree::{DraftJoint, DraftMimic, Name};
use crate::spec::{Collector, JointType, Limits, Rating, did_you_mean, suggest};
use kin_runtime::Pose;
use roxmltree::Node;

/// Reads a joint; `None` after reporting why it has no place in the tree. What
/// else is wrong with it is kept as its faults: it matters on the chain alone.
pub(super) fn read(node: Node, diagnostics: &mut Collector) -> Option<DraftJoint> {
    let before = diagnostics.len();
    check_attributes(node, diagnostics);
    refuse_text(node, diagnostics);
    let name = required(node, "name", diagnostics);
    let word = required(node, "type", diagnostics);
    let ignored = &vocabulary::IN_JOINT;
    let parts = Parts::of(node, &vocabulary::KINEMATIC, ignored, diagnostics);
    let parent = parts.link("parent", node, diagnostics);
    let child = parts.link("child", node, diagnostics);
    let kind = word.as_ref().and_then(|word| kind(word, diagnostics));
    // Every part is read, whatever is wrong with the others.
    let origin = parts.origin(diagnostics);
    let axis = parts.axis(kind, diagnostics);
    let limits = parts.limits(
        kind,
        word.as_ref().is_some_and(|word| word.text == "continuous"),
        diagnostics,
    );
    let mimic = parts.mimic(kind, diagnostics);
    let (name, parent, child) = (name?, parent?, child?);
    let (limits, rating) = limits.unwrap_or((Limits::Missing, Rating::default()));
    Some(DraftJoint {
        name,
        // What is not known to be fixed may move.
        kind: kind.unwrap_or(JointType::Revolute),
        parent,
        child,
        origin: origin.unwrap_or(Pose::IDENTITY),
        axis: axis.unwrap_or([1.0, 0.0, 0.0]),
        mount: Pose::IDENTITY,
        limits,
        mimic: mimic.flatten(),
        rating,
        faults: diagnostics.take_since(before),
    })
}

fn kind(word: &Name, diagnostics: &mut Collector) -> Option<JointType> {
    let kind = vocabulary::joint_type(&word.text);
    if kind.is_none() {
        let reason = format!("`{}` is no joint type", word.text);
        diagnostics.at(
            word.at,
            reason,
            did_you_mean(&word.text, &vocabulary::JOINT_TYPES),
        );
    }
    kind
}

impl Parts<'_, '_> {
    fn link(&self, role: &str, joint: Node, diagnostics: &mut Collector) -> Option<Name> {
        if let Some(node) = self.find(role) {
            return required(node, "link", diagnostics);
        }
        let meant = |node: Node| {
            suggest::nearest(node.tag_name().name(), vocabulary::KINEMATIC) == Some(role)
        };
        if !elements(joint).any(meant) {
            let reason = format!("the joint has no <{role}>, so it connects nothing");
            diagnostics.at(
                place(joint, diagnostics),
                reason,
                format!("add <{role} link=\"...\"/>"),
            );
        }
        None
    }

    fn origin(&self, diagnostics: &mut Collector) -> Option<Pose> {
        match self.find("origin") {
            Some(node) => origin::read(node, diagnostics),
            None => Some(Pose::IDENTITY),
        }
    }

    /// What a joint that cannot move mimics has no effect.
    fn mimic(
        &self,
        kind: Option<JointType>,
        diagnostics: &mut Collector,
    ) -> Option<Option<DraftMimic>> {
        let Some(node) = self
            .find("mimic")
            .filter(|_| kind != Some(JointType::Fixed))
        else {
            return Some(None);
        };
        let number = |name, default, diagnostics: &mut Collector| match node.attribute_node(name) {
            Some(attribute) => numbers::read::<1>(&attribute, diagnostics).map(|[x]| x),
            None => Some(default),
        };
        let joint = required(node, "joint", diagnostics);
        let multiplier = number("multiplier", 1.0, diagnostics);
        let offset = number("offset", 0.0, diagnostics);
        Some(Some(DraftMimic {
            joint: joint?,
            multiplier: multiplier?,
            offset: offset?,
        }))
    }
}
