//! What Rust says of expressions.

use super::comment::comment;
use crate::emit::language::{Function, Language, Operator};
use crate::emit::straight::{self, Trig};
use crate::expr::{RootField, RootPart};
use kin_runtime::{Pose, Twist};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// The language.
pub struct Rust;

/// Writes parts of a graph as Rust.
pub type Writer<'a> = straight::Writer<'a, Rust>;

impl Language for Rust {
    type Text = TokenStream;

    fn name(name: &str) -> TokenStream {
        let name = format_ident!("{name}");
        quote!(#name)
    }

    fn number(x: f64) -> TokenStream {
        let literal = literal(x);
        quote!(#literal)
    }

    fn minus(a: TokenStream) -> TokenStream {
        quote!(-#a)
    }

    fn parenthesized(a: TokenStream) -> TokenStream {
        quote!((#a))
    }

    fn infix(a: TokenStream, operator: Operator, b: TokenStream) -> TokenStream {
        match operator {
            Operator::Plus => quote!(#a + #b),
            Operator::Minus => quote!(#a - #b),
            Operator::Times => quote!(#a * #b),
            Operator::Over => quote!(#a / #b),
        }
    }

    fn call(function: Function, arguments: Vec<TokenStream>) -> TokenStream {
        let function = match (function, &arguments[..]) {
            (Function::Angle, _) => return quote!(math::wrap(math::atan2(#(#arguments),*))),
            (Function::SelectLess, [a, b, x, y]) => return quote!(math::select(#a < #b, #x, #y)),
            (Function::SelectLess, _) => quote!(math::select),
            (Function::Sqrt, _) => quote!(math::sqrt),
            (Function::AngleInLanes, _) => quote!(A::angle),
            (Function::Wrap, _) => quote!(math::wrap),
            (Function::Max, _) => quote!(math::max),
        };
        quote!(#function(#(#arguments),*))
    }

    fn root(quartic: &str, part: RootPart) -> TokenStream {
        let name = Self::name(quartic);
        let place = Literal::u8_unsuffixed(part.place);
        let field = match part.field {
            RootField::Sin => quote!(sin),
            RootField::Cos => quote!(cos),
            RootField::State => quote!(state),
        };
        quote!(#name[#place].#field)
    }

    fn sign(name: &str) -> TokenStream {
        let name = Self::name(name);
        quote!(#name[k])
    }

    fn of_target(entry: &str) -> TokenStream {
        let array = Self::name(entry);
        quote!(#array[t])
    }

    fn kept(value: &str, of_branch: bool) -> TokenStream {
        let array = array(value);
        match of_branch {
            true => quote!(#array[k][t]),
            false => quote!(#array[t]),
        }
    }

    fn definition(name: &str, value: TokenStream) -> TokenStream {
        let name = Self::name(name);
        quote!(let #name = #value;)
    }

    fn roots(name: &str, coefficients: [TokenStream; 5]) -> TokenStream {
        let name = Self::name(name);
        quote!(let #name = trig_roots([#(#coefficients),*]);)
    }

    fn comment(text: &str) -> TokenStream {
        comment(text)
    }
}

/// a b + c in the arithmetic that the caller of a function says.
pub fn mul_add(a: TokenStream, b: TokenStream, c: TokenStream) -> TokenStream {
    quote!(A::fma(#a, #b, #c))
}

/// The statements that compute all sines and cosines of a function, in one call.
pub fn sines_and_cosines(writer: &mut Writer, function: &TokenStream) -> Vec<TokenStream> {
    bound(writer.sines_and_cosines(), function)
}

/// The same of those that a walk has found.
pub fn bound(trig: Trig<TokenStream>, function: &TokenStream) -> Vec<TokenStream> {
    let Trig {
        sums: mut statements,
        angles,
    } = trig;
    let pattern = |name: &Option<String>| match name {
        Some(name) => Rust::name(name),
        None => quote!(_),
    };
    let sines = angles.iter().map(|angle| pattern(&angle.sin));
    let cosines = angles.iter().map(|angle| pattern(&angle.cos));
    let values = angles.iter().map(|angle| &angle.value);
    if !angles.is_empty() {
        statements.push(quote! {
            let ([#(#sines),*], [#(#cosines),*]) = #function([#(#values),*]);
        });
    }
    statements
}

/// A number with its sign.
pub fn signed(x: f64) -> TokenStream {
    straight::signed::<Rust>(x)
}

/// The shortest digits of a positive number, small ones as 1e-9.
pub fn literal(x: f64) -> Literal {
    if x != 0.0 && x < 1e-6 {
        format!("{x:e}")
            .parse()
            .unwrap_or_else(|_| Literal::f64_unsuffixed(x))
    } else {
        Literal::f64_unsuffixed(x)
    }
}

/// `[a, b, c]`, three by three.
pub fn matrix<const R: usize>(rows: [[TokenStream; 3]; R]) -> TokenStream {
    let rows = rows.map(|[a, b, c]| quote!([#a, #b, #c]));
    quote!([#(#rows),*])
}

/// The array of the lanes of a value.
pub fn array(value: &str) -> Ident {
    format_ident!("{value}_")
}

/// What is called `name`.
pub fn identifier(name: &str) -> Ident {
    format_ident!("{name}")
}

/// A vector without the noise of composing frames.
pub fn vector(v: [f64; 3]) -> TokenStream {
    let entries = v.map(|x| signed(if x.abs() < 1e-15 { 0.0 } else { x }));
    quote!([#(#entries),*])
}

/// `[0.0; n]`, or the values one by one.
pub fn numbers(values: &[f64]) -> TokenStream {
    if values.iter().all(|x| *x == 0.0) {
        let n = Literal::usize_unsuffixed(values.len());
        return quote!([0.0; #n]);
    }
    let values = values.iter().map(|&x| signed(x));
    quote!([#(#values),*])
}

/// A pose, by all its entries.
pub fn pose(pose: &Pose) -> TokenStream {
    let rows = pose.rotation.iter().map(|row| numbers(row));
    let translation = numbers(&pose.translation);
    quote!(Pose { rotation: [#(#rows),*], translation: #translation })
}

/// A twist, in the way of a vector.
pub fn twist(twist: &Twist) -> TokenStream {
    let [linear, angular] = [twist.linear, twist.angular].map(vector);
    quote!(Twist { linear: #linear, angular: #angular })
}
