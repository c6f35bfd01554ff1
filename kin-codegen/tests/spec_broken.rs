//! Every file in `tests/broken` must be refused with the message in the `.txt`
//! beside it. `BLESS=1 cargo test` writes the messages anew, for review.
//!
//! A comment `chain: base tip` in a file chooses base and tip.

use kin_codegen::model::Model;
use kin_codegen::spec::{ArmSpec, Diagnostics, Source};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken")
}

/// The robot files, and the messages, each sorted.
fn files() -> (Vec<PathBuf>, Vec<PathBuf>) {
    let entries = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> = entries.collect();
    all.sort();
    let (messages, robots) = all
        .into_iter()
        .partition(|path| path.extension() == Some(OsStr::new("txt")));
    (robots, messages)
}

fn message_file(robot: &Path) -> PathBuf {
    let mut name = robot.as_os_str().to_os_string();
    name.push(".txt");
    name.into()
}

fn read(path: &Path) -> Result<Model, Diagnostics> {
    let text = fs::read_to_string(path).unwrap();
    let chain: Vec<String> = match text.split_once("chain: ") {
        Some((_, rest)) => rest
            .split_whitespace()
            .take(2)
            .map(str::to_string)
            .collect(),
        None => Vec::new(),
    };
    let name = path.file_name().unwrap().to_str().unwrap().to_string();
    let spec = ArmSpec::parse(&Source { path: name, text })?;
    Model::new(
        &spec,
        chain.first().map(String::as_str),
        chain.get(1).map(String::as_str),
    )
}

#[test]
fn broken_files_are_refused_as_expected() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut failures = Vec::new();
    for robot in files().0 {
        let message = match read(&robot) {
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
    let (robots, messages) = files();
    let expected: Vec<PathBuf> = robots.iter().map(|robot| message_file(robot)).collect();
    let orphans: Vec<_> = messages
        .iter()
        .filter(|message| !expected.contains(message))
        .collect();
    assert!(orphans.is_empty(), "{orphans:?}");
}
