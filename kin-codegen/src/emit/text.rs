//! Names from a robot file in comments and documentation: data that must not
//! end the line, the code span or the table that it stands in.

pub use crate::spec::one_line;
use crate::spec::{escaped, is_shown};
use proc_macro2::Literal;

/// A name as a string literal, which the compiler does not suspect of hiding
/// code.
pub fn literal(name: &str) -> Literal {
    let text = escaped(name, |c| is_shown(c) && !matches!(c, '"' | '\\'));
    let literal = format!("\"{text}\"").parse();
    literal.unwrap_or_else(|_| Literal::string(name))
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
