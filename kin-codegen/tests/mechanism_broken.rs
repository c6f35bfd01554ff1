//! Every file in `tests/broken_mechanisms` must be refused with the message in
//! the `.txt` beside it. `BLESS=1 cargo test` writes the messages anew, for
//! review.

use kin_codegen::{Options, Source, compile};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

/// The files with an extension, sorted.
fn files(extension: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken_mechanisms");
    let entries = fs::read_dir(folder).unwrap();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension() == Some(OsStr::new(extension)))
        .collect();
    files.sort();
    files
}

fn message_file(robot: &Path) -> PathBuf {
    let mut name = robot.as_os_str().to_os_string();
    name.push(".txt");
    name.into()
}

fn robots() -> Vec<PathBuf> {
    [files("yaml"), files("urdf")].concat()
}

#[test]
fn broken_mechanisms_are_refused_as_expected() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut failures = Vec::new();
    for robot in robots() {
        let text = fs::read_to_string(&robot).unwrap();
        let path = robot.file_name().unwrap().to_str().unwrap().to_string();
        let message = match compile(&Source { path, text }, &Options::default()) {
            Ok(_) => "accepted\n".to_string(),
            Err(diagnostics) => format!("{diagnostics}\n"),
        };
        let expected = message_file(&robot);
        if bless {
            fs::write(&expected, &message).unwrap();
        }
        let wanted = fs::read_to_string(&expected).unwrap_or_default();
        if message != wanted || message == "accepted\n" {
            failures.push(format!(
                "{}\n--- expected\n{wanted}--- got\n{message}",
                robot.display()
            ));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_message_belongs_to_a_file() {
    let expected: Vec<PathBuf> = robots().iter().map(|robot| message_file(robot)).collect();
    let orphans: Vec<_> = files("txt")
        .into_iter()
        .filter(|message| !expected.contains(message))
        .collect();
    assert!(orphans.is_empty(), "{orphans:?}");
}
