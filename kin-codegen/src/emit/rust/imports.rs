//! What generated code takes in: no more than it names.

use proc_macro2::{TokenStream, TokenTree};
use quote::{format_ident, quote};
use std::collections::HashSet;

/// What generated code can name and users can, too.
const PUBLIC: [&str; 20] = [
    "Following",
    "Frame",
    "Hessian",
    "HighlyRedundantKinematics",
    "Jacobian",
    "JointLimit",
    "Kinematics",
    "Nearest",
    "ParallelKinematics",
    "Parameter",
    "Pose",
    "Posture",
    "Postures",
    "RedundantKinematics",
    "Singularity",
    "Solution",
    "Solutions",
    "Swivel",
    "Target",
    "Twist",
];

/// What is there for generated code alone.
const PRIVATE: [&str; 33] = [
    "Acceptance",
    "Arithmetic",
    "AtSwivel",
    "Between",
    "BodyJacobian",
    "Branches",
    "Completion",
    "Eliminant",
    "Elimination",
    "FREE_BELOW",
    "Forward",
    "Frames",
    "FreeJoint",
    "Fused",
    "GeometricJacobian",
    "Inverse",
    "Lanes",
    "Locked",
    "Projection",
    "SinCos",
    "SpatialJacobian",
    "Univariate",
    "aligned",
    "evaluate",
    "lanes",
    "math",
    "solve",
    "solve_given",
    "solve_nearest",
    "solve_seeded",
    "three_spheres",
    "trig_roots",
    "widen",
];

/// Whether generated code takes in something of this name, which a robot cannot
/// have therefore.
pub fn is_taken(name: &str) -> bool {
    PUBLIC.contains(&name) || PRIVATE.contains(&name)
}

/// The `use` declarations of what the items name, from the crate at `runtime`.
pub fn imports(items: &TokenStream, runtime: &TokenStream) -> TokenStream {
    let mut named = HashSet::new();
    collect(items.clone(), &mut named);
    let used = |all: &[&str], path: TokenStream| {
        let used = all.iter().filter(|name| named.contains(**name));
        let used: Vec<_> = used.map(|name| format_ident!("{name}")).collect();
        (!used.is_empty()).then(|| quote!(use #path::{#(#used),*};))
    };
    let public = used(&PUBLIC, quote!(#runtime));
    let private = used(&PRIVATE, quote!(#runtime::__private));
    quote!(#private #public)
}

/// The identifiers of some tokens.
fn collect(tokens: TokenStream, named: &mut HashSet<String>) {
    for tree in tokens {
        match tree {
            TokenTree::Ident(ident) => {
                named.insert(ident.to_string());
            }
            TokenTree::Group(group) => collect(group.stream(), named),
            _ => {}
        }
    }
}
