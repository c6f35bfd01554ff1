//! The determinant and its factors, as Rust functions.

use super::forward::block;
use crate::expr::determinant::Rows;
use crate::plan::Target;
use crate::singularity::{Locus, Singular, Singularity};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// Determinants of more multiplications than this are left to elimination.
const LONGEST: usize = 64;

/// `jacobian_determinant` and `singularities` of an arm with `n` coordinates.
pub fn methods(singular: &Singular, n: usize) -> TokenStream {
    let count = Literal::usize_unsuffixed(n);
    let g = &singular.graph;
    let product = singular.determinant.product;
    let operations = singular.cost();
    // Of a noisy arm it is a long polynomial.
    let (determinant, cost) = if operations.multiplications > LONGEST && n == 6 {
        let by_elimination = quote!(self.spatial_jacobian(q).determinant());
        (by_elimination, " By elimination.".into())
    } else {
        let expanded = block(g, &[product], n, |w| w.output(product));
        (expanded, format!(" {operations}."))
    };
    let rows = rows(singular.determinant.rows);
    let determinant = quote! {
        #[doc = #rows]
        /// 0 where the arm is singular.
        ///
        #[doc = #cost]
        #[inline]
        #[must_use]
        pub fn jacobian_determinant(&self, q: &[f64; #count]) -> f64 { #determinant }
    };
    if singular.singularities.is_empty() {
        return determinant;
    }
    let values = singular.values();
    let singularities = block(g, &values, n, |w| {
        let names = singular
            .singularities
            .iter()
            .map(|singularity| &singularity.name);
        let values = values.iter().map(|&value| w.output(value));
        quote!(Singularity::by_name([#(#names),*], [#(#values),*]))
    });
    let of_which = match singular.idealized {
        Some(_) => {
            " How far from singular the arm is that the file was read as, a value for each singularity:"
        }
        None => " How far from singular the arm is, a value for each singularity:",
    };
    let lines = singular.singularities.iter().map(line);
    let number = Literal::usize_unsuffixed(values.len());
    quote! {
        #determinant

        #[doc = #of_which]
        ///
        #(#[doc = #lines])*
        #[inline]
        #[must_use]
        pub fn singularities(&self, q: &[f64; #count]) -> [Singularity; #number] { #singularities }
    }
}

fn rows(rows: Rows) -> String {
    match rows {
        Rows::All => " The determinant of the Jacobian, the same for the spatial, body and \
                      geometric one."
            .into(),
        Rows::Moving => " The determinant of the rows of the Jacobian that are not zero in every \
                         configuration."
            .into(),
        Rows::Counting(target) => format!(
            " The determinant of the Jacobian's rows for {}{}.",
            target.phrase(),
            match target {
                Target::PositionAxis | Target::Direction => " (in the tip's axes)",
                _ => "",
            }
        ),
    }
}

fn line(singularity: &Singularity) -> String {
    format!(
        " - `{}`: {}; its value: {}.",
        singularity.name,
        place(singularity),
        singularity.unit()
    )
}

/// Where a singularity is met.
fn place(singularity: &Singularity) -> String {
    let coordinate = |i: &usize| format!("q{}", i + 1);
    let names: Vec<String> = singularity.coordinates.iter().map(coordinate).collect();
    match &singularity.locus {
        Locus::Values(values) => {
            let values: Vec<String> = values.iter().map(|x| format!("{x:.4}")).collect();
            format!("at {} = {}", names.concat(), values.join(" or "))
        }
        Locus::Surface(_) => format!("on a surface of {}", names.join(", ")),
        Locus::Never => "not seen to be reached".into(),
    }
}
