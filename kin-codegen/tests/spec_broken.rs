//! Every file in `tests/broken` must be refused with the message in the `.txt`
//! beside it, and every file in `tests/warned` be read with the warnings there;
//! taken strictly, it is refused with them. `BLESS=1 cargo test` writes the
//! messages anew, for review.
//!
//! A comment `chain: base tip` in a file chooses base and tip.

use kin_codegen::model::Model;
use kin_codegen::spec::{ArmSpec, Diagnostics, Source};
use kin_codegen::{Error, Ik, Options, compile};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

/// The robot files of a folder, and the messages, each sorted.
fn files(folder: &str) -> (Vec<PathBuf>, Vec<PathBuf>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests")
        .join(folder);
    let entries = fs::read_dir(folder)
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

/// The file, and base and tip if it chooses them.
fn read(path: &Path) -> (Source, Options) {
    let text = fs::read_to_string(path).unwrap();
    let chain: Vec<String> = match text.split_once("chain: ") {
        Some((_, rest)) => rest
            .split_whitespace()
            .take(2)
            .map(str::to_string)
            .collect(),
        None => Vec::new(),
    };
    let options = Options {
        base: chain.first().cloned(),
        tip: chain.get(1).cloned(),
        ..Options::default()
    };
    let path = path.file_name().unwrap().to_str().unwrap().to_string();
    (Source { path, text }, options)
}

fn model(path: &Path) -> Result<Model, Diagnostics> {
    let (source, options) = read(path);
    let spec = ArmSpec::parse(&source)?;
    options.model(&spec)
}

/// Compares what is said of every file of a folder with what is expected.
fn check(folder: &str, said: impl Fn(&Path) -> String) {
    let bless = std::env::var_os("BLESS").is_some();
    let mut failures = Vec::new();
    for robot in files(folder).0 {
        let message = said(&robot);
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
fn broken_files_are_refused_as_expected() {
    check("broken", |robot| match model(robot) {
        Ok(_) => "accepted\n".to_string(),
        Err(diagnostics) => format!("{diagnostics}\n"),
    });
}

#[test]
fn odd_files_are_read_with_warnings() {
    check("warned", |robot| {
        let model = model(robot).unwrap_or_else(|refused| panic!("{refused}"));
        let path = robot.file_name().unwrap().to_str().unwrap();
        match Diagnostics::of(path, model.warnings) {
            Some(warnings) => format!("{} to {}\n{warnings}\n", model.base, model.tip),
            None => "accepted\n".to_string(),
        }
    });
}

#[test]
fn warnings_are_errors_of_a_strict_reader() {
    for robot in files("warned").0 {
        let (source, options) = read(&robot);
        let options = Options {
            strict: true,
            ik: Ik::None,
            ..options
        };
        let Err(Error::Broken(errors)) = compile(&source, &options) else {
            panic!("{} is refused", robot.display());
        };
        assert!(!errors.to_string().contains("warning"), "{errors}");
        let relaxed = Options {
            strict: false,
            ..options
        };
        assert!(compile(&source, &relaxed).is_ok());
    }
}

#[test]
fn every_message_belongs_to_a_file() {
    let both = ["broken", "warned"].map(files);
    let robots: Vec<PathBuf> = both.iter().flat_map(|(robots, _)| robots.clone()).collect();
    let messages: Vec<PathBuf> = both.iter().flat_map(|(_, found)| found.clone()).collect();
    let expected: Vec<PathBuf> = robots.iter().map(|robot| message_file(robot)).collect();
    let orphans: Vec<_> = messages
        .iter()
        .filter(|message| !expected.contains(message))
        .collect();
    assert!(orphans.is_empty(), "{orphans:?}");
}
