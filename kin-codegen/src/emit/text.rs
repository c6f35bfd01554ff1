//! Names from a robot file in comments: data that must not end the line that it
//! stands in.

/// Text on one line. What would end the line, or turn its direction, is
/// written as an escape.
pub fn one_line(text: &str) -> String {
    let turns = |c| matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let breaks = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}');
    let mut out = String::new();
    for c in text.chars() {
        match turns(c) || breaks(c) {
            true => out.extend(c.escape_default()),
            false => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_names_stay() {
        assert_eq!(one_line("tool0 [ärm]"), "tool0 [ärm]");
    }

    #[test]
    fn a_name_does_not_end_its_line() {
        assert_eq!(
            one_line("a\nb\r\u{2028}\u{202e}"),
            "a\\nb\\r\\u{2028}\\u{202e}"
        );
    }
}
