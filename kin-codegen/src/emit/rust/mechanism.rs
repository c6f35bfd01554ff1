//! The type of a mechanism. Its chains, and the chains that its forward
//! kinematics cuts out of a loop, are written as the arms that they are, out of
//! sight of the user.

use super::comment::comment;
use super::imports::imports;
use super::language::{matrix, signed};
use super::robot::{generated_by, in_module, limit, rated};
use super::{Names, documentation, forward, inverse};
use crate::arm::CompiledArm;
use crate::emit::text;
use crate::expr::forward::Outputs;
use crate::mechanism::{Aim, CompiledMechanism, ForwardMethod, LegForm, Loop, Rod};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

/// The items that a mechanism becomes.
pub fn mechanism(compiled: &CompiledMechanism, names: &Names) -> TokenStream {
    let (name, runtime) = (&names.robot, &names.runtime);
    let sizes = Sizes::of(compiled);
    let Sizes { n, m, k } = &sizes;
    let doc = documentation::mechanism(compiled, name);
    let doc = doc.iter().map(|line| format!(" {line}"));
    let arms = arms(compiled);
    let constants = constants(compiled, &sizes);
    let chains = chains(compiled, &sizes);
    let ik = ik(compiled, &sizes);
    let fk = fk(compiled, &sizes);
    let own = |is_own: bool| Ident::new(if is_own { "own" } else { "none" }, Span::call_site());
    let (inverse, forward) = (own(ik.is_some()), own(fk.is_some()));
    let generated_by = generated_by(runtime);
    let items = quote! {
        impl ParallelKinematics<#n, #m, #k> for #name {
            #constants
            #chains
            #ik
            #fk
        }
    };
    let (imports, arms_imports) = (imports(&items, runtime), imports(&arms, runtime));
    in_module(
        name,
        &quote! {
            #generated_by
            #imports

            #(#[doc = #doc])*
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
            pub struct #name;

            /// The chains that the mechanism is made of.
            #[allow(dead_code, reason = "it does not ask them for all that an arm can do")]
            mod arms {
                #arms_imports

                #arms
            }

            #items

            #runtime::__private::inherent_parallel_methods! {
                #name, #n, #m, #k, inverse: #inverse, forward: #forward
            }
        },
    )
}

/// The numbers of joints, actuated joints and chains.
struct Sizes {
    n: Literal,
    m: Literal,
    k: Literal,
}

impl Sizes {
    fn of(compiled: &CompiledMechanism) -> Self {
        let mechanism = &compiled.mechanism;
        let [n, m, k] = [
            mechanism.joints(),
            mechanism.actuated().len(),
            mechanism.legs.len(),
        ]
        .map(Literal::usize_unsuffixed);
        Sizes { n, m, k }
    }
}

fn constants(compiled: &CompiledMechanism, Sizes { n, m, k }: &Sizes) -> TokenStream {
    let mechanism = &compiled.mechanism;
    let legs = &mechanism.legs;
    let names = legs.iter().flat_map(|leg| &leg.model.variables);
    let names = names.map(|variable| text::literal(&variable.name));
    let variables = || legs.iter().flat_map(|leg| &leg.model.variables);
    let velocities = rated(variables(), n, |rating| rating.velocity);
    let efforts = rated(variables(), n, |rating| rating.effort);
    let limits = legs.iter().flat_map(|leg| leg.model.limits()).map(limit);
    let ranges = mechanism.ranges().into_iter().map(|[first, end]| {
        let [first, end] = [first, end].map(Literal::usize_unsuffixed);
        quote!([#first, #end])
    });
    let actuated = mechanism
        .actuated()
        .into_iter()
        .map(Literal::usize_unsuffixed);
    let (base, platform) = (
        text::literal(&mechanism.base),
        text::literal(&mechanism.platform),
    );
    let length = signed(mechanism.generic().length());
    let mobility = Literal::usize_unsuffixed(compiled.freedom.mobility);
    let branches = (0..legs.len()).map(|leg| {
        let inverse = compiled.inverse.as_ref();
        Literal::usize_unsuffixed(inverse.map_or(0, |inverse| inverse.legs[leg].branches()))
    });
    let assembly_modes = Literal::usize_unsuffixed(compiled.forward.assembly_modes());
    quote! {
        const JOINT_NAMES: [&'static str; #n] = [#(#names),*];
        const LIMITS: [JointLimit; #n] = [#(#limits),*];
        const VELOCITY_LIMITS: [f64; #n] = #velocities;
        const EFFORT_LIMITS: [f64; #n] = #efforts;
        const CHAINS: [[usize; 2]; #k] = [#(#ranges),*];
        const ACTUATED: [usize; #m] = [#(#actuated),*];
        const BASE: &'static str = #base;
        const PLATFORM: &'static str = #platform;
        const LENGTH: f64 = #length;
        const MOBILITY: usize = #mobility;
        const BRANCHES: [usize; #k] = [#(#branches),*];
        const ASSEMBLY_MODES: usize = #assembly_modes;
    }
}

/// What the chain of a number is called, and its parts.
fn leg_name(leg: usize) -> Ident {
    format_ident!("Leg{}", leg + 1)
}

fn head_name(leg: usize) -> Ident {
    format_ident!("Head{}", leg + 1)
}

fn tail_name(leg: usize) -> Ident {
    format_ident!("Tail{}", leg + 1)
}

fn rod_name(rod: usize) -> Ident {
    format_ident!("Rod{}", rod + 1)
}

/// All serial chains that the functions below call.
fn arms(compiled: &CompiledMechanism) -> TokenStream {
    let mut all = TokenStream::new();
    for (i, leg) in compiled.legs.iter().enumerate() {
        let name = text::code(&compiled.mechanism.legs[i].name);
        all.extend(arm(&leg_name(i), &format!("The chain {name}."), leg));
        let form = compiled.inverse.as_ref().map(|inverse| &inverse.legs[i]);
        if let Some(LegForm::Split(split)) = form {
            let head = format!("The chain {name} up to the point where its last axes meet.");
            let tail = format!("What of the chain {name} turns about that point.");
            all.extend(arm(&head_name(i), &head, &split.head));
            all.extend(arm(&tail_name(i), &tail, &split.tail));
        }
    }
    match &compiled.forward {
        ForwardMethod::Loop(found) => {
            let drive = "Where the actuated joints put one end of the passive ones, seen from the \
                         other.";
            let passive = "The passive joints around the loop.";
            all.extend(arm(&format_ident!("Drive"), drive, &found.drive));
            all.extend(arm(&format_ident!("Passive"), passive, &found.passive));
        }
        ForwardMethod::Spheres(rods) => {
            for (i, rod) in rods.iter().enumerate() {
                let drive = "Where the actuated joints put an end of a rod.";
                all.extend(arm(&rod_name(i), drive, &rod.drive));
            }
        }
        ForwardMethod::Newton => {}
    }
    all
}

/// A serial chain with as much of its kinematics as a mechanism may call.
fn arm(name: &Ident, what: &str, compiled: &CompiledArm) -> TokenStream {
    let what = format!(" {what}");
    let count = compiled.model.variables.len();
    let n = Literal::usize_unsuffixed(count);
    let f = compiled.forward();
    let (g, tip, both) = (&f.graph, &f.tip, &f.both);
    let fk = forward::block(g, &tip.expressions(), count, |w| forward::pose(w, tip));
    let fk_jacobian = forward::block(g, &both.expressions(), count, |w| {
        let pose = forward::pose(w, &both.tip);
        let jacobian = forward::jacobian(w, &both.columns);
        quote!((#pose, #jacobian))
    });
    let inverse = compiled
        .form()
        .map(|form| inverse::methods(&compiled.model, form));
    let lanes = compiled
        .form()
        .and_then(|form| inverse::implementation(name, form));
    quote! {
        #[doc = #what]
        pub struct #name;

        impl #name {
            /// Where the chain ends, in the frame that it begins in, metres; `q`
            /// in radians and metres.
            #[inline]
            pub fn fk(&self, q: &[f64; #n]) -> Pose { #fk }

            /// The same with the spatial Jacobian.
            #[inline]
            pub fn fk_jacobian(&self, q: &[f64; #n]) -> (Pose, Jacobian<#n>) { #fk_jacobian }

            #inverse
        }

        #lanes
    }
}

/// `array[0], array[1], ..` for some places.
fn entries(array: &str, places: impl IntoIterator<Item = usize>) -> TokenStream {
    let array = format_ident!("{array}");
    let places = places.into_iter().map(Literal::usize_unsuffixed);
    quote!([#(#array[#places]),*])
}

fn chains(compiled: &CompiledMechanism, Sizes { n, k, .. }: &Sizes) -> TokenStream {
    let ranges = compiled.mechanism.ranges();
    let mut statements = TokenStream::new();
    let (mut poses, mut twists) = (Vec::new(), Vec::new());
    for (i, [first, end]) in ranges.into_iter().enumerate() {
        let (leg, pose, jacobian) = (
            leg_name(i),
            format_ident!("pose{}", i + 1),
            format_ident!("jacobian{}", i + 1),
        );
        let q = entries("q", first..end);
        statements.extend(quote!(let (#pose, #jacobian) = arms::#leg.fk_jacobian(&#q);));
        poses.push(pose);
        twists.extend((0..end - first).map(|j| {
            let j = Literal::usize_unsuffixed(j);
            quote!(#jacobian.column(#j))
        }));
    }
    quote! {
        #[inline]
        fn chains(&self, q: &[f64; #n]) -> ([Pose; #k], [Twist; #n]) {
            #statements
            ([#(#poses),*], [#(#twists),*])
        }
    }
}

/// The rotation of a pose.
fn rotation(pose: &kin_runtime::Pose) -> TokenStream {
    matrix(pose.rotation.map(|row| row.map(signed)))
}

fn ik(compiled: &CompiledMechanism, Sizes { n, k, .. }: &Sizes) -> Option<TokenStream> {
    let inverse = compiled.inverse.as_ref()?;
    let legs = 0..inverse.legs.len();
    let body = match inverse.aim {
        Aim::Pose | Aim::Translation => {
            let place = quote!(0);
            let all: TokenStream = legs.map(|leg| pushes(compiled, leg, &place)).collect();
            let upright = (inverse.aim == Aim::Translation).then(|| {
                let rotation = rotation(&compiled.mechanism.home());
                let comment = comment("The platform does not turn: its rotation is that at home");
                quote!(#comment let target = &Pose { rotation: #rotation, ..*target };)
            });
            quote!(#upright #all)
        }
        Aim::Lead(lead) => {
            let place = quote!(place as u8);
            let others: TokenStream = legs
                .filter(|leg| *leg != lead)
                .map(|leg| pushes(compiled, leg, &place))
                .collect();
            let [first, end] = compiled.mechanism.ranges()[lead];
            let (name, seed) = (leg_name(lead), entries("seed", first..end));
            let comment = comment(&format!(
                "{} first: the position fixes it, and it tells the others the pose",
                compiled.mechanism.legs[lead].name
            ));
            let lead = Literal::usize_unsuffixed(lead);
            quote! {
                #comment
                for (place, lead) in arms::#name.ik_seeded(target, &#seed).iter().enumerate() {
                    postures.push(#lead, #place, &lead.q);
                    let target = &arms::#name.fk(&lead.q);
                    #others
                    postures.end_place(#place);
                }
            }
        }
    };
    Some(quote! {
        fn ik_seeded(&self, target: &Pose, seed: &[f64; #n]) -> Postures<#n, #k> {
            let mut postures = Postures::new(Self::CHAINS);
            #body
            postures
        }
    })
}

/// Adds the solutions of one chain.
fn pushes(compiled: &CompiledMechanism, leg: usize, place: &TokenStream) -> TokenStream {
    let Some(inverse) = &compiled.inverse else {
        return TokenStream::new();
    };
    let [first, end] = compiled.mechanism.ranges()[leg];
    let number = Literal::usize_unsuffixed(leg);
    let chain = &compiled.mechanism.legs[leg].name;
    let plan = inverse.legs[leg].plan();
    let comment = comment(&format!("{chain}: {plan}"));
    match &inverse.legs[leg] {
        LegForm::Whole(_) => {
            let (name, seed) = (leg_name(leg), entries("seed", first..end));
            quote! {
                #comment
                for found in &arms::#name.ik_seeded(target, &#seed) {
                    postures.push(#number, #place, &found.q);
                }
            }
        }
        LegForm::Split(split) => {
            let (head, tail) = (head_name(leg), tail_name(leg));
            let point = split.point.map(signed);
            let at = first + split.head.model.joints.len();
            let (seed_head, seed_tail) = (entries("seed", first..at), entries("seed", at..end));
            let places = |count: usize| (0..count).map(Literal::usize_unsuffixed);
            let (of_head, of_tail) = (places(at - first), places(end - at));
            quote! {
                #comment
                let point = Pose::from_translation(target.transform_point([#(#point),*]));
                for head in &arms::#head.ik_seeded(&point, &#seed_head) {
                    let rest = arms::#head.fk(&head.q).inverse() * *target;
                    for tail in &arms::#tail.ik_seeded(&rest, &#seed_tail) {
                        let q = [#(head.q[#of_head],)* #(tail.q[#of_tail]),*];
                        postures.push(#number, #place, &q);
                    }
                }
            }
        }
    }
}

fn fk(compiled: &CompiledMechanism, Sizes { n, m, .. }: &Sizes) -> Option<TokenStream> {
    let body = match &compiled.forward {
        ForwardMethod::Loop(found) => around(compiled, found, n),
        ForwardMethod::Spheres(rods) => spheres(compiled, rods, n),
        ForwardMethod::Newton => return None,
    };
    Some(quote! {
        fn fk(&self, actuated: &[f64; #m]) -> Solutions<#n> {
            #body
        }
    })
}

/// Bit i is set where joint i is prismatic.
fn prismatic(compiled: &CompiledMechanism) -> Literal {
    let joints = compiled
        .mechanism
        .legs
        .iter()
        .flat_map(|leg| &leg.model.joints);
    let slides = |(i, joint): (usize, &crate::model::Joint)| {
        (!joint.is_revolute() && i < 32).then_some(1_u32 << (i % 32))
    };
    Literal::u32_unsuffixed(joints.enumerate().filter_map(slides).sum())
}

fn around(compiled: &CompiledMechanism, found: &Loop, n: &Literal) -> TokenStream {
    let driven = entries("actuated", found.driven.iter().copied());
    let actuated = compiled.mechanism.actuated();
    let driving = actuated.iter().enumerate().map(|(a, joint)| {
        let [a, joint] = [a, *joint].map(Literal::usize_unsuffixed);
        quote!(q[#joint] = actuated[#a];)
    });
    let passive = found.joints.iter().enumerate().map(|(i, joint)| {
        let [i, joint] = [i, *joint].map(Literal::usize_unsuffixed);
        quote!(q[#joint] = found.q[#i];)
    });
    let mask = prismatic(compiled);
    let placing = comment("Where the actuated joints put the ends of the passive ones");
    let closing = comment("Every way in which the passive joints close the loop");
    quote! {
        #placing
        let placed = arms::Drive.fk(&#driven);
        #closing
        Solutions::build_with_prismatic(#mask, |solutions| {
            for found in &arms::Passive.ik(&placed) {
                let mut q = [0.0; #n];
                #(#driving)*
                #(#passive)*
                let residual = ParallelKinematics::gap(self, &q);
                let (branch, singular) = (found.branch, found.singular);
                solutions.push(Solution { q, residual, branch, singular });
            }
        })
    }
}

fn spheres(compiled: &CompiledMechanism, rods: &[Rod], n: &Literal) -> TokenStream {
    let mechanism = &compiled.mechanism;
    let centres = rods.iter().enumerate().map(|(i, rod)| {
        let (name, driven) = (rod_name(i), entries("actuated", rod.driven.iter().copied()));
        let [x, y, z] = rod.end.map(signed);
        quote!({
            let from = arms::#name.fk(&#driven).translation;
            [from[0] - (#x), from[1] - (#y), from[2] - (#z)]
        })
    });
    let lengths = rods.iter().map(|rod| signed(rod.length));
    let rotation = rotation(&mechanism.home());
    let joints: Vec<_> = mechanism
        .legs
        .iter()
        .flat_map(|leg| &leg.model.joints)
        .collect();
    let slides = |joint: usize| !joints[joint].is_revolute();
    let kept = mechanism
        .actuated()
        .into_iter()
        .enumerate()
        .map(|(a, joint)| {
            let turns = !slides(joint);
            let [a, joint] = [a, joint].map(Literal::usize_unsuffixed);
            quote!(postures.keep(#joint, actuated[#a], #turns);)
        });
    let free = (0..joints.len()).map(|joint| match slides(joint) {
        true => quote!(JointLimit::prismatic(f64::NEG_INFINITY, f64::INFINITY)),
        false => quote!(JointLimit::Continuous),
    });
    let mask = prismatic(compiled);
    let meeting = comment(
        "The platform's origin is as far as each rod is long from a point that an actuator places",
    );
    let holding = comment("There each chain holds the platform as its actuated joint is set");
    quote! {
        const FREE: [JointLimit; #n] = [#(#free),*];
        #meeting
        let points = three_spheres([#(#centres),*], [#(#lengths),*]);
        let singular = points.exact().len() == 1;
        #holding
        Solutions::build_with_prismatic(#mask, |solutions| {
            for (branch, point) in points.exact().iter().enumerate() {
                let branch = branch as u32;
                let platform = Pose { rotation: #rotation, translation: *point };
                let mut postures = ParallelKinematics::ik(self, &platform);
                #(#kept)*
                if let Some(q) = postures.nearest(&[0.0; #n], &FREE) {
                    let residual = ParallelKinematics::gap(self, &q);
                    solutions.push(Solution { q, residual, branch, singular });
                }
            }
        })
    }
}
