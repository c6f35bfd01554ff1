//! From byte offsets of a text to lines and columns.
//!
//! Places are asked for often, and a file can be one long line: neither lines
//! nor characters are counted anew each time.

use super::Location;

/// Longer lines (generated XML without line breaks) are cut around a place.
const LINE_WIDTH: usize = 160;

/// Bytes between two places at which characters are counted beforehand.
const STRIDE: usize = 256;

/// Where the lines and characters of a text are.
pub(crate) struct Places<'t> {
    text: &'t str,
    /// Offsets at which lines start.
    lines: Vec<usize>,
    /// Characters before every `STRIDE`-th byte.
    characters: Vec<usize>,
}

impl<'t> Places<'t> {
    pub(crate) fn of(text: &'t str) -> Self {
        let breaks = text.match_indices('\n').map(|(i, _)| i + 1);
        let mut before = 0;
        let counted = text.as_bytes().chunks(STRIDE).map(|block| {
            let here = before;
            before += characters(block);
            here
        });
        Places {
            text,
            characters: counted.collect(),
            lines: std::iter::once(0).chain(breaks).collect(),
        }
    }

    /// The place of a byte offset.
    pub(crate) fn at(&self, offset: usize) -> Location {
        let line = self.lines.partition_point(|&start| start <= offset);
        let column = self.characters_before(offset) - self.characters_before(self.lines[line - 1]);
        Location {
            line: line as u32,
            column: column as u32 + 1,
        }
    }

    /// The line of a place, cut around it if it is long, and how many of the
    /// line's characters are left out before.
    pub(crate) fn excerpt(&self, at: Location) -> (&'t str, u32) {
        let line = self.line(at.line);
        // Most lines are short, and their bytes counted at once.
        if line.len() <= LINE_WIDTH {
            return (line, 0);
        }
        let first = self.lines[at.line as usize - 1];
        let last = first + line.len();
        let left = (at.column as usize - 1).saturating_sub(LINE_WIDTH / 2);
        let start = self.offset(first, left).min(last);
        let end = self.offset(start, LINE_WIDTH).min(last);
        if start == first && end == last {
            return (line, 0);
        }
        (&self.text[start..end], left as u32)
    }

    /// The offset of the character that comes `count` characters behind another.
    fn offset(&self, from: usize, count: usize) -> usize {
        let wanted = self.characters_before(from) + count;
        let block = self.characters.partition_point(|&before| before <= wanted) - 1;
        // A character may begin in the block before.
        let near = (block * STRIDE).max(from);
        let start = (near..)
            .find(|&i| self.text.is_char_boundary(i))
            .unwrap_or(near);
        let missing = wanted - self.characters_before(start);
        let mut rest = self.text[start..].char_indices();
        rest.nth(missing)
            .map_or(self.text.len(), |(i, _)| start + i)
    }

    /// A line, counted from 1, without its line break; empty if there is none.
    fn line(&self, number: u32) -> &'t str {
        let number = number as usize;
        let start = self.lines.get(number.wrapping_sub(1));
        let end = self.lines.get(number).copied().unwrap_or(self.text.len());
        let line = start.and_then(|&start| self.text.get(start..end));
        line.unwrap_or("").trim_end_matches(['\n', '\r'])
    }

    fn characters_before(&self, offset: usize) -> usize {
        let offset = offset.min(self.text.len());
        let block = offset / STRIDE;
        match self.characters.get(block) {
            Some(before) => before + characters(&self.text.as_bytes()[block * STRIDE..offset]),
            // The text ends where a block does.
            None => match block.checked_sub(1) {
                Some(last) => {
                    self.characters[last] + characters(&self.text.as_bytes()[last * STRIDE..])
                }
                None => 0,
            },
        }
    }
}

/// How many characters begin in these bytes.
fn characters(utf8: &[u8]) -> usize {
    utf8.iter().filter(|&&byte| byte & 0xc0 != 0x80).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_those_of_counting_from_the_start() {
        let text = "é\n<a>\r\n".to_string() + &"äx".repeat(400) + "\nend";
        let places = Places::of(&text);
        for (offset, _) in text.char_indices().chain([(text.len(), ' ')]) {
            let before = &text[..offset];
            let start = before.rfind('\n').map_or(0, |i| i + 1);
            let expected = Location {
                line: before.matches('\n').count() as u32 + 1,
                column: before[start..].chars().count() as u32 + 1,
            };
            assert_eq!(places.at(offset), expected, "{offset}");
        }
        assert_eq!(places.line(2), "<a>");
        for column in 1..800 {
            let (shown, cut) = places.excerpt(Location { line: 3, column });
            let expected = column.saturating_sub(81);
            assert_eq!(cut, expected);
            let line: String = "äx"
                .repeat(400)
                .chars()
                .skip(cut as usize)
                .take(160)
                .collect();
            assert_eq!(shown, line, "{column}");
        }
        assert_eq!(places.line(4), "end");
        assert_eq!(places.line(9), "");
    }

    #[test]
    fn a_text_that_ends_with_a_block_has_an_end() {
        for length in [0, STRIDE, 2 * STRIDE] {
            let text = "x".repeat(length);
            assert_eq!(Places::of(&text).at(length).column, length as u32 + 1);
        }
    }
}
