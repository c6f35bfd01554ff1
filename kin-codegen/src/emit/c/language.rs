//! What C says of expressions.
//!
//! Names of the robot's own begin with `kin_` until they are [named](super::name) after it.

use super::text;
use crate::emit::curly::Curly;
use crate::emit::language::Language;
use crate::emit::straight::{self, Trig};

/// The language.
pub struct C;

impl Curly for C {
    const DEFINES: &'static str = "const double";
    const INDEX: &'static str = "int";
    const FIELD: &'static str = "->";
    const PREFIX: &'static str = "kin_";
    const SQRT: &'static str = "sqrt";

    fn roots(name: &str, coefficients: &[String; 5]) -> String {
        let coefficients = coefficients.join(", ");
        format!(
            "const double of_{name}[5] = {{{coefficients}}};\nkin_root {name}[4];\n\
             kin_trig_roots(of_{name}, {name});\n"
        )
    }

    /// In one loop.
    fn bound(trig: &Trig<String>) -> String {
        let mut out = trig.sums.concat();
        let angles = &trig.angles;
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

    fn table(name: &str, values: &[&str]) -> String {
        let (count, values) = (values.len(), values.join(", "));
        format!("static const double {name}[{count}] = {{{values}}};\n")
    }

    fn room(name: &str, count: usize) -> String {
        format!("double {name}[{count}];\n")
    }

    fn comment(text: &str) -> String {
        text::comment(&[text.to_owned()])
    }
}

/// A number with its sign, or an infinity.
pub fn signed(x: f64) -> String {
    match x {
        f64::INFINITY => "HUGE_VAL".into(),
        f64::NEG_INFINITY => "-HUGE_VAL".into(),
        x => straight::signed::<C>(x),
    }
}

/// A list of numbers, as an initializer.
pub fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    let values: Vec<String> = values.into_iter().map(signed).collect();
    format!("{{{}}}", values.join(", "))
}
