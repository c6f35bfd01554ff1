//! Characters that look like those of a number, or like a quote, as they are copied from documents.

/// What to write in place of the first of them in a text, if it has one.
pub(crate) fn remedy(text: &str) -> Option<String> {
    text.chars().find_map(|c| {
        let meant = match c {
            '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{fe63}' | '\u{ff0d}' => "`-`",
            '\u{a0}' | '\u{2000}'..='\u{200b}' | '\u{202f}' | '\u{3000}' => "a blank",
            '\u{2018}'..='\u{201f}' | '\u{2032}' | '\u{2033}' | '\u{ff02}' => "`\"`",
            _ => return None,
        };
        let code = u32::from(c);
        Some(format!(
            "write {meant} in place of U+{code:04X}, which looks like it"
        ))
    })
}
