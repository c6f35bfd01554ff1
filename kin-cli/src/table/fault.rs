//! What is wrong with a table.

use kin_codegen::spec::one_line;
use std::fmt;
use std::io;
use std::path::Path;

/// Where something is wrong in a table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The row, from 0, without the line of names.
    pub row: Option<u64>,
    /// The name of the column.
    pub column: Option<String>,
}

/// What is wrong with a table: the file, the place, the reason and what to do.
///
/// ```text
/// poses.csv: row 17, column `qx`: `abc` is no number
/// help: write radians, metres or quaternions as decimal numbers, or leave the field empty
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The file.
    pub file: String,
    /// Where in it.
    pub at: Place,
    /// What was found.
    pub reason: String,
    /// What to do.
    pub remedy: String,
}

impl Fault {
    /// About a file as a whole.
    pub fn whole(file: &Path, reason: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::at(file, Place::default(), reason, remedy)
    }

    /// About a place in a file.
    pub fn at(
        file: &Path,
        at: Place,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self {
            file: file.to_string_lossy().into_owned(),
            at,
            reason: reason.into(),
            remedy: remedy.into(),
        }
    }

    /// A file that cannot be read.
    pub fn unreadable(file: &Path, error: &io::Error) -> Self {
        let remedy = "check that the file is there, and may be read";
        Self::whole(file, format!("cannot be read: {error}"), remedy)
    }

    /// A file that cannot be written.
    pub fn unwritable(file: &Path, error: &io::Error) -> Self {
        let remedy =
            "check that its folder is there and may be written, and that the disk is not full";
        Self::whole(file, format!("cannot be written: {error}"), remedy)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", one_line(&self.file))?;
        let row = self.at.row.map(|row| format!("row {row}"));
        let column = self.at.column.as_deref();
        let column = column.map(|column| format!("column `{}`", one_line(column)));
        let place: Vec<String> = row.into_iter().chain(column).collect();
        if !place.is_empty() {
            write!(f, "{}: ", place.join(", "))?;
        }
        write!(f, "{}\nhelp: {}", self.reason, self.remedy)
    }
}

impl std::error::Error for Fault {}
