//! A folder of what was found, with a file for each robot.

use super::Found;
use crate::hash::fnv1a;
use crate::options::{Options, file_name, stem};
use crate::spec::Source;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile_cached;
    use crate::options::Ik;

    const ROBOT: &str = "robots/planar_2r.yaml";

    fn source() -> Source {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        Source::read(ROBOT, &root).unwrap()
    }

    /// A folder that is not there.
    fn folder(test: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("kin-found-{test}-{}", process::id()));
        let _ = fs::remove_dir_all(&folder);
        folder
    }

    /// How many configurations a certificate says it has tried.
    fn tried(source: &Source, options: &Options, folder: &Path) -> usize {
        let compiled = compile_cached(source, options, folder).unwrap();
        let found = compiled.arm().unwrap().found().unwrap();
        found.certificate.configurations
    }

    /// A folder with what was found for the arm, marked by a number of configurations that no
    /// certificate tries.
    fn marked(test: &str) -> (PathBuf, Entry) {
        let (source, options, folder) = (source(), Options::default(), folder(test));
        let entry = Entry::new(&folder, &source, &options);
        assert!(entry.read().is_none());
        assert_ne!(tried(&source, &options, &folder), MARK);
        let mut found = entry.read().unwrap();
        found.certificate.configurations = MARK;
        entry.write(&found).unwrap();
        assert_eq!(tried(&source, &options, &folder), MARK);
        (folder, entry)
    }

    const MARK: usize = 123_456;

    #[test]
    fn what_is_kept_is_used_for_the_same_robot_alone() {
        let (folder, entry) = marked("same");
        let (source, options) = (source(), Options::default());
        let other_options = Options {
            strict: true,
            ..Options::default()
        };
        assert_ne!(tried(&source, &other_options, &folder), MARK);
        let changed = Source {
            text: source.text.replace("a: 0.3", "a: 0.2"),
            ..source.clone()
        };
        assert_ne!(changed.text, source.text);
        assert_ne!(tried(&changed, &options, &folder), MARK);
        // Under the name of the robot, what was found for another, or by another version.
        let right = fs::read(&entry.file).unwrap();
        let other = Entry::new(&folder, &changed, &options).file;
        let version = 8 + env!("CARGO_PKG_VERSION").len();
        let flipped = |place: usize| {
            let mut changed = right.clone();
            changed[place] ^= 1;
            changed
        };
        let (of_version, of_layout) = (flipped(version - 1), flipped(version + 8));
        for foreign in [fs::read(other).unwrap(), of_version, of_layout] {
            fs::write(&entry.file, foreign).unwrap();
            assert_ne!(tried(&source, &options, &folder), MARK);
            // And written anew.
            assert!(entry.read().is_some());
        }
        fs::remove_dir_all(folder).unwrap();
    }

    /// As another build of this version may have certified.
    #[test]
    fn what_was_found_for_other_expressions_is_not_used() {
        let (folder, entry) = marked("expressions");
        let mut found = entry.read().unwrap();
        found.expressions ^= 1;
        entry.write(&found).unwrap();
        assert_ne!(tried(&source(), &Options::default(), &folder), MARK);
        // And written anew.
        assert_ne!(entry.read().unwrap().certificate.configurations, MARK);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn what_is_damaged_is_not_used() {
        let (folder, entry) = marked("damaged");
        let whole = fs::read(&entry.file).unwrap();
        let refused = |bytes: &[u8]| {
            fs::write(&entry.file, bytes).unwrap();
            assert!(entry.read().is_none());
        };
        for place in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[place] ^= 1 << (place % 8);
            refused(&damaged);
        }
        for length in 0..whole.len() {
            refused(&whole[..length]);
        }
        refused(&[&whole[..], &[0]].concat());
        assert_ne!(tried(&source(), &Options::default(), &folder), MARK);
        assert!(entry.read().is_some());
        fs::remove_dir_all(folder).unwrap();
    }

    /// With a checksum that is right: numbers of things that are not there.
    #[test]
    fn what_is_no_finding_is_not_used() {
        let (folder, entry) = marked("none");
        let whole = fs::read(&entry.file).unwrap();
        let content = &whole[..whole.len() - 8];
        for place in entry.robot.len()..content.len() {
            let mut changed = content.to_vec();
            changed.truncate(place);
            let found = fnv1a(&changed[entry.robot.len()..]);
            changed.extend(found.to_le_bytes());
            fs::write(&entry.file, changed).unwrap();
            assert!(entry.read().is_none());
        }
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_folder_that_cannot_be_written_keeps_nothing() {
        let (source, options) = (source(), Options::default());
        let file = folder("file");
        fs::write(&file, "a file").unwrap();
        assert_ne!(tried(&source, &options, &file), MARK);
        assert_eq!(fs::read_to_string(&file).unwrap(), "a file");
        fs::remove_file(file).unwrap();
        // Nor does an arm without inverse kinematics have anything to keep.
        let folder = folder("empty");
        let forward_alone = Options {
            ik: Ik::None,
            ..options
        };
        compile_cached(&source, &forward_alone, &folder).unwrap();
        assert!(!folder.exists());
    }

    #[test]
    fn many_write_at_once() {
        let (source, options, folder) = (source(), Options::default(), folder("many"));
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| tried(&source, &options, &folder));
            }
        });
        let files = fs::read_dir(&folder).unwrap();
        assert_eq!(files.count(), 1);
        assert!(Entry::new(&folder, &source, &options).read().is_some());
        fs::remove_dir_all(folder).unwrap();
    }
}
