//! Inverse kinematics of arms with more joints than their targets have coordinates:
//! methods that take the values of the joints that stay free, or the turn of the tool.

use super::lanes::Lanes;
use super::language::{twist, vector};
use super::{Names, inverse, univariate};
use crate::closed_form::{ClosedForm, Inverse, Refinement};
use crate::emit::headings::list;
use crate::emit::lanes::TARGET;
use crate::emit::text;
use crate::expr::inverse::InverseGraph;
use crate::geometry::{Carried, Swivel, numbers};
use crate::model::Model;
use crate::redundancy::Redundancy;
use kin_runtime::Twist;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// The methods that solve for joint values, and the constants that tell what they take.
pub fn methods(model: &Model, solver: &ClosedForm, redundancy: &Redundancy) -> TokenStream {
    let n = usize_literal(model.variables.len());
    let (argument, value) = argument(redundancy);
    let constants = constants(model, solver, redundancy);
    let [solve, seeded] = solve(model, solver, redundancy);
    let private = match &solver.inverse {
        Inverse::Expressions(_) => {
            let accept = inverse::acceptance(solver);
            let branches = (!solver.is_in_lanes()).then(|| inverse::branches(solver));
            quote! {
                #accept
                #branches
            }
        }
        Inverse::Univariate(arm) => univariate::constant(arm),
    };
    let what = inverse::reaches(redundancy.target);
    let takes = takes(model, redundancy);
    let assumes = inverse::assumes(solver);
    let plan = format!(" Solved by {}.", solver.plan);
    let parameters_of = parameters_of(redundancy, &n, &value);
    let keeps = match solver.inverse {
        Inverse::Univariate(_) => {
            " As [`Self::ik_at`]; if `seed` (radians, metres) is a singular solution, it is among them."
        }
        Inverse::Expressions(_) => {
            " As [`Self::ik_at`]; a joint that a singular target leaves free keeps its value in `seed` (radians)."
        }
    };
    quote! {
        #constants

        #[doc = #what]
        ///
        #[doc = #takes]
        ///
        /// Angles are in (−π, π]; limits are not applied, see
        /// [`Solutions::within_limits`](::kinematics::Solutions::within_limits). A target out of
        /// reach at this parameter has no solutions, and neither has one of which an
        /// entry is not finite. [`Solution::singular`](::kinematics::Solution::singular) is about the Jacobian of the joints
        /// that are solved for.
        ///
        #[doc = #assumes]
        ///
        #[doc = #plan]
        #[must_use]
        pub fn ik_at(&self, pose: &Pose, #argument) -> Solutions<#n> { #solve }

        #[doc = #keeps]
        #[must_use]
        pub fn ik_seeded_at(
            &self, pose: &Pose, #argument, seed: &[f64; #n]
        ) -> Solutions<#n> {
            #seeded
        }

        #parameters_of

        #private
    }
}

/// What the parameters are; `target` is what a target is called.
pub fn given(model: &Model, redundancy: &Redundancy, target: &str) -> Vec<String> {
    let name = |&joint: &usize| {
        let unit = match model.turns(joint) {
            true => "radians",
            false => "metres",
        };
        let name = text::code(&model.variables[joint].name);
        format!("the value of q{} ({name}), {unit}", joint + 1)
    };
    let turn = redundancy.turn.then(|| {
        format!("the turn of the tool about the tip's z axis from where {target} has it, radians")
    });
    let swivel = redundancy.swivel.map(|_| {
        let [shoulder, wrist] =
            [Swivel::SHOULDER, Swivel::WRIST].map(|joints| numbers(joints.map(|joint| joint + 1)));
        format!(
            "the [swivel angle](::kinematics::Swivel): how far the elbow is turned about the line \
             from the shoulder, where axes {shoulder} meet, to the wrist, where axes {wrist} do, \
             from where axis 1 points; radians"
        )
    });
    let joints = redundancy.joints.iter().map(name);
    joints.chain(swivel).chain(turn).collect()
}

/// The same in a sentence.
fn takes(model: &Model, redundancy: &Redundancy) -> String {
    let all = given(model, redundancy, "`pose`");
    match &all[..] {
        [one] => format!(" `parameter` is {one}."),
        _ => format!(" `parameters` are {}.", list(all)),
    }
}

fn usize_literal(x: usize) -> Literal {
    Literal::usize_unsuffixed(x)
}

fn constants(model: &Model, solver: &ClosedForm, redundancy: &Redundancy) -> TokenStream {
    let branches = usize_literal(solver.plan.branches());
    let joints = redundancy.joints.iter().map(|&joint| {
        let joint = usize_literal(joint);
        quote!(Parameter::Joint(#joint))
    });
    let swivel = redundancy
        .swivel
        .map(|_| quote!(Parameter::Swivel(Self::SWIVEL)));
    let turn = redundancy.turn.then(|| quote!(Parameter::Turn));
    let parameters = joints.chain(swivel).chain(turn);
    let count = usize_literal(redundancy.parameters());
    let swivel = redundancy.swivel.map(|swivel| {
        let swivel = self::swivel(&swivel.at_run_time(model));
        quote! {
            /// What the swivel angle is told by.
            pub const SWIVEL: Swivel = #swivel;
        }
    });
    quote! {
        #swivel
        /// What [`Self::ik_at`] takes beside a target.
        pub const PARAMETERS: [Parameter; #count] = [#(#parameters),*];
        /// How many branches [`Self::ik_at`] looks at.
        pub const BRANCHES_AT: usize = #branches;
    }
}

/// The parameters of `ik_at` as an argument, and their type.
fn argument(redundancy: &Redundancy) -> (TokenStream, TokenStream) {
    let size = usize_literal(redundancy.parameters());
    match redundancy.parameters() {
        1 => (quote!(parameter: f64), quote!(f64)),
        _ => (quote!(parameters: &[f64; #size]), quote!([f64; #size])),
    }
}

/// A parameter by its place.
fn parameter(redundancy: &Redundancy, i: usize) -> TokenStream {
    match redundancy.parameters() {
        1 => quote!(parameter),
        _ => {
            let i = usize_literal(i);
            quote!(parameters[#i])
        }
    }
}

/// The bodies of `ik_at` and `ik_seeded_at`.
fn solve(model: &Model, solver: &ClosedForm, redundancy: &Redundancy) -> [TokenStream; 2] {
    let parameter = |i: usize| parameter(redundancy, i);
    let k = redundancy.joints.len();
    let seen = solver.given.parameters();
    let turned = turned(redundancy);
    let given: Vec<TokenStream> = (0..k).map(parameter).collect();
    let joints = redundancy.joints.iter().map(|&joint| usize_literal(joint));
    let slides = |variable: &usize| !model.turns(*variable);
    let prismatic = (0..model.variables.len()).filter(slides);
    let prismatic = Literal::u64_unsuffixed(prismatic.fold(0, |mask, i| mask | 1 << i));
    let locked = (k > 0)
        .then(|| quote!(let locked = Locked::new([#(#joints),*], [#(#given),*], #prismatic);));
    let answer = |answer: TokenStream| {
        quote! {
            #turned
            #locked
            #answer
        }
    };
    let seed = match k {
        0 => quote!(seed),
        _ => quote!(&locked.others(seed)),
    };
    match &solver.inverse {
        Inverse::Univariate(_) => {
            let target = carried(solver, &given);
            let arm = at_given(solver, &given);
            let solved = usize_literal(solver.given.variables());
            let all = |solutions: TokenStream| match k {
                0 => solutions,
                _ => quote!(locked.all(&#solutions)),
            };
            [
                quote!(#arm.solutions::<#solved>(#target)),
                quote!(#arm.solutions_near::<#solved>(#target, #seed)),
            ]
            .map(|solutions| answer(all(solutions)))
        }
        Inverse::Expressions(_) => {
            let n = usize_literal(model.variables.len());
            let name = match redundancy.parameters() {
                1 => quote!(parameter),
                _ => quote!(parameters),
            };
            let swivel = (seen > k).then(|| parameter(k));
            let given: Vec<TokenStream> = given.into_iter().chain(swivel.clone()).collect();
            let sorted = match &swivel {
                Some(angle) => at_swivel(angle),
                None => sorted(solver, &given, &seed),
            };
            let solved = match solver.is_in_lanes() {
                true => {
                    quote!(solve_given(self, pose, #seed, &[#(#given),*], |branches| { #sorted }))
                }
                false => {
                    let given = (seen > 0).then(|| quote!(, &[#(#given),*]));
                    quote! {
                        let branches = self.branches(pose, #seed #given);
                        #sorted
                    }
                }
            };
            [
                quote!(self.ik_seeded_at(pose, #name, &[0.0; #n])),
                answer(solved),
            ]
        }
    }
}

/// How the branches become solutions.
fn sorted(solver: &ClosedForm, given: &[TokenStream], seed: &TokenStream) -> TokenStream {
    if given.is_empty() {
        return inverse::sorted(solver);
    }
    let target = solver.plan.target;
    // Those of an arm off its design are refused.
    if target.is_projected() {
        return quote!(locked.solutions(&branches, &Self::ACCEPT));
    }
    let target = format_ident!("{target:?}");
    let arm = quote!(|q| self.fk_jacobian(q), pose, Target::#target);
    let corrected = quote!(locked.corrected(&branches, #arm, seed, &Self::ACCEPT));
    match &solver.refinement {
        Refinement::Univariate(_) => {
            let (arm, target) = (at_given(solver, given), carried(solver, given));
            let refined = quote! {
                locked.all(&branches.refined_onto(&#arm, #target, #seed, &Self::ACCEPT))
            };
            inverse::completed(solver, &corrected, refined)
        }
        Refinement::Correction => corrected,
    }
}

/// How the branches at a swivel angle become solutions.
fn at_swivel(angle: &TokenStream) -> TokenStream {
    quote! {
        let arm = AtSwivel {
            swivel: &Self::SWIVEL,
            angle: #angle,
            links: |q: &_| self.fk_links(q),
            fk_jacobian: |q: &_| self.fk_jacobian(q),
        };
        branches.at_swivel(&arm, pose, seed, &Self::ACCEPT)
    }
}

/// The target of the joints between those that are given.
fn carried(solver: &ClosedForm, given: &[TokenStream]) -> TokenStream {
    let all = Carried::new(&solver.given);
    let Carried { front, behind, .. } = &all;
    if all.between().len() == given.len() {
        return quote!(pose);
    }
    let (in_front, at_the_tip) = (given, &given[all.between().end..]);
    let undone = |(twist, value): (&Twist, &TokenStream)| {
        let twist = self::twist(twist);
        quote!(Pose::exp(&#twist, -#value))
    };
    let front = front.iter().zip(in_front).map(undone).rev();
    let behind = behind.iter().zip(at_the_tip).map(undone).rev();
    quote!(&(#(#front *)* *pose #(* #behind)*))
}

/// The arm of the joints that are solved for.
fn at_given(solver: &ClosedForm, given: &[TokenStream]) -> TokenStream {
    let between = &given[Carried::new(&solver.given).between()];
    match between.is_empty() {
        true => quote!(Self::UNIVARIATE),
        false => quote!(Self::UNIVARIATE.at(&Self::BETWEEN, &[#(#between),*])),
    }
}

/// The points of a swivel.
fn swivel(swivel: &kin_runtime::Swivel) -> TokenStream {
    let [shoulder, elbow, wrist, reference] = [
        swivel.shoulder,
        swivel.elbow,
        swivel.wrist,
        swivel.reference,
    ]
    .map(vector);
    let link = usize_literal(swivel.link);
    quote! {
        Swivel {
            shoulder: #shoulder,
            link: #link,
            elbow: #elbow,
            wrist: #wrist,
            reference: #reference,
        }
    }
}

/// The parameters of a configuration.
fn parameters_of(redundancy: &Redundancy, n: &Literal, value: &TokenStream) -> TokenStream {
    let joints = redundancy.joints.iter().map(|&joint| {
        let joint = usize_literal(joint);
        quote!(q[#joint])
    });
    let swivel = redundancy
        .swivel
        .map(|_| quote!(Self::SWIVEL.angle(&self.fk_links(q), &self.fk(q))));
    let turn = redundancy.turn.then(|| quote!(pose.turn_to(&self.fk(q))));
    let all: Vec<TokenStream> = joints.chain(swivel).chain(turn).collect();
    let answer = match &all[..] {
        [one] => one.clone(),
        all => quote!([#(#all),*]),
    };
    match redundancy.turn {
        true => quote! {
            /// What [`Self::ik_at`] has to be given with `pose` to have `q` (radians,
            /// metres) among its solutions, if that puts the tip there.
            #[inline]
            #[must_use]
            pub fn redundancy(&self, pose: &Pose, q: &[f64; #n]) -> #value { #answer }
        },
        false => quote! {
            /// What [`Self::ik_at`] has to be given to have `q` (radians, metres) among
            /// its solutions.
            #[inline]
            #[must_use]
            pub fn redundancy(&self, q: &[f64; #n]) -> #value { #answer }
        },
    }
}

/// The trait of arms with one parameter, or with several.
pub fn kinematics(
    solver: &ClosedForm,
    redundancy: &Redundancy,
    names: &Names,
    n: &Literal,
) -> TokenStream {
    let name = &names.robot;
    let arguments = root_arguments(solver, redundancy);
    let margins = match arguments {
        Some(_) => None,
        None => margins(solver, redundancy),
    };
    if redundancy.parameters() > 1 {
        let count = usize_literal(redundancy.parameters());
        return quote! {
            impl HighlyRedundantKinematics<#n, #count> for #name {
                const PARAMETERS: [Parameter; #count] = Self::PARAMETERS;
                const BRANCHES_AT: usize = Self::BRANCHES_AT;

                #[inline]
                fn ik_at(&self, pose: &Pose, parameters: &[f64; #count]) -> Solutions<#n> {
                    #name::ik_at(self, pose, parameters)
                }

                #[inline]
                fn ik_seeded_at(
                    &self, pose: &Pose, parameters: &[f64; #count], seed: &[f64; #n]
                ) -> Solutions<#n> {
                    #name::ik_seeded_at(self, pose, parameters, seed)
                }
                #arguments
                #margins
            }
        };
    }
    quote! {
        impl RedundantKinematics<#n> for #name {
            const PARAMETER: Parameter = Self::PARAMETERS[0];
            const BRANCHES_AT: usize = Self::BRANCHES_AT;

            #[inline]
            fn ik_at(&self, pose: &Pose, parameter: f64) -> Solutions<#n> {
                #name::ik_at(self, pose, parameter)
            }

            #[inline]
            fn ik_seeded_at(
                &self, pose: &Pose, parameter: f64, seed: &[f64; #n]
            ) -> Solutions<#n> {
                #name::ik_seeded_at(self, pose, parameter, seed)
            }
            #arguments
            #margins
        }
    }
}

/// What the roots of an exact arm's plan are the roots of.
fn root_arguments(solver: &ClosedForm, redundancy: &Redundancy) -> Option<TokenStream> {
    let exact = solver.expressions().filter(|_| solver.is_exact());
    let (graph, roots) = exact?.of_arguments()?;
    let (prologue, lanes) = lanes_at_parameter(solver, redundancy, &graph);
    let mut written = lanes.q.iter();
    let copies = roots.iter().enumerate().filter_map(|(root, argument)| {
        argument.as_ref()?;
        let (root, lanes) = (usize_literal(root), written.next()?);
        Some(quote! {
            for (to, from) in arguments[#root].iter_mut().zip(#lanes.iter().cycle()) {
                *to = from[0];
            }
        })
    });
    let count = usize_literal(roots.len());
    let copies: Vec<TokenStream> = copies.collect();
    let (takes, _) = argument(redundancy);
    Some(quote! {
        const ROOTS: usize = #count;

        fn root_arguments(&self, pose: &Pose, #takes) -> [[f64; 16]; 4] {
            #prologue
            let mut arguments = [[f64::INFINITY; 16]; 4];
            #(#copies)*
            arguments
        }
    })
}

/// The statements that compute the lanes of a graph at a parameter.
fn lanes_at_parameter(
    solver: &ClosedForm,
    redundancy: &Redundancy,
    graph: &InverseGraph,
) -> (TokenStream, Lanes) {
    let turned = turned(redundancy);
    let seed = std::iter::repeat_n(quote!(0.0), solver.given.variables());
    let given = (0..solver.given.parameters()).map(|i| parameter(redundancy, i));
    let inputs = seed.chain(given).chain([quote!(FREE_BELOW)]);
    let (statements, lanes) = inverse::statements(solver, graph, inputs, &quote!(lanes::sin_cos));
    let own = TARGET + solver.given.variables();
    let reads = lanes.inputs[own..own + solver.given.parameters()].contains(&true);
    let unread = (!reads && !redundancy.turn).then(|| match redundancy.parameters() {
        1 => quote!(let _ = parameter;),
        _ => quote!(let _ = parameters;),
    });
    let prologue = quote! {
        #turned
        #unread
        const T: usize = 1;
        type A = Fused<false>;
        let targets = &[*pose];
        #statements
    };
    (prologue, lanes)
}

/// The target with the turn of the tool, if that is a parameter.
fn turned(redundancy: &Redundancy) -> Option<TokenStream> {
    redundancy.turn.then(|| {
        let turn = parameter(redundancy, redundancy.parameters() - 1);
        quote!(let pose = &pose.turned(#turn);)
    })
}

/// How far the branches are from having no root, if they come from a plan; what tells where
/// solutions begin and end, if that is an elimination.
fn margins(solver: &ClosedForm, redundancy: &Redundancy) -> Option<TokenStream> {
    if solver.is_told_by_elimination() {
        return Some(eliminant(solver, redundancy));
    }
    let inverse = solver.expressions()?;
    let margin = inverse.of_margin()?;
    let choices = margin.graph.choices();
    let (prologue, lanes) = lanes_at_parameter(solver, redundancy, &margin);
    let margin = &lanes.residual;
    let branches = usize_literal(solver.plan.branches());
    let width = usize_literal(1 << choices);
    let each = match choices {
        0 => quote!(margins[..#branches].fill(#margin[0][0]);),
        _ => quote! {
            for (k, branch) in margins[..#branches].iter_mut().enumerate() {
                *branch = #margin[k % #width][0];
            }
        },
    };
    let (takes, _) = argument(redundancy);
    Some(quote! {
        fn margins_at(
            &self, pose: &Pose, #takes
        ) -> ::core::option::Option<[f64; 16]> {
            #prologue
            let mut margins = [0.0; 16];
            #each
            Some(margins)
        }
    })
}

/// What is left of a target by elimination.
fn eliminant(solver: &ClosedForm, redundancy: &Redundancy) -> TokenStream {
    let turned = turned(redundancy);
    let given = (0..redundancy.joints.len()).map(|i| parameter(redundancy, i));
    let given: Vec<TokenStream> = given.collect();
    let (arm, target) = (at_given(solver, &given), carried(solver, &given));
    let (takes, _) = argument(redundancy);
    quote! {
        fn eliminant_at(
            &self, pose: &Pose, #takes, which: usize
        ) -> ::core::option::Option<Eliminant> {
            #turned
            #arm.eliminant(#target, which)
        }
    }
}
