//! `kin`: explain, generate, check, map and show the kinematics of a robot file.
//!
//! What a person asks of a robot file, and a build does not need: [`explain`]
//! tells all that was found, [`check`] and [`sweep`] hold the closed form
//! against independent solvers, [`batch`] computes the rows of tables. [`run`] takes a command line and gives back
//! what to print, so that commands can be tested without processes.

mod arguments;
mod bar;
pub mod batch;
pub mod check;
mod exit;
pub mod explain;
mod generate;
mod json;
mod many;
mod plot;
pub mod sweep;
pub mod table;
pub mod view;
mod workspace;

pub use exit::Exit;

use arguments::{Arguments, Command};
use clap::Parser;
use kin_codegen::spec::one_line;
use std::ffi::OsString;
use std::path::Path;
use std::{fs, io};

/// What a command has to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Done {
    /// For standard output.
    pub stdout: String,
    /// For standard error.
    pub stderr: String,
    /// How it went.
    pub exit: Exit,
}

impl Done {
    fn printing(stdout: impl Into<String>) -> Self {
        Self {
            stdout: stdout.into(),
            stderr: String::new(),
            exit: Exit::Success,
        }
    }

    fn failing(exit: Exit, stderr: impl std::fmt::Display) -> Self {
        Self {
            stdout: String::new(),
            stderr: format!("{stderr}\n"),
            exit,
        }
    }

    /// After writing a file, but not over the one that the robot was read from.
    fn writing(robot: &str, path: &Path, content: impl AsRef<[u8]>) -> Self {
        if let Some(refused) = Self::over_robot(robot, path) {
            return refused;
        }
        match fs::write(path, content) {
            Ok(()) => Self::printing(""),
            Err(error) => Self::unwritten(path, &error),
        }
    }

    /// Why an output is not written over the robot file.
    fn over_robot(robot: &str, path: &Path) -> Option<Self> {
        is_same(Path::new(robot), path).then(|| {
            let path = one_line(&path.to_string_lossy());
            let reason = format!("{path} is the robot file\nhelp: name another file");
            Self::failing(Exit::Broken, reason)
        })
    }

    fn unwritten(path: &Path, error: &io::Error) -> Self {
        let help = match error.kind() {
            io::ErrorKind::NotFound if path.parent().is_some_and(Path::is_dir) => {
                "choose another folder"
            }
            io::ErrorKind::NotFound => "make its folder first",
            io::ErrorKind::IsADirectory => "name a file in it",
            _ => "choose another place",
        };
        let path = one_line(&path.to_string_lossy());
        Self::failing(
            Exit::Broken,
            format!("cannot write {path}: {error}\nhelp: {help}"),
        )
    }
}

/// Whether two paths are one file or folder.
fn is_same(one: &Path, other: &Path) -> bool {
    let [one, other] = [one, other].map(fs::canonicalize);
    matches!((one, other), (Ok(one), Ok(other)) if one == other)
}

/// Runs a command line, the program's name first.
///
/// ```
/// let done = kin_cli::run(["kin", "check", "../robots/scara.yaml"]);
/// assert_eq!(done.exit, kin_cli::Exit::Success);
/// assert!(done.stdout.starts_with("../robots/scara.yaml: solved: "));
/// ```
pub fn run<A: Into<OsString> + Clone>(arguments: impl IntoIterator<Item = A>) -> Done {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(help) if !help.use_stderr() => return Done::printing(help.to_string()),
        Err(error) => return Done::failing(Exit::Usage, error.to_string().trim_end()),
    };
    match arguments.command {
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Workspace(arguments) => workspace::run(&arguments),
        Command::Fk(arguments) => many::forward(&arguments),
        Command::Ik(arguments) => many::inverse(&arguments),
        Command::View(arguments) => view::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
    }
}
