//! Rust: a zero-sized type for a robot.

mod comment;
mod documentation;
mod forward;
mod frames;
mod imports;
mod inverse;
mod lanes;
mod language;
mod mechanism;
mod redundant;
mod robot;
mod single;
mod singular;
mod univariate;

pub(crate) use comment::{header, print, without_comments};
pub(crate) use imports::is_taken;
pub use mechanism::mechanism;
pub use robot::robot;

use proc_macro2::{Ident, TokenStream};

/// What the user names in generated code.
pub struct Names {
    /// The robot's type.
    pub robot: Ident,
    /// The path of the crate `kinematics`.
    pub runtime: TokenStream,
}
