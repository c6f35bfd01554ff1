//! The `kinematics!` macro.

use kin_codegen::{Options, Source, generate};
use proc_macro::TokenStream;

/// Compiles a robot file.
#[proc_macro]
pub fn kinematics(input: TokenStream) -> TokenStream {
    let path = syn::parse_macro_input!(input as syn::LitStr);
    let root = std::env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
    let file = std::path::Path::new(&root).join(path.value());
    let text = match std::fs::read_to_string(&file) {
        Ok(text) => text,
        Err(error) => {
            return syn::Error::new(path.span(), error)
                .to_compile_error()
                .into();
        }
    };
    let source = Source {
        path: path.value(),
        text,
    };
    match generate(&source, &Options::default()) {
        Ok(generated) => generated.tokens.into(),
        Err(error) => syn::Error::new(path.span(), error)
            .to_compile_error()
            .into(),
    }
}
