//! Robots read at run time from what was found before.

use kinematics::{Robot, RobotOptions, RobotSource};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A folder of this test's own, in which every robot is searched for once.
pub fn folder() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_CRATE_NAME"));
        // What another build of the compiler has found.
        let _ = fs::remove_dir_all(&folder);
        folder
    })
}

/// A robot from there.
pub fn cached(path: &str, options: &RobotOptions) -> Robot {
    let source = RobotSource::read(path, Path::new("")).unwrap();
    let load = || Robot::load_cached(&source, options, folder()).unwrap();
    load();
    load()
}
