//! Generated code links and runs without std and without an allocator.
#![cfg(target_os = "linux")]

use std::path::{Path, PathBuf};
use std::process::Command;

#[test]
fn a_program_without_std_finds_all_solutions() {
    let folder = output_folder();
    build(&folder);
    let status = Command::new(folder.join("no_std")).status().unwrap();
    assert!(status.success(), "it finds wrong solutions");
}

/// Where cargo put this test's own program: `target/debug`, say.
fn output_folder() -> PathBuf {
    let own = std::env::current_exe().unwrap();
    own.ancestors().nth(2).unwrap().to_owned()
}

/// Builds the program by itself: in a build of the whole workspace, other
/// packages turn the feature `std` of the runtime on. With the macros as they are
/// built already, which the package beside asks for.
fn build(folder: &Path) {
    let profile = match folder.file_name().unwrap().to_str().unwrap() {
        "debug" => "dev",
        name => name,
    };
    let status = Command::new(env!("CARGO"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["build", "--package", "no_std", "--package", "kinematics-ui"])
        .arg("--config")
        .arg(format!("profile.{profile}.panic = 'abort'"))
        .args(["--profile", profile, "--target-dir"])
        .arg(folder.parent().unwrap())
        .status();
    assert!(status.unwrap().success(), "it does not link");
}
