//! The branches of `T` targets as Rust: one source for single targets, with `T` = 1, whose
//! loops over branches become vector instructions, and for batches, whose loops over targets
//! inside of those do.

use super::comment::comment;
use super::language::{Rust, array, bound, identifier, mul_add};
use crate::closed_form::ClosedForm;
use crate::emit::headings;
use crate::emit::lanes::{self, Output, Stage, is_minus, told_of_angles};
use crate::emit::straight::sign_name;
use crate::expr::inverse::InverseGraph;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

/// The statements that compute the lanes, and the arrays of the results.
pub struct Lanes {
    /// The body.
    pub statements: Vec<TokenStream>,
    /// By coordinate of q.
    pub q: Vec<TokenStream>,
    /// Metres.
    pub residual: TokenStream,
    /// Positive where there is no branch.
    pub invalid: TokenStream,
    /// Positive where the branch is singular.
    pub singular: TokenStream,
    /// See [`lanes::Lanes::free_joints`].
    pub free_joints: Vec<[TokenStream; 2]>,
    /// See [`lanes::Lanes::busy`].
    pub busy: usize,
    /// The inputs that are read.
    pub inputs: Vec<bool>,
    /// The angles whose sines and cosines the body asks for: what adds them up, and each.
    pub angles: (Vec<TokenStream>, Vec<TokenStream>),
}

/// Writes all lanes of a closed form; `inputs` are those behind the target, and `sin_cos` is
/// the function that gives the sines and cosines of angles.
pub fn lanes(
    solver: &ClosedForm,
    inverse: &InverseGraph,
    inputs: impl IntoIterator<Item = TokenStream>,
    sin_cos: &TokenStream,
) -> Lanes {
    let found = lanes::lanes::<Rust>(solver, inverse, inputs, Some(mul_add));
    let values = found.trig.angles.iter().map(|angle| angle.value.clone());
    let angles = (found.trig.sums.clone(), values.collect());
    let mut statements = bound(found.trig, sin_cos);
    if !statements.is_empty() {
        statements.insert(0, comment(told_of_angles(solver)));
    }
    statements.extend(found.given);
    for (number, stage) in found.stages.iter().enumerate() {
        if number == 0 {
            statements.extend(target_loop(stage));
            continue;
        }
        statements.extend(widened(stage));
        statements.push(comment(&stage.heading));
        statements.push(lane_loop(stage));
    }
    let width = Literal::usize_unsuffixed(found.width);
    let result = |output: &Output<TokenStream>| written(output, &width);
    Lanes {
        statements,
        q: found.q.iter().map(result).collect(),
        residual: result(&found.residual),
        invalid: result(&found.invalid),
        singular: result(&found.singular),
        free_joints: found
            .free_joints
            .iter()
            .map(|free| free.each_ref().map(result))
            .collect(),
        busy: found.busy,
        inputs: found.inputs,
        angles,
    }
}

/// A result as an array of lanes.
fn written(output: &Output<TokenStream>, width: &Literal) -> TokenStream {
    match output {
        Output::OfTarget(value) => {
            let array = array(value);
            quote!([#array.0; #width])
        }
        Output::Earlier(value) => {
            let array = array(value);
            quote!(#array.all())
        }
        Output::Last(value) => {
            let array = array(value);
            quote!(#array.0)
        }
        Output::ValueOfTarget(value) => quote!([::core::array::from_fn(|t| #value); #width]),
        Output::Value(value) => quote!([[#value; T]; #width]),
    }
}

/// The values that outlive a loop, with their arrays.
fn kept(stage: &Stage<Rust>) -> (Vec<Ident>, Vec<Ident>) {
    let kept = stage.kept.iter();
    kept.map(|value| (array(value), identifier(value))).unzip()
}

/// The loop over targets of what their branches share.
fn target_loop(stage: &Stage<Rust>) -> Option<TokenStream> {
    let (arrays, values) = kept(stage);
    let body = &stage.body;
    (!arrays.is_empty()).then(|| {
        quote! {
            aligned!(#(#arrays),* = [0.0; T]);
            for t in 0..T {
                #(#body)*
                #(#arrays[t] = #values;)*
            }
        }
    })
}

/// A loop over branches, and over the targets of each.
fn lane_loop(stage: &Stage<Rust>) -> TokenStream {
    let width = Literal::usize_unsuffixed(1 << stage.signs);
    let (names, lanes): (Vec<Ident>, Vec<TokenStream>) = stage
        .reads
        .iter()
        .map(|&choice| {
            (
                identifier(&sign_name(choice)),
                sign_lanes(choice, stage.signs),
            )
        })
        .unzip();
    let (arrays, values) = kept(stage);
    let body = &stage.body;
    quote! {
        #(let #names = #lanes;)*
        aligned!(#(#arrays),* = [[0.0; T]; #width]);
        for k in 0..#width {
            for t in 0..T {
                #(#body)*
                #(#arrays[k][t] = #values;)*
            }
        }
    }
}

/// The sign of a choice in every lane.
fn sign_lanes(choice: u8, signs: u8) -> TokenStream {
    let lanes = (0..1_u32 << signs).map(|lane| match is_minus(choice, lane) {
        false => quote!(1.0),
        true => quote!(-1.0),
    });
    quote!([#(#lanes),*])
}

/// Statements that bring older arrays to the width of a stage.
fn widened(stage: &Stage<Rust>) -> Option<TokenStream> {
    let (names, from) = &stage.widened;
    let to = 1 << stage.signs;
    let comment = comment(&headings::widened(*from, to));
    let [from, to] = [*from, to].map(Literal::usize_unsuffixed);
    let names: Vec<Ident> = names.iter().map(|name| array(name)).collect();
    (!names.is_empty()).then(|| quote!(#comment widen!(#(#names),* from #from to #to of T);))
}
