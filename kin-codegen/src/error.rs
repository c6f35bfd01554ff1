//! Why a robot file does not become code.

use crate::refusal::Refusal;
use crate::spec::Diagnostics;
use std::fmt;

/// Why a robot file, or what was asked of it, does not become code. Displayed
/// as a compiler's messages, each with a remedy.
#[derive(Clone, Debug)]
pub enum Error {
    /// Something is wrong with the file or the options.
    Broken(Diagnostics),
    /// The file is sound, and has several robots: the options have to choose.
    Ambiguous(Diagnostics),
    /// The file is sound, and its robot has no closed-form inverse kinematics.
    Refused(Box<Refusal>),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Broken(diagnostics) | Error::Ambiguous(diagnostics) => diagnostics.fmt(f),
            Error::Refused(refusal) => refusal.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<Diagnostics> for Error {
    fn from(diagnostics: Diagnostics) -> Self {
        match diagnostics.is_ambiguous() {
            true => Error::Ambiguous(diagnostics),
            false => Error::Broken(diagnostics),
        }
    }
}
