//! A folder of what was found, with a file for each robot.

use super::Found;
use crate::hash::fnv1a;
use crate::options::Options;
use crate::spec::{Source, file_name, stem};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, io, process};

/// The file of a robot: what it is for, what was found, and a checksum.
pub(crate) struct Entry {
    file: PathBuf,
    /// The version of this crate and the layout of what it finds, the options, the name and the
    /// whole text of the robot file: a hash could be that of another robot.
    robot: Vec<u8>,
}

impl Entry {
    /// The file that this robot has in a folder.
    pub(crate) fn new(folder: &Path, source: &Source, options: &Options) -> Self {
        let mut robot = Vec::with_capacity(source.text.len() + 64);
        let (version, options) = (env!("CARGO_PKG_VERSION"), options.to_string());
        let file = file_name(&source.path);
        for part in [version, Found::layout(), &options, file, &source.text] {
            robot.extend((part.len() as u64).to_le_bytes());
            robot.extend(part.as_bytes());
        }
        let name = format!("{}-{:016x}.found", stem(&source.path), fnv1a(&robot));
        let file = folder.join(name);
        Self { file, robot }
    }

    /// What it has; none where it is of another robot, or damaged.
    pub(crate) fn read(&self) -> Option<Found> {
        let bytes = fs::read(&self.file).ok()?;
        let (found, checksum) = bytes.strip_prefix(&self.robot[..])?.split_last_chunk()?;
        let is_whole = u64::from_le_bytes(*checksum) == fnv1a(found);
        is_whole.then(|| Found::from_bytes(found))?
    }

    /// Writes it beside its place, and moves it there: nobody reads half a file, whoever else
    /// writes it.
    pub(crate) fn write(&self, found: &Found) -> io::Result<()> {
        static WRITTEN: AtomicUsize = AtomicUsize::new(0);
        let number = WRITTEN.fetch_add(1, Ordering::Relaxed);
        let partial = format!("{}-{number}.partial", process::id());
        let partial = self.file.with_extension(partial);
        let found = found.to_bytes();
        let checksum = fnv1a(&found).to_le_bytes();
        let bytes = [&self.robot[..], &found, &checksum].concat();
        if let Some(folder) = self.file.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(&partial, bytes)?;
        fs::rename(&partial, &self.file)
    }
}
