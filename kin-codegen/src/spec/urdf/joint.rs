//! A joint: its name, its type, and the parts that carry kinematics.

use super::checks::{attribute, check_attributes, place, refuse_text, refuse_unknown, required};
use super::{elements, numbers, origin, vocabulary};
use crate::spec::tree::{DraftJoint, DraftMimic, Name};
use crate::spec::{Collector, JointType, Limits, did_you_mean, orientation, suggest};
use kin_runtime::Pose;
use roxmltree::Node;

/// Reads a joint; `None` after reporting why.
pub(super) fn read(node: Node, diagnostics: &mut Collector) -> Option<DraftJoint> {
    check_attributes(node, diagnostics);
    refuse_text(node, diagnostics);
    let name = required(node, "name", diagnostics);
    let word = required(node, "type", diagnostics);
    let parts = Parts::of(node, diagnostics);
    let parent = parts.link("parent", node, diagnostics);
    let child = parts.link("child", node, diagnostics);
    let kind = word.as_ref().and_then(|word| kind(word, diagnostics));
    // Every part is read before the first missing one ends it.
    let origin = parts.origin(diagnostics);
    let axis = parts.axis(kind, diagnostics);
    let limits = parts.limits(
        kind,
        word.as_ref().is_some_and(|word| word.text == "continuous"),
        diagnostics,
    );
    let mimic = parts.mimic(kind, diagnostics);
    Some(DraftJoint {
        name: name?,
        kind: kind?,
        parent: parent?,
        child: child?,
        origin: origin?,
        axis: axis?,
        mount: Pose::IDENTITY,
        limits: limits?,
        mimic: mimic?,
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

/// The children of a joint that carry kinematics, each at most once.
struct Parts<'a, 'i>(Vec<Node<'a, 'i>>);

impl<'a, 'i> Parts<'a, 'i> {
    fn of(joint: Node<'a, 'i>, diagnostics: &mut Collector) -> Self {
        let known = [&vocabulary::KINEMATIC[..], &vocabulary::IN_JOINT].concat();
        let mut parts = Parts(Vec::new());
        for child in elements(joint) {
            let name = child.tag_name().name();
            refuse_unknown(child, "joint", &known, diagnostics);
            if !vocabulary::KINEMATIC.contains(&name) {
                continue;
            }
            if parts.find(name).is_some() {
                let reason = format!("a second <{name}> in the same joint: only one can hold");
                diagnostics.at(place(child, diagnostics), reason, "remove one of them");
                continue;
            }
            check_attributes(child, diagnostics);
            refuse_text(child, diagnostics);
            parts.0.push(child);
        }
        parts
    }

    fn find(&self, name: &str) -> Option<Node<'a, 'i>> {
        self.0
            .iter()
            .copied()
            .find(|node| node.tag_name().name() == name)
    }

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

    /// Unit length; along x where the joint does not say, as URDF has it.
    fn axis(&self, kind: Option<JointType>, diagnostics: &mut Collector) -> Option<[f64; 3]> {
        const X: [f64; 3] = [1.0, 0.0, 0.0];
        let Some(node) = self.find("axis") else {
            return Some(X);
        };
        let xyz = attribute(node, "xyz", diagnostics)?;
        let axis = numbers::read(&xyz, diagnostics)?;
        let moves_along_it = matches!(
            kind,
            Some(JointType::Revolute | JointType::Prismatic | JointType::Planar)
        );
        let direction = orientation::unit(axis);
        if direction.is_none() && moves_along_it {
            let reason = format!("the axis {} is no direction", xyz.value().trim());
            let at = diagnostics.place(xyz.range_value().start);
            diagnostics.at(
                at,
                reason,
                "write the direction of the joint's axis, for example xyz=\"0 0 1\"",
            );
            return None;
        }
        Some(direction.unwrap_or(X))
    }

    fn limits(
        &self,
        kind: Option<JointType>,
        continuous: bool,
        diagnostics: &mut Collector,
    ) -> Option<Limits> {
        let Some(node) = self.find("limit") else {
            let needs_them =
                matches!(kind, Some(JointType::Revolute | JointType::Prismatic)) && !continuous;
            return Some(if needs_them {
                Limits::Missing
            } else {
                Limits::Unlimited
            });
        };
        let bound = |name, diagnostics: &mut Collector| match node.attribute_node(name) {
            Some(attribute) => numbers::read::<1>(&attribute, diagnostics).map(|[x]| x),
            None => Some(0.0),
        };
        let (lower, upper) = (bound("lower", diagnostics), bound("upper", diagnostics));
        for rating in ["effort", "velocity"] {
            if let Some(attribute) = node.attribute_node(rating) {
                numbers::refuse_junk(&attribute, diagnostics);
            }
        }
        let (lower, upper) = (lower?, upper?);
        let at = place(node, diagnostics);
        Some(if continuous {
            Limits::Unlimited
        } else {
            Limits::Range { lower, upper, at }
        })
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
