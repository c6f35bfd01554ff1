//! The header.

use super::name::named;
use super::text;
use crate::arm::CompiledArm;
use crate::closed_form::{ClosedForm, Inverse};
use crate::emit::curly::data::size;
use crate::emit::headings::{list, steps};
use crate::emit::postures::Postures;
use crate::emit::text::{degrees, number};
use crate::geometry::Coupling;
use crate::model::Model;
use crate::plan::Target;
use crate::redundancy::Redundancy;
use std::fmt::Write as _;

const CONVENTIONS: &str = include_str!("runtime/conventions.h");
const FORWARD: &str = include_str!("runtime/forward.h");
const FRAMES: &str = include_str!("runtime/frames.h");
const SOLUTION: &str = include_str!("runtime/solution.h");
const IK: &str = include_str!("runtime/ik.h");
const IK_OF_ROOTS: &str = include_str!("runtime/univariate/ik.h");
const IK_AT: &str = include_str!("runtime/ik_at.h");

/// What it declares beside functions.
const CONSTANTS: &str = "\
/* The joints' and their links' names, in the order of q; those of base and tip. In UTF-8. */
extern const char *const kin_joint_names[KIN_JOINTS];
extern const char *const kin_link_names[KIN_JOINTS];
extern const char *const kin_base;
extern const char *const kin_tip;
/* Whether joints turn, 1, or slide, 0; 0 too where others follow one so that a full turn of it
 * is another configuration. */
extern const int kin_turns[KIN_JOINTS];
/* Radians and metres, rad/s and m/s, N m and N; infinite where the robot file has none. */
extern const double kin_lower_limits[KIN_JOINTS];
extern const double kin_upper_limits[KIN_JOINTS];
extern const double kin_velocity_limits[KIN_JOINTS];
extern const double kin_effort_limits[KIN_JOINTS];
";

/// All of it, behind the comment at the top.
pub fn all(compiled: &CompiledArm, prefix: &str) -> String {
    let about = text::comment(&about(compiled));
    guarded(prefix, &about, CONVENTIONS, &of_arm(compiled, prefix))
}

/// Declarations as a header, with what holds of all of them in front.
pub fn guarded(prefix: &str, about: &str, conventions: &str, declarations: &str) -> String {
    let conventions = named(conventions, prefix);
    // Names that differ by case are two.
    let guard = format!("{prefix}_H");
    format!(
        "#ifndef {guard}\n#define {guard}\n\n{about}\n{conventions}\n#ifdef __cplusplus\n\
         extern \"C\" {{\n#endif\n\n{declarations}\n#ifdef __cplusplus\n}}\n#endif\n\n#endif\n"
    )
}

/// An arm's sizes, constants, types and functions.
pub fn of_arm(compiled: &CompiledArm, prefix: &str) -> String {
    let mut parts = vec![CONSTANTS, FORWARD];
    if !compiled.model.frames.is_empty() {
        parts.push(FRAMES);
    }
    if let Some(form) = compiled.form() {
        parts.push(SOLUTION);
        parts.push(match compiled.redundancy {
            Some(_) => IK_AT,
            None if form.expressions().is_none() => IK_OF_ROOTS,
            None => IK,
        });
    }
    let (sizes, parts) = (sizes(compiled), parts.join("\n"));
    named(&format!("{sizes}\n{parts}"), prefix)
}

/// An arm's sizes and types.
pub fn types(compiled: &CompiledArm) -> String {
    let solution = compiled.form().map_or("", |_| SOLUTION);
    format!("{}\n{solution}", sizes(compiled))
}

fn sizes(compiled: &CompiledArm) -> String {
    let model = &compiled.model;
    let mut sizes = format!("#define KIN_JOINTS {}\n", model.variables.len());
    if !model.frames.is_empty() {
        let _ = writeln!(sizes, "#define KIN_FRAMES {}", model.frames.len());
        sizes += "#define KIN_NO_SUCH_FRAME (-1)\n";
    }
    if let Some(form) = compiled.form() {
        let branches = form.plan.branches();
        let _ = writeln!(
            sizes,
            "/* How many branches inverse kinematics looks at. */"
        );
        let _ = writeln!(sizes, "#define KIN_BRANCHES {branches}");
        let _ = writeln!(sizes, "#define KIN_MAX_SOLUTIONS {}", form.most_solutions());
        if let Some(redundancy) = &compiled.redundancy {
            let _ = writeln!(
                sizes,
                "/* What inverse kinematics takes beside a target. */"
            );
            let _ = writeln!(sizes, "#define KIN_PARAMETERS {}", redundancy.parameters());
        }
    }
    sizes
}

/// What the robot is.
pub fn about(compiled: &CompiledArm) -> Vec<String> {
    let model = &compiled.model;
    let mut out = vec![
        format!(
            "The arm `{}` from `{}` to `{}`{}, compiled from `{}`.",
            model.name,
            model.base,
            model.tip,
            model.tool_text(),
            compiled.file
        ),
        String::new(),
    ];
    out.extend((0..model.variables.len()).map(|i| joint(model, i)));
    if let Some(form) = compiled.form() {
        out.extend(solved(compiled, form));
    }
    out
}

fn joint(model: &Model, i: usize) -> String {
    let variable = &model.variables[i];
    let turns = model.turns(i);
    let bound = |x: f64| match turns {
        true => format!("{} degrees", degrees(x)),
        false => format!("{} m", number(x, 4)),
    };
    let travel = match variable.limits {
        Some([lower, upper]) => format!("{} to {}", bound(lower), bound(upper)),
        None => "without limits".into(),
    };
    let kind = if turns { "turns" } else { "slides" };
    format!("q[{i}]: `{}`, {kind}, {travel}.", variable.name)
}

/// How inverse kinematics is solved, and what its branches are.
fn solved(compiled: &CompiledArm, form: &ClosedForm) -> Vec<String> {
    let redundancy = compiled.redundancy.as_ref();
    let target = compiled.target();
    let reads = match target {
        Target::Pose => "whole poses".to_owned(),
        _ => format!("{}; the rest of a pose is not read", target.phrase()),
    };
    let mut out = vec![
        String::new(),
        format!(
            "Inverse kinematics of {reads}. Solutions reach the target to {:.1e} m, angles \
             counted at the distance of {:.4} m.",
            form.acceptance().tolerance,
            size(form)
        ),
    ];
    out.extend(redundancy.map(|redundancy| parameters(&compiled.model, redundancy)));
    out.extend(form.linkage.coupling.iter().map(Coupling::sentence));
    match &form.inverse {
        Inverse::Expressions(inverse) => {
            let steps = steps(&form.plan, &form.linkage, &inverse.parts);
            out.extend((1..).zip(steps).map(|(i, step)| format!("{i}. {step}")));
        }
        Inverse::Univariate(_) => out.push(format!(
            "Solved by {}: a trigonometric polynomial in one joint, whose roots are isolated, and \
             Newton's method. The branch of a solution is its place.",
            form.plan
        )),
    }
    let Some(postures) = Postures::of(form) else {
        return out;
    };
    let columns = &postures.columns;
    out.push(String::new());
    out.extend((0..form.plan.branches() as u32).map(|branch| {
        let words = columns.iter().zip(postures.words(branch));
        let words: Vec<String> = words
            .map(|(column, word)| format!("{} {word}", column.name))
            .collect();
        format!("Branch {branch}: {}.", words.join(", "))
    }));
    out.extend(columns.iter().map(|column| column.meaning.clone()));
    out.retain(|line| line != " ");
    out
}

/// What the parameters are.
fn parameters(model: &Model, redundancy: &Redundancy) -> String {
    let joints = redundancy.joints.iter().map(|&joint| {
        let name = &model.variables[joint].name;
        format!("the value of q[{joint}] (`{name}`)")
    });
    let turn = redundancy.turn.then(|| {
        "the turn of the tool about the tip's z axis from where the target has it, radians"
            .to_owned()
    });
    let swivel = redundancy.swivel.map(|_| {
        "the swivel angle: how far the elbow is turned about the line from the shoulder to the \
         wrist, from where axis 1 points, radians"
            .to_owned()
    });
    format!("Parameters: {}.", list(joints.chain(swivel).chain(turn)))
}
