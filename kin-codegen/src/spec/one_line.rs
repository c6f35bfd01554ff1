//! Names and lines of a robot file where they are shown: data that neither ends
//! the line that it stands in nor steers a terminal.

/// Whether a character shows itself: it neither ends a line, nor is a control
/// character, nor turns the direction of its text.
pub fn is_shown(c: char) -> bool {
    let turns = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    !turns && !c.is_control() && !matches!(c, '\u{2028}' | '\u{2029}')
}

/// Text on one line. Characters that would end it, or have a meaning to
/// terminals, are written as escapes.
///
/// ```
/// assert_eq!(kin_codegen::spec::one_line("tool\n\u{1b}[2J ä"), r"tool\n\u{1b}[2J ä");
/// ```
pub fn one_line(text: &str) -> String {
    escaped(text, is_shown)
}

/// Text with escapes for the characters that do not stay.
pub(crate) fn escaped(text: &str, stays: impl Fn(char) -> bool) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match stays(c) {
            true => out.push(c),
            false => out.extend(c.escape_default()),
        }
    }
    out
}
