//! What the XML reader of ROS, TinyXML, takes and XML does not allow: `--` in comments, blanks
//! and comments before the declaration, prefixes that are not declared. So is the name of a document
//! type that defines nothing.
//!
//! None of it is part of the robot. It is written over, byte for byte, so that every place
//! stays where it is, and warned of where it is no XML.

use super::markup::{Part, parts};
use super::{vocabulary, xacro};
use crate::spec::Collector;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ops::Range;

/// The text without these.
pub(super) fn strict<'t>(text: &'t str, diagnostics: &mut Collector) -> Cow<'t, str> {
    let mut strict = Cow::Borrowed(text);
    let declared = declared(text);
    let mut undeclared = BTreeSet::new();
    let mut is_first = true;
    for (range, part) in parts(text) {
        let (start, within) = (range.start, &text[range.clone()]);
        match part {
            Part::Comment => hide_dashes(within, start, &mut strict, diagnostics),
            Part::Instruction if is_first && start > 0 && is_declaration(within) => {
                overwrite(&mut strict, start, &blank(within));
                let reason = "the XML declaration does not stand at the beginning of the file";
                let remedy = "remove what stands before it";
                diagnostics.warn(diagnostics.place(start), reason, remedy);
            }
            Part::Open(_) if is_bare_type(within) => {
                overwrite(&mut strict, start, &blank(within));
            }
            Part::Open(_) | Part::Close => {
                let mut warn = |prefix, at| {
                    if undeclared.insert(prefix) {
                        let reason = format!("the XML prefix `{prefix}:` is used but not declared");
                        let remedy = format!(
                            "declare it in the root element, xmlns:{prefix}=\"...\", or remove \
                             what uses it"
                        );
                        diagnostics.warn(diagnostics.place(at), reason, remedy);
                    }
                };
                let slash = usize::from(within.starts_with("</"));
                let name = element(&within[1 + slash..]);
                if let Some(prefix) = prefix(name).filter(|it| !declared.contains(it)) {
                    let at = start + 1 + slash;
                    overwrite(&mut strict, at + prefix.len(), "_");
                    // Elements of xacro are looked at one by one.
                    if prefix != xacro::PREFIX {
                        warn(prefix, at);
                    }
                }
                // No attribute of another namespace is the robot's.
                for (range, name) in attributes(within, 1 + slash + name.len()) {
                    if let Some(prefix) = prefix(name).filter(|it| !declared.contains(it)) {
                        let at = start + range.start;
                        overwrite(&mut strict, at, &blank(&within[range]));
                        warn(prefix, at);
                    }
                }
            }
            Part::Literal | Part::Instruction => {}
        }
        is_first &= matches!(part, Part::Comment);
    }
    strict
}

/// Parts of the robot behind the dashes may have been meant to stand outside: a comment that has
/// some is left to be refused.
fn hide_dashes(comment: &str, start: usize, strict: &mut Cow<str>, diagnostics: &mut Collector) {
    let content = &comment["<!--".len()..comment.len() - "-->".len()];
    let dashes = content
        .find("--")
        .or(content.strip_suffix('-').map(str::len));
    let is_kinematic = |tag: &str| {
        let mut words = vocabulary::STRUCTURE.iter().chain(&vocabulary::KINEMATIC);
        words.any(|word| tag.trim_start_matches('/').starts_with(word))
    };
    let hides = |dashes: usize| content[dashes..].split('<').skip(1).any(is_kinematic);
    let Some(dashes) = dashes.filter(|&dashes| !hides(dashes)) else {
        return;
    };
    let at = start + "<!--".len();
    overwrite(strict, at, &content.replace('-', " "));
    diagnostics.warn(
        diagnostics.place(at + dashes),
        "the comment contains `--`, which XML does not allow",
        "write the comment without `--`, or remove it",
    );
}

fn overwrite(text: &mut Cow<str>, at: usize, by: &str) {
    text.to_mut().replace_range(at..at + by.len(), by);
}

/// As many bytes, on as many lines.
fn blank(text: &str) -> String {
    let bytes = text.bytes();
    let blank = bytes.map(|byte| if byte == b'\n' { '\n' } else { ' ' });
    blank.collect()
}

fn is_declaration(instruction: &str) -> bool {
    let rest = instruction.strip_prefix("<?xml");
    rest.is_some_and(|rest| rest.starts_with(char::is_whitespace))
}

/// A document type without definitions of its own, which could rewrite the content; what a file
/// that it names defines is not read.
fn is_bare_type(tag: &str) -> bool {
    tag.starts_with("<!DOCTYPE") && !tag.contains('[')
}

/// The element's name, from a text that begins with it.
fn element(text: &str) -> &str {
    let end = text.find(|c: char| c.is_whitespace() || "/>=\"'".contains(c));
    &text[..end.unwrap_or(text.len())]
}

/// The attributes of a tag behind the element's name: the bytes that each takes, and its name.
fn attributes(tag: &str, mut at: usize) -> impl Iterator<Item = (Range<usize>, &str)> {
    std::iter::from_fn(move || {
        let equals = at + tag[at..].find('=')?;
        let name = tag[at..equals].trim();
        let start = equals - tag[at..equals].trim_start().len();
        let open = equals + tag[equals..].find(['"', '\''])?;
        let close = open + 1 + tag[open + 1..].find(&tag[open..=open])?;
        at = close + 1;
        Some((start..at, name))
    })
}

/// The prefix of a name.
fn prefix(name: &str) -> Option<&str> {
    let (prefix, rest) = name.split_once(':')?;
    let is_prefix = !prefix.is_empty() && !rest.is_empty() && !["xml", "xmlns"].contains(&prefix);
    is_prefix.then_some(prefix)
}

/// All prefixes that some element declares.
fn declared(text: &str) -> BTreeSet<&str> {
    let behind = text.split("xmlns:").skip(1);
    let declared =
        behind.filter_map(|rest| rest.split(|c: char| c.is_whitespace() || c == '=').next());
    declared.collect()
}
