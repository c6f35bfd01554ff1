//! Generated code in single precision: the same tokens with other types and literals.

use proc_macro2::{Group, Ident, Literal, TokenStream, TokenTree};

/// The items with `f32` for `f64`, and every number rounded once, to the nearest `f32`, and
/// written with the digits that it has.
pub fn in_single(items: TokenStream) -> TokenStream {
    let tree = |tree: TokenTree| match tree {
        TokenTree::Group(group) => {
            let mut single = Group::new(group.delimiter(), in_single(group.stream()));
            single.set_span(group.span());
            TokenTree::Group(single)
        }
        TokenTree::Ident(ident) if ident == "f64" => Ident::new("f32", ident.span()).into(),
        TokenTree::Literal(literal) => rounded(&literal).unwrap_or(literal).into(),
        other => other,
    };
    items.into_iter().map(tree).collect()
}

/// A number with a point or an exponent; none if the literal is something else.
fn rounded(literal: &Literal) -> Option<Literal> {
    let digits = literal.to_string();
    let is_number = digits.starts_with(|c: char| c.is_ascii_digit());
    let is_float = is_number && digits.contains(['.', 'e']);
    let exact: f64 = digits.parse().ok().filter(|_| is_float)?;
    let x = exact as f32;
    // As in double precision; small ones as 1e-9.
    match x != 0.0 && x < 1e-6 {
        true => format!("{x:e}").parse().ok(),
        false => Some(Literal::f32_unsuffixed(x)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::quote;

    #[test]
    fn numbers_are_rounded_once_and_types_are_single() {
        let double = quote!(
            fn f(x: &[f64; 3]) -> f64 {
                0.1333 * x[0] + 3.141592653589793 - 4.930380657631324e-32
            }
        );
        let single = quote!(
            fn f(x: &[f32; 3]) -> f32 {
                0.1333 * x[0] + 3.1415927 - 4.9303807e-32
            }
        );
        assert_eq!(in_single(double).to_string(), single.to_string());
        // Halfway between two numbers of f32 and a little more: the digits of f64 decide.
        let above = 1.0 + f64::from(f32::EPSILON) / 2.0 + f64::EPSILON;
        let [above, rounded] = [
            Literal::f64_unsuffixed(above),
            Literal::f32_unsuffixed(1.000_000_1),
        ];
        assert_eq!(in_single(quote!(#above)).to_string(), rounded.to_string());
        let others = quote!("0.1 f64" 12 0 b'e');
        assert_eq!(in_single(others.clone()).to_string(), others.to_string());
    }
}
