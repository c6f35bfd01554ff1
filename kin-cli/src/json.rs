//! JSON that shows on a terminal what it holds.

use kin_codegen::spec::is_shown;
use serde::Serialize;

/// A value as indented JSON. Characters that steer a terminal or turn the direction
/// of text are written as escapes: JSON itself asks that of a few alone.
pub fn pretty(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let json = serde_json::to_string_pretty(value)?;
    let mut shown = String::with_capacity(json.len() + 1);
    for c in json.chars() {
        // They stand in strings, but for the ends of lines.
        match c == '\n' || is_shown(c) {
            true => shown.push(c),
            false => (c.encode_utf16(&mut [0; 2]).iter())
                .for_each(|unit| shown += &format!("\\u{unit:04x}")),
        }
    }
    shown.push('\n');
    Ok(shown)
}
