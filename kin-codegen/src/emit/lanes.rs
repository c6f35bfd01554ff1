//! Inverse kinematics as Rust: all branches together, as array lanes.
//!
//! Values that depend on no sign are scalars. Every sign doubles the lanes:
//! one loop per sign, whose body is straight-line code on lane `k`, which the
//! compiler turns into vector instructions. Arrays that outlive their loop are
//! widened, so that every access in a loop is contiguous.

use super::straight::{Writer, sign_name};
use crate::expr::Node;
use crate::expr::inverse::Inverse;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use std::collections::BTreeMap;

/// The statements that compute the lanes, and how to read the results.
pub struct Lanes {
    /// The body.
    pub statements: Vec<TokenStream>,
    /// By coordinate of q: an expression in the lane index `k`.
    pub q: Vec<TokenStream>,
    /// Likewise.
    pub residual: TokenStream,
    /// Likewise.
    pub invalid: TokenStream,
    /// Likewise.
    pub singular: TokenStream,
    /// The inputs that are read.
    pub inputs: Vec<bool>,
}

/// Writes all lanes of an inverse. `inputs` are the names of the target's
/// twelve entries.
pub fn lanes(inverse: &Inverse, inputs: &[TokenStream]) -> Lanes {
    let g = &inverse.graph;
    let levels = g.levels();
    let outputs = inverse.outputs();
    let mut writer = Writer::new(g, &outputs, inputs, &levels);
    // The last level at which each node is read.
    let mut last_read = vec![0; levels.len()];
    for (i, node) in g.nodes().iter().enumerate() {
        for e in node.operands().filter(|_| writer.needs(g.at(i))) {
            last_read[e.index()] = last_read[e.index()].max(levels[i]);
        }
    }
    // What is returned is read after the last loop, in all lanes.
    for e in &outputs {
        last_read[e.index()] = g.choices();
    }
    let mut statements = writer.statements(
        |i| levels[i] == 0,
        |_, name, value| (quote!(let #name = #value;), quote!(#name)),
    );
    // Arrays alive, by node: name and last level.
    let mut alive: BTreeMap<usize, (Ident, u8)> = BTreeMap::new();
    for level in 1..=g.choices() {
        statements.push(widened(&alive, level));
        let width = Literal::usize_unsuffixed(1 << level);
        let mut arrays = Vec::new();
        let body = writer.statements(
            |i| levels[i] == level,
            |e, name, value| {
                let i = e.index();
                if last_read[i] > level || outputs.contains(&e) {
                    arrays.push(name.clone());
                    alive.insert(i, (name.clone(), last_read[i]));
                    (quote!(#name[k] = #value;), quote!(#name[k]))
                } else {
                    (quote!(let #name = #value;), quote!(#name))
                }
            },
        );
        let (sign, sign_lanes) = signs(level);
        statements.push(quote! {
            #(let mut #arrays = [0.0; #width];)*
            for k in 0..#width {
                let #sign = #sign_lanes[k];
                #(#body)*
            }
        });
    }
    Lanes {
        q: inverse.q.iter().map(|&e| writer.output(e)).collect(),
        residual: writer.output(inverse.residual),
        invalid: writer.output(inverse.invalid),
        singular: writer.output(inverse.singular),
        inputs: used_inputs(&writer, inverse),
        statements,
    }
}

/// The sign of a level's choice and its values: + for the first half of the
/// lanes, − for the second.
fn signs(level: u8) -> (Ident, TokenStream) {
    let half = 1 << (level - 1);
    let plus = std::iter::repeat_n(quote!(1.0), half);
    let minus = std::iter::repeat_n(quote!(-1.0), half);
    let lanes = plus.chain(minus);
    (sign_name(level - 1), quote!([#(#lanes),*]))
}

/// Statements that bring older arrays to the width of a level.
fn widened(alive: &BTreeMap<usize, (Ident, u8)>, level: u8) -> TokenStream {
    let names = alive
        .values()
        .filter(|(_, last)| *last >= level)
        .map(|(name, _)| name);
    let (from, to) = (1_usize << (level - 1), 1_usize << level);
    let (from, to) = (
        Literal::usize_unsuffixed(from),
        Literal::usize_unsuffixed(to),
    );
    quote!(#(let #names = widen::<#from, #to>(#names);)*)
}

fn used_inputs(writer: &Writer, inverse: &Inverse) -> Vec<bool> {
    let g = &inverse.graph;
    (0..12)
        .map(|k| g.find(Node::Input(k)).is_some_and(|e| writer.needs(e)))
        .collect()
}
