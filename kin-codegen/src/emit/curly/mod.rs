//! Languages in which C's statements mean what they mean in C: what C and JavaScript spell
//! alike, and what each of them has to say of the rest.

pub mod data;
pub mod forward;
pub mod lanes;

use super::language::{Function, Language, Operator};
use super::straight::Trig;
use crate::expr::{RootField, RootPart};

/// What C and JavaScript do not spell alike.
pub trait Curly {
    /// What a value's definition begins with.
    const DEFINES: &'static str;
    /// What a loop's index is declared by.
    const INDEX: &'static str;
    /// What stands between the struct of all lanes and its fields.
    const FIELD: &'static str;

    /// What the runtime's functions begin with.
    const PREFIX: &'static str;
    /// The square root.
    const SQRT: &'static str;

    /// The statement that solves a quartic and gives its roots a name.
    fn roots(name: &str, coefficients: &[String; 5]) -> String;
    /// The statements that compute all sines and cosines of a function.
    fn bound(trig: &Trig<String>) -> String;
    /// The statement that gives a constant array its name.
    fn table(name: &str, values: &[&str]) -> String;
    /// The statement that makes room for so many numbers.
    fn room(name: &str, count: usize) -> String;
    /// A comment, where a statement can stand.
    fn comment(text: &str) -> String;
}

impl<L: Curly> Language for L {
    type Text = String;

    fn name(name: &str) -> String {
        name.to_owned()
    }

    fn number(x: f64) -> String {
        format!("{x:?}")
    }

    fn minus(a: String) -> String {
        format!("-{a}")
    }

    fn parenthesized(a: String) -> String {
        format!("({a})")
    }

    fn infix(a: String, operator: Operator, b: String) -> String {
        let operator = match operator {
            Operator::Plus => '+',
            Operator::Minus => '-',
            Operator::Times => '*',
            Operator::Over => '/',
        };
        format!("{a} {operator} {b}")
    }

    fn call(function: Function, arguments: Vec<String>) -> String {
        let arguments = arguments.join(", ");
        let prefix = L::PREFIX;
        match function {
            Function::Sqrt => format!("{}({arguments})", L::SQRT),
            Function::Angle => format!("{prefix}wrap({prefix}atan2({arguments}))"),
            Function::AngleInLanes => format!("{prefix}angle({arguments})"),
            Function::Wrap => format!("{prefix}wrap({arguments})"),
            Function::Max => format!("{prefix}max({arguments})"),
            Function::SelectLess => format!("{prefix}select({arguments})"),
        }
    }

    fn root(quartic: &str, part: RootPart) -> String {
        let field = match part.field {
            RootField::Sin => "sine",
            RootField::Cos => "cosine",
            RootField::State => "state",
        };
        format!("{quartic}[{}].{field}", part.place)
    }

    fn sign(name: &str) -> String {
        name.to_owned()
    }

    fn of_target(entry: &str) -> String {
        entry.to_owned()
    }

    fn kept(value: &str, of_branch: bool) -> String {
        match of_branch {
            true => format!("{value}_[k]"),
            false => value.to_owned(),
        }
    }

    fn definition(name: &str, value: String) -> String {
        format!("{} {name} = {value};\n", L::DEFINES)
    }

    fn roots(name: &str, coefficients: [String; 5]) -> String {
        <L as Curly>::roots(name, &coefficients)
    }

    fn comment(text: &str) -> String {
        <L as Curly>::comment(text)
    }
}

/// A loop over k.
pub fn counted<L: Curly>(from: usize, to: usize, body: &str) -> String {
    let index = L::INDEX;
    format!("for ({index} k = {from}; k < {to}; ++k) {{\n{body}}}\n")
}

/// Lines, each of them four columns further in.
pub fn indented(lines: &str) -> String {
    let line = |line: &str| match line.is_empty() {
        true => "\n".into(),
        false => format!("    {line}\n"),
    };
    lines.lines().map(line).collect()
}

/// Paragraphs as a comment between `/*` and `*/`, each of which is broken between words; `shown`
/// makes text of names that ends neither its line nor the comment.
pub fn comment_of(paragraphs: &[String], shown: impl Fn(&str) -> String) -> String {
    let broken = |paragraph: &String| broken(&shown(paragraph), WIDTH - 3);
    block(&paragraphs.iter().flat_map(broken).collect::<Vec<_>>())
}

/// The same, whose last line is not broken.
pub fn header_of(paragraphs: &[String], last: &str, shown: impl Fn(&str) -> String) -> String {
    let broken = |paragraph: &String| broken(&shown(paragraph), WIDTH - 3);
    let mut lines: Vec<String> = paragraphs.iter().flat_map(broken).collect();
    lines.push(shown(last));
    block(&lines)
}

/// Lines of comments end here.
const WIDTH: usize = 92;

fn block(lines: &[String]) -> String {
    let inside = lines.join("\n * ").replace(" \n", "\n");
    match lines.len() {
        0 => String::new(),
        1 => format!("/* {inside} */\n"),
        _ => format!("/* {inside}\n */\n"),
    }
}

fn broken(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.len() - 1;
        let line = &mut lines[last];
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= width {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}
