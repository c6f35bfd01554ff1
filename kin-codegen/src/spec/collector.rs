//! Collects diagnostics while a file is read, so that one run tells all.

use super::{Diagnostic, Diagnostics, Location, Source};

/// The diagnostics about one source so far.
pub(crate) struct Collector<'s> {
    source: &'s Source,
    /// Byte offsets at which lines start: places are asked for often.
    line_starts: Vec<usize>,
    list: Vec<Diagnostic>,
}

impl<'s> Collector<'s> {
    pub(crate) fn new(source: &'s Source) -> Self {
        let breaks = source.text.match_indices('\n').map(|(i, _)| i + 1);
        let line_starts = std::iter::once(0).chain(breaks).collect();
        Collector {
            source,
            line_starts,
            list: Vec::new(),
        }
    }

    /// The place of a byte offset of the source.
    pub(crate) fn place(&self, offset: usize) -> Location {
        let line = self.line_starts.partition_point(|&start| start <= offset);
        let before = self.source.text.get(self.line_starts[line - 1]..offset);
        Location {
            line: line as u32,
            column: before.unwrap_or("").chars().count() as u32 + 1,
        }
    }

    /// Reports a place.
    pub(crate) fn at(
        &mut self,
        at: Location,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let line = self.line(at.line).to_string();
        self.list.push(Diagnostic {
            at: Some(at),
            line,
            reason: reason.into(),
            remedy: remedy.into(),
        });
    }

    /// Reports the robot as a whole.
    pub(crate) fn whole(&mut self, reason: impl Into<String>, remedy: impl Into<String>) {
        self.list.push(Diagnostic::whole(reason, remedy));
    }

    /// Whether there is a diagnostic about this very place.
    pub(crate) fn mentions(&self, at: Location) -> bool {
        self.list.iter().any(|diagnostic| diagnostic.at == Some(at))
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

    fn line(&self, number: u32) -> &str {
        let number = number as usize;
        let start = self.line_starts.get(number.wrapping_sub(1));
        let end = self
            .line_starts
            .get(number)
            .copied()
            .unwrap_or(self.source.text.len());
        let line = start.and_then(|&start| self.source.text.get(start..end));
        line.unwrap_or("").trim_end_matches(['\n', '\r'])
    }
}
