//! How a command ends.

use kin_codegen::Error;
use std::process::ExitCode;

/// The exit codes of `kin`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// All is well.
    Success = 0,
    /// A robot file or an option is wrong, or a file cannot be read or
    /// written.
    Broken = 1,
    /// The command line is wrong.
    Usage = 2,
    /// A robot file is sound, but its arm has no closed form.
    Refused = 3,
    /// The checked-in code is not what would be generated.
    Stale = 4,
    /// A closed form has lost solutions, or given wrong ones.
    Incomplete = 5,
    /// A robot file has several robots, and the options do not choose one.
    Ambiguous = 6,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        ExitCode::from(exit as u8)
    }
}

impl From<&Error> for Exit {
    fn from(error: &Error) -> Self {
        match error {
            Error::Broken(_) => Exit::Broken,
            Error::Ambiguous(_) => Exit::Ambiguous,
            Error::Refused(_) => Exit::Refused,
        }
    }
}
