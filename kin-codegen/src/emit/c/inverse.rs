//! Inverse kinematics as C functions.

use super::language::{numbers, signed};
use super::{lanes, runtime, univariate};
use crate::closed_form::{ClosedForm, Inverse, Refinement};
use crate::emit::curly::data::{counts, size};
use crate::emit::curly::indented;
use crate::expr::inverse::InverseGraph;
use crate::model::Model;
use crate::plan::Target;
use crate::redundancy::Redundancy;
use kin_runtime::__private::{Completion, Projection};
use kin_runtime::Swivel;
use std::fmt::Write as _;

/// The definitions that solve for joint values.
pub fn functions(model: &Model, solver: &ClosedForm, redundancy: Option<&Redundancy>) -> String {
    let solve = match &solver.inverse {
        Inverse::Expressions(inverse) => by_expressions(model, solver, inverse, redundancy),
        Inverse::Univariate(arm) => {
            vec![
                univariate::search(solver, arm),
                univariate::solve(solver, arm),
            ]
        }
    };
    let parts = [constants(solver), whole(model, solver)].into_iter();
    let parts = parts.chain(solve).chain([entry(redundancy, solver)]);
    let parts = parts.filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("\n")
}

/// The branches of a plan, and `kin_solve`.
fn by_expressions(
    model: &Model,
    solver: &ClosedForm,
    inverse: &InverseGraph,
    redundancy: Option<&Redundancy>,
) -> Vec<String> {
    let swivel = redundancy.and_then(|redundancy| redundancy.swivel);
    let correction = match swivel {
        Some(swivel) => [
            points(&swivel.at_run_time(model)),
            runtime::SWIVEL.to_owned(),
            runtime::SEEN.to_owned(),
            runtime::AT_SWIVEL.to_owned(),
            runtime::INSERT.to_owned(),
            runtime::SWIVELLED.to_owned(),
            runtime::ADD_CORRECTED.to_owned(),
        ]
        .join("\n"),
        None => {
            let (projection, corrected) = match solver.corrected_projection() {
                Some(it) => (
                    projection(&it),
                    runtime::CORRECTED.replace("kin_see_joints", "kin_see_projected"),
                ),
                None => (String::new(), runtime::CORRECTED.to_owned()),
            };
            [
                runtime::SEEN,
                &projection,
                runtime::INSERT,
                &corrected,
                runtime::ADD_CORRECTED,
            ]
            .join("\n")
        }
    };
    let (search, refined) = match &solver.refinement {
        Refinement::Univariate(arm) => univariate::refine(solver, arm),
        _ => (String::new(), String::new()),
    };
    vec![
        free_joints(inverse),
        lanes::function(solver, inverse),
        runtime::DISPATCH.to_owned(),
        branches(inverse),
        correction,
        search,
        solve(solver, &refined),
    ]
}

/// What the runtime's pieces take from the arm.
fn constants(solver: &ClosedForm) -> String {
    let (size, accept) = (size(solver), solver.acceptance());
    let all = [
        ("SOLVED", solver.given.variables().to_string()),
        ("SIZE", signed(size)),
        ("TOLERANCE", signed(accept.tolerance)),
        ("TAKEN", signed(accept.taken)),
        ("NEARLY", signed(accept.nearly)),
        ("NEAR_SINGULAR", signed(accept.near_singular)),
    ];
    let mut out = String::from(
        "/* The joints that are solved for; the arm's size, at whose distance angles count as \
         lengths,\n * and by how much solutions may miss the target, branches that are solutions as they are, and those \
         that are\n * corrected, metres; below which conditioning of the Jacobian branches do not tell solutions, of an \
         arm off its\n * design. */\n",
    );
    for (name, value) in all {
        let _ = writeln!(out, "#define KIN_{name} {value}");
    }
    let counts = counts(solver.plan.target)
        .map(|counts| i32::from(counts).to_string())
        .join(", ");
    out + &format!(
        "\nstatic const kin_metric kin_own_metric = {{\n    KIN_SIZE, KIN_TOLERANCE, {counts}}};\n"
    )
}

/// How projected targets see the tip.
fn projection(projection: &Projection) -> String {
    let Projection { counts, axis, home } = projection;
    let entries = |values: &[f64]| values.iter().map(|&x| signed(x)).collect::<Vec<_>>();
    let axis = entries(axis).join(", ");
    let rows = home.rotation.iter().zip(&home.translation);
    let rows = rows.map(|([x, y, z], shift)| entries(&[*x, *y, *z, *shift]).join(", "));
    let home = rows.collect::<Vec<_>>().join(",\n    ");
    format!(
        "/* The direction of the first axis, and the tip at home; whether the height along that axis is \
         not read. */\n\
         static const double kin_axis[3] = {{{axis}}};\n\
         static const double kin_home[12] = {{\n    {home}}};\n\
         #define KIN_PLANAR {}\n\n{}",
        i32::from(*counts == Target::Planar),
        runtime::PROJECTION
    )
}

/// The points by which a swivel angle is told.
fn points(swivel: &Swivel) -> String {
    let vectors = [
        ("shoulder", swivel.shoulder),
        ("elbow", swivel.elbow),
        ("wrist", swivel.wrist),
        ("reference", swivel.reference),
    ];
    let mut out = format!(
        "/* The shoulder and the reference direction in base coordinates; the elbow in those of \
         the link\n * that carries it, and the wrist in those of the tip. */\n\
         #define KIN_ELBOW_LINK {}\n",
        swivel.link
    );
    for (name, vector) in vectors {
        let [x, y, z] = vector.map(signed);
        let _ = writeln!(
            out,
            "static const double kin_{name}[3] = {{{x}, {y}, {z}}};"
        );
    }
    out
}

/// The values of all joints from those that are solved for and those that are given.
fn whole(model: &Model, solver: &ClosedForm) -> String {
    let given = &solver.given;
    let locked = &given.locked;
    let all = 0..model.variables.len();
    let solved: Vec<String> = all
        .filter(|i| !locked.contains(i))
        .map(|i| i.to_string())
        .collect();
    let mut body = String::new();
    for (k, joint) in locked.iter().enumerate() {
        let _ = match model.turns(*joint) {
            true => writeln!(body, "    q[{joint}] = kin_wrap(given[{k}]);"),
            false => writeln!(body, "    q[{joint}] = given[{k}];"),
        };
    }
    if locked.is_empty() {
        body += "    (void)given;\n";
    }
    format!(
        "/* The joints that are solved for. */\nstatic const int kin_solved[KIN_SOLVED] = {{{}}};\n\n\
         /* The values of all joints, from those that are solved for and those that are given. */\n\
         static void kin_whole(const double solved[KIN_SOLVED], const double *given, \
         double q[KIN_JOINTS])\n{{\n    for (int i = 0; i < KIN_SOLVED; ++i) {{\n        \
         q[kin_solved[i]] = solved[i];\n    }}\n{body}}}\n",
        solved.join(", ")
    )
}

/// The lanes, with joints that are free moved where their own values leave a later root none.
fn branches(inverse: &InverseGraph) -> String {
    let heading = "/* The seed with its joints turned; one without a seed takes no part in a choice. */\n\
                   static void kin_turn_seed(\n    const double from[KIN_SOLVED], double turn, \
                   double seed[KIN_SOLVED])\n{\n    for (int i = 0; i < KIN_SOLVED; ++i) {\n        \
                   seed[i] = (fabs(from[i]) < HUGE_VAL ? from[i] : 0.0) + turn;\n    }\n}\n\n\
                   /* The lanes, and whether joints that are free have moved in some of them. */\n\
                   static int kin_compute_branches(\n    const double target[12], \
                   const double from[KIN_SOLVED], const double *given, kin_lanes *lanes)\n{\n    \
                   double seed[KIN_SOLVED];\n    kin_turn_seed(from, 0.0, seed);\n    \
                   kin_compute_lanes(target, seed, given, 1e-22, lanes);\n";
    if inverse.free_joints.is_empty() {
        return format!("{heading}    return 0;\n}}\n");
    }
    format!(
        "{}\n{heading}    for (int i = 0; i < KIN_FREE; ++i) {{\n        \
         for (int k = 0; k < KIN_BRANCHES; ++k) {{\n            \
         if (lanes->no_root[i][k] > 0.0) {{\n                \
         kin_move_free_joints(target, seed, given, lanes, 0, -1, lanes);\n                \
         return 1;\n            }}\n        }}\n    }}\n    return 0;\n}}\n",
        runtime::MOVING
    )
}

/// The coordinates of the seed that joints have that may be free.
fn free_joints(inverse: &InverseGraph) -> String {
    let joints = inverse.free_joints.iter();
    let coordinates: Vec<String> = joints
        .clone()
        .map(|it| it.turn.coordinate.to_string())
        .collect();
    let slides: Vec<f64> = joints.map(|it| it.slide.unwrap_or(0.0)).collect();
    match coordinates.len() {
        0 => String::new(),
        count => format!(
            "/* The joints that singular targets leave free, where their values can leave a later \
             root none, and\n * how far slides go while an angle turns by one radian, 0 for angles. \
             */\n#define KIN_FREE {count}\n\
             static const int kin_free[KIN_FREE] = {{{}}};\n\
             static const double kin_free_slides[KIN_FREE] = {};\n",
            coordinates.join(", "),
            numbers(slides)
        ),
    }
}

/// The branches that reach their target, or what becomes of them by the statements `refined`: of all
/// of an arm off its design, and of an exact one where its branches are completed.
fn solve(solver: &ClosedForm, refined: &str) -> String {
    if !refined.is_empty() && !solver.is_exact() {
        return format!(
            "/* The branches, refined to the arm as given. */\n\
             static int kin_solve(\n    const double target[12], const double seed[KIN_SOLVED], \
             const double *given,\n    kin_solution *solutions)\n{{\n    kin_lanes lanes;\n    \
             kin_search search;\n    int count;\n    \
             kin_compute_branches(target, seed, given, &lanes);\n{refined}}}\n"
        );
    }
    let completed = |runs: &str, asks: &str| {
        format!(
            "    for (int k = 0; k < KIN_BRANCHES; ++k) {{\n        \
             incomplete |= {asks};\n    }}\n    \
             if ({runs}incomplete) {{\n        kin_search search;\n{}    }}\n",
            indented(refined)
        )
    };
    let [mut flag, mut degenerate, mut unanswered] = [const { String::new() }; 3];
    match solver.completion() {
        Completion::Never => {}
        Completion::Unanswered => {
            unanswered = completed("count == 0 && ", "lanes.residual[k] <= KIN_NEARLY");
        }
        Completion::Degenerate => degenerate = completed("", "kin_is_degenerate(&lanes, k)"),
    }
    if solver.completion() != Completion::Never {
        flag.push_str("    int incomplete = 0;\n");
    }
    let is_projected = solver.plan.target.is_projected();
    let corrected = match (is_projected, solver.is_exact()) {
        (true, true) => "",
        (true, false) => {
            "    if (nearly) {\n        double seen[12];\n        \
             kin_project_target(target, seen);\n        count = kin_add_corrected(&lanes, seen, seed, given, \
             solutions, count);\n    }\n"
        }
        (false, _) => {
            "    if (nearly) {\n        count = kin_add_corrected(&lanes, target, seed, given, \
             solutions, count);\n    }\n"
        }
    };
    let (mark, singular, marked) = match corrected {
        "" => ("", "", ""),
        _ => (
            "    int nearly = 0;\n",
            "            nearly |= solutions[count].singular;\n",
            " else if (lanes.invalid[k] <= 0.0 && lanes.residual[k] <= KIN_NEARLY) {\n            \
             nearly = 1;\n        }",
        ),
    };
    let reaching = format!(
        "for (int k = 0; k < KIN_BRANCHES; ++k) {{\n        \
         if (lanes.invalid[k] <= 0.0 && lanes.residual[k] <= KIN_TAKEN) {{\n            \
         double q[KIN_SOLVED];\n            \
         for (int i = 0; i < KIN_SOLVED; ++i) {{\n                q[i] = lanes.q[i][k];\n            }}\n            \
         kin_whole(q, given, solutions[count].q);\n            \
         solutions[count].residual = lanes.residual[k];\n            \
         solutions[count].branch = k;\n            \
         solutions[count].singular = lanes.singular[k] > 0.0;\n{singular}            ++count;\n        }}{marked}\n    }}\n{corrected}"
    );
    if solver.completion() == Completion::Never && solver.is_exact() {
        let unread = match corrected {
            "" => "    (void)target;\n    (void)seed;\n",
            _ => "",
        };
        // Of lanes that are another function's.
        let reaching = reaching
            .replace("lanes.", "lanes->")
            .replace("&lanes", "lanes");
        return format!(
            "/* The branches that reach their target, the others corrected. */\n\
             static int kin_reaching(\n    const kin_lanes *lanes, const double target[12], \
             const double seed[KIN_SOLVED],\n    const double *given, kin_solution *solutions)\n{{\n    \
             int count = 0;\n{mark}{unread}    {reaching}    return count;\n}}\n\n{}",
            runtime::LED_TO
        );
    }
    format!(
        "/* The branches that reach their target, the others corrected. */\n\
         static int kin_solve(\n    const double target[12], const double seed[KIN_SOLVED], \
         const double *given,\n    kin_solution *solutions)\n{{\n    kin_lanes lanes;\n    \
         int count = 0;\n{mark}{flag}    kin_compute_branches(target, seed, given, &lanes);\n\
         {degenerate}    {reaching}{unanswered}    \
         return count > 0 ? count : kin_why_none(&kin_own_metric, target);\n}}\n"
    )
}

/// The public functions.
fn entry(redundancy: Option<&Redundancy>, solver: &ClosedForm) -> String {
    let zeros = vec!["0.0"; solver.given.variables()].join(", ");
    // Of a polynomial all roots are found without a seed.
    let (seeds, seed) = match solver.inverse {
        Inverse::Expressions(_) => (
            format!("    static const double seed[KIN_SOLVED] = {{{zeros}}};\n"),
            "seed",
        ),
        Inverse::Univariate(_) => (String::new(), "0"),
    };
    let Some(redundancy) = redundancy else {
        return format!(
            "int kin_ik(const double pose[12], kin_solution solutions[KIN_MAX_SOLUTIONS])\n{{\n{seeds}    \
             return kin_solve(pose, {seed}, 0, solutions);\n}}\n\n\
             int kin_ik_seeded(\n    const double pose[12], const double seed[KIN_JOINTS],\n    \
             kin_solution solutions[KIN_MAX_SOLUTIONS])\n{{\n    \
             return kin_solve(pose, seed, 0, solutions);\n}}\n\n{}\n\
             int kin_ik_nearest(\n    const double pose[12], const double seed[KIN_JOINTS], \
             kin_solution *solution)\n{{\n    kin_solution solutions[KIN_MAX_SOLUTIONS];\n    \
             const int count = kin_solve(pose, seed, 0, solutions);\n    \
             return count > 0 ? kin_choose(solutions, count, seed, solution) : count;\n}}\n",
            runtime::NEAREST
        );
    };
    // The turn of the tool comes last.
    let count = redundancy.parameters() - usize::from(redundancy.turn);
    let turned = match redundancy.turn {
        true => format!(
            "    double sine, cosine, turned[12];\n    \
             kin_sin_cos(parameters[{count}], &sine, &cosine);\n    \
             for (int i = 0; i < 12; i += 4) {{\n        \
             turned[i] = pose[i] * cosine + pose[i + 1] * sine;\n        \
             turned[i + 1] = pose[i + 1] * cosine - pose[i] * sine;\n        \
             turned[i + 2] = pose[i + 2];\n        turned[i + 3] = pose[i + 3];\n    }}\n"
        ),
        false => String::new(),
    };
    let target = if redundancy.turn { "turned" } else { "pose" };
    let of_swivel = match redundancy.swivel {
        Some(_) => {
            "    double links[12 * KIN_JOINTS], tip[12], elbow[3], wrist[3];\n    \
             kin_fk_links(q, links);\n    kin_fk(q, tip);\n    \
             kin_point(links + 12 * KIN_ELBOW_LINK, kin_elbow, elbow);\n    \
             kin_point(tip, kin_wrist, wrist);\n    \
             parameters[0] = kin_swivel(elbow, wrist);\n"
        }
        None => "",
    };
    let joints = redundancy.joints.iter().enumerate();
    let of_joints: String = joints
        .map(|(i, joint)| format!("    parameters[{i}] = q[{joint}];\n"))
        .collect();
    let of_turn = match redundancy.turn {
        true => format!(
            "    double reached[12], sine = 0.0, cosine = 0.0;\n    kin_fk(q, reached);\n    \
             for (int i = 0; i < 12; i += 4) {{\n        \
             sine += pose[i + 1] * reached[i] - pose[i] * reached[i + 1];\n        \
             cosine += pose[i] * reached[i] + pose[i + 1] * reached[i + 1];\n    }}\n    \
             parameters[{count}] = kin_atan2(sine, cosine);\n"
        ),
        false => "    (void)pose;\n".into(),
    };
    let others = (0..solver.given.variables() + redundancy.joints.len())
        .filter(|joint| !redundancy.joints.contains(joint));
    let others: Vec<String> = others.map(|joint| format!("seed[{joint}]")).collect();
    let others = others.join(", ");
    let at = "\n    const double pose[12], const double parameters[KIN_PARAMETERS],\n    ";
    let solutions = "kin_solution solutions[KIN_MAX_SOLUTIONS])\n{\n";
    format!(
        "static int kin_solve_at({at}const double *seed, {solutions}{turned}    \
         for (int i = 0; i < KIN_PARAMETERS; ++i) {{\n        \
         if (!(fabs(parameters[i]) <= 1e15)) {{\n            return KIN_NOT_FINITE;\n        }}\n    }}\n    \
         return kin_solve({target}, seed, parameters, solutions);\n}}\n\n\
         int kin_ik_at({at}{solutions}{seeds}    \
         return kin_solve_at(pose, parameters, {seed}, solutions);\n}}\n\n\
         int kin_ik_seeded_at({at}const double seed[KIN_JOINTS], {solutions}    \
         const double solved[KIN_SOLVED] = {{{others}}};\n    \
         return kin_solve_at(pose, parameters, solved, solutions);\n}}\n\n{}\n\
         int kin_ik_nearest_at({at}const double seed[KIN_JOINTS], kin_solution *solution)\n{{\n    \
         kin_solution solutions[KIN_MAX_SOLUTIONS];\n    \
         const int count = kin_ik_seeded_at(pose, parameters, seed, solutions);\n    \
         return count > 0 ? kin_choose(solutions, count, seed, solution) : count;\n}}\n\n\
         void kin_redundancy(\n    const double pose[12], const double q[KIN_JOINTS], \
         double parameters[KIN_PARAMETERS])\n{{\n{of_swivel}{of_turn}{of_joints}}}\n",
        runtime::NEAREST
    )
}
