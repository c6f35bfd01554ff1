//! Recognises xacro that was not expanded, and what an expansion leaves over.

use super::{elements, vocabulary};
use crate::spec::Collector;
use roxmltree::{Document, Node};
use std::collections::HashSet;

/// The way out.
pub(super) const EXPAND: &str =
    "expand it first: `xacro arm.urdf.xacro > arm.urdf`, and use the result";

/// The way out of a call that xacro itself does not expand.
const EXPAND_OR_REMOVE: &str = "expand the file that this one is part of, and use the result; if the \
                                robot is whole without what is called, remove the call";

/// The way out of a file of definitions.
const EXPAND_INCLUDING: &str =
    "expand the file that includes it: `xacro robot.urdf.xacro > robot.urdf`, and use the result";

/// What the elements have before their names. Where it is not declared, xacro itself expands nothing.
pub(super) const PREFIX: &str = "xacro";

/// Definitions, which add nothing by themselves.
const DEFINITIONS: [&str; 3] = ["property", "arg", "macro"];

/// Reports the first xacro element that stands for links or joints, or else
/// every `${...}` and `$(...)` where kinematics is written. Warns of what an
/// expansion left over: definitions, and what looks belong to.
pub(super) fn refuse(document: &Document, diagnostics: &mut Collector) {
    let xacros = document.descendants().filter(|it| name(it).is_some());
    let mut left_over = None;
    for element in xacros.filter(|it| it.ancestors().skip(1).all(|above| name(&above).is_none())) {
        let Some(name) = name(&element) else { continue };
        if is_harmless(element, name) {
            left_over.get_or_insert((element, name));
            continue;
        }
        let at = diagnostics.place(element.range().start);
        if is_call_of_nothing(document, name) {
            let reason = format!(
                "<xacro:{name}> calls a macro of xacro that this file neither defines nor includes"
            );
            diagnostics.at(at, reason, EXPAND_OR_REMOVE);
            return;
        }
        let reason = format!(
            "<xacro:{name}>: this file is xacro, a program that writes a URDF, and has not been expanded"
        );
        diagnostics.at(at, reason, EXPAND);
        return;
    }
    if let Some(call) = bare_call(document) {
        let name = call.tag_name().name();
        let reason = format!(
            "<{name}> calls a macro of xacro, without the prefix that xacro knows it by, and this file \
             has not been expanded"
        );
        let at = diagnostics.place(call.range().start);
        diagnostics.at(at, reason, format!("{}; {EXPAND}", prefixed(name)));
        return;
    }
    if let Some((element, name)) = left_over {
        let at = diagnostics.place(element.range().start);
        let is_link = |node: Node| node.tag_name().name() == "link";
        if !elements(document.root_element()).any(is_link) {
            let reason = format!(
                "<xacro:{name}>: this file is xacro, for others to include, and has no robot of its own"
            );
            diagnostics.at(at, reason, EXPAND_INCLUDING);
            return;
        }
        let reason = format!("<xacro:{name}> is left over from xacro, and means nothing here");
        diagnostics.warn(
            at,
            reason,
            "remove it, if nothing is missing from the robot",
        );
    }
    let structure = |node: &Node| vocabulary::STRUCTURE.contains(&node.tag_name().name());
    for node in elements(document.root_element()).filter(structure) {
        refuse_expressions(node, diagnostics);
        elements(node)
            .filter(|part| vocabulary::KINEMATIC.contains(&part.tag_name().name()))
            .for_each(|part| refuse_expressions(part, diagnostics));
    }
}

/// What an element of xacro is called: by its namespace, or by the prefix where that is not
/// declared, of which `lenient` has written the colon over.
pub(super) fn name<'a>(node: &Node<'a, '_>) -> Option<&'a str> {
    let name = node.tag_name();
    match name.namespace() {
        Some(uri) if uri.contains("xacro") => Some(name.name()),
        _ => name.name().strip_prefix(PREFIX)?.strip_prefix('_'),
    }
}

/// A call of a macro that comes from nowhere: what an expansion leaves of one that it did not know.
fn is_call_of_nothing(document: &Document, called: &str) -> bool {
    const KEYWORDS: [&str; 6] = [
        "include",
        "if",
        "unless",
        "insert_block",
        "element",
        "attribute",
    ];
    let defines = |node: Node| match name(&node) {
        Some("include") => true,
        Some("macro") => node.attribute("name") == Some(called),
        _ => false,
    };
    !KEYWORDS.contains(&called) && !document.descendants().any(defines)
}

/// A call, without the prefix, of a macro of links or joints that is defined here.
fn bare_call<'a, 'i>(document: &'a Document<'i>) -> Option<Node<'a, 'i>> {
    let is_structure = |node: Node| vocabulary::STRUCTURE.contains(&node.tag_name().name());
    let macros = document
        .descendants()
        .filter(|it| name(it) == Some("macro") && it.children().any(is_structure));
    let defined: HashSet<&str> = macros.filter_map(|it| it.attribute("name")).collect();
    let is_call = |&node: &Node| !is_structure(node) && defined.contains(&node.tag_name().name());
    elements(document.root_element()).find(is_call)
}

/// How a macro is called.
fn prefixed(name: &str) -> String {
    format!(
        "write <xacro:{name} .../>, with xmlns:xacro=\"http://www.ros.org/wiki/xacro\" in the root \
         element"
    )
}

/// A definition, or something about how a link looks or what it weighs.
fn is_harmless(element: Node, name: &str) -> bool {
    let within = |node: Node| {
        let name = node.tag_name().name();
        vocabulary::IN_LINK.contains(&name) || vocabulary::IN_JOINT.contains(&name)
    };
    DEFINITIONS.contains(&name) || element.ancestors().skip(1).any(within)
}

fn refuse_expressions(node: Node, diagnostics: &mut Collector) {
    for attribute in node.attributes() {
        let value = attribute.value();
        if let Some(start) = value.find("${").or_else(|| value.find("$(")) {
            let at = diagnostics.place(attribute.range_value().start + start);
            let reason = format!(
                "`{value}` is a xacro expression that has not been expanded, so it has no value"
            );
            diagnostics.at(at, reason, EXPAND);
        }
    }
}
