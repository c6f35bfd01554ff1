//! A parallel mechanism: its chains as arms, and what they make of the platform together.

use super::called::hidden;
use super::declarations::{about as about_arm, guarded, of_arm, types};
use super::definitions::{constants, file, functions, limits};
use super::language::{numbers, signed};
use super::name::{named, of_part};
use super::runtime;
use super::text::{comment, string};
use crate::arm::CompiledArm;
use crate::emit::curly::data::rows;
use crate::mechanism::{Aim, CompiledMechanism, ForwardMethod, LegForm, Rod};
use std::fmt::Write as _;

const CONVENTIONS: &str = include_str!("runtime/mechanism/conventions.h");
const MECHANISM: &str = include_str!("runtime/mechanism/mechanism.h");
const IK: &str = include_str!("runtime/mechanism/ik.h");
const FK: &str = include_str!("runtime/mechanism/fk.h");

/// A chain of the mechanism, or what its kinematics makes of chains.
struct Part<'a> {
    /// What its names have behind the mechanism's.
    name: String,
    what: String,
    arm: &'a CompiledArm,
}

impl Part<'_> {
    /// What only this file calls.
    fn own(&self) -> String {
        let variables = self.arm.model.variables.iter().enumerate();
        let variables: Vec<_> = variables
            .map(|(i, variable)| (variable, self.arm.model.turns(i)))
            .collect();
        let limits = limits(&variables).replace(";\n", ";\n\n");
        let header = comment(std::slice::from_ref(&self.what)) + &types(self.arm);
        let all = [header, limits, functions(self.arm)];
        of_part(&hidden(&all.join("\n")), &self.name, runtime::is_shared)
    }
}

/// The chains.
fn chains(compiled: &CompiledMechanism) -> Vec<Part<'_>> {
    let chain = |(k, arm): (usize, _)| {
        let what = format!("The chain `{}`.", compiled.mechanism.legs[k].name);
        let name = format!("chain{k}");
        Part { name, what, arm }
    };
    compiled.legs.iter().enumerate().map(chain).collect()
}

/// What kinematics makes of them.
fn parts(compiled: &CompiledMechanism) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut add = |name: String, what: String, arm| parts.push(Part { name, what, arm });
    for (k, leg) in inverse(compiled)
        .iter()
        .flat_map(|(_, legs)| legs.iter().enumerate())
    {
        if let LegForm::Split(split) = leg {
            let name = &compiled.mechanism.legs[k].name;
            let head = format!("The chain `{name}` up to the point where its last axes meet.");
            let tail = format!("What of the chain `{name}` turns about that point.");
            add(format!("chain{k}_head"), head, &split.head);
            add(format!("chain{k}_tail"), tail, &split.tail);
        }
    }
    match forward(compiled) {
        Some(Forward::Loop(found)) => {
            let drive = "Where the actuated joints put one end of the passive ones, seen from the \
                         other.";
            add("drive".into(), drive.into(), &found.drive);
            let passive = "The passive joints around the loop.";
            add("passive".into(), passive.into(), &found.passive);
        }
        Some(Forward::Spheres(rods)) => {
            for (i, rod) in rods.iter().enumerate() {
                let what = "Where the actuated joints put an end of a rod.";
                add(format!("rod{i}"), what.into(), &rod.drive);
            }
        }
        None => {}
    }
    parts
}

/// Inverse kinematics.
fn inverse(compiled: &CompiledMechanism) -> Option<(Aim, &[LegForm])> {
    let inverse = compiled.inverse.as_ref()?;
    Some((inverse.aim, &inverse.legs))
}

/// A closed form of forward kinematics.
enum Forward<'a> {
    Loop(&'a crate::mechanism::Loop),
    Spheres(&'a [Rod]),
}

/// The same of forward kinematics; by spheres, it needs the inverse.
fn forward(compiled: &CompiledMechanism) -> Option<Forward<'_>> {
    match &compiled.forward {
        ForwardMethod::Loop(found) => found.passive.form().map(|_| Forward::Loop(found)),
        ForwardMethod::Spheres(rods) => inverse(compiled).map(|_| Forward::Spheres(rods)),
        ForwardMethod::Newton => None,
    }
}

/// The header, behind the comment at the top.
pub fn declarations(compiled: &CompiledMechanism, prefix: &str) -> String {
    let mechanism = &compiled.mechanism;
    let about = vec![format!(
        "The mechanism `{}` from `{}` to `{}`, compiled from `{}`.",
        mechanism.name, mechanism.base, mechanism.platform, compiled.file
    )];
    let mut sizes = String::new();
    for (name, value) in [
        ("JOINTS", mechanism.joints()),
        ("CHAINS", mechanism.legs.len()),
        ("ACTUATED", mechanism.actuated().len()),
        ("MOBILITY", compiled.freedom.mobility),
    ] {
        let _ = writeln!(sizes, "#define KIN_{name} {value}");
    }
    let length = signed(mechanism.generic().length());
    let _ = writeln!(
        sizes,
        "/* At whose distance angles count as lengths, metres. */\n#define KIN_LENGTH {length}"
    );
    let mut own = format!("{sizes}\n{MECHANISM}");
    if let Some((aim, _)) = inverse(compiled) {
        own += IK;
        own += match aim {
            Aim::Pose => "",
            Aim::Translation => {
                "/* The platform does not turn: of a target the translation is read. */\n"
            }
            Aim::Lead(_) => {
                "/* Of a target the translation is read, which leaves the platform no other freedom. */\n"
            }
        };
    }
    if forward(compiled).is_some() {
        own += &FK.replace(
            "\n/* One assembly. */",
            &format!(
                "\n#define KIN_ASSEMBLY_MODES {}\n\n/* One assembly. */",
                compiled.forward.assembly_modes()
            ),
        );
    }
    let mut all = named(&own, prefix);
    for part in chains(compiled) {
        let mut about = vec![part.what, String::new()];
        about.extend(about_arm(part.arm));
        let declared = of_arm(part.arm, &format!("{prefix}_{}", part.name));
        let _ = write!(all, "\n{}\n{declared}", comment(&about));
    }
    guarded(prefix, &comment(&about), CONVENTIONS, &all)
}

/// The file of definitions, behind the comment at the top.
pub fn definitions(compiled: &CompiledMechanism, prefix: &str) -> String {
    let (mut data, mut code) = (own_constants(compiled, prefix), String::new());
    for part in chains(compiled) {
        data += &constants(part.arm, &format!("{prefix}_{}", part.name));
        let functions = of_part(&functions(part.arm), &part.name, runtime::is_shared);
        let _ = writeln!(code, "{functions}");
    }
    for part in parts(compiled) {
        let _ = writeln!(code, "{}", part.own());
    }
    code += &chain_twists(compiled);
    for piece in runtime::MECHANISM.iter().chain([&runtime::LIMITS]) {
        let _ = write!(code, "\n{piece}");
    }
    if let Some((aim, legs)) = inverse(compiled) {
        let seeded = seeded(compiled, aim, legs);
        let _ = write!(
            code,
            "\n{}",
            runtime::POSTURES.replacen(ENTRIES, &(seeded + ENTRIES), 1)
        );
    }
    match forward(compiled) {
        Some(Forward::Loop(found)) => code += &around(compiled, found),
        Some(Forward::Spheres(rods)) => code += &spheres(compiled, rods),
        None => {}
    }
    file(prefix, &data, &named(&runtime::with_pieces(&code), prefix))
}

/// What of the answers calls the function that solves.
const ENTRIES: &str = "int kin_ik(const double pose[12], kin_postures *postures)";

fn own_constants(compiled: &CompiledMechanism, prefix: &str) -> String {
    let mechanism = &compiled.mechanism;
    let legs = &mechanism.legs;
    let variables = legs.iter().flat_map(|leg| {
        let variables = leg.model.variables.iter().enumerate();
        variables.map(|(i, variable)| (variable, leg.model.turns(i)))
    });
    let variables: Vec<_> = variables.collect();
    let names: Vec<String> = variables.iter().map(|(it, _)| string(&it.name)).collect();
    let mut out = named("const char *const kin_joint_names[KIN_JOINTS]", prefix);
    let _ = writeln!(out, " = {{\n    {}\n}};", names.join(",\n    "));
    for (what, name) in [("base", &mechanism.base), ("platform", &mechanism.platform)] {
        out += &named(&format!("const char *const kin_{what}"), prefix);
        let _ = writeln!(out, " = {};", string(name));
    }
    let places = |values: Vec<usize>| {
        let values: Vec<String> = values.iter().map(usize::to_string).collect();
        values.join(", ")
    };
    let first = mechanism.ranges().into_iter().map(|[first, _]| first);
    let chains = places(first.chain([mechanism.joints()]).collect());
    let actuated = places(mechanism.actuated());
    let tables = format!(
        "const int kin_chains[KIN_CHAINS + 1] = {{{chains}}};\n\
         const int kin_actuated[KIN_ACTUATED] = {{{actuated}}};\n{}",
        limits(&variables)
    );
    out + &named(&tables, prefix)
}

/// The function that asks all chains where they put the platform.
fn chain_twists(compiled: &CompiledMechanism) -> String {
    let mut out = String::from(
        "/* Where each chain puts the platform, and the spatial twist of each joint. */\n\
         static void kin_chain_twists(\n    const double q[KIN_JOINTS], \
         double poses[12 * KIN_CHAINS], double twists[6 * KIN_JOINTS])\n{\n    \
         double jacobian[6 * KIN_JOINTS];\n",
    );
    for (k, [first, end]) in compiled.mechanism.ranges().into_iter().enumerate() {
        let count = end - first;
        let _ = write!(
            out,
            "    kin_chain{k}_fk_jacobian(q + {first}, poses + {}, jacobian);\n    \
             for (int joint = 0; joint < {count}; ++joint) {{\n        \
             for (int i = 0; i < 6; ++i) {{\n            \
             twists[6 * ({first} + joint) + i] = jacobian[{count} * i + joint];\n        }}\n    }}\n",
            12 * k
        );
    }
    out + "}\n"
}

/// The functions that solve chains, and the one that asks them.
fn seeded(compiled: &CompiledMechanism, aim: Aim, legs: &[LegForm]) -> String {
    let mechanism = &compiled.mechanism;
    let mut out = String::new();
    let followers = |k: &usize| aim != Aim::Lead(*k);
    for (k, leg) in legs.iter().enumerate().filter(|(k, _)| followers(k)) {
        out += &solves(compiled, k, leg);
    }
    out += "int kin_ik_seeded(const double pose[12], const double seed[KIN_JOINTS], \
            kin_postures *postures)\n{\n";
    let asks = |place: &str, target: &str| {
        let all = (0..legs.len()).filter(followers);
        let all = all.map(|k| {
            let first = mechanism.ranges()[k][0];
            format!("kin_solve_chain{k}({target}, seed + {first}, {place}, postures);\n")
        });
        all.collect::<Vec<_>>()
    };
    let empty = "    for (int chain = 0; chain < KIN_CHAINS; ++chain) {\n        \
                 postures->counts[chain] = 0;\n    }\n";
    match aim {
        Aim::Pose => {
            out += empty;
            asks("0", "pose")
                .iter()
                .for_each(|ask| out += &format!("    {ask}"));
        }
        Aim::Translation => {
            let _ = write!(
                out,
                "    /* The platform does not turn: its rotation is that at home. */\n    \
                 double upright[12] = {};\n{empty}    \
                 for (int i = 3; i < 12; i += 4) {{\n        upright[i] = pose[i];\n    }}\n",
                numbers(rows(&mechanism.home()))
            );
            asks("0", "upright")
                .iter()
                .for_each(|ask| out += &format!("    {ask}"));
        }
        Aim::Lead(lead) => {
            let first = mechanism.ranges()[lead][0];
            let upper = format!("KIN_CHAIN{lead}");
            let _ = write!(
                out,
                "    /* The position fixes this chain, and it tells the others the pose. */\n    \
                 kin_chain{lead}_solution found[{upper}_MAX_SOLUTIONS];\n    \
                 const int count = kin_chain{lead}_ik_seeded(pose, seed + {first}, found);\n{empty}    \
                 for (int place = 0; place < count; ++place) {{\n        double target[12];\n        \
                 kin_add(postures, {lead}, place, found[place].q);\n        \
                 kin_chain{lead}_fk(found[place].q, target);\n"
            );
            asks("place", "target")
                .iter()
                .for_each(|ask| out += &format!("        {ask}"));
            out += "        kin_end_place(postures, place);\n    }\n";
        }
    }
    out + "    return kin_count(postures);\n}\n\n"
}

/// The function that adds all solutions of a chain.
fn solves(compiled: &CompiledMechanism, k: usize, leg: &LegForm) -> String {
    let chain = &compiled.mechanism.legs[k].name;
    let about = comment(&[format!("{chain}: {}", leg.plan())]);
    let heading = format!(
        "{about}static void kin_solve_chain{k}(\n    const double target[12], const double *seed, \
         int place, kin_postures *postures)\n{{\n"
    );
    match leg {
        LegForm::Whole(_) => format!(
            "{heading}    kin_chain{k}_solution found[KIN_CHAIN{k}_MAX_SOLUTIONS];\n    \
             const int count = kin_chain{k}_ik_seeded(target, seed, found);\n    \
             for (int i = 0; i < count; ++i) {{\n        \
             kin_add(postures, {k}, place, found[i].q);\n    }}\n}}\n\n"
        ),
        LegForm::Split(split) => {
            let [x, y, z] = split.point.map(signed);
            let n = split.head.model.joints.len();
            let all = n + split.tail.model.joints.len();
            format!(
                "{heading}    static const double point[3] = {{{x}, {y}, {z}}};\n    \
                 double wrist[12] = {{1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0}};\n    \
                 kin_chain{k}_head_solution heads[KIN_CHAIN{k}_HEAD_MAX_SOLUTIONS];\n    \
                 kin_chain{k}_tail_solution tails[KIN_CHAIN{k}_TAIL_MAX_SOLUTIONS];\n    \
                 int count;\n    \
                 for (int i = 0; i < 12; i += 4) {{\n        \
                 wrist[i + 3] = target[i] * point[0] + target[i + 1] * point[1]\n            \
                 + target[i + 2] * point[2] + target[i + 3];\n    }}\n    \
                 count = kin_chain{k}_head_ik_seeded(wrist, seed, heads);\n    \
                 for (int i = 0; i < count; ++i) {{\n        \
                 double turned[12], back[12], rest[12], q[{all}];\n        int more;\n        \
                 kin_chain{k}_head_fk(heads[i].q, turned);\n        kin_invert(turned, back);\n        \
                 kin_compose(back, target, rest);\n        \
                 more = kin_chain{k}_tail_ik_seeded(rest, seed + {n}, tails);\n        \
                 for (int j = 0; j < more; ++j) {{\n            \
                 for (int joint = 0; joint < {all}; ++joint) {{\n                \
                 q[joint] = joint < {n} ? heads[i].q[joint] : tails[j].q[joint - {n}];\n            \
                 }}\n            kin_add(postures, {k}, place, q);\n        }}\n    }}\n}}\n\n"
            )
        }
    }
}

/// The actuated values, by their numbers, as a list.
fn driven(numbers: &[usize]) -> String {
    let values = numbers.iter().map(|a| format!("actuated[{a}]"));
    values.collect::<Vec<_>>().join(", ")
}

/// Forward kinematics of a loop.
fn around(compiled: &CompiledMechanism, found: &crate::mechanism::Loop) -> String {
    let mut sets = String::new();
    for (a, joint) in compiled.mechanism.actuated().into_iter().enumerate() {
        let _ = writeln!(sets, "        assemblies[i].q[{joint}] = actuated[{a}];");
    }
    for (i, joint) in found.joints.iter().enumerate() {
        let _ = writeln!(sets, "        assemblies[i].q[{joint}] = found[i].q[{i}];");
    }
    let count = found.driven.len();
    format!(
        "\nint kin_fk(const double actuated[KIN_ACTUATED], \
         kin_assembly assemblies[KIN_ASSEMBLY_MODES])\n{{\n    \
         /* Where the actuated joints put the ends of the passive ones, and every way in which these\n     \
         * close the loop. */\n    const double drive[{count}] = {{{}}};\n    \
         kin_passive_solution found[KIN_PASSIVE_MAX_SOLUTIONS];\n    double placed[12];\n    \
         int count;\n    kin_drive_fk(drive, placed);\n    \
         count = kin_passive_ik(placed, found);\n    count = count < 0 ? 0 : count;\n    \
         for (int i = 0; i < count; ++i) {{\n{sets}        \
         assemblies[i].residual = kin_gap(assemblies[i].q);\n        \
         assemblies[i].branch = found[i].branch;\n        \
         assemblies[i].singular = found[i].singular;\n    }}\n    return count;\n}}\n",
        driven(&found.driven)
    )
}

/// Forward kinematics of a platform on three rods.
fn spheres(compiled: &CompiledMechanism, rods: &[Rod]) -> String {
    let mut asks = String::new();
    for (i, rod) in rods.iter().enumerate() {
        let [x, y, z] = rod.end.map(signed);
        let count = rod.driven.len();
        let _ = write!(
            asks,
            "    {{\n        const double drive[{count}] = {{{}}};\n        \
             static const double end[3] = {{{x}, {y}, {z}}};\n        \
             kin_rod{i}_fk(drive, from);\n        \
             for (int k = 0; k < 3; ++k) {{\n            \
             centres[{} + k] = from[4 * k + 3] - end[k];\n        }}\n    }}\n",
            driven(&rod.driven),
            3 * i
        );
    }
    let lengths: Vec<String> = rods.iter().map(|rod| signed(rod.length)).collect();
    let home = numbers(rows(&compiled.mechanism.home()));
    format!(
        "\n{}\n/* Keeps the solutions of chains in which the actuated joints have these values, to 1e-6,\n \
         * and of two that do, as next to where a chain is stretched, the nearer. */\n\
         static void kin_keep(kin_postures *postures, const double actuated[KIN_ACTUATED])\n{{\n    \
         for (int a = 0; a < KIN_ACTUATED; ++a) {{\n        \
         const int joint = kin_actuated[a];\n        int chain = 0;\n        \
         while (joint >= kin_chains[chain + 1]) {{\n            ++chain;\n        }}\n        \
         double apart[KIN_MOST], nearest = HUGE_VAL, most;\n        \
         for (int b = 0; b < postures->counts[chain]; ++b) {{\n            \
         const double off = postures->q[b][joint] - actuated[a];\n            \
         apart[b] = fabs(kin_turns[joint] ? kin_wrap(off) : off);\n            \
         nearest = apart[b] < nearest ? apart[b] : nearest;\n        }}\n        \
         /* Rounding parts those that have the same value. */\n        \
         most = -kin_max(-nearest - 1e-9, -1e-6);\n        \
         for (int b = 0; b < postures->counts[chain]; ++b) {{\n            \
         if (!(apart[b] < most)) {{\n                \
         postures->places[chain][b] = -1;\n            }}\n        }}\n    }}\n}}\n\n\
         int kin_fk(const double actuated[KIN_ACTUATED], \
         kin_assembly assemblies[KIN_ASSEMBLY_MODES])\n{{\n    \
         /* The platform's origin is as far as each rod is long from a point that an actuator places;\n     \
         * there each chain holds the platform as its actuated joint is set. */\n    \
         static const double home[12] = {home};\n    \
         static const double lengths[3] = {{{}}}, seed[KIN_JOINTS] = {{0.0}};\n    \
         double centres[9], points[6], from[12];\n    int met, count = 0;\n{asks}    \
         met = kin_three_spheres(centres, lengths, points);\n    \
         for (int branch = 0; branch < met; ++branch) {{\n        double target[12];\n        \
         kin_postures postures;\n        kin_assembly *const next = assemblies + count;\n        \
         for (int i = 0; i < 12; ++i) {{\n            \
         target[i] = i % 4 == 3 ? points[3 * branch + i / 4] : home[i];\n        }}\n        \
         kin_ik(target, &postures);\n        kin_keep(&postures, actuated);\n        \
         if (kin_choose_posture(&postures, seed, 0, next->q)) {{\n            \
         next->residual = kin_gap(next->q);\n            next->branch = branch;\n            \
         next->singular = met == 1;\n            ++count;\n        }}\n    }}\n    \
         return count;\n}}\n",
        runtime::SPHERES,
        lengths.join(", ")
    )
}
