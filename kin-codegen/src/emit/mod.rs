//! From expressions to Rust: the only room that knows the language.

mod comment;
mod documentation;
mod forward;
mod frames;
pub(crate) mod header;
mod headings;
mod imports;
mod inverse;
mod lanes;
mod mechanism;
mod postures;
mod redundant;
mod robot;
mod singular;
mod straight;
mod text;
mod univariate;

pub(crate) use comment::{print, without_comments};
pub(crate) use imports::is_taken;
pub use mechanism::mechanism;
pub use robot::robot;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// What the user names in generated code.
pub struct Names {
    /// The robot's type.
    pub robot: Ident,
    /// The path of the crate `kinematics`.
    pub runtime: TokenStream,
}

/// `[a, b, c]`, three by three.
fn matrix<const R: usize>(rows: [[TokenStream; 3]; R]) -> TokenStream {
    let rows = rows.map(|[a, b, c]| quote!([#a, #b, #c]));
    quote!([#(#rows),*])
}
