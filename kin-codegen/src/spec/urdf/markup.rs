//! The tags of XML, and what of it takes long to read.
//!
//! The XML reader compares each attribute of an element with all others, and
//! each prefix that is declared with all that hold around it. So both are
//! counted before, tag by tag.

use crate::spec::bounds::{XML_ATTRIBUTES, XML_PREFIXES};
use std::ops::Range;

/// A tag beyond the bounds, and where it begins.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Excess {
    pub offset: usize,
    pub reason: String,
}

/// What stands between `<` and `>`.
pub(super) enum Part {
    Comment,
    /// Literal text.
    Literal,
    /// The declaration, or a processing instruction.
    Instruction,
    Close,
    Open(Tag),
}

/// What a text has between `<` and `>`, in its order and with the bytes that each takes, as far
/// as each ends.
pub(super) fn parts(text: &str) -> impl Iterator<Item = (Range<usize>, Part)> + '_ {
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = find(text, at, "<")?;
        let rest = &text[start..];
        let passed = [
            ("<!--", "-->", Part::Comment),
            ("<![CDATA[", "]]>", Part::Literal),
            ("<?", "?>", Part::Instruction),
            ("</", ">", Part::Close),
        ];
        let passed = passed.into_iter().find(|(open, ..)| rest.starts_with(open));
        let part = match passed {
            Some((open, close, part)) => {
                at = find(text, start + open.len(), close)? + close.len();
                part
            }
            None => {
                let tag = Tag::of(rest)?;
                at = start + tag.length;
                Part::Open(tag)
            }
        };
        Some((start..at, part))
    })
}

/// The first tag with more than the bounds allow. Text that is no XML is left
/// to the reader.
pub(super) fn excess(text: &str) -> Option<Excess> {
    // By open element: the prefixes declared by it and around it.
    let mut open: Vec<usize> = Vec::new();
    for (range, part) in parts(text) {
        let tag = match part {
            Part::Open(tag) => tag,
            Part::Close => {
                open.pop();
                continue;
            }
            Part::Comment | Part::Literal | Part::Instruction => continue,
        };
        let prefixes = open.last().unwrap_or(&0) + tag.prefixes;
        let reason = if tag.attributes > XML_ATTRIBUTES {
            format!(
                "this element has {} attributes, and at most {XML_ATTRIBUTES} are read",
                tag.attributes
            )
        } else if prefixes > XML_PREFIXES {
            format!(
                "{prefixes} prefixes (`xmlns:...`) hold here, and at most {XML_PREFIXES} are read"
            )
        } else {
            if !tag.is_empty {
                open.push(prefixes);
            }
            continue;
        };
        let offset = range.start;
        return Some(Excess { offset, reason });
    }
    None
}

fn find(text: &str, from: usize, pattern: &str) -> Option<usize> {
    text[from..].find(pattern).map(|i| from + i)
}

/// The start of an element.
pub(super) struct Tag {
    length: usize,
    attributes: usize,
    prefixes: usize,
    /// `<.../>`
    is_empty: bool,
}

impl Tag {
    /// From a text that begins with it; `None` if it does not end.
    fn of(text: &str) -> Option<Tag> {
        let mut tag = Tag {
            length: 0,
            attributes: 0,
            prefixes: 0,
            is_empty: false,
        };
        let mut quote = None;
        let mut last = b'<';
        for (i, &byte) in text.as_bytes().iter().enumerate() {
            match (quote, byte) {
                (Some(open), _) if byte == open => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => tag.attributes += 1,
                (None, b'>') => {
                    tag.length = i + 1;
                    tag.is_empty = last == b'/';
                    return Some(tag);
                }
                (None, b'x') => tag.prefixes += usize::from(text[i..].starts_with("xmlns")),
                (None, _) => {}
            }
            last = byte;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write;

    fn numbered(n: usize, one: impl Fn(usize) -> String) -> String {
        (0..n).fold(String::new(), |mut text, i| {
            let _ = write!(text, "{}", one(i));
            text
        })
    }

    #[test]
    fn attributes_are_counted_tag_by_tag() {
        let element = |n| format!("<a{}/>", numbered(n, |i| format!(" a{i}='='")));
        let text = format!("<r>{}{}</r>", element(256), element(256));
        assert_eq!(excess(&text), None);
        let text = format!("<r>{}{}</r>", element(1), element(257));
        let reason = "this element has 257 attributes, and at most 256 are read".to_owned();
        let offset = text.rfind("<a").unwrap();
        assert_eq!(excess(&text), Some(Excess { offset, reason }));
    }

    #[test]
    fn prefixes_count_as_far_as_they_hold() {
        let declared = |i| format!("<a xmlns:n{i}='u'>");
        let side_by_side = numbered(1000, |i| declared(i) + "</a>");
        assert_eq!(excess(&format!("<r>{side_by_side}</r>")), None);
        assert_eq!(excess(&numbered(64, declared)), None);
        let reason = excess(&numbered(65, declared)).unwrap().reason;
        assert_eq!(
            reason,
            "65 prefixes (`xmlns:...`) hold here, and at most 64 are read"
        );
    }

    #[test]
    fn what_is_no_tag_has_no_attributes() {
        let many = "=".repeat(1000);
        for text in [
            "<!--<a {}>-->",
            "<![CDATA[<a {}>]]>",
            "<?a {}?>",
            "<a>{}</a>",
            "<a b='{}>'/>",
            "<a {}",
        ] {
            assert_eq!(excess(&text.replace("{}", &many)), None, "{text}");
        }
    }
}
