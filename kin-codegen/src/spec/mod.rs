//! Reading robot files.
mod diagnostic;
pub use diagnostic::{Diagnostic, Diagnostics, Location};

/// A robot file in memory: the text, and the path that messages name.
#[derive(Clone, Debug)]
pub struct Source {
    /// As the user wrote it; its extension chooses the format.
    pub path: String,
    /// The whole file.
    pub text: String,
}
