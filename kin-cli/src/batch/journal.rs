//! What was done of an output, line by line beside it.

use super::place::open_hidden;
use super::task::Tally;
use crate::table::Fault;
use serde::{Deserialize, Serialize};
use std::fs::{File, TryLockError};
use std::io::{self, BufRead, BufReader, Seek, Write};
use std::path::Path;

/// A piece that was written.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Done {
    /// Its share of the input, as [`crate::table::Reader::extent`] counts it.
    pub(super) extent: u64,
    pub(super) rows: u64,
    pub(super) bytes: u64,
    /// CRC-32 of the bytes.
    pub(super) checksum: u32,
    /// For [`crate::table::Encoder::tail`].
    pub(super) note: Vec<u8>,
    pub(super) tally: Tally,
}

/// A line behind the first, which is the identity: what was made from what.
#[derive(Serialize, Deserialize)]
enum Line {
    Piece(Done),
    /// The output is whole, and has its name.
    Whole,
}

/// A file of lines, locked as long as this lives.
pub(super) struct Journal(File);

/// What a journal says.
#[derive(Default)]
pub(super) struct Progress {
    pub(super) done: Vec<Done>,
    pub(super) is_whole: bool,
}

/// A process that is just being started has the files of this one for a moment, and with them the
/// lock, until it is given up.
impl Drop for Journal {
    fn drop(&mut self) {
        // Where it cannot be, closing the file does.
        let _ = self.0.unlock();
    }
}

impl Journal {
    /// Opens the journal of an output, and reads it if it is about the same identity.
    pub(super) fn open(
        path: &Path,
        output: &Path,
        identity: &str,
    ) -> Result<(Self, Progress), Fault> {
        let file = open_hidden(path, output)?;
        // Where files cannot be locked, nobody is warned.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            let reason = "is being written by another process";
            return Err(Fault::whole(output, reason, "wait until that has ended"));
        }
        let progress = progress(&file, identity);
        Ok((Self(file), progress))
    }

    /// Begins anew with these pieces.
    pub(super) fn begin(&mut self, identity: &str, done: &[Done]) -> io::Result<()> {
        self.0.set_len(0)?;
        self.0.rewind()?;
        self.0.write_all(format!("{identity}\n").as_bytes())?;
        done.iter().try_for_each(|done| self.add(done))
    }

    pub(super) fn add(&mut self, done: &Done) -> io::Result<()> {
        self.write(&Line::Piece(done.clone()))
    }

    pub(super) fn end(&mut self) -> io::Result<()> {
        self.write(&Line::Whole)
    }

    fn write(&mut self, line: &Line) -> io::Result<()> {
        let text = serde_json::to_string(line)?;
        let checksum = crc32fast::hash(text.as_bytes());
        self.0
            .write_all(format!("{checksum:08x} {text}\n").as_bytes())
    }
}

/// What stands in whole lines, up to the first that is none of a journal.
fn progress(file: &File, identity: &str) -> Progress {
    let mut lines = BufReader::new(file).lines().map_while(Result::ok);
    let mut progress = Progress::default();
    if lines.next().as_deref() != Some(identity) {
        return progress;
    }
    for line in lines.map_while(|line| read(&line)) {
        match line {
            Line::Piece(done) => progress.done.push(done),
            Line::Whole => progress.is_whole = true,
        }
    }
    progress
}

/// A line with its checksum; none if it was cut off or damaged.
fn read(line: &str) -> Option<Line> {
    let (checksum, text) = line.split_once(' ')?;
    let expected = format!("{:08x}", crc32fast::hash(text.as_bytes()));
    (checksum == expected).then(|| serde_json::from_str(text).ok())?
}
