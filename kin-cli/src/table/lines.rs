//! A text file in portions of whole rows.

use std::io::{self, Read};

/// Bytes that are read at once.
const BLOCK: usize = 1 << 20;

/// A row of more bytes is none of a table.
const LONGEST: usize = 1 << 20;

/// Reads rows: lines that are not blank, with those line breaks inside that stand in quotes.
pub(super) struct Lines<R> {
    input: R,
    /// What was read and not yet taken.
    buffer: Vec<u8>,
    /// Where in it the search for line breaks goes on, and where the row begins.
    scanned: usize,
    begin: usize,
    is_quoted: bool,
    is_at_end: bool,
}

/// Some rows, and how many they are.
pub(super) struct Rows {
    pub(super) text: Vec<u8>,
    pub(super) count: usize,
}

/// Why there are no rows.
pub(super) enum Stopped {
    Unreadable(io::Error),
    /// A row does not end.
    Endless,
}

impl<R: Read> Lines<R> {
    pub(super) fn new(input: R) -> Self {
        Self {
            input,
            buffer: Vec::new(),
            scanned: 0,
            begin: 0,
            is_quoted: false,
            is_at_end: false,
        }
    }

    /// The next rows, at most as many as said; blank lines among them.
    pub(super) fn take(&mut self, rows: usize) -> Result<Option<Rows>, Stopped> {
        let mut count = 0;
        while count < rows {
            let rest = &self.buffer[self.scanned..];
            match memchr::memchr2(b'\n', b'"', rest) {
                Some(at) => {
                    self.scanned += at + 1;
                    match rest[at] {
                        b'"' => self.is_quoted = !self.is_quoted,
                        _ if self.is_quoted => {}
                        _ => count += self.end_row(),
                    }
                }
                None if self.is_at_end => {
                    self.scanned = self.buffer.len();
                    count += self.end_row();
                    break;
                }
                None => {
                    self.scanned = self.buffer.len();
                    if self.scanned - self.begin > LONGEST {
                        return Err(Stopped::Endless);
                    }
                    self.read().map_err(Stopped::Unreadable)?;
                }
            }
        }
        let rest = self.buffer.split_off(self.begin);
        let text = std::mem::replace(&mut self.buffer, rest);
        (self.scanned, self.begin) = (0, 0);
        Ok((count > 0).then_some(Rows { text, count }))
    }

    /// Ends a row behind what was scanned; 0 if it is blank.
    fn end_row(&mut self) -> usize {
        let row = &self.buffer[self.begin..self.scanned];
        self.begin = self.scanned;
        usize::from(!row.trim_ascii().is_empty())
    }

    fn read(&mut self) -> io::Result<()> {
        let before = self.buffer.len();
        let mut block = (&mut self.input).take(BLOCK as u64);
        block.read_to_end(&mut self.buffer)?;
        self.is_at_end = self.buffer.len() == before;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn portions(text: &str, rows: usize) -> Vec<(String, usize)> {
        let mut lines = Lines::new(text.as_bytes());
        std::iter::from_fn(|| lines.take(rows).ok().flatten())
            .map(|rows| (String::from_utf8(rows.text).unwrap(), rows.count))
            .collect()
    }

    #[test]
    fn blank_lines_are_no_rows_and_the_last_line_needs_no_break() {
        let found = portions("a\n\r\nb\n\nc", 2);
        assert_eq!(found, [("a\n\r\nb\n".into(), 2), ("\nc".into(), 1)]);
        assert_eq!(portions("\n\n", 2), []);
    }

    #[test]
    fn a_line_break_in_quotes_ends_no_row() {
        let found = portions("\"a\nb\"\nc\n", 1);
        assert_eq!(found, [("\"a\nb\"\n".into(), 1), ("c\n".into(), 1)]);
    }

    #[test]
    fn a_row_that_does_not_end_is_not_read_to_the_end_of_the_file() {
        let text = [b"\"".to_vec(), vec![b'1'; 64 * LONGEST]].concat();
        let mut lines = Lines::new(&text[..]);
        assert!(matches!(lines.take(1), Err(Stopped::Endless)));
        assert!(lines.buffer.len() < 4 * LONGEST);
    }
}
