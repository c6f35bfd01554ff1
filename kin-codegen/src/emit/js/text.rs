//! Text of JavaScript in which names of a robot file are data, also where the script stands in
//! a page of HTML.

use crate::emit::curly;
use crate::spec::one_line;

/// Text that neither ends its line, nor its comment, nor the script that it stands in.
fn shown(text: &str) -> String {
    let mut out = String::new();
    let mut before = ' ';
    for c in one_line(text).chars() {
        if matches!((before, c), ('*', '/') | ('/', '*')) || before == '<' {
            out.push(' ');
        }
        out.push(c);
        before = c;
    }
    out
}

/// A comment of some paragraphs, each of which is broken between words.
pub fn comment(paragraphs: &[String]) -> String {
    curly::comment_of(paragraphs, shown)
}

/// The same, whose last line is not broken.
pub fn header(paragraphs: &[String], last: &str) -> String {
    curly::header_of(paragraphs, last, shown)
}

/// A name as a string literal. All but letters, digits and harmless signs of ASCII is escaped, so
/// that no reader of the script or of the page around it sees anything else.
pub fn string(name: &str) -> String {
    let mut out = String::from("\"");
    for unit in name.encode_utf16() {
        match u8::try_from(unit) {
            Ok(
                c @ (b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b' ' | b'_' | b'-' | b'.' | b','),
            ) => {
                out.push(char::from(c));
            }
            Ok(c @ (b'(' | b')' | b'+' | b':' | b'=' | b';' | b'[' | b']')) => {
                out.push(char::from(c));
            }
            _ => out.push_str(&format!("\\u{unit:04x}")),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_end_neither_their_comment_nor_the_script() {
        let text = comment(&["*/ </script> <!-- a\u{2028}b".into()]);
        assert_eq!(text, "/* * / < /script> < !-- a\\u{2028}b */\n");
    }

    #[test]
    fn names_do_not_end_their_string() {
        assert_eq!(string("tool0 (x)"), "\"tool0 (x)\"");
        assert_eq!(
            string("\"</script>\u{2028}\\😀"),
            "\"\\u0022\\u003c\\u002fscript\\u003e\\u2028\\u005c\\ud83d\\ude00\""
        );
    }
}
