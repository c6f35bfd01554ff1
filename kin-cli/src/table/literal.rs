//! Literals of Python, as the heads of NPY files are written in.

use std::str::Chars;

/// A value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Literal {
    Text(String),
    Number(u64),
    Truth(bool),
    /// A tuple or a list.
    Sequence(Vec<Literal>),
    Dictionary(Vec<(Literal, Literal)>),
}

/// Values in values are few: names, lists of columns, shapes of their entries.
const DEEPEST: usize = 8;

impl Literal {
    /// Reads a literal with nothing but space behind it.
    pub(super) fn read(text: &str) -> Option<Self> {
        let mut rest = text;
        let value = value(&mut rest, DEEPEST)?;
        rest.trim().is_empty().then_some(value)
    }

    /// The value of a key.
    pub(super) fn get(&self, key: &str) -> Option<&Literal> {
        let Literal::Dictionary(entries) = self else {
            return None;
        };
        let is = |found: &Literal| matches!(found, Literal::Text(text) if text == key);
        let entry = entries.iter().find(|(found, _)| is(found));
        entry.map(|(_, value)| value)
    }
}

fn value(rest: &mut &str, deep: usize) -> Option<Literal> {
    let deep = deep.checked_sub(1)?;
    *rest = rest.trim_start();
    let first = rest.chars().next()?;
    match first {
        '\'' | '"' => {
            *rest = &rest[1..];
            text(rest, first).map(Literal::Text)
        }
        '(' => sequence(rest, ')', deep),
        '[' => sequence(rest, ']', deep),
        '{' => {
            let entry = |rest: &mut &str| {
                let key = value(rest, deep)?;
                take(rest, ':')?;
                Some((key, value(rest, deep)?))
            };
            list(rest, '}', entry).map(Literal::Dictionary)
        }
        _ => {
            let is_in = |c: char| c.is_ascii_alphanumeric();
            let end = rest.find(|c| !is_in(c)).unwrap_or(rest.len());
            let (word, behind) = rest.split_at(end);
            *rest = behind;
            match word {
                "True" => Some(Literal::Truth(true)),
                "False" => Some(Literal::Truth(false)),
                // Python 2 wrote a letter behind long integers.
                _ => word.trim_end_matches('L').parse().ok().map(Literal::Number),
            }
        }
    }
}

/// What stands before a quotation mark.
fn text(rest: &mut &str, mark: char) -> Option<String> {
    let mut text = String::new();
    let mut chars = rest.chars();
    loop {
        text.push(match chars.next()? {
            '\\' => escaped(&mut chars)?,
            c if c == mark => break,
            c => c,
        });
    }
    *rest = chars.as_str();
    Some(text)
}

/// The character that an escape behind its backslash stands for.
fn escaped(chars: &mut Chars) -> Option<char> {
    let digits = match chars.next()? {
        c @ ('\'' | '"' | '\\') => return Some(c),
        'n' => return Some('\n'),
        'r' => return Some('\r'),
        't' => return Some('\t'),
        'x' => 2,
        'u' => 4,
        'U' => 8,
        _ => return None,
    };
    let digit = |value: u32, c: char| Some(16 * value + c.to_digit(16)?);
    let value = chars.take(digits).try_fold(0_u32, digit)?;
    char::from_u32(value)
}

fn sequence(rest: &mut &str, close: char, deep: usize) -> Option<Literal> {
    list(rest, close, |rest| value(rest, deep)).map(Literal::Sequence)
}

/// What stands between a bracket and its counterpart, separated by commas.
fn list<T>(
    rest: &mut &str,
    close: char,
    mut entry: impl FnMut(&mut &str) -> Option<T>,
) -> Option<Vec<T>> {
    *rest = &rest[1..];
    let mut entries = Vec::new();
    loop {
        if take(rest, close).is_some() {
            return Some(entries);
        }
        entries.push(entry(rest)?);
        if take(rest, ',').is_none() {
            take(rest, close)?;
            return Some(entries);
        }
    }
}

/// Passes over a character, and what space is before it.
fn take(rest: &mut &str, expected: char) -> Option<()> {
    *rest = rest.trim_start().strip_prefix(expected)?;
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_of_an_array_is_read() {
        let head = "{'descr': [('a', '<f8'), (\"b\", '|b1')], 'fortran_order': False, \
                    'shape': (3,), }   \n";
        let read = Literal::read(head).unwrap();
        assert_eq!(read.get("fortran_order"), Some(&Literal::Truth(false)));
        let shape = Literal::Sequence(vec![Literal::Number(3)]);
        assert_eq!(read.get("shape"), Some(&shape));
        let Some(Literal::Sequence(fields)) = read.get("descr") else {
            panic!("{read:?}");
        };
        let text = |text: &str| Literal::Text(text.into());
        assert_eq!(fields[1], Literal::Sequence(vec![text("b"), text("|b1")]));
    }

    #[test]
    fn what_is_no_literal_is_none() {
        let deep = "(".repeat(100_000);
        for text in [
            "", "{", "{'a' 1}", "(1 2)", "'a", "1 2", "-1", "'\\x'", "é", &deep,
        ] {
            assert_eq!(Literal::read(text), None, "{text}");
        }
    }
}
