//! Inverse kinematics as Rust: all branches of `T` targets together, as array lanes.
//!
//! Values that depend on no sign are one for each target. Every sign doubles the
//! branches, and the values that depend on it are computed in a loop over them,
//! with a loop over the targets inside, whose body is straight-line code on target
//! `t` of branch `k`. Of one target, the loop over branches becomes vector
//! instructions; of several, the loop over targets. For that the signs are arrays
//! from outside of the loop, a loop reads no array that it writes, and arrays that
//! outlive their loop are widened, so that every access is contiguous. Two lanes
//! are too few to vectorize, so the first two signs share a loop of four.

use super::comment::comment;
use super::headings::{self, GIVEN, Headings, SHARED};
use super::straight::{Place, Writer, sign_name};
use crate::closed_form::ClosedForm;
use crate::expr::inverse::InverseGraph;
use crate::expr::{Expr, Graph, Node};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

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
    /// What the next root says of an angle that may be free: its level, and positive
    /// where it has none.
    pub free_angle: [TokenStream; 2],
    /// The inputs that are read.
    pub inputs: Vec<bool>,
}

/// The loops: each handles the signs up to the given number.
fn loops(choices: u8) -> Vec<u8> {
    match choices {
        0 | 1 => (1..=choices).collect(),
        _ => (2..=choices).collect(),
    }
}

/// How many numbers a target has, the first inputs.
pub const TARGET: usize = 12;

/// When each node is computed.
fn stages(g: &Graph, loops: &[u8]) -> Vec<usize> {
    let mut of_target = vec![false; g.nodes().len()];
    for (i, node) in g.nodes().iter().enumerate() {
        of_target[i] = match node {
            Node::Input(k) => usize::from(*k) < TARGET,
            _ => node.operands().any(|e| of_target[e.index()]),
        };
    }
    let stage = |(level, of_target): (u8, bool)| match (level, of_target) {
        (0, false) => GIVEN,
        (0, true) => SHARED,
        _ => SHARED + 1 + loops.iter().position(|&last| level <= last).unwrap_or(0),
    };
    g.levels().into_iter().zip(of_target).map(stage).collect()
}

/// Writes all lanes of a closed form. `inputs` are the names of its inputs, those of
/// the target arrays with a place for each target.
pub fn lanes(solver: &ClosedForm, inverse: &InverseGraph, inputs: &[TokenStream]) -> Lanes {
    let g = &inverse.graph;
    let headings = Headings::new(&solver.plan, &solver.linkage, inverse);
    let outputs = inverse.outputs();
    let loops = loops(g.choices());
    let stages = stages(g, &loops);
    let inputs: Vec<TokenStream> = (inputs.iter().enumerate())
        .map(|(i, name)| {
            if i < TARGET {
                quote!(#name[t])
            } else {
                name.clone()
            }
        })
        .collect();
    let mut writer = Writer::new(g, &outputs, &inputs, &stages);
    let last_read = last_read(&writer, inverse, &stages, SHARED + loops.len());
    let mut statements = given(&mut writer, solver, &headings, &stages);
    // Arrays alive, by node: name and the last stage that reads them.
    let mut alive: BTreeMap<usize, (Ident, usize)> = BTreeMap::new();
    let mut before = 0;
    for (stage, signs) in (SHARED..).zip(std::iter::once(0).chain(loops)) {
        if stage > SHARED + 1 {
            statements.push(widened(&alive, &stages, stage, 1 << before, 1 << signs));
        }
        let mut kept: Vec<(Ident, Ident)> = Vec::new();
        let mut opened = headings.of_stage(&writer, &stages, stage);
        let place = if stage == SHARED {
            Place::Scalar
        } else {
            Place::Lane
        };
        let mut body = writer.statements(
            place,
            |i| stages[i] == stage,
            |i| opened.before(i),
            |e, name, value| {
                let last = last_read[e.index()];
                if last > stage || outputs.contains(&e) {
                    let array = format_ident!("{name}_");
                    kept.push((array.clone(), name.clone()));
                    alive.insert(e.index(), (array, last));
                }
                (quote!(let #name = #value;), quote!(#name))
            },
        );
        body.push(opened.rest());
        // From here on they are read from their arrays.
        let branch = (stage > SHARED).then(|| quote!([k]));
        for (i, (array, _)) in alive.iter().filter(|(i, _)| stages[**i] == stage) {
            writer.rename(g.at(*i), quote!(#array #branch [t]));
        }
        if stage == SHARED {
            statements.extend(target_loop(&kept, &body));
            continue;
        }
        let read = signs_read(&writer, g, &stages, stage);
        statements.push(headings::lanes(&solver.plan, &read, signs));
        statements.push(lane_loop(&read, signs, &kept, &body));
        before = signs;
    }
    let width = Literal::usize_unsuffixed(1 << before);
    let last = stages.iter().copied().max().unwrap_or(SHARED);
    let array = |e: Expr| match (alive.get(&e.index()), stages[e.index()]) {
        (Some((array, _)), SHARED) => quote!([#array; #width]),
        (Some((array, _)), stage) if stage < last => quote!(#array.all()),
        (Some((array, _)), _) => quote!(#array),
        (None, SHARED) => {
            let value = writer.output(e);
            quote!([::core::array::from_fn(|t| #value); #width])
        }
        (None, _) => {
            let value = writer.output(e);
            quote!([[#value; T]; #width])
        }
    };
    Lanes {
        q: inverse.q.iter().map(|&e| array(e)).collect(),
        residual: array(inverse.residual),
        invalid: array(inverse.invalid),
        singular: array(inverse.singular),
        free_angle: match inverse.free_angle {
            Some(free) => [array(free.level), array(free.no_root)],
            None => std::array::from_fn(|_| quote!([[0.0; T]; #width])),
        },
        inputs: (0..inputs.len()).map(|k| writer.needs_input(k)).collect(),
        statements,
    }
}

/// The statements in front of all loops.
fn given(
    writer: &mut Writer,
    solver: &ClosedForm,
    headings: &Headings,
    stages: &[usize],
) -> Vec<TokenStream> {
    let mut statements = Vec::new();
    let seeds = writer.sines_and_cosines(&quote!(lanes::sin_cos));
    if !seeds.is_empty() {
        statements.push(comment(match solver.given.parameters() {
            0 => "The seed, for an angle that the target leaves free",
            _ => "What is given beside the target; the seed, for an angle that both leave free",
        }));
        statements.extend(seeds);
    }
    let mut opened = headings.of_stage(writer, stages, GIVEN);
    statements.extend(writer.statements(
        Place::Scalar,
        |i| stages[i] == GIVEN,
        |i| opened.before(i),
        |_, name, value| (quote!(let #name = #value;), quote!(#name)),
    ));
    statements.push(opened.rest());
    statements
}

/// The last stage at which each node is read; results are read after all.
fn last_read(
    writer: &Writer,
    inverse: &InverseGraph,
    stages: &[usize],
    after: usize,
) -> Vec<usize> {
    let g = &inverse.graph;
    let mut last = vec![0; stages.len()];
    for (i, node) in g.nodes().iter().enumerate() {
        for e in node.operands().filter(|_| writer.needs(g.at(i))) {
            last[e.index()] = last[e.index()].max(stages[i]);
        }
    }
    for e in inverse.outputs() {
        last[e.index()] = after;
    }
    last
}

/// The choices whose signs a stage reads: its own, and earlier ones that it
/// selects by.
fn signs_read(writer: &Writer, g: &Graph, stages: &[usize], stage: usize) -> BTreeSet<u8> {
    let nodes = g.nodes();
    let here = (0..nodes.len()).filter(|&i| stages[i] == stage && writer.needs(g.at(i)));
    here.flat_map(|i| nodes[i].operands())
        .filter_map(|e| match nodes[e.index()] {
            Node::Sign(choice) => Some(choice.0),
            _ => None,
        })
        .collect()
}

/// The loop over targets of what their branches share.
fn target_loop(kept: &[(Ident, Ident)], body: &[TokenStream]) -> Option<TokenStream> {
    let (arrays, values): (Vec<&Ident>, Vec<&Ident>) = kept.iter().map(|(a, v)| (a, v)).unzip();
    (!kept.is_empty()).then(|| {
        quote! {
            #(let mut #arrays = [0.0; T];)*
            for t in 0..T {
                #(#body)*
                #(#arrays[t] = #values;)*
            }
        }
    })
}

/// One loop over the branches of `signs` choices, of which those in `read` are
/// read, and the targets of each.
fn lane_loop(
    read: &BTreeSet<u8>,
    signs: u8,
    kept: &[(Ident, Ident)],
    body: &[TokenStream],
) -> TokenStream {
    let width = Literal::usize_unsuffixed(1 << signs);
    let (names, lanes): (Vec<Ident>, Vec<TokenStream>) = read
        .iter()
        .map(|&choice| (sign_name(choice), sign_lanes(choice, signs)))
        .unzip();
    let (arrays, values): (Vec<&Ident>, Vec<&Ident>) = kept.iter().map(|(a, v)| (a, v)).unzip();
    quote! {
        #(let #names = #lanes;)*
        #(let mut #arrays = [[0.0; T]; #width];)*
        for k in 0..#width {
            for t in 0..T {
                #(#body)*
                #(#arrays[k][t] = #values;)*
            }
        }
    }
}

/// The sign of a choice in every lane: lane k has + where bit `choice` of k is
/// clear.
fn sign_lanes(choice: u8, signs: u8) -> TokenStream {
    let lanes = (0..1_u32 << signs).map(|k| match k >> choice & 1 {
        0 => quote!(1.0),
        _ => quote!(-1.0),
    });
    quote!([#(#lanes),*])
}

/// Statements that bring older arrays to the width of a stage.
fn widened(
    alive: &BTreeMap<usize, (Ident, usize)>,
    stages: &[usize],
    stage: usize,
    from: usize,
    to: usize,
) -> TokenStream {
    let read = alive
        .iter()
        .filter(|(i, (_, last))| stages[**i] > SHARED && *last >= stage);
    let names: Vec<&Ident> = read.map(|(_, (name, _))| name).collect();
    let comment = (!names.is_empty()).then(|| headings::widened(from, to));
    let (from, to) = (
        Literal::usize_unsuffixed(from),
        Literal::usize_unsuffixed(to),
    );
    quote!(#comment #(let #names = widen::<#from, #to, T, _>(&#names);)*)
}
