//! What was found for a robot before, in a folder: used for that robot alone, and only if it is whole.

use kin_codegen::{Ik, Options, Source, compile_cached};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::{fs, process};

/// Quickly compiled.
const ROBOT: &str = "\
robot: crank
units: {angle: deg, length: m}
dh: [{name: turn, theta: 0, d: 0, a: 0.3, alpha: 0}]
";

/// A number of configurations that no certificate tries.
const MARK: usize = 123_456;

fn source() -> Source {
    Source {
        path: "crank.yaml".into(),
        text: ROBOT.into(),
    }
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
    let certified = compiled.arm().unwrap().inverse.as_ref();
    certified.unwrap().certificate.configurations
}

/// The hash of Fowler, Noll and Vo, of 64 bits.
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

/// The file of a robot in a folder: whose it is (five texts behind their lengths), what was found, and
/// the hash of that.
struct Kept {
    folder: PathBuf,
    file: PathBuf,
    /// As it was written, and with the mark.
    unmarked: Vec<u8>,
    whole: Vec<u8>,
    found: Range<usize>,
}

impl Kept {
    /// What was found for the arm, with the mark.
    fn marked(test: &str) -> Self {
        let folder = folder(test);
        let configurations = tried(&source(), &Options::default(), &folder);
        assert_ne!(configurations, MARK);
        let mut files = fs::read_dir(&folder).unwrap();
        let file = files.next().unwrap().unwrap().path();
        assert!(files.next().is_none());
        let whole = fs::read(&file).unwrap();
        let mut start = 0;
        for _ in 0..5 {
            let length = whole[start..start + 8].try_into().unwrap();
            start += 8 + u64::from_le_bytes(length) as usize;
        }
        let mut kept = Self {
            folder,
            file,
            found: start..whole.len() - 8,
            unmarked: whole.clone(),
            whole,
        };
        let mut found = kept.whole[kept.found.clone()].to_vec();
        let number = (configurations as u64).to_le_bytes();
        let mut places = found.windows(8).enumerate();
        let mut places = places.by_ref().filter(|(_, window)| *window == number);
        let place = places.next().unwrap().0;
        assert!(places.next().is_none());
        found[place..place + 8].copy_from_slice(&(MARK as u64).to_le_bytes());
        kept.whole = kept.with(&found);
        kept.write(&kept.whole);
        assert!(kept.is_used());
        kept
    }

    /// The file with something else found, and its hash.
    fn with(&self, found: &[u8]) -> Vec<u8> {
        let robot = &self.whole[..self.found.start];
        [robot, found, &fnv1a(found).to_le_bytes()].concat()
    }

    fn found(&self) -> &[u8] {
        &self.whole[self.found.clone()]
    }

    fn write(&self, bytes: &[u8]) {
        fs::write(&self.file, bytes).unwrap();
    }

    fn is_used(&self) -> bool {
        tried(&source(), &Options::default(), &self.folder) == MARK
    }

    /// Whether this is not used, and written anew.
    fn refuses(&self, bytes: &[u8]) -> bool {
        self.write(bytes);
        !self.is_used() && fs::read(&self.file).unwrap() == self.unmarked
    }
}

impl Drop for Kept {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

#[test]
fn what_is_kept_is_used_for_the_same_robot_alone() {
    let kept = Kept::marked("same");
    let (source, options) = (source(), Options::default());
    let strict = Options {
        strict: true,
        ..Options::default()
    };
    assert_ne!(tried(&source, &strict, &kept.folder), MARK);
    let before = files(&kept.folder);
    let changed = Source {
        text: source.text.replace("a: 0.3", "a: 0.2"),
        ..source.clone()
    };
    assert_ne!(changed.text, source.text);
    assert_ne!(tried(&changed, &options, &kept.folder), MARK);
    assert!(kept.is_used());
    // Under the name of the robot, what was found for another, or by another version.
    let other = files(&kept.folder)
        .into_iter()
        .find(|file| !before.contains(file));
    let version = 8 + env!("CARGO_PKG_VERSION").len();
    let flipped = |place: usize| {
        let mut changed = kept.whole.clone();
        changed[place] ^= 1;
        changed
    };
    let (of_version, of_layout) = (flipped(version - 1), flipped(version + 8));
    for foreign in [fs::read(other.unwrap()).unwrap(), of_version, of_layout] {
        assert!(kept.refuses(&foreign));
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let files = fs::read_dir(folder).unwrap();
    files.map(|file| file.unwrap().path()).collect()
}

/// As another build of this version may have certified: what is last tells its expressions.
#[test]
fn what_was_found_for_other_expressions_is_not_used() {
    let kept = Kept::marked("expressions");
    let mut found = kept.found().to_vec();
    *found.last_mut().unwrap() ^= 1;
    assert!(kept.refuses(&kept.with(&found)));
}

#[test]
fn what_is_damaged_is_not_used() {
    let kept = Kept::marked("damaged");
    // Of the texts that tell whose it is, some places.
    let texts = (0..kept.found.start).step_by(97);
    for place in texts.chain(kept.found.start..kept.whole.len()) {
        let mut damaged = kept.whole.clone();
        damaged[place] ^= 1 << (place % 8);
        assert!(kept.refuses(&damaged), "{place}");
        assert!(kept.refuses(&kept.whole[..place]), "{place}");
    }
    assert!(kept.refuses(&[&kept.whole[..], &[0]].concat()));
}

/// With a hash that is right: parts that are not there.
#[test]
fn what_is_no_finding_is_not_used() {
    let kept = Kept::marked("none");
    for length in 0..kept.found.len() {
        let found = &kept.found()[..length];
        assert!(kept.refuses(&kept.with(found)), "{length}");
    }
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
    let files = files(&folder);
    assert_eq!(files.len(), 1);
    let whole = fs::read(&files[0]).unwrap();
    tried(&source, &options, &folder);
    assert_eq!(fs::read(&files[0]).unwrap(), whole);
    fs::remove_dir_all(folder).unwrap();
}
