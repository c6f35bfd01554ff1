//! Inverse kinematics as a Rust function.

use super::lanes::{Lanes, lanes};
use super::straight::literal;
use crate::model::{JointKind, Model};
use crate::plan::Target;
use crate::solver::ClosedForm;
use crate::verify::SOUND;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// The body of `ik(&self, pose: &Pose) -> Solutions<N>`.
pub fn body(model: &Model, solver: &ClosedForm) -> TokenStream {
    let names = target_names();
    let lanes = lanes(&solver.inverse, &names);
    let entries = target_pattern(&names, &lanes.inputs);
    let statements = &lanes.statements;
    let branches = Literal::usize_unsuffixed(solver.plan.branches());
    let accept = accept(model, solver, &lanes);
    let sliding = sliding_mask(model);
    quote! {
        #entries
        #(#statements)*
        Solutions::build_with_prismatic(#sliding, |solutions| {
            for k in 0..#branches {
                #accept
            }
        })
    }
}

/// What becomes of one lane.
fn accept(model: &Model, solver: &ClosedForm, lanes: &Lanes) -> TokenStream {
    let Lanes {
        q,
        residual,
        invalid,
        singular,
        ..
    } = lanes;
    let tolerance = literal(SOUND * solver.linkage.size);
    if solver.polish == 0 {
        return quote! {
            solutions.push_if(
                (#invalid <= 0.0) & (#residual <= #tolerance),
                Solution {
                    q: [#(#q),*],
                    residual: #residual,
                    branch: k as u32,
                    singular: #singular > 0.0,
                },
            );
        };
    }
    let size = Literal::f64_unsuffixed(solver.linkage.size);
    let steps = Literal::usize_unsuffixed(solver.polish);
    let n = Literal::usize_unsuffixed(model.variables.len());
    let rows = match solver.plan.target {
        Target::Pose => quote!(6),
        Target::Position => quote!(3),
    };
    let wrapped = (0..model.variables.len()).map(|i| {
        let index = Literal::usize_unsuffixed(i);
        if model.turns(i) {
            quote!(math::wrap(landed.q[#index]))
        } else {
            quote!(landed.q[#index])
        }
    });
    quote! {
        if #invalid > 0.0 {
            continue;
        }
        let landed = polish::<#n, #rows>(
            |q| self.fk_jacobian(q),
            pose,
            [#(#q),*],
            #size,
            #steps,
        );
        solutions.push_distinct_if(
            landed.residual <= #tolerance,
            Solution {
                q: [#(#wrapped),*],
                residual: landed.residual,
                branch: k as u32,
                singular: landed.singular,
            },
        );
    }
}

/// The names of the target's entries: r11 … r33, px, py, pz.
fn target_names() -> Vec<TokenStream> {
    let rotation = (1..=3).flat_map(|i| (1..=3).map(move |j| format_ident!("r{i}{j}")));
    let translation = ["px", "py", "pz"].map(|name| format_ident!("{name}"));
    rotation
        .chain(translation)
        .map(|name| quote!(#name))
        .collect()
}

/// Takes the target apart, as far as it is read.
fn target_pattern(names: &[TokenStream], used: &[bool]) -> TokenStream {
    let name = |i: usize| if used[i] { names[i].clone() } else { quote!(_) };
    let row = |i: usize| {
        let entries = (3 * i..3 * i + 3).map(name);
        quote!([#(#entries),*])
    };
    let rows = (0..3).map(row);
    let translation = row(3);
    quote! {
        let [#(#rows),*] = pose.rotation;
        let #translation = pose.translation;
    }
}

/// One bit for every prismatic joint.
fn sliding_mask(model: &Model) -> Literal {
    let slides = |i: &usize| {
        model
            .joints
            .iter()
            .any(|joint| joint.variable == *i && joint.kind == JointKind::Prismatic)
    };
    let mask = (0..model.variables.len())
        .filter(slides)
        .map(|i| 1_u32 << i)
        .sum();
    Literal::u32_unsuffixed(mask)
}
