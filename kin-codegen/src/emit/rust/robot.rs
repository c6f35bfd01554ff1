//! The type of a robot, with its constants, methods and documentation.

use super::imports::imports;
use super::language::{Writer, signed};
use super::single::in_single;
use super::{Names, documentation, forward, frames, inverse, redundant, singular};
use crate::arm::CompiledArm;
use crate::emit::postures::Postures;
use crate::emit::text;
use crate::expr::forward::Outputs;
use crate::expr::jacobian::Columns;
use crate::model::Variable;
use crate::scalar::Scalar;
use crate::spec::Rating;
use kin_runtime::JointLimit;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// The items that a robot becomes.
pub fn robot(compiled: &CompiledArm, names: &Names) -> TokenStream {
    let (name, runtime) = (&names.robot, &names.runtime);
    let n = Literal::usize_unsuffixed(compiled.model.variables.len());
    let postures = compiled.form().and_then(Postures::of);
    let doc = documentation::arm(compiled, name, postures.as_ref());
    let doc = doc.iter().map(|line| format!(" {line}"));
    let constants = constants(compiled, &n, postures.as_ref());
    let methods = methods(compiled, &n);
    let redundancy = compiled.redundancy.as_ref();
    let inverse = compiled.form().map(|form| match redundancy {
        Some(redundancy) => redundant::methods(&compiled.model, form, redundancy),
        None => {
            let all = inverse::methods(&compiled.model, form);
            let one = inverse::choice(&compiled.model, form);
            quote!(#all #one)
        }
    });
    let variables = compiled.model.variables.len();
    let singular = compiled.singular();
    let singular = singular.map(|singular| singular::methods(singular, variables));
    let derivatives = compiled.forward().dot.as_ref();
    let derivatives = derivatives.map(|dot| self::derivatives(compiled, dot, &n));
    let kinematics = kinematics(compiled, names, &n);
    let redundant = redundancy.zip(compiled.form());
    let redundant = redundant.map(|(it, form)| redundant::kinematics(form, it, names, &n));
    let generated_by = generated_by(runtime);
    let items = quote! {
        impl #name {
            #constants
            #methods
            #inverse
            #singular
            #derivatives
        }
    };
    let straight = straight(compiled, name);
    let lanes = compiled
        .form()
        .and_then(|form| inverse::implementation(name, form));
    let types = types(compiled, names);
    let imports = imports(&quote!(#items #straight #lanes #redundant), &types);
    let items = in_module(
        name,
        &quote! {
            #generated_by
            #imports

            #(#[doc = #doc])*
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
            pub struct #name;

            #items
            #straight
            #lanes
            #kinematics
            #redundant
        },
    );
    match compiled.model.scalar {
        Scalar::F64 => items,
        Scalar::F32 => in_single(items),
    }
}

/// Where the types of the scalar are.
fn types(compiled: &CompiledArm, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    match compiled.model.scalar {
        Scalar::F64 => runtime.clone(),
        Scalar::F32 => quote!(#runtime::single),
    }
}

/// The items of a type, in a module of their own: a constant or unit struct
/// where the robot stands would be a pattern wherever a variable has its name. Formatted as it is, or
/// `cargo fmt` would make checked-in code stale.
pub(super) fn in_module(name: &Ident, items: &TokenStream) -> TokenStream {
    let module = format_ident!("__{name}");
    quote! {
        #[cfg_attr(rustfmt, rustfmt_skip)]
        #[allow(non_snake_case, reason = "named as the type is, so that no two are one")]
        #[allow(
            clippy::all, clippy::pedantic, clippy::nursery,
            reason = "nobody writes generated code again: lints on its style have nobody to tell"
        )]
        mod #module { #items }
        #[allow(unused_imports, reason = "a robot may stand where nothing uses it yet")]
        pub use #module::#name;
    }
}

/// The check that the runtime goes with this version of the compiler.
pub(super) fn generated_by(runtime: &TokenStream) -> TokenStream {
    let version = concat!(
        env!("CARGO_PKG_VERSION_MAJOR"),
        ".",
        env!("CARGO_PKG_VERSION_MINOR")
    );
    let version = version.parse::<Literal>().into_iter();
    quote!(#(#runtime::__private::generated_by!(#version);)*)
}

fn constants(compiled: &CompiledArm, n: &Literal, postures: Option<&Postures>) -> TokenStream {
    let model = &compiled.model;
    let names = model
        .variables
        .iter()
        .map(|variable| text::literal(&variable.name));
    let limits = model.limits().into_iter().map(limit);
    let velocities = rated(&model.variables, n, |rating| rating.velocity);
    let efforts = rated(&model.variables, n, |rating| rating.effort);
    let links =
        (0..model.variables.len()).map(|i| text::literal(&model.joints[model.joint_of(i)].link));
    let (base, tip) = (text::literal(&model.base), text::literal(&model.tip));
    let branches = Literal::usize_unsuffixed(compiled.branches());
    let frames = frames::constant(model);
    let postures = postures.map(|postures| named(postures, compiled.branches()));
    let target = compiled.target();
    let target = format_ident!("{target:?}");
    quote! {
        /// The joints' names in the robot file, in the order of `q`: from base
        /// to tip.
        pub const JOINT_NAMES: [&'static str; #n] = [#(#names),*];
        /// The joints' kinds and travel, in the order of `q`: radians, and
        /// metres of prismatic joints.
        pub const LIMITS: [JointLimit; #n] = [#(#limits),*];
        /// How fast the joints may move: rad/s, and m/s of prismatic joints;
        /// infinity where the robot file does not say.
        pub const VELOCITY_LIMITS: [f64; #n] = #velocities;
        /// What the joints' drives may exert: N m, and N of prismatic joints;
        /// infinity where the robot file does not say.
        pub const EFFORT_LIMITS: [f64; #n] = #efforts;
        /// The links whose poses [`Self::fk_links`] gives, in its order.
        pub const LINK_NAMES: [&'static str; #n] = [#(#links),*];
        #frames
        /// The link in whose frame poses are given.
        pub const BASE: &'static str = #base;
        /// The link whose frame poses are of.
        pub const TIP: &'static str = #tip;
        /// What of a target counts for inverse kinematics.
        pub const TARGET: Target = Target::#target;
        /// What the branches are called, by [`Solution::branch`](::kinematics::Solution).
        pub const POSTURES: &'static [Posture] = &[#postures];
        /// How many branches inverse kinematics looks at; 0 without it.
        pub const BRANCHES: usize = #branches;
    }
}

/// Every branch with its postures, if there are any.
fn named(postures: &Postures, branches: usize) -> TokenStream {
    let parts = postures.columns.iter().map(|column| &column.name);
    let parts = quote!(&[#(#parts),*]);
    let named = (0..branches as u32).map(|branch| {
        let words = postures.words(branch);
        let words = quote!(&[#(#words),*]);
        let branch = Literal::u32_unsuffixed(branch);
        quote!(Posture::new(#branch, #parts, #words))
    });
    quote!(#(#named),*)
}

pub(super) fn limit(limit: JointLimit) -> TokenStream {
    let (lower, upper) = (bound(limit.lower()), bound(limit.upper()));
    match limit {
        JointLimit::Prismatic { .. } => quote!(JointLimit::prismatic(#lower, #upper)),
        JointLimit::Revolute { .. } => quote!(JointLimit::revolute(#lower, #upper)),
        JointLimit::Continuous => quote!(JointLimit::Continuous),
    }
}

/// What the drives of `n` coordinates are rated for; infinity where that is not
/// known.
pub(super) fn rated<'a>(
    variables: impl IntoIterator<Item = &'a Variable>,
    n: &Literal,
    of: fn(&Rating) -> Option<f64>,
) -> TokenStream {
    let ratings = variables.into_iter().map(|variable| of(&variable.rating));
    let known: Vec<f64> = ratings.map(|it| it.unwrap_or(f64::INFINITY)).collect();
    same_or_all(&known, n)
}

/// `[x; n]`, or the values one by one where they differ.
fn same_or_all(values: &[f64], n: &Literal) -> TokenStream {
    let all = values.iter().copied().map(bound);
    match values {
        [first, rest @ ..] if rest.iter().all(|x| x == first) => {
            let first = bound(*first);
            quote!([#first; #n])
        }
        _ => quote!([#(#all),*]),
    }
}

/// A number that may be infinite.
fn bound(x: f64) -> TokenStream {
    match x {
        f64::INFINITY => quote!(f64::INFINITY),
        f64::NEG_INFINITY => quote!(f64::NEG_INFINITY),
        x => signed(x),
    }
}

fn methods(compiled: &CompiledArm, n: &Literal) -> TokenStream {
    let f = compiled.forward();
    let spatial = match f.spatial_alone() {
        Some(_) => by_itself("SpatialJacobian"),
        None => quote!(self.fk_jacobian(q).1),
    };
    let [body, geometric] = ["BodyJacobian", "GeometricJacobian"].map(by_itself);
    let fk_cost = format!(" {}.", f.cost(&f.tip.expressions()));
    let both_cost = format!(" {}.", f.cost(&f.both.expressions()));
    quote! {
        /// The pose of the tip in the base frame, metres, at joint values `q`:
        /// radians, and metres of prismatic joints.
        ///
        /// Limits are not applied. A joint value that is not finite gives a
        /// pose that is not a number.
        ///
        #[doc = #fk_cost]
        #[inline]
        #[must_use]
        pub fn fk(&self, q: &[f64; #n]) -> Pose { evaluate(self, q) }

        /// The pose, in the base frame, of the link that each joint moves, in
        /// the order of `q`; what is fixed behind the last joint is not in it.
        /// Units as of [`Self::fk`].
        #[inline]
        #[must_use]
        pub fn fk_links(&self, q: &[f64; #n]) -> [Pose; #n] { evaluate(self, q) }

        /// The spatial Jacobian J_s (MLS section 3.4.1): times joint rates, the
        /// twist (v, ω) of the tip in base coordinates, v being the velocity of
        /// the point of the tip that passes the base's origin.
        ///
        /// Metres, and rows of ω without unit, per radian; per metre for
        /// prismatic joints. A joint value that is not finite gives entries
        /// that are not numbers; so in the other Jacobians.
        #[inline]
        #[must_use]
        pub fn spatial_jacobian(&self, q: &[f64; #n]) -> Jacobian<#n> { #spatial }

        /// The body Jacobian J_b (MLS section 3.4.1): times joint rates, the
        /// velocity of the tip's origin and the angular velocity, both in tip
        /// axes. Units as of [`Self::spatial_jacobian`].
        #[inline]
        #[must_use]
        pub fn body_jacobian(&self, q: &[f64; #n]) -> Jacobian<#n> { #body }

        /// The geometric Jacobian, which ROS uses: times joint rates, the
        /// velocity of the tip's origin and the angular velocity, both in base
        /// axes. Units as of [`Self::spatial_jacobian`].
        #[inline]
        #[must_use]
        pub fn geometric_jacobian(&self, q: &[f64; #n]) -> Jacobian<#n> { #geometric }

        /// [`Self::fk`] and [`Self::spatial_jacobian`], computed together.
        ///
        #[doc = #both_cost]
        #[inline]
        #[must_use]
        pub fn fk_jacobian(&self, q: &[f64; #n]) -> (Pose, Jacobian<#n>) { evaluate(self, q) }
    }
}

/// A Jacobian that is computed by itself.
fn by_itself(jacobian: &str) -> TokenStream {
    let jacobian = format_ident!("{jacobian}");
    quote! {
        let #jacobian(jacobian) = evaluate(self, q);
        jacobian
    }
}

/// Forward kinematics as straight-line code, of one configuration or in batches.
fn straight(compiled: &CompiledArm, name: &Ident) -> TokenStream {
    let n = compiled.model.variables.len();
    let count = Literal::usize_unsuffixed(n);
    let f = compiled.forward();
    let implementation =
        |output, outputs: &dyn Outputs, result: &dyn Fn(&Writer) -> TokenStream| {
            forward::implementation(name, &output, &f.graph, &outputs.expressions(), n, result)
        };
    let fk = implementation(quote!(Pose), &f.tip, &|w| forward::pose(w, &f.tip));
    let fk_jacobian = implementation(quote!((Pose, Jacobian<#count>)), &f.both, &|w| {
        let pose = forward::pose(w, &f.both.tip);
        let jacobian = forward::jacobian(w, &f.both.columns);
        quote!((#pose, #jacobian))
    });
    let fk_links = implementation(quote!([Pose; #count]), &f.links, &|w| {
        let poses = f.links.iter().map(|link| forward::pose(w, link));
        quote!([#(#poses),*])
    });
    let jacobian = |which: &str, columns: &Columns| {
        let which = format_ident!("{which}");
        implementation(quote!(#which<#count>), columns, &|w| {
            let jacobian = forward::jacobian(w, columns);
            quote!(#which(#jacobian))
        })
    };
    let spatial = f.spatial_alone();
    let spatial = spatial.map(|columns| jacobian("SpatialJacobian", columns));
    let body = jacobian("BodyJacobian", &f.body);
    let geometric = jacobian("GeometricJacobian", &f.geometric);
    quote! {
        #fk
        #fk_jacobian
        #fk_links
        #spatial
        #body
        #geometric
    }
}

/// The trait, by the inherent methods, and what it provides.
fn kinematics(compiled: &CompiledArm, names: &Names, n: &Literal) -> TokenStream {
    let (name, runtime) = (&names.robot, &names.runtime);
    let own = |is_own: bool, other: &'static str| if is_own { "own" } else { other };
    let singular = compiled.singular();
    let groups = [
        own(compiled.branches() > 0, "none"),
        own(compiled.forward().dot.is_some(), "provided"),
        own(singular.is_some(), "none"),
        own(
            singular.is_some_and(|singular| !singular.singularities.is_empty()),
            "none",
        ),
    ];
    let in_lanes = compiled
        .form()
        .is_some_and(|form| compiled.branches() > 0 && form.is_in_lanes());
    let batches = if in_lanes { "inverse" } else { "forward" };
    let batches = format_ident!("{batches}");
    let scalar = (compiled.model.scalar == Scalar::F32).then(|| quote!(scalar: f32,));
    let [inverse, derivatives, determinant, singularities] =
        groups.map(|word| Ident::new(word, proc_macro2::Span::call_site()));
    quote! {
        #runtime::__private::implement_kinematics! {
            #name, #n, #scalar batches: #batches, inverse: #inverse, derivatives: #derivatives, determinant: #determinant,
            singularities: #singularities
        }
    }
}

/// The derivatives of the Jacobian where joints mimic others, so that the trait
/// cannot tell them from the Jacobian.
fn derivatives(compiled: &CompiledArm, dot: &Columns, n: &Literal) -> TokenStream {
    let count = compiled.model.variables.len();
    let graph = &compiled.forward().graph;
    let body = forward::block_with_rates(graph, &dot.expressions(), count, |w| {
        forward::jacobian(w, dot)
    });
    quote! {
        /// The time derivative of the spatial Jacobian at joint values `q`,
        /// radians and metres, and at the joint rates, rad/s and m/s.
        #[must_use]
        pub fn jacobian_dot(&self, q: &[f64; #n], rates: &[f64; #n]) -> Jacobian<#n> { #body }

        /// The derivatives of the spatial Jacobian by every joint.
        #[must_use]
        pub fn hessian(&self, q: &[f64; #n]) -> Hessian<#n> {
            let unit = |k| ::core::array::from_fn(|j| if j == k { 1.0 } else { 0.0 });
            let derivative = |k| self.jacobian_dot(q, &unit(k));
            Hessian { derivatives: ::core::array::from_fn(derivative) }
        }
    }
}
