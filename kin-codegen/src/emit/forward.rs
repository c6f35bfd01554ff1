//! Forward kinematics and Jacobians as Rust functions.

use super::matrix;
use super::straight::{Place, Writer};
use crate::expr::jacobian::Columns;
use crate::expr::linear::Motion;
use crate::expr::{Expr, Graph};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// A block that computes outputs from `q`, and from `rates` if the graph has
/// inputs for them, and returns `result`.
pub fn block(
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    result: impl FnOnce(&Writer) -> TokenStream,
) -> TokenStream {
    let inputs: Vec<TokenStream> = (0..usize::from(g.inputs()))
        .map(|i| {
            let of = if i < n { quote!(q) } else { quote!(rates) };
            let i = Literal::usize_unsuffixed(i % n);
            quote!(#of[#i])
        })
        .collect();
    let stages = vec![0; g.nodes().len()];
    let mut writer = Writer::new(g, outputs, &inputs, &stages);
    let trig = writer.sines_and_cosines();
    let statements = writer.statements(
        Place::Scalar,
        |_| true,
        |_| TokenStream::new(),
        |_, name, value| (quote!(let #name = #value;), quote!(#name)),
    );
    let result = result(&writer);
    quote!(#(#trig)* #(#statements)* #result)
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
