//! Names from a robot file in comments and documentation: data that must not
//! end the line, the code span or the table that it stands in.

use proc_macro2::Literal;

/// Whether a character would end a line, or turn the direction of its text.
fn is_written(c: char) -> bool {
    let turns =
        matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    !turns && !c.is_control() && !matches!(c, '\u{2028}' | '\u{2029}')
}

/// Text on one line. What would end the line is written as an escape.
pub fn one_line(text: &str) -> String {
    escaped(text, is_written)
}

/// A name as a string literal, which the compiler does not suspect of hiding
/// code.
pub fn literal(name: &str) -> Literal {
    let text = escaped(name, |c| is_written(c) && !matches!(c, '"' | '\\'));
    let literal = format!("\"{text}\"").parse();
    literal.unwrap_or_else(|_| Literal::string(name))
}

fn escaped(text: &str, stays: impl Fn(char) -> bool) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match stays(c) {
            true => out.push(c),
            false => out.extend(c.escape_default()),
        }
    }
    out
}

/// A name as a Markdown code span, also in a table.
pub fn code(name: &str) -> String {
    let name = one_line(name).replace('|', "\\|");
    let longest = name.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    match longest {
        0 => format!("`{name}`"),
        // A fence that the name does not contain.
        _ => {
            let fence = "`".repeat(longest + 1);
            format!("{fence} {name} {fence}")
        }
    }
}

/// With at most so many digits behind the point.
pub fn number(x: f64, digits: i32) -> String {
    let scale = 10_f64.powi(digits);
    format!("{}", (x * scale).round() / scale + 0.0)
}

/// Radians in degrees, with at most two digits behind the point.
pub fn degrees(radians: f64) -> String {
    number(radians.to_degrees(), 2)
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

    #[test]
    fn a_name_does_not_end_its_code_span_or_cell() {
        assert_eq!(code("base_link"), "`base_link`");
        assert_eq!(code("a`b``c"), "``` a`b``c ```");
        assert_eq!(code("a|b"), "`a\\|b`");
    }
}
