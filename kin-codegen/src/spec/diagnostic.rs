//! Diagnostics as data: a place, a reason and a remedy.

use super::places::Places;
use super::{Source, bounds, is_shown, one_line};
use std::fmt;

/// A place in a robot file, both counted from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Location {
    /// The line, from 1.
    pub line: u32,
    /// The character in the line, from 1; a tab is one.
    pub column: u32,
}

/// One thing that is wrong: where, why, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Where; `None` when it is about the robot as a whole.
    pub at: Option<Location>,
    /// The offending line, without its line break; empty without a place. Of a
    /// long line, the part around the place.
    pub line: String,
    /// How many characters of a long line are left out before that part.
    pub cut: u32,
    /// What was found and why it matters: one line, and those of a list.
    pub reason: String,
    /// What to do.
    pub remedy: String,
    /// Whether it keeps the file from being used.
    pub severity: Severity,
}

/// Whether a diagnostic keeps a file from being used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// What is said here can change a frame or a joint value.
    Error,
    /// It cannot.
    Warning,
    /// The file is sound, and describes more than one robot: an option has to
    /// choose.
    Ambiguity,
}

/// Everything wrong with one robot file; never empty.
///
/// Displayed as a compiler would, one paragraph per diagnostic:
///
/// ```text
/// arm.urdf:42:17: joint `elbow` has the axis 0 0 0, which is no direction
///     <axis xyz="0 0 0"/>
///                ^
/// help: write the direction the joint turns about, for example xyz="0 0 1"
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics {
    path: String,
    /// Never empty: no constructor makes it so.
    list: Vec<Diagnostic>,
}

/// Stands in a shown line for a character that is not: one column wide, so that
/// the caret stays where it points.
const UNSHOWN: char = '\u{fffd}';

/// More than this is noise: the first diagnostics usually explain the rest.
const SHOWN: usize = 20;

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, diagnostic) in self.iter().take(SHOWN).enumerate() {
            if i > 0 {
                f.write_str("\n\n")?;
            }
            diagnostic.write(&self.path, f)?;
        }
        match self.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => write!(f, "\n\n{}: and {more} more", one_line(&self.path)),
        }
    }
}

impl std::error::Error for Diagnostics {}

impl Diagnostics {
    /// One diagnostic about the file that the user named `path`.
    pub fn one(path: impl Into<String>, diagnostic: Diagnostic) -> Self {
        Self {
            path: path.into(),
            list: vec![diagnostic],
        }
    }

    /// Several, in the order of the file; none of an empty list.
    pub fn of(path: &str, mut list: Vec<Diagnostic>) -> Option<Self> {
        // Those about the robot as a whole come last.
        list.sort_by_key(|diagnostic| (diagnostic.at.is_none(), diagnostic.at));
        list.dedup();
        (!list.is_empty()).then(|| Self {
            path: path.into(),
            list,
        })
    }

    /// These and others about the same file, in its order.
    pub(crate) fn and(self, other: Self) -> Self {
        let list = self.iter().chain(other.iter()).cloned().collect();
        Self::of(&self.path, list).unwrap_or(self)
    }

    /// The same, all of them errors.
    pub(crate) fn into_errors(self) -> Self {
        let error = |diagnostic| Diagnostic {
            severity: Severity::Error,
            ..diagnostic
        };
        Self {
            path: self.path,
            list: self.list.into_iter().map(error).collect(),
        }
    }

    /// The file, as the user named it.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The first in the file, which usually explains the rest.
    pub fn first(&self) -> &Diagnostic {
        &self.list[0]
    }

    /// All of them, in the order of the file; those about the robot as a whole
    /// come last.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// Whether the file is sound, and the user only has to choose.
    pub fn is_ambiguous(&self) -> bool {
        let mut severities = self.iter().map(|diagnostic| diagnostic.severity);
        severities.all(|severity| severity == Severity::Ambiguity)
    }

    /// How many there are: one at least.
    #[allow(clippy::len_without_is_empty, reason = "never empty")]
    pub fn len(&self) -> usize {
        self.list.len()
    }
}

impl Diagnostic {
    /// About the robot as a whole.
    pub fn whole(reason: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self {
            at: None,
            line: String::new(),
            cut: 0,
            reason: one_line(&brief(reason.into())),
            remedy: one_line(&brief(remedy.into())),
            severity: Severity::Error,
        }
    }

    /// The same as a warning.
    pub fn warning(self) -> Self {
        Self {
            severity: Severity::Warning,
            ..self
        }
    }

    /// About a place in a file.
    pub fn at(
        at: Location,
        source: &Source,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::whole(reason, remedy).in_text(at, &Places::of(&source.text))
    }

    /// The same about a place in a text.
    pub(super) fn in_text(self, at: Location, places: &Places) -> Self {
        let (line, cut) = places.excerpt(at);
        Self {
            at: Some(at),
            line: line
                .chars()
                .map(|c| if is_shown(c) || c == '\t' { c } else { UNSHOWN })
                .collect(),
            cut,
            ..self
        }
    }

    pub(crate) fn write(&self, path: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Error => "",
            Severity::Ambiguity => "ambiguous: ",
            Severity::Warning => "warning: ",
        };
        let path = one_line(path);
        match self.at {
            None => writeln!(f, "{path}: {severity}{}", self.reason)?,
            Some(Location { line, column }) => {
                writeln!(f, "{path}:{line}:{column}: {severity}{}", self.reason)?;
                let before = column.saturating_sub(1 + self.cut) as usize;
                writeln!(f, "{}\n{}^", self.line, blank(&self.line, before))?;
            }
        }
        write!(f, "help: {}", self.remedy)
    }
}

/// As many blanks as a line has characters before a place. Tabs stay tabs, so
/// that a caret behind them lands right at any tab width.
fn blank(line: &str, before: usize) -> String {
    let beyond = std::iter::repeat(' ');
    let blank = |c| if c == '\t' { '\t' } else { ' ' };
    line.chars().chain(beyond).take(before).map(blank).collect()
}

/// A message without the megabytes that a file may hold: whatever stands
/// between quotes is cut, and the whole too, should it have many of them.
fn brief(message: String) -> String {
    if message.len() <= bounds::QUOTED {
        return message;
    }
    let mut short = String::new();
    for part in message.split_inclusive(['`', '"']) {
        cut(part, bounds::QUOTED, &mut short);
        if short.len() > 12 * bounds::QUOTED {
            short.push_str(" ...");
            break;
        }
    }
    short
}

/// Adds the first characters of a text, and the quote at its end.
fn cut(text: &str, most: usize, to: &mut String) {
    let Some((end, _)) = text.char_indices().nth(most) else {
        return to.push_str(text);
    };
    to.push_str(&text[..end]);
    to.push_str("...");
    to.extend(text.chars().next_back().filter(|c| matches!(c, '`' | '"')));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagnostic(at: Option<(u32, u32)>, line: &str) -> Diagnostics {
        let at = at.map(|(line, column)| Location { line, column });
        let diagnostic = Diagnostic::whole("reason", "remedy");
        let list = vec![match at {
            Some(at) => diagnostic.in_text(at, &Places::of(line)),
            None => diagnostic,
        }];
        Diagnostics {
            path: "arm.urdf".into(),
            list,
        }
    }

    #[test]
    fn a_place_shows_its_line_and_a_caret() {
        let shown = diagnostic(Some((1, 4)), "\t <axis/>").to_string();
        assert_eq!(
            shown,
            "arm.urdf:1:4: reason\n\t <axis/>\n\t  ^\nhelp: remedy"
        );
    }

    #[test]
    fn the_whole_robot_has_no_line() {
        assert_eq!(
            diagnostic(None, "").to_string(),
            "arm.urdf: reason\nhelp: remedy"
        );
    }

    #[test]
    fn a_long_line_is_cut_around_the_caret() {
        let line = format!("{}X{}", "a".repeat(1000), "b".repeat(1000));
        let shown = diagnostic(Some((1, 1001)), &line).to_string();
        let rows: Vec<_> = shown.lines().collect();
        assert_eq!(rows[1].len(), 160);
        assert_eq!(rows[1].find('X'), rows[2].find('^'));
    }

    #[test]
    fn what_a_message_quotes_is_cut() {
        let name = "é".repeat(1_000_000);
        let about = Diagnostic::whole(format!("`{name}` is no link; see \"{name}\""), "");
        let shown = "é".repeat(bounds::QUOTED);
        assert_eq!(
            about.reason,
            format!("`{shown}...` is no link; see \"{shown}...\"")
        );
        let quotes = Diagnostic::whole("`".repeat(1_000_000), "");
        assert!(quotes.reason.len() < 20 * bounds::QUOTED);
    }

    #[test]
    fn many_diagnostics_are_counted() {
        let mut all = diagnostic(None, "");
        all.list = vec![all.list[0].clone(); SHOWN + 3];
        assert!(all.to_string().ends_with("arm.urdf: and 3 more"));
    }
}
