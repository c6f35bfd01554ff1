//! Recognises xacro that was not expanded.

use super::{elements, vocabulary};
use crate::spec::Collector;
use roxmltree::{Document, Node};

/// The way out.
pub(super) const EXPAND: &str =
    "expand it first: `xacro arm.urdf.xacro > arm.urdf`, and use the result";

/// Reports the first xacro element, or else about every `${...}` and
/// `$(...)` where kinematics is written.
pub(super) fn refuse(document: &Document, diagnostics: &mut Collector) {
    let is_xacro = |node: &Node| {
        node.tag_name()
            .namespace()
            .is_some_and(|uri| uri.contains("xacro"))
    };
    if let Some(element) = document.descendants().find(is_xacro) {
        let name = element.tag_name().name();
        let reason = format!(
            "<xacro:{name}>: this file is xacro, a program that writes a URDF, and has not been expanded"
        );
        diagnostics.at(diagnostics.place(element.range().start), reason, EXPAND);
        return;
    }
    let structure = |node: &Node| vocabulary::STRUCTURE.contains(&node.tag_name().name());
    for node in elements(document.root_element()).filter(structure) {
        refuse_expressions(node, diagnostics);
        elements(node)
            .filter(|part| vocabulary::KINEMATIC.contains(&part.tag_name().name()))
            .for_each(|part| refuse_expressions(part, diagnostics));
    }
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
