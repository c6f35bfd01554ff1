//! Complaints as data: a place, a reason and a remedy.

/// A place in a robot file, both counted from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Location {
    /// Line.
    pub line: u32,
    /// Column.
    pub column: u32,
}

/// One complaint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Where; `None` when the complaint is about the robot as a whole.
    pub at: Option<Location>,
    /// The offending line, without its line break; empty without a place.
    pub line: String,
    /// What was found and why it matters.
    pub reason: String,
    /// What to do.
    pub remedy: String,
}

/// Everything wrong with one robot file; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics {
    /// The file, as the user named it.
    pub path: String,
    /// In the order of the file.
    pub list: Vec<Diagnostic>,
}
