//! Forward kinematics and Jacobians as Rust functions.

use super::comment::comment;
use super::language::{Writer, matrix, mul_add, sines_and_cosines};
use crate::emit::language::MulAdd;
use crate::emit::straight::Place;
use crate::expr::jacobian::Columns;
use crate::expr::linear::Motion;
use crate::expr::{Expr, Graph};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// A block that computes outputs from `q` and returns `result`.
pub fn block(
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    result: impl FnOnce(&Writer) -> TokenStream,
) -> TokenStream {
    block_of(&["q"], None, g, outputs, n, result).0
}

/// The same as the robot's implementation of `Forward`, whose caller says how the
/// sines and cosines are found, and in which arithmetic; `output` is the type of the result.
pub fn implementation(
    robot: &Ident,
    output: &TokenStream,
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    result: impl FnOnce(&Writer) -> TokenStream,
) -> TokenStream {
    let (body, angles) = block_of(&["q"], Some(quote!(sin_cos.of)), g, outputs, n, result);
    let unused = (angles == 0).then(|| quote!(let _ = sin_cos;));
    let [angles, n] = [angles, n].map(Literal::usize_unsuffixed);
    quote! {
        impl Forward<#output, #n, #angles> for #robot {
            #[inline(always)]
            fn at<A: Arithmetic>(q: &[f64; #n], sin_cos: impl SinCos<#angles>) -> #output {
                #unused
                #body
            }
        }
    }
}

/// The same from `q` and `rates`, the inputs behind it.
pub fn block_with_rates(
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    result: impl FnOnce(&Writer) -> TokenStream,
) -> TokenStream {
    block_of(&["q", "rates"], None, g, outputs, n, result).0
}

/// The block, and of how many angles it asks the sines and cosines; `sin_cos` is whom, where the
/// caller of the function says so, and in which arithmetic.
fn block_of(
    parameters: &[&str],
    sin_cos: Option<TokenStream>,
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    result: impl FnOnce(&Writer) -> TokenStream,
) -> (TokenStream, usize) {
    let inputs: Vec<TokenStream> = (0..usize::from(g.inputs()))
        .map(|i| {
            let of = format_ident!("{}", parameters.get(i / n).unwrap_or(&"q"));
            let i = Literal::usize_unsuffixed(i % n);
            quote!(#of[#i])
        })
        .collect();
    let stages = vec![0; g.nodes().len()];
    let fused = sin_cos.is_some().then_some(mul_add as MulAdd<_>);
    let mut writer = Writer::new(g, outputs, &inputs, &stages, fused);
    let sin_cos = sin_cos.unwrap_or_else(|| quote!(lanes::sin_cos));
    let trig = sines_and_cosines(&mut writer, &sin_cos);
    let statements = writer.statements(Place::Scalar, |_| true, |_| Vec::new(), |_, _| ());
    // A parameter that nothing depends on is taken all the same.
    let unread = (parameters.iter().enumerate())
        .filter(|(i, _)| !(i * n..(i + 1) * n).any(|k| writer.needs_input(k)))
        .map(|(_, parameter)| {
            let parameter = format_ident!("{parameter}");
            quote!(let _ = #parameter;)
        });
    let heading = writer
        .adds_angles()
        .then(|| comment("Angles about parallel axes add up"));
    let result = result(&writer);
    let body = quote!(#(#unread)* #heading #(#trig)* #(#statements)* #result);
    (body, writer.angles().len())
}

/// `Pose { .. }`.
pub fn pose(writer: &Writer, motion: &Motion) -> TokenStream {
    let rotation = matrix(motion.rotation.map(|row| row.map(|e| writer.output(e))));
    let translation = motion.translation.map(|e| writer.output(e));
    quote!(Pose { rotation: #rotation, translation: [#(#translation),*] })
}

/// `Jacobian { .. }`, by rows.
pub fn jacobian(writer: &Writer, columns: &Columns) -> TokenStream {
    let rows = (0..6).map(|row| {
        let entries = columns
            .0
            .iter()
            .map(|column| writer.output(column[row / 3][row % 3]));
        quote!([#(#entries),*])
    });
    quote!(Jacobian { rows: [#(#rows),*] })
}
