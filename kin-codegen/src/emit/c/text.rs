//! Text of C in which names of a robot file are data.

use crate::emit::curly;
use crate::spec::one_line;

/// Text that neither ends its line nor its comment, nor has a trigraph.
fn shown(text: &str) -> String {
    let mut out = String::new();
    let mut before = ' ';
    for c in one_line(text).chars() {
        if matches!((before, c), ('*', '/') | ('/', '*') | ('?', '?')) {
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

/// A name as a string literal of its UTF-8 bytes. A NUL, which would end it, is written as
/// Java's "modified UTF-8" does: C0 80.
pub fn string(name: &str) -> String {
    let mut out = String::from("\"");
    for byte in name.bytes() {
        match byte {
            0 => out.push_str("\\300\\200"),
            // A question mark could begin a trigraph.
            b'"' | b'\\' | b'?' => {
                out.push('\\');
                out.push(char::from(byte));
            }
            b' '..=b'~' => out.push(char::from(byte)),
            _ => out.push_str(&format!("\\{byte:03o}")),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_end_their_comment() {
        let text = comment(&["a*/b/**/c??/d\ne".into()]);
        assert_eq!(text, "/* a* /b/ ** /c? ?/d\\ne */\n");
    }

    #[test]
    fn names_do_not_end_their_string() {
        assert_eq!(string("tool0"), "\"tool0\"");
        assert_eq!(
            string("\"; system(\"\\??/\n0ä\0"),
            r#""\"; system(\"\\\?\?/\0120\303\244\300\200""#
        );
    }
}
