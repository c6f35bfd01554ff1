//! A file that is written piece by piece, and goes on where it was interrupted.
//!
//! The pieces stand in a hidden file beside the output, and a journal says of each how long it
//! is, its checksum and what became of its rows. The output appears under its name when it is
//! whole, and at once. What was made from other input, by other options or by another `kin` is
//! not gone on with.

use super::journal::{Done, Journal, Progress};
use super::pipeline::Finished;
use super::place::{beside, open_hidden, place_of};
use crate::table::{Encoder, Fault};
use std::fs::{self, File};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// An output that is not whole yet.
pub(super) struct Partial<'a> {
    output: PathBuf,
    encoder: &'a dyn Encoder,
    data: File,
    journal: Journal,
    /// All pieces, in their order.
    pub(super) done: Vec<Done>,
    /// Whether the output was whole before this was opened.
    pub(super) is_whole: bool,
}

/// Removes the journal of an output that is whole, after which it would be made anew.
pub(super) fn forget(output: &Path) {
    // If it stays, nothing but time is lost.
    if let Ok(place) = place_of(output) {
        let _ = fs::remove_file(beside(&place, "journal"));
    }
}

impl<'a> Partial<'a> {
    /// Begins an output, or goes on with it.
    ///
    /// # Errors
    ///
    /// The files cannot be written, or another process is writing them.
    pub(super) fn open(
        output: &Path,
        identity: &str,
        encoder: &'a dyn Encoder,
    ) -> Result<Self, Fault> {
        let unwritable = |error| Fault::unwritable(output, &error);
        let (journal, progress) = Journal::open(&beside(output, "journal"), output, identity)?;
        let Progress { done, is_whole } = progress;
        let data = open_hidden(&beside(output, "partial"), output)?;
        let mut partial = Self {
            output: output.to_owned(),
            encoder,
            data,
            journal,
            done,
            is_whole: is_whole && output.is_file(),
        };
        if partial.is_whole {
            let _ = fs::remove_file(beside(output, "partial"));
        } else {
            partial.go_on(identity).map_err(unwritable)?;
        }
        Ok(partial)
    }

    /// Keeps those pieces that the data have whole, and what stands before them.
    fn go_on(&mut self, identity: &str) -> io::Result<()> {
        let head = self.encoder.head(0);
        let mut data = BufReader::new(&self.data);
        // What stands there now may have the number of rows; it is written again.
        let mut before = vec![0; head.len()];
        let has_head = data.read_exact(&mut before).is_ok();
        let is_sound =
            |done: &&Done| has_head && checksum(&mut data, done.bytes) == Some(done.checksum);
        let intact = self.done.iter().take_while(is_sound).count();
        self.done.truncate(intact);
        let bytes: u64 = self.done.iter().map(|done| done.bytes).sum();
        self.journal.begin(identity, &self.done)?;
        self.data.rewind()?;
        self.data.write_all(&head)?;
        self.data.set_len(head.len() as u64 + bytes)?;
        self.data.seek(SeekFrom::End(0)).map(drop)
    }

    /// Writes a piece behind the others.
    pub(super) fn add(&mut self, finished: Finished) -> Result<(), Fault> {
        let done = Done {
            extent: finished.extent,
            rows: finished.piece.rows,
            bytes: finished.piece.bytes.len() as u64,
            checksum: crc32fast::hash(&finished.piece.bytes),
            note: finished.piece.note,
            tally: finished.tally,
        };
        let written = self.data.write_all(&finished.piece.bytes);
        let written = written.and_then(|()| self.journal.add(&done));
        written.map_err(|error| Fault::unwritable(&self.output, &error))?;
        self.done.push(done);
        Ok(())
    }

    /// Gives the output its name, now that all pieces are there.
    pub(super) fn finish(&mut self) -> Result<(), Fault> {
        let mut pieces = self.done.iter().map(|done| (done.bytes, &done.note[..]));
        let tail = self.encoder.tail(&mut pieces).map_err(|reason| {
            let remedy = "remove the hidden files beside it, and run the command again";
            Fault::whole(&self.output, reason, remedy)
        })?;
        let written = self.write_ends(&tail);
        written.map_err(|error| Fault::unwritable(&self.output, &error))
    }

    fn write_ends(&mut self, tail: &[u8]) -> io::Result<()> {
        self.data.write_all(tail)?;
        let rows = self.done.iter().map(|done| done.rows).sum();
        self.data.rewind()?;
        self.data.write_all(&self.encoder.head(rows))?;
        // On the disk before it has its name.
        self.data.sync_all()?;
        fs::rename(beside(&self.output, "partial"), &self.output)?;
        self.journal.end()
    }
}

/// The CRC-32 of so many bytes; none if there are not as many.
fn checksum(data: &mut impl Read, bytes: u64) -> Option<u32> {
    let mut hasher = crc32fast::Hasher::new();
    let mut rest = bytes;
    let mut block = vec![0; 1 << 16];
    while rest > 0 {
        let part = &mut block[..rest.min(1 << 16) as usize];
        data.read_exact(part).ok()?;
        hasher.update(part);
        rest -= part.len() as u64;
    }
    Some(hasher.finalize())
}
