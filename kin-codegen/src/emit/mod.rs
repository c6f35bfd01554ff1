//! From expressions to Rust: the only room that knows the language.

mod comment;
mod forward;
mod headings;
mod inverse;
mod lanes;
mod mechanism;
mod robot;
mod singular;
mod straight;
mod summary;
mod text;

pub(crate) use comment::{print, push_comment, without_comments};
pub use mechanism::mechanism;
pub use robot::{TAKEN, robot};

use proc_macro2::TokenStream;
use quote::quote;

/// `[a, b, c]`, three by three.
fn matrix<const R: usize>(rows: [[TokenStream; 3]; R]) -> TokenStream {
    let rows = rows.map(|[a, b, c]| quote!([#a, #b, #c]));
    quote!([#(#rows),*])
}
