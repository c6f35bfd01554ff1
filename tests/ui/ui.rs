//! Programs that must not compile, and what the compiler says about each.
//! `TRYBUILD=overwrite cargo test --package kinematics-ui --test ui` writes
//! the messages anew, for review.

use std::fs;
use std::path::{Path, PathBuf};

#[test]
fn ui() {
    stage(Path::new("robots"));
    let programs = trybuild::TestCases::new();
    // One that compiles makes trybuild build instead of check: what a robot
    // without inverse kinematics says about `ik` is found only then.
    programs.pass("neighbours.rs");
    programs.compile_fail("arguments/*.rs");
    programs.compile_fail("*_*.rs");
}

/// Puts robot files where the macro looks for them: trybuild compiles the
/// programs as a crate of its own, in the target directory.
fn stage(robots: &Path) {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .parent()
        .expect("a folder in the target directory");
    let folder: PathBuf = target.join("tests/trybuild/kinematics-ui/robots");
    fs::create_dir_all(&folder).unwrap();
    for robot in fs::read_dir(robots).unwrap() {
        let robot = robot.unwrap();
        fs::copy(robot.path(), folder.join(robot.file_name())).unwrap();
    }
}
