//! One file in, one file out.

use super::partial::{Partial, forget};
use super::pipeline::Pipeline;
use super::place::place_of;
use super::task::{Tally, Task};
use crate::table::{Encoder, Fault, Place, Reader};
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

/// A table to be read, what is computed of its rows, and where that is written.
///
/// Rows are read and written in their order, so many at once; the answers are the same on any
/// number of cores, and whether or not the job was interrupted.
pub struct Job<'a> {
    /// The table.
    pub input: &'a Path,
    /// What reads it; its columns are selected.
    pub reader: Box<dyn Reader>,
    /// What is computed.
    pub task: &'a dyn Task,
    /// What writes it.
    pub encoder: Box<dyn Encoder>,
    /// Where that is written, in whole or not at all.
    pub output: PathBuf,
    /// Rows that are read at once.
    pub batch: usize,
    /// Whether a row that says nothing is an error.
    pub is_strict: bool,
    /// All else that the answers depend on: the robot and the options.
    pub robot: String,
}

/// What came of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Rows of the output.
    pub answers: u64,
    /// What became of the rows of the input.
    pub tally: Tally,
    /// How many rows of the input were done before.
    pub before: u64,
    /// Whether it was stopped before its end.
    pub is_stopped: bool,
}

impl Job<'_> {
    /// Runs to the end, or until `progress`, which is told how much of the reader's extent is
    /// done since it was told last, says to stop.
    ///
    /// # Errors
    ///
    /// The first fault of the input, or why the output cannot be written. What was done before
    /// is kept, and gone on with.
    pub fn run(
        mut self,
        progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Report, Fault> {
        self.output = place_of(&self.output)?;
        let identity = self.identity()?;
        let mut partial = Partial::open(&self.output, &identity, &*self.encoder)?;
        let skipped = partial.done.len();
        let extent = partial.done.iter().map(|done| done.extent).sum();
        let mut flow = progress(extent);
        if !partial.is_whole && flow.is_continue() {
            let pipeline = Pipeline {
                input: self.input,
                task: self.task,
                encoder: &*self.encoder,
                batch: self.batch,
            };
            flow = pipeline.run(&mut *self.reader, skipped, |finished| {
                if let Some((row, reason)) = &finished.tally.first_fault
                    && self.is_strict
                {
                    return Err(faulty(self.input, *row, reason));
                }
                let extent = finished.extent;
                partial.add(finished)?;
                Ok(progress(extent))
            })?;
            if flow.is_continue() {
                partial.finish()?;
            }
        }
        let mut report = Report {
            answers: 0,
            tally: Tally::default(),
            before: partial.done[..skipped].iter().map(|it| it.tally.rows).sum(),
            is_stopped: flow.is_break(),
        };
        for done in &partial.done {
            report.answers += done.rows;
            report.tally.add(&done.tally);
        }
        Ok(report)
    }

    /// What makes two runs one: a line of text.
    fn identity(&self) -> Result<String, Fault> {
        let unreadable = |error| Fault::unreadable(self.input, &error);
        let input = fs::metadata(self.input).map_err(unreadable)?;
        let modified = input.modified().ok();
        let modified = modified.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
        let identity = serde_json::json!({
            "kin": env!("CARGO_PKG_VERSION"),
            "robot": self.robot,
            "input": self.input.to_string_lossy(),
            "bytes": input.len(),
            "modified": modified.map(|since| since.as_nanos().to_string()),
            "changed": changed(&input),
            "batch": self.batch,
            "strict": self.is_strict,
        });
        Ok(identity.to_string())
    }
}

/// When the file was written or replaced, which no copy keeps, where the system tells.
#[cfg(unix)]
fn changed(file: &fs::Metadata) -> Option<[i64; 2]> {
    use std::os::unix::fs::MetadataExt;
    Some([file.ctime(), file.ctime_nsec()])
}

#[cfg(not(unix))]
fn changed(_: &fs::Metadata) -> Option<[i64; 2]> {
    None
}

fn faulty(input: &Path, row: u64, reason: &str) -> Fault {
    let at = Place {
        row: Some(row),
        column: None,
    };
    Fault::at(input, at, reason, "mend the row, or leave out `--strict`")
}

/// Forgets that these outputs were made: their jobs would begin anew.
pub fn forget_all<'a>(outputs: impl Iterator<Item = &'a Path>) {
    outputs.for_each(forget);
}
