//! From expressions to Rust: the only room that knows the language.

mod comment;
mod documentation;
mod forward;
pub(crate) mod header;
mod headings;
mod imports;
mod inverse;
mod lanes;
mod mechanism;
mod postures;
mod robot;
mod singular;
mod straight;
mod text;

pub(crate) use comment::{print, without_comments};
pub use mechanism::mechanism;
pub use robot::{TAKEN, robot};

use proc_macro2::TokenStream;
use quote::quote;

/// `[a, b, c]`, three by three.
fn matrix<const R: usize>(rows: [[TokenStream; 3]; R]) -> TokenStream {
    let rows = rows.map(|[a, b, c]| quote!([#a, #b, #c]));
    quote!([#(#rows),*])
}
