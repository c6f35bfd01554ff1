//! Inverse kinematics as Rust functions.

use super::lanes::{Lanes, lanes};
use super::language::{identifier, literal, numbers, pose};
use super::univariate;
use crate::closed_form::{ClosedForm, Inverse, Refinement};
use crate::emit::lanes::{TARGET, target_names};
use crate::expr::inverse::InverseGraph;
use crate::model::Model;
use crate::plan::Target;
use kin_runtime::__private::{Acceptance, Completion, Projection};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// The methods that solve for joint values.
pub fn methods(model: &Model, solver: &ClosedForm) -> TokenStream {
    if let Inverse::Univariate(arm) = &solver.inverse {
        let what = what(solver.plan.target);
        return univariate::methods(arm, model.variables.len(), &what);
    }
    let n = Literal::usize_unsuffixed(model.variables.len());
    let branches = branches(solver);
    let accept = acceptance(solver);
    let unseeded = quote!(&[0.0; #n]);
    let (answer, seeded) = match solver.is_in_lanes() {
        true => {
            let [at_zero, at_seed] = [&unseeded, &quote!(seed)].map(|seed| otherwise(solver, seed));
            (
                quote!(solve(self, pose, &[], #at_zero)),
                quote!(solve_seeded(self, pose, seed, &[], #at_seed)),
            )
        }
        false => (quote!(self.ik_seeded(pose, #unseeded)), refined(solver)),
    };
    let closest = closest(model, solver);
    let unsettled = unsettled(solver);
    let what = what(solver.plan.target);
    let plan = format!(" Solved by {}.", solver.plan);
    let assumes = assumes(solver);
    quote! {
        #accept

        #[doc = #what]
        ///
        /// Angles are in (−π, π]; limits are not applied, see
        /// [`Solutions::within_limits`](::kinematics::Solutions::within_limits). A target out
        /// of reach has no solutions, and neither has one of which an entry
        /// that is read is not finite. A singular target has a representative
        /// of each family of solutions, with zero for a joint that is free.
        ///
        #[doc = #assumes]
        ///
        #[doc = #plan]
        #[must_use]
        pub fn ik(&self, pose: &Pose) -> Solutions<#n> {
            #answer
        }

        /// As [`Self::ik`]; a joint that a singular target leaves free keeps
        /// its value in `seed` (radians), so that solutions along a path are
        /// continuous; that of a joint whose seed is not finite is 0. The
        /// solutions of other targets do not depend on it.
        #[must_use]
        pub fn ik_seeded(&self, pose: &Pose, seed: &[f64; #n]) -> Solutions<#n> {
            #seeded
        }

        /// The branch whose subproblems come nearest to `pose`: a solution if
        /// there is one, and for a target out of reach the least-squares
        /// solution of the subproblems, with its distance (metres) as the
        /// residual. None if `pose` is not a number.
        #[must_use]
        pub fn ik_approximate(&self, pose: &Pose) -> ::core::option::Option<Solution<#n>> {
            #closest
        }

        #branches
        #unsettled
    }
}

/// The solutions where lanes do not tell them.
fn otherwise(solver: &ClosedForm, seed: &TokenStream) -> TokenStream {
    let seed = takes_seed(solver).then(|| quote!(#seed,));
    quote!(|branches| self.sorted(pose, #seed &branches))
}

/// Whether a seed tells which of a singular target's solutions these are where lanes do not.
fn takes_seed(solver: &ClosedForm) -> bool {
    !(solver.plan.target.is_projected() && solver.is_exact())
}

/// All solutions of another one.
fn refined(solver: &ClosedForm) -> TokenStream {
    let sorted = sorted(solver);
    quote! {
        let branches = self.branches(pose, seed);
        #sorted
    }
}

/// The private method `sorted`, for targets of which the lanes alone do not tell the
/// solutions.
fn unsettled(solver: &ClosedForm) -> Option<TokenStream> {
    let [n, width, _] = sizes(solver);
    let sorted = sorted(solver);
    let seed = takes_seed(solver).then(|| quote!(seed: &[f64; #n],));
    let unread = solver
        .plan
        .target
        .is_projected()
        .then(|| quote!(let _ = pose;));
    solver.is_in_lanes().then(|| {
        quote! {
            #[cold]
            fn sorted(&self, pose: &Pose, #seed branches: &Branches<#n, #width>) -> Solutions<#n> {
                #unread
                #sorted
            }
        }
    })
}

/// The private method `branches`, which `ik` and its like share.
pub fn branches(solver: &ClosedForm) -> TokenStream {
    let [n, width, locked] = sizes(solver);
    let (takes, given) = match solver.given.parameters() {
        0 => (quote!(), quote!(&[])),
        _ => (quote!(, locked: &[f64; #locked]), quote!(locked)),
    };
    quote! {
        /// All branches of the plan as lanes, those that do not exist marked.
        #[inline]
        fn branches(
            &self, pose: &Pose, seed: &[f64; #n] #takes
        ) -> Branches<#n, #width> {
            Branches::of(self, pose, seed, #given)
        }
    }
}

/// How many joints are solved for, branches there are, and joints are given.
fn sizes(solver: &ClosedForm) -> [Literal; 3] {
    let given = &solver.given;
    [
        given.variables(),
        solver.plan.branches(),
        given.parameters(),
    ]
    .map(Literal::usize_unsuffixed)
}

/// The branches of several targets as the robot's implementation of `Inverse`.
pub fn implementation(robot: &Ident, solver: &ClosedForm) -> Option<TokenStream> {
    let inverse = solver.expressions()?;
    let sizes = sizes(solver);
    let [n, width, locked] = &sizes;
    let places = |name: &str, count: usize| -> Vec<TokenStream> {
        let name = format_ident!("{name}");
        let places = (0..count).map(Literal::usize_unsuffixed);
        places.map(|i| quote!(#name[#i])).collect()
    };
    let seed = places("seed", solver.given.variables());
    let given = places("locked", solver.given.parameters());
    let ends = [TARGET + seed.len(), TARGET + seed.len() + given.len()];
    let inputs = seed.into_iter().chain(given).chain([quote!(free)]);
    let (statements, lanes) = statements(solver, inverse, inputs, &quote!(sin_cos.of));
    let (sums, angles) = &lanes.angles;
    let count = Literal::usize_unsuffixed(angles.len());
    let without_angles = angles.is_empty().then(|| quote!(let _ = sin_cos;));
    let parameters = [
        (quote!(seed), TARGET..ends[0]),
        (quote!(locked), ends[0]..ends[1]),
        (quote!(free), ends[1]..ends[1] + 1),
    ];
    let unused = parameters.into_iter().filter_map(|(name, inputs)| {
        let used = lanes.inputs[inputs].contains(&true);
        (!used).then(|| quote!(let _ = #name;))
    });
    let free = inverse.free_joints.iter().map(|free| {
        let coordinate = Literal::usize_unsuffixed(free.turn.coordinate);
        let slide = free.slide.map(literal);
        let slide = slide.map_or_else(|| quote!(None), |slide| quote!(Some(#slide)));
        quote!(FreeJoint { coordinate: #coordinate, slide: #slide })
    });
    let free: Vec<TokenStream> = free.collect();
    let free_joints = Literal::usize_unsuffixed(free.len());
    let busy = Literal::usize_unsuffixed(lanes.busy);
    let completion = solver.completion();
    let completion = (completion != Completion::Never).then(|| {
        let completion = format_ident!("{completion:?}");
        quote!(const COMPLETION: Completion = Completion::#completion;)
    });
    let q = &lanes.q;
    let (residual, invalid, singular) = (&lanes.residual, &lanes.invalid, &lanes.singular);
    let level = lanes.free_joints.iter().map(|[level, _]| level);
    let no_root = lanes.free_joints.iter().map(|[_, no_root]| no_root);
    Some(quote! {
        impl Inverse<#n, #width, #locked, #count, #free_joints> for #robot {
            const ACCEPT: Acceptance = #robot::ACCEPT;
            #completion
            const WIDTH: usize = #busy;
            const FREE: [FreeJoint; #free_joints] = [#(#free),*];

            #[inline(always)]
            fn angles(seed: &[f64; #n], locked: &[f64; #locked]) -> [f64; #count] {
                let _ = (seed, locked);
                #(#sums)*
                [#(#angles),*]
            }

            #[inline(always)]
            fn lanes<A: Arithmetic, const T: usize>(
                targets: &[Pose; T],
                seed: &[f64; #n],
                locked: &[f64; #locked],
                sin_cos: impl SinCos<#count>,
                free: f64,
            ) -> Lanes<#n, #width, { T }, #free_joints> {
                #(#unused)*
                #without_angles
                #statements
                Lanes {
                    q: [#(#q),*],
                    residual: #residual,
                    invalid: #invalid,
                    singular: #singular,
                    level: [#(#level),*],
                    no_root: [#(#no_root),*],
                }
            }
        }
    })
}

/// The statements that compute the lanes of a graph from the T `targets` and more
/// `inputs`; `sin_cos` is the function that gives the sines and cosines of angles.
pub fn statements(
    solver: &ClosedForm,
    inverse: &InverseGraph,
    inputs: impl Iterator<Item = TokenStream>,
    sin_cos: &TokenStream,
) -> (TokenStream, Lanes) {
    let lanes = lanes(solver, inverse, inputs, sin_cos);
    let entries = target_pattern(&lanes.inputs);
    let statements = &lanes.statements;
    (quote!(#entries #(#statements)*), lanes)
}

/// How the branch that comes nearest is chosen.
fn closest(model: &Model, solver: &ClosedForm) -> TokenStream {
    let n = Literal::usize_unsuffixed(model.variables.len());
    let branches = quote!(self.branches(pose, &[0.0; #n]));
    let target = solver.plan.target;
    if target.is_projected() && solver.is_exact() {
        return quote!(#branches.closest(&Self::ACCEPT));
    }
    let [fk, pose] = seen(solver);
    let target = format_ident!("{target:?}");
    let closest = quote! {
        #branches.closest_by(|q| #fk, #pose, Target::#target, &Self::ACCEPT)
    };
    if solver.is_exact() {
        return closest;
    }
    // The branches are those of the idealized arm.
    quote!(self.ik(pose).first().copied().or_else(|| #closest))
}

/// The pose at `q` and the target, as what counts of a target sees them.
fn seen(solver: &ClosedForm) -> [TokenStream; 2] {
    match solver.corrected_projection() {
        Some(_) => [
            quote!(Self::PROJECTION.pose(&self.fk(q))),
            quote!(&Self::PROJECTION.target(pose)),
        ],
        None => [quote!(self.fk(q)), quote!(pose)],
    }
}

/// The methods that choose the one solution that moves the joints least.
pub fn choice(model: &Model, solver: &ClosedForm) -> TokenStream {
    let n = Literal::usize_unsuffixed(model.variables.len());
    let (from_seed, by) = match solver.is_in_lanes() {
        true => {
            let of = |nearest: TokenStream, seed: TokenStream| {
                let otherwise = otherwise(solver, &seed);
                let [fk, seen] = seen(solver);
                let target = solver.plan.target;
                let target = format_ident!("{target:?}");
                let missed = quote!(|q| Target::#target.distance(&#fk, #seen, Self::ACCEPT.size));
                quote!(solve_nearest(self, pose, &[], #nearest, #seed, #missed, #otherwise))
            };
            let limits = quote!(const { &Nearest::new([0.0; #n], &Self::LIMITS) });
            (
                of(limits, quote!(seed)),
                of(quote!(nearest), quote!(&nearest.seed)),
            )
        }
        false => (
            quote!(self.ik_nearest_by(pose, &Nearest::new(*seed, &Self::LIMITS))),
            quote!(self.ik_seeded(pose, &nearest.seed).nearest_by(nearest)),
        ),
    };
    quote! {
        /// The solution that moves the joints least from `seed` (radians), inside
        /// the limits of the arm and with full turns where these lead there; a
        /// joint that a singular target leaves free keeps its value in `seed`.
        /// None if there is none.
        #[must_use]
        pub fn ik_nearest(&self, pose: &Pose, seed: &[f64; #n])
            -> ::core::option::Option<Solution<#n>>
        {
            #from_seed
        }

        /// The solution that moves the joints least from the seed of `nearest`,
        /// inside its limits and steps; see
        /// [`Nearest`](::kinematics::Nearest). None if there is none.
        #[must_use]
        pub fn ik_nearest_by(&self, pose: &Pose, nearest: &Nearest<#n>)
            -> ::core::option::Option<Solution<#n>>
        {
            #by
        }
    }
}

/// How the branches become solutions.
pub fn sorted(solver: &ClosedForm) -> TokenStream {
    let target = solver.plan.target;
    if target.is_projected() && solver.is_exact() {
        return quote!(branches.solutions(&Self::ACCEPT));
    }
    let [fk_jacobian, pose] = match solver.corrected_projection() {
        Some(_) => [
            quote!(Self::PROJECTION.fk_jacobian(self.fk_jacobian(q))),
            quote!(&Self::PROJECTION.target(pose)),
        ],
        None => [quote!(self.fk_jacobian(q)), quote!(pose)],
    };
    let target = format_ident!("{target:?}");
    let corrected = quote! {
        branches.corrected(|q| #fk_jacobian, #pose, Target::#target, seed, &Self::ACCEPT)
    };
    match &solver.refinement {
        Refinement::Correction => corrected,
        Refinement::Univariate(_) => {
            let refined =
                quote!(branches.refined_onto(&Self::UNIVARIATE, pose, seed, &Self::ACCEPT));
            completed(solver, &corrected, refined)
        }
    }
}

/// How branches with an elimination beside become solutions: those of an exact arm are refined where
/// some may be missing.
pub fn completed(
    solver: &ClosedForm,
    corrected: &TokenStream,
    refined: TokenStream,
) -> TokenStream {
    let completion = solver.completion();
    let name = format_ident!("{completion:?}");
    let completed = quote!(branches.are_completed(Completion::#name, &Self::ACCEPT));
    match completion {
        Completion::Never => refined,
        Completion::Unanswered => quote! {
            let corrected = #corrected;
            match corrected.is_empty() && #completed {
                true => #refined,
                false => corrected,
            }
        },
        Completion::Degenerate => quote! {
            match #completed {
                true => #refined,
                false => #corrected,
            }
        },
    }
}

/// The constants by which branches become solutions.
pub fn acceptance(solver: &ClosedForm) -> TokenStream {
    let Acceptance {
        size,
        tolerance,
        taken,
        nearly,
        near_singular,
        prismatic,
    } = solver.acceptance();
    let [size, tolerance, taken, nearly, near_singular] =
        [size, tolerance, taken, nearly, near_singular].map(literal);
    let prismatic = Literal::u64_unsuffixed(prismatic);
    let beside = match &solver.refinement {
        Refinement::Univariate(arm) => Some(univariate::constant(arm)),
        _ => projection(solver),
    };
    quote! {
        const ACCEPT: Acceptance = Acceptance {
            size: #size,
            tolerance: #tolerance,
            taken: #taken,
            nearly: #nearly,
            near_singular: #near_singular,
            prismatic: #prismatic,
        };
        #beside
    }
}

/// How projected targets see the tip of an arm that is off its design.
fn projection(solver: &ClosedForm) -> Option<TokenStream> {
    let Projection { counts, axis, home } = solver.corrected_projection()?;
    let counts = format_ident!("{counts:?}");
    let (axis, home) = (numbers(&axis), pose(&home));
    Some(quote! {
        const PROJECTION: Projection = Projection {
            counts: Target::#counts,
            axis: #axis,
            home: #home,
        };
    })
}

fn what(target: Target) -> String {
    let rest = match target {
        Target::Pose => "",
        _ => " The rest of `pose` is not read.",
    };
    format!("{}{rest}", reaches(target))
}

/// What solutions do.
pub fn reaches(target: Target) -> String {
    let reaches = match target {
        Target::Pose => "put the tip at `pose`",
        Target::Position => "put the tip's origin at the translation of `pose`",
        Target::PositionAxis => {
            "put the tip's origin at the translation of `pose` and its z axis along that of `pose`"
        }
        Target::PositionYaw => {
            "put the tip's origin at the translation of `pose`, turned as `pose` is about the \
             first axis"
        }
        Target::Planar => {
            "put the tip's origin at the translation of `pose` across the first axis, turned as \
             `pose` is about that axis"
        }
        Target::Direction => "turn the tip's z axis along that of `pose`",
        Target::Orientation => "turn the tip as `pose` is turned",
    };
    format!(" All joint values that {reaches} in the base frame, metres.")
}

/// What the rotation of a target is taken to be.
pub fn assumes(solver: &ClosedForm) -> String {
    let tolerance = solver.acceptance().tolerance;
    match solver.plan.target {
        Target::Position => {
            format!(" Solutions reach the position to {tolerance:.1e} m.")
        }
        target => {
            let differs = match target {
                Target::Pose | Target::Orientation => "a solution's pose differs from it",
                _ => "what counts of a solution's pose differs from it",
            };
            format!(
                " The rotation of `pose` is taken as it is: {differs} by at most \
                 {tolerance:.1e} m, radians counted at the distance of the arm's size. A matrix \
                 that is no rotation to that accuracy has no solutions, in reach or not: \
                 [`Pose::rotation_error`](::kinematics::Pose::rotation_error) tells, and \
                 [`Pose::orthonormalized`](::kinematics::Pose::orthonormalized) mends rounded ones."
            )
        }
    }
}

/// Takes the targets apart, as far as they are read: an array for each entry.
fn target_pattern(used: &[bool]) -> TokenStream {
    let names = target_names().into_iter().zip(used);
    let names = names.map(|(name, used)| match used {
        true => {
            let name = identifier(&name);
            quote!(#name)
        }
        false => quote!(_),
    });
    quote!(let [#(#names),*] = lanes::entries(targets);)
}
