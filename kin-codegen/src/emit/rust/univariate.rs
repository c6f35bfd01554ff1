//! Inverse kinematics by a polynomial in one joint: the arm's numbers, and calls of
//! what is the same for every arm.

use super::language::{self, literal, numbers, pose, signed};
use crate::univariate::Arm;
use kin_runtime::__private::univariate::{Between, Elimination};
use kin_runtime::Target;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

/// The methods that solve for joint values.
pub fn methods(arm: &Arm, joints: usize, what: &str) -> TokenStream {
    let n = Literal::usize_unsuffixed(joints);
    let constant = constant(arm);
    let joint = arm.kept[0].elimination.joints[0] + 1;
    let most = match joints {
        6 => "A general arm has up to sixteen solutions.",
        _ => "A general arm of fewer than six joints has one solution, others may have more.",
    };
    let order = format!(
        " {most} They come in the order of q{joint}, those of singular targets last, and \
         [`Solution::branch`](::kinematics::Solution::branch) is their place: it changes where two solutions meet."
    );
    let rotation = match arm.counts {
        Target::Pose => {
            " A matrix whose distance from a rotation is more than 1e-9 has no solutions."
        }
        _ => " A z axis whose length is off 1 by more than 1e-9 has no solutions.",
    };
    quote! {
        #constant

        #[doc = #what]
        ///
        #[doc = #order]
        ///
        /// Angles are in (−π, π]; limits are not applied, see
        /// [`Solutions::within_limits`](::kinematics::Solutions::within_limits). A target out
        /// of reach has no solutions, and neither has one of which an entry is not
        /// finite. A singular target has some members of each family of solutions.
        ///
        #[doc = #rotation]
        #[must_use]
        pub fn ik(&self, pose: &Pose) -> Solutions<#n> {
            Self::UNIVARIATE.solutions(pose)
        }

        /// As [`Self::ik`]; if `seed` (radians) is a singular solution, it is among them.
        #[must_use]
        pub fn ik_seeded(&self, pose: &Pose, seed: &[f64; #n]) -> Solutions<#n> {
            Self::UNIVARIATE.solutions_near(pose, seed)
        }

        /// A solution if there is one, and for a target out of reach a configuration
        /// of which no small motion comes nearer, with its distance (metres) as the
        /// residual. None if `pose` is not a number.
        #[must_use]
        pub fn ik_approximate(&self, pose: &Pose) -> ::core::option::Option<Solution<#n>> {
            Self::UNIVARIATE.closest(pose)
        }
    }
}

pub fn constant(arm: &Arm) -> TokenStream {
    let fixed = arm.frames.fixed.iter().map(pose);
    let prismatic = Literal::u64_unsuffixed(arm.frames.prismatic);
    let size = literal(arm.size);
    let counts = Ident::new(&format!("{:?}", arm.counts), Span::call_site());
    let eliminations = arm.kept.iter().map(|kept| elimination(&kept.elimination));
    let between = between(&arm.between);
    quote! {
        /// The arm, lengths in units of half its size, and what is left of it when
        /// all joints but one are eliminated: the best to be kept first.
        const UNIVARIATE: Univariate<'static> = Univariate {
            frames: Frames {
                fixed: [#(#fixed),*],
                prismatic: #prismatic,
            },
            size: #size,
            counts: Target::#counts,
            eliminations: &[#(#eliminations),*],
        };
        #between
    }
}

/// The joints that are given between those that are solved for.
fn between(joints: &[Between]) -> Option<TokenStream> {
    let count = Literal::usize_unsuffixed(joints.len());
    let each = joints.iter().map(|Between { behind, twist }| {
        let behind = Literal::u8_unsuffixed(*behind);
        let twist = language::twist(twist);
        quote!(Between { behind: #behind, twist: #twist })
    });
    (!joints.is_empty()).then(|| {
        quote! {
            /// The joints that are given between those of [`Self::UNIVARIATE`], which has them at
            /// zero.
            const BETWEEN: [Between; #count] = [#(#each),*];
        }
    })
}

fn elimination(elimination: &Elimination) -> TokenStream {
    let Elimination {
        joints,
        backwards,
        degree,
        moved,
        functionals,
        half,
        third,
        fold,
        powers,
        rows,
        columns,
    } = elimination;
    let integers = |all: &[u8]| {
        let all = all.iter().map(|&x| Literal::u8_unsuffixed(x));
        quote!([#(#all),*])
    };
    let [degree, half] = [degree, half].map(|&x| Literal::u8_unsuffixed(x));
    let (joints, columns) = (integers(joints), integers(columns));
    let powers = integers(powers);
    let rows = rows.iter().map(|row| integers(row));
    let functionals = functionals.iter().map(|functional| numbers(functional));
    let third = third.iter().map(|functional| numbers(functional));
    let fold = match fold {
        Some(angle) => {
            let angle = signed(*angle);
            quote!(Some(#angle))
        }
        None => quote!(None),
    };
    quote! {
        Elimination {
            joints: #joints,
            backwards: #backwards,
            degree: #degree,
            moved: #moved,
            functionals: [#(#functionals),*],
            half: #half,
            third: [#(#third),*],
            fold: #fold,
            powers: #powers,
            rows: [#(#rows),*],
            columns: #columns,
        }
    }
}
