//! What C says of expressions.
//!
//! Names of the robot's own begin with `kin_` until they are [named](super::name) after it.

use super::text;
use crate::emit::language::{Function, Language, Operator};
use crate::emit::straight::{self, Trig};
use crate::expr::{RootField, RootPart};

/// The language.
pub struct C;

/// Writes parts of a graph as C.
pub type Writer<'a> = straight::Writer<'a, C>;

impl Language for C {
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
        let function = match (function, &arguments[..]) {
            (Function::Angle, [y, x]) => return format!("kin_wrap(kin_atan2({y}, {x}))"),
            (Function::Angle, _) => "",
            (Function::SelectLess, _) => "kin_select",
            (Function::Sqrt, _) => "sqrt",
            (Function::AngleInLanes, _) => "kin_angle",
            (Function::Wrap, _) => "kin_wrap",
            (Function::Max, _) => "kin_max",
        };
        format!("{function}({})", arguments.join(", "))
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
        format!("const double {name} = {value};\n")
    }

    fn roots(name: &str, coefficients: [String; 5]) -> String {
        let coefficients = coefficients.join(", ");
        format!(
            "const double of_{name}[5] = {{{coefficients}}};\nkin_root {name}[4];\n\
             kin_trig_roots(of_{name}, {name});\n"
        )
    }

    fn comment(text: &str) -> String {
        text::comment("", &[text.to_owned()])
    }
}

/// The statements that compute all sines and cosines of a function, in one loop.
pub fn bound(trig: Trig<String>) -> String {
    let Trig { sums, angles } = trig;
    let mut out = sums.concat();
    if angles.is_empty() {
        return out;
    }
    let count = angles.len();
    let values: Vec<&str> = angles.iter().map(|angle| angle.value.as_str()).collect();
    out += &format!(
        "const double angles[{count}] = {{{}}};\ndouble sines[{count}], cosines[{count}];\n\
         for (int i = 0; i < {count}; ++i) {{\n    kin_sin_cos(angles[i], &sines[i], \
         &cosines[i]);\n}}\n",
        values.join(", ")
    );
    for (i, angle) in angles.iter().enumerate() {
        for (name, array) in [(&angle.sin, "sines"), (&angle.cos, "cosines")] {
            if let Some(name) = name {
                out += &C::definition(name, format!("{array}[{i}]"));
            }
        }
    }
    out
}

/// A number with its sign, or an infinity.
pub fn signed(x: f64) -> String {
    match x {
        f64::INFINITY => "HUGE_VAL".into(),
        f64::NEG_INFINITY => "-HUGE_VAL".into(),
        x => straight::signed::<C>(x),
    }
}

/// Lines, each of them four columns further in.
pub fn indented(lines: &str) -> String {
    let line = |line: &str| match line.is_empty() {
        true => "\n".into(),
        false => format!("    {line}\n"),
    };
    lines.lines().map(line).collect()
}
