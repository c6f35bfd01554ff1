//! Comments beside tokens.
//!
//! A comment is no token, and `quote!` drops it. Where generated code is to
//! have one, a statement or item marks the place, `__comment!("text");`. Code
//! that is printed has the comment there; tokens that are compiled as they are
//! lose the marker.

use crate::emit::header::Header;
use crate::emit::text::one_line;
use proc_macro2::{Group, Ident, Literal, TokenStream, TokenTree};
use quote::quote;

const MARKER: &str = "__comment";

/// Printed lines end here; a longer comment goes on in the next line.
const WIDTH: usize = 88;

/// The marker of a comment, where a statement or an item can stand.
pub fn comment(text: &str) -> TokenStream {
    let marker = Ident::new(MARKER, proc_macro2::Span::call_site());
    let text = Literal::string(text);
    quote!(#marker!(#text);)
}

/// The tokens without markers.
pub fn without_comments(tokens: TokenStream) -> TokenStream {
    let mut kept = Vec::new();
    let mut rest = tokens.into_iter();
    while let Some(tree) = rest.next() {
        match tree {
            TokenTree::Ident(ident) if ident == MARKER => {
                // Its `!`, text and semicolon.
                rest.by_ref().take(3).for_each(drop);
            }
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), without_comments(group.stream()));
                inner.set_span(group.span());
                kept.push(TokenTree::Group(inner));
            }
            other => kept.push(other),
        }
    }
    kept.into_iter().collect()
}

/// The items as formatted source, with a blank line between any two. Numbers of an array that has
/// a line for each share lines.
pub fn print(items: TokenStream) -> String {
    let file = syn::parse2(items)
        .unwrap_or_else(|error| unreachable!("the emitted items do not parse: {error}"));
    let mut out = String::new();
    let mut before = "";
    let formatted = prettyplease::unparse(&file);
    let mut lines = formatted.lines();
    while let Some(line) = lines.next() {
        if is_apart(before, line) {
            out.push('\n');
        }
        match marked(line, &mut lines) {
            Some(text) => push_comment(&mut out, indent(line), &text),
            None if is_number(before) && is_number(line) => push_number(&mut out, line),
            None => {
                out.push_str(line);
                out.push('\n');
            }
        }
        before = line;
    }
    out
}

/// The comment at the top of a file.
pub fn header(header: &Header) -> String {
    let mut out = String::new();
    for paragraph in &header.paragraphs {
        push_comment(&mut out, "", paragraph);
    }
    push_line(&mut out, &header.made_by);
    out
}

/// `text` as one line of a comment, however long.
fn push_line(out: &mut String, text: &str) {
    out.push_str("// ");
    out.push_str(&one_line(text));
    out.push('\n');
}

/// `text` as lines of a comment.
fn push_comment(out: &mut String, indent: &str, text: &str) {
    let mut line = format!("{indent}//");
    let empty = line.len();
    for word in one_line(text).split(' ') {
        if line.len() > empty && line.chars().count() + 1 + word.chars().count() > WIDTH {
            out.push_str(&line);
            out.push('\n');
            line.truncate(empty);
        }
        line.push(' ');
        line.push_str(word);
    }
    out.push_str(&line);
    out.push('\n');
}

/// Whether all of a line is a number of an array.
fn is_number(line: &str) -> bool {
    let number = line.trim_start().strip_suffix(',');
    number.is_some_and(|number| number.parse::<f64>().is_ok())
}

/// A number behind another one, in its line if there is room.
fn push_number(out: &mut String, line: &str) {
    let number = line.trim_start();
    let last = out.trim_end().rsplit('\n').next().unwrap_or_default();
    if last.len() + 1 + number.len() > WIDTH {
        out.push_str(line);
    } else {
        out.truncate(out.trim_end().len());
        out.push(' ');
        out.push_str(number);
    }
    out.push('\n');
}

/// Whether a new item begins behind one that ended.
fn is_apart(before: &str, line: &str) -> bool {
    let is_use = |line: &str| line.trim_start().starts_with("use ");
    let ends = matches!(before.trim_start(), "}" | "};" | "];") || is_use(before);
    let begins = ["///", "#[", "pub ", "fn ", "const ", "impl ", "mod "];
    let begins = begins
        .iter()
        .any(|word| line.trim_start().starts_with(word));
    ends && begins && indent(before) == indent(line)
}

fn indent(line: &str) -> &str {
    &line[..line.len() - line.trim_start().len()]
}

/// The text of a marker that begins in a line. A long one goes on in the next
/// line and ends in the one behind it.
fn marked<'a>(line: &'a str, next: &mut impl Iterator<Item = &'a str>) -> Option<String> {
    let text = line.trim_start().strip_prefix(MARKER)?.strip_prefix("!(")?;
    let text = match text {
        "" => {
            let text = next.next()?;
            next.next();
            text
        }
        _ => text.strip_suffix(");")?,
    };
    Some(syn::parse_str::<syn::LitStr>(text).ok()?.value())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn function(text: &str) -> TokenStream {
        let comment = comment(text);
        quote!(fn f(x: f64) -> f64 { #comment let y = x; { #comment } y })
    }

    #[test]
    fn a_marker_is_printed_as_a_comment() {
        let code = print(function("1. q1 by SP4"));
        let expected = "fn f(x: f64) -> f64 {\n    // 1. q1 by SP4\n    let y = x;\n    {\n        \
                        // 1. q1 by SP4\n    }\n    y\n}\n";
        assert_eq!(code, expected);
    }

    #[test]
    fn numbers_of_an_array_share_lines() {
        let numbers = (1..30).map(|k| Literal::f64_unsuffixed(1.0 / f64::from(k * k * k)));
        let numbers = quote!(const NUMBERS: [f64; 29] = [#(-#numbers,)*];);
        let code = print(numbers.clone());
        let lines: Vec<&str> = code.lines().collect();
        assert!(lines.iter().all(|line| line.len() <= WIDTH), "{code}");
        assert!(lines.len() < 12, "{code}");
        let printed: TokenStream = code.parse().unwrap();
        assert_eq!(printed.to_string(), numbers.to_string());
    }

    #[test]
    fn tokens_are_the_same_without_markers() {
        let plain = quote!(
            fn f(x: f64) -> f64 {
                let y = x;
                {}
                y
            }
        );
        let stripped = without_comments(function("anything"));
        assert_eq!(stripped.to_string(), plain.to_string());
    }

    #[test]
    fn text_cannot_leave_its_comment() {
        for text in [
            "\nlet x = 2;",
            "\r\nlet x = 2;",
            "\"); let x = 2; //",
            "*/ \u{202e}",
        ] {
            let code = print(function(text));
            let tokens: TokenStream = code.parse().unwrap();
            let expected = without_comments(function(""));
            assert_eq!(tokens.to_string(), expected.to_string(), "{code}");
            assert!(!code.contains('\u{202e}'));
        }
    }

    #[test]
    fn names_do_not_leave_the_header() {
        let header = header(&Header {
            paragraphs: vec!["From a\nb.urdf".into()],
            made_by: "kin generate 'a\nb.urdf'".into(),
        });
        assert!(
            header.lines().all(|line| line.starts_with("// ")),
            "{header}"
        );
        assert!(header.contains(r"'a\nb.urdf'"), "{header}");
    }

    #[test]
    fn long_comments_are_broken_between_words() {
        let code = print(function(&"word ".repeat(40)));
        assert!(
            code.lines().all(|line| line.chars().count() <= WIDTH),
            "{code}"
        );
        assert_eq!(code.matches("word").count(), 80);
        assert!(!code.contains(MARKER), "{code}");
    }
}
