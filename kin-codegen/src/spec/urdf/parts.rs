//! The parts of a joint that carry kinematics, be it one of the tree or one that closes a loop.

use super::checks::{attribute, check_attributes, place, refuse_text, refuse_unknown};
use super::{elements, numbers, origin, vocabulary};
use crate::spec::{Collector, JointType, Limits, Rating, orientation};
use roxmltree::Node;

/// Limits of a continuous joint that are so far apart, radians, are those of a full turn, which says
/// nothing.
const NEARLY_ALL_AROUND: f64 = 6.2;

/// Other parts in which people forget to close the element.
const DYNAMICS: [&str; 3] = ["dynamics", "calibration", "safety_controller"];

/// The children of a joint that are read, each at most once.
pub(super) struct Parts<'a, 'i>(Vec<Node<'a, 'i>>);

impl<'a, 'i> Parts<'a, 'i> {
    /// Those that `read` names; what carries kinematics in other joints only is refused.
    pub fn of(
        joint: Node<'a, 'i>,
        read: &[&str],
        ignored: &[&str],
        diagnostics: &mut Collector,
    ) -> Self {
        let known = [read, ignored].concat();
        let parent = joint.tag_name().name();
        let mut parts = Parts(Vec::new());
        for child in elements(joint) {
            let name = child.tag_name().name();
            refuse_nested(child, parent, diagnostics);
            if !read.contains(&name) {
                if vocabulary::KINEMATIC.contains(&name) {
                    let reason = format!("<{name}> in a <{parent}>, which has none");
                    let remedy = format!("remove it; a <{parent}> has {}", listed(read));
                    diagnostics.at(place(child, diagnostics), reason, remedy);
                } else {
                    refuse_unknown(child, parent, &known, diagnostics);
                }
                continue;
            }
            if let Some(first) = parts.find(name) {
                second(first, child, diagnostics);
                continue;
            }
            check_attributes(child, diagnostics);
            refuse_text(child, diagnostics);
            parts.0.push(child);
        }
        parts
    }

    pub fn find(&self, name: &str) -> Option<Node<'a, 'i>> {
        self.0
            .iter()
            .copied()
            .find(|node| node.tag_name().name() == name)
    }

    /// Unit length; along x where the joint does not say, as URDF has it.
    pub fn axis(&self, kind: Option<JointType>, diagnostics: &mut Collector) -> Option<[f64; 3]> {
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

    pub fn limits(
        &self,
        kind: Option<JointType>,
        continuous: bool,
        diagnostics: &mut Collector,
    ) -> Option<(Limits, Rating)> {
        let stops = matches!(kind, Some(JointType::Revolute | JointType::Prismatic)) && !continuous;
        let Some(node) = self.find("limit") else {
            let limits = match stops {
                true => Limits::Missing,
                false => Limits::Unlimited,
            };
            return Some((limits, Rating::default()));
        };
        let infinite = warn_of_infinite(node, diagnostics);
        let bound = |name, diagnostics: &mut Collector| match node.attribute_node(name) {
            Some(attribute) => numbers::read::<1>(&attribute, diagnostics).map(|[x]| x),
            None if stops && has_two_bounds(node) => {
                refuse_missing_bound(node, name, diagnostics);
                None
            }
            None => Some(0.0),
        };
        let bounds = match infinite {
            true => Some((f64::NEG_INFINITY, f64::INFINITY)),
            false => {
                let (lower, upper) = (bound("lower", diagnostics), bound("upper", diagnostics));
                lower.zip(upper)
            }
        };
        let rating = |name, diagnostics: &mut Collector| {
            let attribute = node.attribute_node(name)?;
            numbers::refuse_junk(&attribute, diagnostics);
            let value: f64 = attribute.value().trim().parse().ok()?;
            if value < 0.0 {
                let reason = format!("the {name} {value} is negative, so it bounds nothing");
                let remedy =
                    format!("write how large the joint's {name} may be in either direction");
                let at = diagnostics.place(attribute.range_value().start);
                diagnostics.warn(at, reason, remedy);
            }
            // People write 0 and huge numbers where they do not know.
            (value.is_finite() && value > 0.0).then_some(value)
        };
        let rating = Rating {
            velocity: rating("velocity", diagnostics),
            effort: rating("effort", diagnostics),
        };
        let (lower, upper) = bounds?;
        let at = place(node, diagnostics);
        if continuous && lower < upper && upper - lower < NEARLY_ALL_AROUND {
            let reason = format!(
                "the limits {lower}..{upper} rad do not hold: the joint is continuous, which has none"
            );
            let remedy =
                "make it type=\"revolute\" if it stops there, or remove `lower` and `upper`";
            diagnostics.warn(at, reason, remedy);
        }
        let limits = match continuous || infinite {
            true => Limits::Unlimited,
            false => Limits::Range { lower, upper, at },
        };
        Some((limits, rating))
    }
}

/// What carries kinematics is lost inside of another part, where nobody reads it.
fn refuse_nested(part: Node, joint: &str, diagnostics: &mut Collector) {
    let name = part.tag_name().name();
    let is_part = vocabulary::KINEMATIC.contains(&name) || DYNAMICS.contains(&name);
    for inner in elements(part).filter(|_| is_part) {
        let lost = inner.tag_name().name();
        if vocabulary::attributes(name).contains(&lost) {
            let reason = format!("<{lost}> inside of <{name}> is not read");
            let remedy = format!("write it as an attribute: <{name} {lost}=\"...\"/>");
            diagnostics.at(place(inner, diagnostics), reason, remedy);
        }
        if vocabulary::KINEMATIC.contains(&lost) {
            let reason = format!("<{lost}> inside of <{name}> is not read");
            let remedy =
                format!("close <{name} .../> in front of it: both belong in the <{joint}>");
            let at = place(inner, diagnostics);
            match lost {
                // A joint that needs one is refused for having none.
                "limit" => diagnostics.warn(at, reason, remedy),
                _ => diagnostics.at(at, reason, remedy),
            }
        }
    }
}

/// A part that is given twice: once is enough if both say the same.
fn second(first: Node, again: Node, diagnostics: &mut Collector) {
    let name = again.tag_name().name();
    let said = |node: Node| {
        let words = |value: &str| value.split_whitespace().collect::<Vec<_>>().join(" ");
        let mut said: Vec<(String, String)> = node
            .attributes()
            .map(|attribute| (attribute.name().to_owned(), words(attribute.value())))
            .collect();
        said.sort();
        said
    };
    let at = place(again, diagnostics);
    if said(first) == said(again) {
        let reason = format!("a second <{name}> in the same joint says what the first does");
        diagnostics.warn(at, reason, "remove one of them");
    } else {
        let reason = format!("a second <{name}> in the same joint: only one can hold");
        diagnostics.at(at, reason, "remove one of them");
    }
}

/// Whether a bound that is left out of a limit is no 0: urdfdom 6 requires both
/// of a joint with stops from URDF 1.2 on, and elsewhere takes infinity.
fn has_two_bounds(limit: Node) -> bool {
    let root = limit.document().root_element();
    origin::number(origin::version(root)) >= vec![1, 2]
}

fn refuse_missing_bound(limit: Node, name: &str, diagnostics: &mut Collector) {
    let root = limit.document().root_element();
    let reason = format!(
        "<limit> without `{name}` in a URDF of version {}: from version 1.2 on it is no longer 0",
        origin::version(root)
    );
    let remedy = format!(
        "add {name}=\"...\", or make the joint continuous if it turns freely (for the 0 of older \
         versions, {name}=\"0\")"
    );
    diagnostics.at(place(limit, diagnostics), reason, remedy);
}

/// Whether a limit is infinite both ways, which is none, though no number for urdfdom.
fn warn_of_infinite(limit: Node, diagnostics: &mut Collector) -> bool {
    let bound = |name| limit.attribute(name)?.trim().parse::<f64>().ok();
    let (lower, upper) = (bound("lower"), bound("upper"));
    let is_infinite = lower == Some(f64::NEG_INFINITY) && upper == Some(f64::INFINITY);
    if is_infinite {
        let reason = "the limits are infinite, which ROS does not read as numbers";
        let remedy = "make the joint continuous if it turns freely, or write how far it moves";
        diagnostics.warn(place(limit, diagnostics), reason, remedy);
    }
    is_infinite
}

fn listed(elements: &[&str]) -> String {
    let named: Vec<String> = elements.iter().map(|name| format!("<{name}>")).collect();
    named.join(", ")
}
