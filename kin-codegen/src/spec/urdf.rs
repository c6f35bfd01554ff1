//! URDF.
//!
//! [`strict`] walks the XML with roxmltree: it knows every element and
//! attribute that can carry kinematics, reports whatever else stands in
//! their place, and knows where everything is. The tests read every file a
//! second time with urdf-rs, and compare.
mod checks;
mod joint;
mod lenient;
mod loops;
mod markup;
mod numbers;
mod origin;
mod parts;
mod strict;
mod vocabulary;
mod xacro;

use super::{Collector, Diagnostics, Source, Spec, format, look_alike, tree};
use roxmltree::Node;

/// Reads a URDF.
pub(super) fn parse(source: &Source) -> Result<Spec, Diagnostics> {
    let mut diagnostics = Collector::new(source);
    let mut spec = read(source, &mut diagnostics);
    if let Some(spec) = &mut spec {
        *spec.warnings_mut() = diagnostics.take_warnings();
    }
    diagnostics.unless_any(spec)
}

fn read(source: &Source, diagnostics: &mut Collector) -> Option<Spec> {
    if let Some(markup::Excess { offset, reason }) = markup::excess(&source.text) {
        diagnostics.at(
            diagnostics.place(offset),
            reason,
            "keep what the robot needs",
        );
        return None;
    }
    let text = lenient::strict(&source.text, diagnostics);
    let document = match roxmltree::Document::parse(&text) {
        Ok(document) => document,
        Err(error) => {
            explain_xml(&error, source, diagnostics);
            return None;
        }
    };
    xacro::refuse(&document, diagnostics);
    if !diagnostics.is_empty() {
        return None;
    }
    let draft = strict::read(&document, source, diagnostics)?;
    let tree = tree::build(draft, source, diagnostics)?;
    match loops::is_looped(&document) {
        false => Some(Spec::Arm(tree)),
        true => {
            tree.refuse_apart(diagnostics);
            if !diagnostics.is_empty() {
                return None;
            }
            loops::read(&document, tree, diagnostics).map(Spec::Mechanism)
        }
    }
}

/// Children in the namespace of an element that is in the root's, usually
/// none: other namespaces are extensions, which say nothing about kinematics. Nor does what is left
/// over from xacro.
fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    let namespace = node.tag_name().namespace();
    let is_own = move |child: &Node| child.tag_name().namespace() == namespace;
    node.children()
        .filter(move |child| child.is_element() && is_own(child) && xacro::name(child).is_none())
}

/// The text is no XML at all.
fn explain_xml(error: &roxmltree::Error, source: &Source, diagnostics: &mut Collector) {
    use roxmltree::Error;
    let at = super::Location {
        line: error.pos().row,
        column: error.pos().col,
    };
    match error {
        Error::UnknownNamespace(prefix, _) if prefix == "xacro" => {
            diagnostics.at(
                at,
                "this file is xacro, a program that writes a URDF, and has not been expanded",
                xacro::EXPAND,
            );
        }
        Error::UnknownNamespace(prefix, _) => {
            let reason = format!(
                "the XML prefix `{prefix}:` is used but not declared, so this is no well-formed XML"
            );
            let remedy = format!(
                "declare it in the root element, xmlns:{prefix}=\"...\", or remove what uses it"
            );
            diagnostics.at(at, reason, remedy);
        }
        Error::DtdDetected => {
            let remedy = "remove the <!DOCTYPE ...> and write its entities out";
            diagnostics.whole(
                "the file has a document type definition, which could rewrite its content",
                remedy,
            );
        }
        Error::NoRootNode | Error::UnclosedRootNode | Error::UnexpectedEndOfStream
            if source.text.trim().is_empty() =>
        {
            diagnostics.whole(
                "the file is empty",
                "give a URDF: <robot name=\"arm\"> ... </robot>",
            );
        }
        Error::NoRootNode | Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            let end = diagnostics.place(source.text.trim_end().len());
            diagnostics.at(
                end,
                "the file ends before its XML does",
                "close every element; the file may have been cut off",
            );
        }
        _ if !source.text.trim_start().starts_with('<') => {
            diagnostics.at(
                at,
                "this is no XML: it does not begin with `<`",
                rename(source),
            );
        }
        Error::MalformedEntityReference(_) => diagnostics.at(
            at,
            format!("this is no well-formed XML: {}", without_place(error)),
            "write &amp; for the character `&`",
        ),
        Error::InvalidComment(_) => diagnostics.at(
            at,
            "the comment contains `--`, which XML does not allow",
            "write the comment without `--`, or remove it",
        ),
        Error::UnknownToken(_) if second_root(at, source) => diagnostics.at(
            at,
            "a second element stands behind the root, and XML has one root",
            "keep one <robot> in a file",
        ),
        _ => {
            let here: String = rest_of_line(at, source).take(1).collect();
            let remedy = look_alike::remedy(&here);
            diagnostics.at(
                at,
                format!("this is no well-formed XML: {}", without_place(error)),
                remedy.unwrap_or_else(|| "correct the XML at this place".into()),
            );
        }
    }
}

/// What to do with a file that is not XML at all.
fn rename(source: &Source) -> &'static str {
    if format::is_yaml_robot(&source.text) {
        "name the file `.yaml` if it is one"
    } else {
        "give a URDF: <robot name=\"arm\"> ... </robot>"
    }
}

/// Whether an element begins behind the end of the robot.
fn second_root(at: super::Location, source: &Source) -> bool {
    let mut rest = rest_of_line(at, source);
    rest.next() == Some('<') && rest.next().is_some_and(char::is_alphabetic)
}

/// From a place on.
fn rest_of_line(at: super::Location, source: &Source) -> impl Iterator<Item = char> {
    let mut lines = source.text.lines().skip(at.line as usize - 1);
    let line = lines.next().unwrap_or("");
    line.chars().skip(at.column as usize - 1)
}

/// The message without the "at 1:2" which ours starts with already.
fn without_place(error: &roxmltree::Error) -> String {
    let text = error.to_string();
    let place = format!(" at {}", error.pos());
    text.strip_suffix(&place)
        .map(str::to_string)
        .unwrap_or(text)
}
