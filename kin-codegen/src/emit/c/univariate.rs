//! Inverse kinematics by a polynomial in one joint: the arm's numbers, in front of what is the
//! same for every arm.

use super::language::{numbers, signed};
use super::{runtime, tables};
use crate::closed_form::ClosedForm;
use crate::emit::curly::data::{is_whole, nonzero_functionals, rows, twist};
use crate::geometry::Carried;
use crate::univariate::Arm;
use kin_runtime::__private::univariate::{Between, Elimination};
use std::fmt::Write as _;

/// The definitions that search for the solutions of a target.
pub fn search(solver: &ClosedForm, arm: &Arm) -> String {
    let undo = (!solver.given.locked.is_empty()).then_some(runtime::UNDO);
    let between = Carried::new(&solver.given).between();
    let functionals = match arm.kept.iter().any(|kept| kept.elimination.moved) {
        true => runtime::MOVED_FUNCTIONALS,
        false => runtime::FUNCTIONALS,
    };
    let parts = [
        runtime::ELIMINATION.to_owned(),
        constants(arm),
        undo.unwrap_or_default().to_owned(),
        frames(&arm.between, between.start),
        runtime::LINE.to_owned(),
        runtime::OWN_FUNCTIONALS.to_owned(),
        functionals.to_owned(),
        runtime::SEARCH.join("\n"),
    ];
    let parts = parts.into_iter().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("\n")
}

/// The call that makes solutions of what was found.
const TO_SOLUTIONS: &str = "kin_to_solutions(target, &search.found, given, solutions)";

/// What makes solutions of what was found.
fn from_found(solver: &ClosedForm, arm: &Arm) -> &'static str {
    match is_whole(solver, arm) {
        true => runtime::WHOLE,
        false => runtime::SHORT,
    }
}

/// From branches of an idealized arm to solutions of this one, behind its branches and
/// [`runtime::INSERT`]: what it is, and the statements that do it.
pub fn refine(solver: &ClosedForm, arm: &Arm) -> (String, String) {
    let (carry, carrying, target) = carry(solver);
    let found = from_found(solver, arm);
    let parts = [
        &search(solver, arm),
        runtime::ARRIVE,
        found,
        runtime::REFINE,
        &carry,
    ];
    let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    let refined = format!(
        "{carrying}    kin_refine({target}, seed, given, &lanes, &search);\n    count = {};\n    \
         return count > 0 ? count : kin_why_none(&kin_own_metric, target);\n",
        TO_SOLUTIONS
    );
    (parts.join("\n"), refined)
}

/// From what is found to solutions, and `kin_solve`; behind [`search`].
pub fn solve(solver: &ClosedForm, arm: &Arm) -> String {
    let (carry, carrying, target) = carry(solver);
    let parts = [
        runtime::SEEN,
        runtime::INSERT,
        runtime::ARRIVE,
        from_found(solver, arm),
        runtime::SOLVE,
    ];
    let solve = format!(
        "/* The solutions of a target. Of a polynomial's roots the branch is the place. */\n\
         static int kin_solve(\n    const double target[12], const double *seed, \
         const double *given,\n    kin_solution *solutions)\n{{\n    kin_search search;\n    \
         int count;\n{carrying}    kin_search_target({target}, seed, given, &search);\n    \
         count = {TO_SOLUTIONS};\n    \
         for (int i = 0; i < count; ++i) {{\n        solutions[i].branch = i;\n    }}\n    \
         return count > 0 ? count : kin_why_none(&kin_own_metric, target);\n}}\n"
    );
    let parts = parts.into_iter().map(str::to_owned);
    let parts = parts.chain([carry, solve]);
    let parts: Vec<String> = parts.filter(|part| !part.is_empty()).collect();
    parts.join("\n")
}

/// The numbers of an arm.
fn constants(arm: &Arm) -> String {
    let degrees = arm.kept.iter().map(|kept| kept.elimination.degree);
    let is_high = degrees.max() > Some(8);
    let most = if is_high { 12 } else { 8 };
    let fixed = arm.frames.fixed.iter().map(|it| numbers(rows(it)));
    let slides = (0..6).map(|joint| i32::from(arm.frames.slides(joint)).to_string());
    let eliminations = arm.kept.iter().map(|kept| elimination(&kept.elimination));
    let mut out = format!(
        "/* The highest degree of a polynomial. */\n#define KIN_DEGREE {most}\n{}",
        tables::all(is_high)
    );
    let _ = writeln!(
        out,
        "\n/* The arm's size as given, metres, and its six joints, some of which may stand behind \
         its tip and\n * stay at zero: the constant motions between them, lengths in units of half \
         that size, and which\n * slide. */\n#define KIN_ARM_SIZE {}\n\
         static const double kin_fixed[7][12] = {{\n    {}}};\n\
         static const int kin_slides[6] = {{{}}};\n\n\
         /* Those that are asked, the best first. */\n#define KIN_ELIMINATIONS {}\n\
         static const kin_elimination kin_eliminations[KIN_ELIMINATIONS] = {{\n    {}}};",
        signed(arm.size),
        fixed.collect::<Vec<_>>().join(",\n    "),
        slides.collect::<Vec<_>>().join(", "),
        arm.kept.len(),
        eliminations.collect::<Vec<_>>().join(",\n    "),
    );
    out
}

/// The function that writes the constant motions, moved by the joints that are given between
/// those that are solved for: of all that are given, those from the `first` on.
fn frames(between: &[Between], first: usize) -> String {
    let (mut given, mut moved) = ("    (void)given;\n".to_owned(), String::new());
    if !between.is_empty() {
        let value = match first {
            0 => "given[i]".to_owned(),
            first => format!("given[{first} + i]"),
        };
        let count = between.len();
        let twists: Vec<String> = between.iter().map(|it| numbers(twist(&it.twist))).collect();
        let behind: Vec<u8> = between.iter().map(|it| it.behind).collect();
        given = format!(
            "    static const double twists[{count}][6] = {{\n        {}}};\n    \
             static const int behind[{count}] = {};\n    double motion[12], moved[12];\n",
            twists.join(",\n        "),
            integers(&behind)
        );
        moved = format!(
            "    for (int i = {}; i >= 0; --i) {{\n        \
             kin_undo(twists[i], -{value}, motion);\n        \
             kin_compose(motion, fixed[behind[i]], moved);\n        \
             for (int k = 0; k < 12; ++k) {{\n            fixed[behind[i]][k] = moved[k];\n        \
             }}\n    }}\n",
            count - 1
        );
    }
    format!(
        "/* The constant motions, with the joints that are given between those that are solved for \
         at their\n * values. */\nstatic void kin_fix_frames(const double *given, double \
         fixed[7][12])\n{{\n{given}    for (int i = 0; i < 7; ++i) {{\n        \
         for (int k = 0; k < 12; ++k) {{\n            fixed[i][k] = kin_fixed[i][k];\n        }}\n    \
         }}\n{moved}}}\n"
    )
}

fn integers(values: &[u8]) -> String {
    let values: Vec<String> = values.iter().map(u8::to_string).collect();
    format!("{{{}}}", values.join(", "))
}

fn elimination(elimination: &Elimination) -> String {
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
    let count = nonzero_functionals(elimination).len();
    let rows: Vec<String> = rows.iter().map(|row| integers(row)).collect();
    let vectors = |all: &[[f64; 15]]| {
        let all: Vec<String> = all.iter().map(|row| numbers(*row)).collect();
        format!("{{\n        {}}}", all.join(",\n        "))
    };
    format!(
        "{{{}, {}, {degree}, {}, {count}, {half}, {},\n    {},\n    {}, {}, {},\n    {{{}}},\n    {}}}",
        integers(joints),
        i32::from(*backwards),
        i32::from(*moved),
        vectors(functionals),
        vectors(third),
        i32::from(fold.is_some()),
        signed(fold.unwrap_or(0.0)),
        integers(powers),
        rows.join(", "),
        integers(columns),
    )
}

/// The function that moves a target by the joints that are given at the ends of the arm, its call,
/// and what the target is behind that.
fn carry(solver: &ClosedForm) -> (String, &'static str, &'static str) {
    let carried = Carried::new(&solver.given);
    if carried.between().len() == solver.given.locked.len() {
        return (String::new(), "", "target");
    }
    let call = "    double carried[12];\n    kin_carry(target, given, carried);\n";
    (carrying(&carried), call, "carried")
}

fn carrying(carried: &Carried) -> String {
    let Carried { front, behind, .. } = carried;
    let twists = front.iter().chain(behind);
    let twists: Vec<String> = twists.map(|it| numbers(twist(it))).collect();
    let count = twists.len();
    let value = match carried.between() {
        none if none.is_empty() => "given[i]".to_owned(),
        between => format!("given[i < {} ? i : i + {}]", front.len(), between.len()),
    };
    format!(
        "/* The target of the joints that are solved for: those that are given stand at the \
         ends, and their\n * motions are known, the first ones seen from the base, the others from \
         the tip. */\nstatic void kin_carry(const double target[12], const double *given, \
         double carried[12])\n{{\n    static const double twists[{count}][6] = {{\n        {}}};\n    \
         double motion[12], moved[12];\n    for (int i = 0; i < 12; ++i) {{\n        \
         carried[i] = target[i];\n    }}\n    for (int n = 0; n < {count}; ++n) {{\n        \
         const int i = n < {first} ? n : {first} + {count} - 1 - n;\n        \
         kin_undo(twists[i], {value}, motion);\n        \
         if (n < {first}) {{\n            kin_compose(motion, carried, moved);\n        \
         }} else {{\n            kin_compose(carried, motion, moved);\n        }}\n        \
         for (int k = 0; k < 12; ++k) {{\n            carried[k] = moved[k];\n        }}\n    }}\n}}\n",
        twists.join(",\n        "),
        first = front.len(),
    )
}
