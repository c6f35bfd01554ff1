//! Numbers in attributes, each with its place.

use crate::spec::{Collector, look_alike};
use roxmltree::Attribute;

/// The `N` numbers of an attribute, separated by white space; `None` after
/// reporting whatever is no finite number.
pub(super) fn read<const N: usize>(
    attribute: &Attribute,
    diagnostics: &mut Collector,
) -> Option<[f64; N]> {
    let name = attribute.name();
    let value = attribute.value();
    let words: Vec<&str> = value.split_ascii_whitespace().collect();
    if words.len() != N {
        let at = diagnostics.place(attribute.range_value().start);
        let commas = if value.contains(',') {
            ", separated by blanks instead of commas"
        } else {
            ""
        };
        let reason = format!(
            "{name}=\"{value}\" has {} where {N} belong{}",
            count(words.len()),
            if N == 1 { "s" } else { "" }
        );
        let remedy = look_alike::remedy(value);
        let remedy = remedy.unwrap_or_else(|| format!("write {}{commas}", count(N)));
        diagnostics.at(at, reason, remedy);
        return None;
    }
    let mut numbers = [0.0; N];
    for (number, word) in numbers.iter_mut().zip(words) {
        *number = finite(word, attribute, diagnostics)?;
    }
    Some(numbers)
}

fn finite(word: &str, attribute: &Attribute, diagnostics: &mut Collector) -> Option<f64> {
    // In a value with entities the word's offset differs from the file's.
    let inside = word.as_ptr() as usize - attribute.value().as_ptr() as usize;
    let verbatim = attribute.range_value().len() == attribute.value().len();
    let start = attribute.range_value().start + if verbatim { inside } else { 0 };
    let at = diagnostics.place(start);
    match word.parse::<f64>() {
        Ok(number) if number.is_finite() => Some(number),
        Ok(_) => {
            let reason = format!("{}: `{word}` is not a finite number", attribute.name());
            let remedy = match attribute.name() {
                "lower" | "upper" => {
                    "write the value in metres or radians; a joint that turns without stops is \
                     type=\"continuous\""
                }
                _ => "write the value in metres or radians",
            };
            diagnostics.at(at, reason, remedy);
            None
        }
        Err(_) => {
            let reason = format!("{}: `{word}` is not a number", attribute.name());
            diagnostics.at(at, reason, plainly(word));
            None
        }
    }
}

/// Reports an attribute that is not read, unless it is a number or
/// empty: a file with junk in it has been damaged elsewhere too.
pub(super) fn refuse_junk(attribute: &Attribute, diagnostics: &mut Collector) {
    let word = attribute.value().trim();
    if !word.is_empty() && word.parse::<f64>().is_err() {
        let at = diagnostics.place(attribute.range_value().start);
        let reason = format!("{}: `{word}` is not a number", attribute.name());
        diagnostics.at(at, reason, plainly(word));
    }
}

/// How to write what is no number.
fn plainly(word: &str) -> String {
    if let Some(remedy) = look_alike::remedy(word) {
        return remedy;
    }
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    let point = word.replacen(',', ".", 1);
    if is_number(word.trim_matches(',')) {
        "separate the numbers by blanks instead of commas".into()
    } else if is_number(&point) {
        format!("write a decimal point: {point}")
    } else {
        "write a plain decimal number such as 1.5707963267948966".into()
    }
}

fn count(n: usize) -> String {
    match n {
        0 => "no number".into(),
        1 => "1 number".into(),
        n => format!("{n} numbers"),
    }
}
