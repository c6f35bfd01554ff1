//! What JavaScript says of expressions. Functions of the runtime begin with `$`, since values
//! may have any other name.

use super::text;
use crate::emit::curly::{Curly, indented};
use crate::emit::straight::{self, Trig};

/// The language, as of ECMAScript 2020.
pub struct JavaScript;

impl Curly for JavaScript {
    const DEFINES: &'static str = "const";
    const INDEX: &'static str = "let";
    const FIELD: &'static str = ".";
    const PREFIX: &'static str = "$";
    const SQRT: &'static str = "Math.sqrt";

    fn roots(name: &str, coefficients: &[String; 5]) -> String {
        format!(
            "const {name} = $trig_roots([{}]);\n",
            coefficients.join(", ")
        )
    }

    fn bound(trig: &Trig<String>) -> String {
        let angles = trig.angles.iter().map(|angle| {
            let of = [("sine", &angle.sin), ("cosine", &angle.cos)];
            let names = of
                .iter()
                .filter_map(|(field, name)| Some(format!("{field}: {}", name.as_ref()?)));
            let names: Vec<String> = names.collect();
            format!(
                "const {{ {} }} = $sin_cos({});\n",
                names.join(", "),
                angle.value
            )
        });
        trig.sums.concat() + &angles.collect::<String>()
    }

    fn table(name: &str, values: &[&str]) -> String {
        format!("const {name} = [{}];\n", values.join(", "))
    }

    fn room(name: &str, count: usize) -> String {
        format!("const {name} = new Float64Array({count});\n")
    }

    fn comment(text: &str) -> String {
        text::comment(&[text.to_owned()])
    }
}

/// A number with its sign, or an infinity.
pub fn signed(x: f64) -> String {
    match x {
        f64::INFINITY => "Infinity".into(),
        f64::NEG_INFINITY => "-Infinity".into(),
        x => straight::signed::<JavaScript>(x),
    }
}

/// An array of numbers.
pub fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    array(values.into_iter().map(signed))
}

/// An array.
pub fn array(items: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", items.into_iter().collect::<Vec<_>>().join(", "))
}

/// The rows of a definition, `name: value` each.
pub fn object(fields: &[(&str, String)]) -> String {
    let fields = fields
        .iter()
        .map(|(name, value)| format!("{name}: {value},\n"));
    format!("{{\n{}}}", indented(&fields.collect::<String>()))
}

/// A function of one statement list that begins with an array and gives it back.
pub fn filling(parameters: &str, name: &str, count: usize, statements: &str) -> String {
    let room = JavaScript::room(name, count);
    let body = format!("{room}{statements}return {name};\n");
    format!("({parameters}) => {{\n{}}}", indented(&body))
}
