//! What holds of everything that may stand between the parentheses of the
//! macro. Taken in beside the macro's parser, which no library exports.

use proc_macro2::TokenStream;
use syn::Result;

/// Parses arguments; whether they are some.
pub fn check<T>(text: &str, parse: impl Fn(TokenStream) -> Result<T>) -> bool {
    let Ok(tokens) = text.parse::<TokenStream>() else {
        return false;
    };
    match parse(tokens) {
        Ok(_) => true,
        Err(error) => {
            let messages: Vec<String> = error.into_iter().map(|e| e.to_string()).collect();
            assert!(!messages.is_empty());
            for message in messages {
                assert!(!message.is_empty() && message.len() < 10_000, "{message}");
            }
            false
        }
    }
}
