//! Where the tokens of a YAML text are.
//!
//! The parser tells the place of an error and of nothing else, and takes time
//! quadratic in the depth of brackets before it tells anything. So the text is
//! cut into tokens first: brackets and their depth are known before the parser
//! sees them, and nodes find their places among the tokens.
//!
//! Which character begins what is as in libyaml. Constructs whose end would
//! have to be found by indentation, or that no robot needs, are refused.

use crate::spec::bounds::YAML_DEPTH;

/// A piece of the text from which the place of a node is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: Kind,
    /// Byte offset.
    pub start: usize,
    /// Byte offset behind it.
    pub end: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `[` or `{`.
    Open,
    /// The `-` before an entry of a list.
    Dash,
    /// `*name`.
    Alias,
    /// A number, a word or a quoted text. One without quotes that goes over
    /// several lines may be several of these.
    Scalar,
}

/// What is YAML and not read, and where.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Unsupported {
    pub offset: usize,
    pub reason: String,
    pub remedy: &'static str,
}

/// All tokens, in the order of the text.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, Unsupported> {
    let mut scanner = Scanner {
        text,
        at: 0,
        depth: 0,
        tokens: Vec::new(),
    };
    // The parser says of these that they are in line 1.
    if let Some((offset, control)) = text.char_indices().find(|(_, c)| is_control(*c)) {
        scanner.at = offset;
        let reason = format!(
            "the control character U+{:04X} stands here",
            u32::from(control)
        );
        return Err(scanner.unsupported(
            reason,
            "remove it, or write it as an escape in double quotes",
        ));
    }
    while scanner.skip_blank() {
        scanner.token()?;
    }
    Ok(scanner.tokens)
}

struct Scanner<'t> {
    text: &'t str,
    at: usize,
    /// How many brackets are open.
    depth: usize,
    tokens: Vec<Token>,
}

impl Scanner<'_> {
    /// Goes to the next character that begins something, if there is one.
    fn skip_blank(&mut self) -> bool {
        loop {
            match self.peek() {
                None => return false,
                Some('#') => self.skip_while(|c| !is_break(c)),
                Some(c) if is_blank(c) => self.skip_while(is_blank),
                Some(_) => return true,
            }
        }
    }

    fn token(&mut self) -> Result<(), Unsupported> {
        let start = self.at;
        let flow = self.depth > 0;
        let Some(first) = self.peek() else {
            return Ok(());
        };
        let separate = self.is_blank_at(start + first.len_utf8());
        match first {
            '[' | '{' => self.open(start)?,
            ']' | '}' => {
                self.depth = self.depth.saturating_sub(1);
                self.at += 1;
            }
            ',' => self.at += 1,
            '-' if separate => self.push(Kind::Dash, start + 1),
            ':' if separate || flow => self.at += 1,
            '-' | '.' if self.is_document_mark() => self.at += 3,
            '?' if separate || flow => {
                return Err(
                    self.unsupported("a key marked by `?` is not read", "write `key: value`")
                );
            }
            '|' | '>' if !flow => {
                let reason = format!("a block of text (`{first}`) is not read");
                return Err(self.unsupported(reason, "write the text in quotes, on one line"));
            }
            '*' => {
                let end = self.behind_name(start + 1);
                self.push(Kind::Alias, end);
            }
            '&' => self.at = self.behind_name(start + 1),
            '!' => self.skip_while(|c| !is_blank(c) && c != ','),
            '"' | '\'' => {
                let end = self.behind_quote(first);
                self.push(Kind::Scalar, end);
            }
            _ => {
                let end = self.behind_word();
                self.push(Kind::Scalar, end);
            }
        }
        Ok(())
    }

    fn open(&mut self, start: usize) -> Result<(), Unsupported> {
        self.depth += 1;
        if self.depth > YAML_DEPTH {
            return Err(
                self.unsupported(too_deep(), "close the brackets before; a robot needs four")
            );
        }
        self.push(Kind::Open, start + 1);
        Ok(())
    }

    /// Behind a quoted text, or at the end if the quote is missing.
    fn behind_quote(&self, quote: char) -> usize {
        let bytes = self.text.as_bytes();
        let mut at = self.at + 1;
        while let Some(&byte) = bytes.get(at) {
            match byte {
                b'\\' if quote == '"' => at += 2,
                b'\'' if quote == '\'' && bytes.get(at + 1) == Some(&b'\'') => at += 2,
                _ if byte == quote as u8 => return at + 1,
                _ => at += 1,
            }
        }
        self.text.len()
    }

    /// Behind a text without quotes. Between brackets it goes on over line
    /// breaks; elsewhere the next line may or may not belong to it, and is
    /// looked at on its own.
    fn behind_word(&self) -> usize {
        let flow = self.depth > 0;
        let mut end = self.at;
        let mut blank = false;
        for (i, c) in self.text[self.at..].char_indices() {
            let at = self.at + i;
            let ends = match c {
                '#' => blank,
                ':' => self.is_blank_at(at + 1),
                ',' | '[' | ']' | '{' | '}' => flow,
                c => is_break(c) && !flow,
            };
            // The first character is a text's, whatever it is.
            if ends && i > 0 {
                break;
            }
            blank = is_blank(c);
            if !blank {
                end = at + c.len_utf8();
            }
        }
        end
    }

    /// Behind the name of an anchor.
    fn behind_name(&self, start: usize) -> usize {
        let other = |c: char| !(c.is_ascii_alphanumeric() || matches!(c, '-' | '_'));
        let length = self.text[start..].find(other);
        length.map_or(self.text.len(), |length| start + length)
    }

    /// `---` or `...`, alone at the start of a line.
    fn is_document_mark(&self) -> bool {
        let rest = &self.text[self.at..];
        let first = self.text[..self.at]
            .chars()
            .next_back()
            .is_none_or(is_break);
        first
            && (rest.starts_with("---") || rest.starts_with("..."))
            && self.is_blank_at(self.at + 3)
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    /// Whether there is a blank, or nothing, at an offset.
    fn is_blank_at(&self, offset: usize) -> bool {
        let rest = self.text.get(offset..);
        rest.is_some_and(|rest| rest.chars().next().is_none_or(is_blank))
    }

    fn skip_while(&mut self, skipped: impl Fn(char) -> bool) {
        let length = self.text[self.at..].find(|c| !skipped(c));
        self.at = length.map_or(self.text.len(), |length| self.at + length);
    }

    fn push(&mut self, kind: Kind, end: usize) {
        let start = self.at;
        self.tokens.push(Token { kind, start, end });
        self.at = end;
    }

    fn unsupported(&self, reason: impl Into<String>, remedy: &'static str) -> Unsupported {
        Unsupported {
            offset: self.at,
            reason: reason.into(),
            remedy,
        }
    }
}

/// Why brackets, lists and mappings may not go on inside one another.
pub(super) fn too_deep() -> String {
    format!(
        "{YAML_DEPTH} brackets, lists and mappings stand here one inside another, and no more are read"
    )
}

/// What YAML has only as escapes.
fn is_control(c: char) -> bool {
    let allowed = is_blank(c) || !c.is_control();
    !allowed || matches!(c, '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

fn is_break(c: char) -> bool {
    matches!(c, '\n' | '\r' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t') || is_break(c)
}
