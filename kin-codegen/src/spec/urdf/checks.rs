//! What is checked on every element: its name, its attributes, its text.

use super::vocabulary;
use crate::spec::tree::Name;
use crate::spec::{Collector, Location, did_you_mean, suggest};
use roxmltree::{Attribute, Node};

/// Where an element begins.
pub(super) fn place(node: Node, diagnostics: &Collector) -> Location {
    diagnostics.place(node.range().start)
}

/// Reports a child that may be a misspelling of one in the vocabulary of its
/// parent, or belongs elsewhere; warns of what only a vendor knows, and of any in a link, of
/// which none moves a frame.
pub(super) fn refuse_unknown(
    child: Node,
    parent: &str,
    known: &[&str],
    diagnostics: &mut Collector,
) {
    let name = child.tag_name().name();
    if known.contains(&name) {
        return;
    }
    let at = place(child, diagnostics);
    let reason = format!("unknown element <{name}> in a <{parent}>");
    if vocabulary::STRUCTURE.contains(&name) {
        diagnostics.at(at, reason, format!("move it out, next to the <{parent}>"));
    } else if (parent, name) == ("joint", "pose") && !child.text().is_some_and(is_zero) {
        let remedy = "write `<origin xyz=\"...\" rpy=\"...\"/>`: a pose is how SDF says that, as seen from \
                      the child link";
        diagnostics.at(at, reason, remedy);
    } else if let Some(meant) = suggest::nearest(name, known.iter().copied()) {
        let remedy = format!("did you mean <{meant}>?");
        match parent {
            "link" => diagnostics.warn(at, reason, remedy),
            _ => diagnostics.at(at, reason, remedy),
        }
    } else {
        let remedy = "remove it, or give it an XML namespace of its own if another program needs \
                      it; it is not read here";
        diagnostics.warn(at, reason, remedy);
    }
}

/// An attribute that must be there. One that is misspelt has been reported
/// under the name it has.
pub(super) fn attribute<'a, 'i>(
    node: Node<'a, 'i>,
    name: &str,
    diagnostics: &mut Collector,
) -> Option<Attribute<'a, 'i>> {
    let found = node.attribute_node(name);
    let element = node.tag_name().name();
    let known = vocabulary::attributes(element);
    let meant = |a: &Attribute| {
        let nearest = suggest::nearest(a.name(), known.iter().copied());
        // Of one that is refused it is said that the only one is meant.
        let is_refused = a.namespace().is_none()
            && !vocabulary::tolerates_attributes(element)
            && !is_zero(a.value());
        nearest == Some(name) || known.len() == 1 && is_refused
    };
    if found.is_none() && !node.attributes().any(|a| meant(&a)) {
        let reason = format!("<{element}> has no `{name}`");
        let remedy = format!("add {name}=\"...\"");
        diagnostics.at(place(node, diagnostics), reason, remedy);
    }
    found
}

/// A name in an attribute that must be there.
pub(super) fn required(node: Node, name: &str, diagnostics: &mut Collector) -> Option<Name> {
    let attribute = attribute(node, name, diagnostics)?;
    let at = diagnostics.place(attribute.range_value().start);
    let text = attribute.value();
    if text.trim().is_empty() {
        let reason = format!("{name}=\"{text}\" is empty");
        diagnostics.at(
            at,
            reason,
            format!("give the <{}> a {name}", node.tag_name().name()),
        );
        return None;
    }
    if let Some(breaks) = attribute_text(node, &attribute).find(['\t', '\n', '\r']) {
        let at = diagnostics.place(attribute.range_value().start + breaks);
        let reason = format!(
            "a tab or a line break in {name}=\"{text}\": not every reader of URDF takes it for a blank"
        );
        diagnostics.at(at, reason, "write the name without it");
        return None;
    }
    Some(Name {
        text: text.to_string(),
        at,
    })
}

/// The value as it stands in the file: XML makes blanks of tabs and line breaks.
fn attribute_text<'i>(node: Node<'_, 'i>, attribute: &Attribute) -> &'i str {
    &node.document().input_text()[attribute.range_value()]
}

/// Reports attributes that the element does not have, or that look
/// like misspellings of those it has. What is all zeros says nothing.
pub(super) fn check_attributes(node: Node, diagnostics: &mut Collector) {
    let element = node.tag_name().name();
    let known = vocabulary::attributes(element);
    for attribute in node
        .attributes()
        .filter(|a| a.namespace().is_none() && !known.contains(&a.name()))
    {
        let is_said = known.iter().any(|&name| node.has_attribute(name));
        let other = vocabulary::other_word(element, attribute.name()).filter(|_| !is_said);
        let meant = suggest::nearest(attribute.name(), known.iter().copied()).or(other);
        if meant.is_none() && vocabulary::tolerates_attributes(element) {
            continue;
        }
        let at = diagnostics.place(attribute.range().start);
        let reason = format!("unknown attribute `{}` in <{element}>", attribute.name());
        if meant.is_none() && is_zero(attribute.value()) {
            diagnostics.warn(at, reason, "remove it: it is zero, and not read");
        } else {
            let remedy = other.map(|other| format!("write `{other}` in its place"));
            let remedy = remedy.unwrap_or_else(|| did_you_mean(attribute.name(), known));
            diagnostics.at(at, reason, remedy);
        }
    }
}

/// Numbers that are all 0.
fn is_zero(value: &str) -> bool {
    let mut words = value.split_whitespace().peekable();
    words.peek().is_some() && words.all(|word| word.parse::<f64>() == Ok(0.0))
}

/// Joints consist of elements; a number in text there is something lost.
pub(super) fn refuse_text(node: Node, diagnostics: &mut Collector) {
    let texts = node
        .children()
        .filter(|c| c.is_text() && c.text().is_some_and(|t| !t.trim().is_empty()));
    for text in texts {
        let content = text.text().unwrap_or("");
        let blank = content.len() - content.trim_start().len();
        let at = diagnostics.place(text.range().start + blank);
        let reason = format!("text in a <{}> has no meaning", node.tag_name().name());
        let mut words = content.split(|c: char| c.is_whitespace() || "=\"'".contains(c));
        if words.any(|word| word.parse::<f64>().is_ok_and(f64::is_finite)) {
            diagnostics.at(at, reason, "write it as an attribute, or in a comment");
        } else {
            diagnostics.warn(at, reason, "write it in a comment, or remove it");
        }
    }
}
