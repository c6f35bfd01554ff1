//! Portions of a table through a task, on all cores, in their order.

use super::task::{Tally, Task};
use crate::table::{Encoder, Fault, Piece, Portion, Reader};
use std::collections::BTreeMap;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;
use std::sync::mpsc::{self, Receiver};
use std::thread;

/// A table, what is computed of its rows, and how that is written.
pub(super) struct Pipeline<'a> {
    pub(super) input: &'a Path,
    pub(super) task: &'a dyn Task,
    pub(super) encoder: &'a dyn Encoder,
    /// Rows of a portion.
    pub(super) batch: usize,
}

/// What came of a portion.
pub(super) struct Finished {
    pub(super) extent: u64,
    pub(super) piece: Piece,
    pub(super) tally: Tally,
}

/// Hands out portions one by one.
struct Feed<'a> {
    reader: &'a mut dyn Reader,
    number: usize,
    is_at_end: bool,
    /// One for each portion that may be under way: what bounds the memory.
    permits: Receiver<()>,
}

impl Feed<'_> {
    fn next(&mut self, rows: usize) -> Option<(usize, Result<Portion, Fault>)> {
        self.permits.recv().ok()?;
        if self.is_at_end {
            return None;
        }
        let portion = self.reader.next(rows).transpose();
        self.is_at_end = !matches!(portion, Some(Ok(_)));
        let number = self.number;
        self.number += 1;
        Some((number, portion?))
    }
}

impl Pipeline<'_> {
    /// Runs all portions but the first `skipped`, which were done before; `take` has them in their
    /// order.
    ///
    /// # Errors
    ///
    /// The first in the file, whatever the number of cores; or that of `take`.
    pub(super) fn run(
        &self,
        reader: &mut dyn Reader,
        skipped: usize,
        mut take: impl FnMut(Finished) -> Result<ControlFlow<()>, Fault>,
    ) -> Result<ControlFlow<()>, Fault> {
        for _ in 0..skipped {
            reader.next(self.batch)?;
        }
        let threads = thread::available_parallelism().map_or(1, NonZero::get);
        let under_way = 2 * threads;
        let (permit, permits) = mpsc::sync_channel(under_way);
        for _ in 0..under_way {
            let _ = permit.try_send(());
        }
        let feed = Mutex::new(Feed {
            reader,
            number: 0,
            is_at_end: false,
            permits,
        });
        let next = || feed.lock().ok()?.next(self.batch);
        thread::scope(|scope| {
            let (done, results) = mpsc::channel();
            for _ in 0..threads {
                let done = done.clone();
                scope.spawn(move || {
                    while let Some((number, portion)) = next() {
                        let result = portion.and_then(|portion| self.work(portion));
                        if done.send((number, result)).is_err() {
                            break;
                        }
                    }
                });
            }
            drop(done);
            // Moved in, so that an early return ends the threads.
            let permit = permit;
            let mut early = BTreeMap::new();
            let mut due = 0;
            for (number, result) in results {
                early.insert(number, result);
                while let Some(result) = early.remove(&due) {
                    if take(result?)?.is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                    due += 1;
                    let _ = permit.try_send(());
                }
            }
            Ok(ControlFlow::Continue(()))
        })
    }

    fn work(&self, portion: Portion) -> Result<Finished, Fault> {
        let (first, extent) = (portion.first, portion.extent);
        let columns = portion.decode()?;
        let (answers, tally) = self.task.run(first, &columns);
        let piece = self.encoder.encode(&answers);
        let piece = piece.map_err(|reason| {
            Fault::whole(self.input, reason, "try another format for the answers")
        })?;
        Ok(Finished {
            extent,
            piece,
            tally,
        })
    }
}
