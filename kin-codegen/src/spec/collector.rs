//! Collects diagnostics while a file is read, so that one run tells all.

use super::places::Places;
use super::{Diagnostic, Diagnostics, Location, Source, did_you_mean, list_names};
use std::collections::HashSet;

/// Diagnostics of one file that look for the name that was meant.
const SUGGESTIONS: usize = 100;

/// The diagnostics about one source so far.
pub(crate) struct Collector<'s> {
    source: &'s Source,
    places: Places<'s>,
    list: Vec<Diagnostic>,
    /// The places that were ever reported.
    reported: HashSet<Location>,
}

impl<'s> Collector<'s> {
    pub(crate) fn new(source: &'s Source) -> Self {
        Collector {
            source,
            places: Places::of(&source.text),
            list: Vec::new(),
            reported: HashSet::new(),
        }
    }

    /// The place of a byte offset of the source.
    pub(crate) fn place(&self, offset: usize) -> Location {
        self.places.at(offset)
    }

    /// Reports a place.
    pub(crate) fn at(
        &mut self,
        at: Location,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let diagnostic = Diagnostic::whole(reason, remedy).in_text(at, &self.places);
        self.reported.insert(at);
        self.list.push(diagnostic);
    }

    /// Reports the robot as a whole.
    pub(crate) fn whole(&mut self, reason: impl Into<String>, remedy: impl Into<String>) {
        self.list.push(Diagnostic::whole(reason, remedy));
    }

    /// A remedy that names the nearest of the robot's names. The mistakes of a
    /// file that has hundreds of them have one cause: they do without.
    pub(crate) fn nearest_of(&self, word: &str, names: &[&str]) -> String {
        match self.reported.len() < SUGGESTIONS {
            true => did_you_mean(word, names),
            false => format!("use one of {}", list_names(names)),
        }
    }

    /// Whether there is a diagnostic about this very place.
    pub(crate) fn mentions(&self, at: Location) -> bool {
        self.reported.contains(&at)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The value, if there was nothing to report.
    pub(crate) fn unless_any<T>(self, value: Option<T>) -> Result<T, Diagnostics> {
        match (Diagnostics::of(&self.source.path, self.list), value) {
            (None, Some(value)) => Ok(value),
            (Some(diagnostics), _) => Err(diagnostics),
            // Whoever gives up says why; should one forget, the user still
            // gets an error instead of a blank line.
            (None, None) => Err(Diagnostics::one(
                &self.source.path,
                Diagnostic::whole(
                    "the file cannot be read, for a reason that was not recorded",
                    "report this file as a defect of kin-codegen",
                ),
            )),
        }
    }
}
