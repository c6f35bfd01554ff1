//! The rustdoc of a generated type: what it is, how to use it, its joints, its
//! plan, and what its branches are called. Lines of Markdown.

use super::redundant::given;
use crate::arm::CompiledArm;
use crate::closed_form::{ClosedForm, Inverse, Refinement};
use crate::emit::headings::{does, list, steps};
use crate::emit::postures::Postures;
use crate::emit::text::{code, degrees, number, one_line};
use crate::geometry::{Linkage, structure};
use crate::mechanism::{CompiledMechanism, Leg, LegForm};
use crate::model::{Model, Variable};
use crate::random::Random;
use crate::redundancy::Weighed;
use crate::scalar::Scalar;
use crate::solver::Certified;
use crate::spec::Diagnostic;
use crate::univariate::Arm;
use kin_runtime::__private::Completion;
use kin_runtime::Pose;
use proc_macro2::Ident;

/// Of an arm.
pub fn arm(compiled: &CompiledArm, name: &Ident, postures: Option<&Postures>) -> Vec<String> {
    let model = &compiled.model;
    let mut lines = vec![
        format!(
            "The arm {} from {} to {}, compiled from {}.",
            code(&model.name),
            code(&model.base),
            code(&model.tip),
            code(&compiled.file),
        ),
        String::new(),
        format!("Axes: {}.", structure(model)),
        String::new(),
        home(model),
    ];
    if model.scalar == Scalar::F32 {
        let solved = model.scalar.tolerances().solved * compiled.linkage.size;
        lines.extend([
            String::new(),
            format!(
                "Numbers are `f32`, types those of [`single`](::kinematics::single), and nothing is \
                 computed in `f64`. A solution misses its target by {solved:.0e} m at most."
            ),
        ]);
    }
    lines.extend(example(compiled, name));
    lines.extend(section("Joints"));
    lines.extend(joints(
        model
            .variables
            .iter()
            .enumerate()
            .map(|(i, variable)| (variable, !model.turns(i), String::new())),
    ));
    lines.extend(warnings(&model.warnings));
    lines.extend(section("Inverse kinematics"));
    match &compiled.inverse {
        None => lines.push("None: generated with `ik = none`.".into()),
        Some(certified) => {
            lines.extend(redundancy(compiled));
            lines.extend(inverse(certified, compiled.targets()));
            lines.extend(section("Branches"));
            lines.extend(branches(&certified.form, postures));
        }
    }
    lines
}

/// What is odd in the file.
fn warnings(warnings: &[Diagnostic]) -> Vec<String> {
    if warnings.is_empty() {
        return Vec::new();
    }
    let mut lines = section("Warnings about the file").to_vec();
    lines.extend(warnings.iter().map(|warning| {
        let at = warning
            .at
            .map_or_else(String::new, |at| format!("line {}: ", at.line));
        format!("- {at}{}", code(&warning.reason.replace('`', "'")))
    }));
    lines
}

/// Of a mechanism.
pub fn mechanism(compiled: &CompiledMechanism, name: &Ident) -> Vec<String> {
    let mechanism = &compiled.mechanism;
    let legs = &mechanism.legs;
    let chains: Vec<String> = legs
        .iter()
        .map(|leg| format!("{} ({})", code(&leg.name), leg.structure()))
        .collect();
    let mut lines = vec![
        format!(
            "The mechanism {} from {} to {}, compiled from {}.",
            code(&mechanism.name),
            code(&mechanism.base),
            code(&mechanism.platform),
            code(&compiled.file),
        ),
        String::new(),
        format!("Chains: {}.", chains.join(", ")),
        format!(
            "Mobility {} by rank, {} by Grübler's formula.",
            compiled.freedom.mobility, compiled.freedom.gruebler
        ),
        String::new(),
        placed(
            &mechanism.platform,
            None,
            &mechanism.base,
            &mechanism.home(),
        ),
    ];
    lines.extend(example_of_mechanism(compiled, name));
    let actuated = mechanism.actuated();
    lines.extend(section("Joints"));
    let all = legs.iter().flat_map(|leg| {
        let variables = leg.model.variables.iter().enumerate();
        variables.map(move |(i, variable)| (leg, i, variable))
    });
    lines.extend(joints(all.enumerate().map(
        |(joint, (leg, i, variable))| {
            let driven = if actuated.contains(&joint) {
                ", actuated"
            } else {
                ""
            };
            let of = format!(" of {}{driven}", code(&leg.name));
            (variable, !leg.model.turns(i), of)
        },
    )));
    lines.extend(section("Inverse kinematics"));
    match compiled.targets(code) {
        Some(targets) => {
            lines.push(format!("Targets are {targets}."));
            lines.push(String::new());
            let forms = compiled.inverse.iter().flat_map(|inverse| &inverse.legs);
            let plan =
                |(leg, form): (&Leg, &LegForm)| format!("- {}: {}", code(&leg.name), form.plan());
            lines.extend(legs.iter().zip(forms).map(plan));
        }
        None => lines.push("None: generated with `ik = none`.".into()),
    }
    lines.extend(section("Forward kinematics"));
    lines.push(sentence(&compiled.forward.method()));
    lines
}

fn section(title: &str) -> [String; 3] {
    [String::new(), format!("# {title}"), String::new()]
}

/// Text from elsewhere, as a sentence of Markdown.
fn sentence(text: &str) -> String {
    let mut text = one_line(text);
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    text + "."
}

fn home(model: &Model) -> String {
    placed(&model.tip, model.tool, &model.base, &model.home)
}

/// Where a link, or a tool that it carries, is with all joints at zero.
fn placed(link: &str, tool: Option<[f64; 6]>, base: &str, home: &Pose) -> String {
    let vector = |v: [f64; 3]| {
        let entries = v.map(|x| number(x, 4));
        format!("({})", entries.join(", "))
    };
    let axis = |j: usize| vector([0, 1, 2].map(|i| home.rotation[i][j]));
    let tool = tool.map_or_else(String::new, |[x, y, z, roll, pitch, yaw]| {
        let (origin, angles) = (vector([x, y, z]), vector([roll, pitch, yaw]));
        format!("a tool at {origin} m, with roll, pitch and yaw {angles} rad, in ")
    });
    format!(
        "Poses are of {tool}the frame of {} in that of {}. With all joints at zero its origin is at \
         {} m, its x axis along {} and its z axis along {}.",
        code(link),
        code(base),
        vector(home.translation),
        axis(0),
        axis(2),
    )
}

/// The joints in a table: each with whether it slides, and what else is to be
/// said of it.
fn joints<'a>(all: impl Iterator<Item = (&'a Variable, bool, String)>) -> Vec<String> {
    let row = |(i, (variable, slides, more)): (usize, (&Variable, bool, String))| {
        let bound = |x: f64| match (x.is_finite(), slides) {
            (false, _) => "none".into(),
            (_, true) => format!("{} m", number(x, 4)),
            (_, false) => format!("{}°", degrees(x)),
        };
        let kind = match (slides, variable.limits) {
            (true, _) => "prismatic",
            (_, Some(_)) => "revolute",
            (_, None) => "continuous",
        };
        let [from, to] = variable
            .limits
            .unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
            .map(bound);
        let name = code(&variable.name);
        format!("| q{} | {name}{more} | {kind} | {from} | {to} |", i + 1)
    };
    let head = [
        "| | joint | kind | lower | upper |",
        "|---|---|---|---|---|",
    ];
    let head = head.map(String::from).into_iter();
    head.chain(all.enumerate().map(row)).collect()
}

/// What stays free, and why that.
fn redundancy(compiled: &CompiledArm) -> Vec<String> {
    let Some(redundancy) = &compiled.redundancy else {
        return Vec::new();
    };
    let model = &compiled.model;
    let given = list(given(model, redundancy, "it"));
    let others = |weighed: &Weighed| {
        let joints = list(weighed.joints.iter().map(|joint| format!("q{}", joint + 1)));
        weighed.weight.map(|weight| format!("{joints}: {weight}"))
    };
    let weighed: Vec<String> = redundancy.weighed.iter().filter_map(others).collect();
    let why = match (redundancy.weighed.len(), &weighed[..]) {
        _ if redundancy.swivel.is_some() => " All branches exist at every value of it, if they \
                                             do at one. It is not defined where the wrist is on \
                                             axis 1 or on that of the upper arm."
            .into(),
        (0 | 1, _) => String::new(),
        (_, []) => " No joint makes the others a closed form; this one leaves the best polynomial \
                    of those at the ends of the chain."
            .into(),
        (_, all) => format!(
            " By what could be given, the operations of all branches of a plan for the others, residuals aside: {}.",
            all.join(", ")
        ),
    };
    vec![
        format!("`ik_at` is given beside a target {given}.{why}"),
        String::new(),
        "Where it is singular, and how it moves while the tip rests: the documentation of \
         `RedundantKinematics` tells the methods."
            .into(),
        String::new(),
    ]
}

fn inverse(certified: &Certified, targets: Option<String>) -> Vec<String> {
    let (solver, seen) = (&certified.form, &certified.certificate);
    let plan = &solver.plan;
    let mut lines = Vec::new();
    if let Some(targets) = targets {
        lines.extend([targets, String::new()]);
    }
    if let Some(coupling) = &solver.linkage.coupling {
        lines.extend([coupling.sentence(), String::new()]);
    }
    match &solver.inverse {
        Inverse::Expressions(inverse) => {
            let sentences = steps(plan, &solver.linkage, &inverse.parts);
            for (i, (step, sentence)) in plan.steps.iter().zip(sentences).enumerate() {
                lines.push(format!("{}. {sentence}{}", i + 1, does(step.subproblem)));
            }
        }
        Inverse::Univariate(arm) => lines.push(univariate(arm, &solver.given)),
    }
    if solver.linkage.has_free_turn {
        lines.push(String::new());
        lines.push(format!(
            "q{} is the turn about the tip's z axis that a target leaves free.",
            solver.linkage.links.len()
        ));
    }
    lines.push(String::new());
    lines.push(format!(
        "{} branches. Verified on {} configurations: {} recovered, {} solutions, the worst {:.1e} \
         m from its target.",
        plan.branches(),
        seen.configurations,
        match seen.lost {
            0 => "all".into(),
            lost => format!("all but {lost}"),
        },
        seen.solutions,
        seen.worst_residual,
    ));
    if seen.unanswered > 0 {
        lines.push(format!(
            "Of {} singular configurations, {} got no representative.",
            seen.singular + seen.excused,
            seen.unanswered
        ));
    }
    lines.extend(seen.reservations());
    if !solver.is_exact() {
        lines.push(String::new());
        lines.push(format!(
            "The file's axes are off exact relations by up to {:.1e} rad: the closed form runs on \
             an arm whose tip is within {:.1e} m, and every branch is refined onto the file's own.",
            solver
                .idealized
                .moved
                .iter()
                .map(|moved| moved.angle)
                .fold(0.0, f64::max),
            solver.tip_shift,
        ));
    }
    if let Refinement::Univariate(arm) = &solver.refinement {
        let where_ = match solver.completion() {
            Completion::Never => {
                "Near singular configurations, where branches do not tell all solutions"
            }
            Completion::Unanswered => "Where no branch reaches a target and one nearly does",
            Completion::Degenerate => {
                "Where a step degenerates and branches do not tell all solutions"
            }
        };
        lines.push(format!(
            "{where_}, the roots of a polynomial of degree {} in {} do; what they add is numbered from {} on.",
            arm.kept[0].elimination.degree,
            arm.kept_beside(&solver.given),
            solver.plan.branches(),
        ));
    }
    lines
}

/// Which joint is kept, and how well that does.
fn univariate(arm: &Arm, linkage: &Linkage) -> String {
    let mut kept = arm.kept.iter().map(|kept| arm.kept_name(kept, linkage));
    let joint = kept.next().unwrap_or_default();
    let degree = arm.kept.first().map_or(0, |kept| kept.elimination.degree);
    let others: Vec<String> = kept.collect();
    let others = match others.is_empty() {
        true => String::new(),
        false => format!(
            "; where that is not sure to tell all solutions, {} is kept",
            others.join(", then ")
        ),
    };
    format!(
        "No sequence of subproblems solves the chain. All joints but {joint} are eliminated, \
         which leaves a trigonometric polynomial of degree {degree} in it{others}."
    )
}

/// The number of every branch, with the words for its postures.
fn branches(solver: &ClosedForm, postures: Option<&Postures>) -> Vec<String> {
    let Some(postures) = postures else {
        return vec!["A solution's number is its place in the answer.".into()];
    };
    if postures.columns.is_empty() {
        return vec!["There is one: a target has at most one solution.".into()];
    }
    let columns = &postures.columns;
    let heads: Vec<String> = columns
        .iter()
        .map(|column| format!("{} ({})", column.name, column.told_by()))
        .collect();
    let row = |branch: u32| {
        let words: Vec<&str> = postures.words(branch).collect();
        format!("| {branch} | {} |", words.join(" | "))
    };
    let mut lines = vec![
        "`Solution::branch` is the number of the solution's posture, as in `POSTURES`:".into(),
        String::new(),
        format!("| branch | {} |", heads.join(" | ")),
        format!("|---|{}", "---|".repeat(columns.len())),
    ];
    lines.extend((0..solver.plan.branches() as u32).map(row));
    lines.push(String::new());
    lines.extend(
        columns
            .iter()
            .map(|column| format!("- {}", sentence(&column.meaning))),
    );
    lines
}

/// Targets looked at for the example.
const EXAMPLES: usize = 32;

/// From joint values to a pose and back. The path of the type is the user's, so
/// it is no test of the user's crate.
fn example(compiled: &CompiledArm, name: &Ident) -> Vec<String> {
    let (q, solutions) = instance(compiled);
    let values: Vec<String> = q.iter().map(|x| format!("{x:?}")).collect();
    let slides = (0..q.len()).any(|i| !compiled.model.turns(i));
    let turns = (0..q.len()).any(|i| compiled.model.turns(i));
    let units = match (turns, slides) {
        (true, false) => "radians",
        (false, true) => "metres",
        _ => "radians and metres",
    };
    let mut lines: Vec<String> = section("Example").into();
    lines.push("```ignore".into());
    lines.push(format!("let q = [{}]; // {units}", values.join(", ")));
    lines.push(format!("let pose = {name}.fk(&q);"));
    let asks = match &compiled.redundancy {
        None => format!("let solutions = {name}.ik(&pose);"),
        Some(redundancy) => {
            let pose = if redundancy.turn { "&pose, " } else { "" };
            let by = if redundancy.parameters() == 1 {
                ""
            } else {
                "&"
            };
            lines.push(format!("let parameter = {name}.redundancy({pose}&q);"));
            format!("let solutions = {name}.ik_at(&pose, {by}parameter);")
        }
    };
    match solutions {
        None => lines.push("println!(\"{:?} m\", pose.translation);".into()),
        Some(count) => lines.extend([
            asks,
            format!("assert_eq!(solutions.len(), {count});"),
            match compiled.redundancy {
                None => format!("let nearest = {name}.ik_nearest(&pose, &q).unwrap();"),
                Some(_) => {
                    format!("let nearest = solutions.nearest(&q, &{name}::LIMITS).unwrap();")
                }
            },
            format!(
                "assert!((0..{}).all(|i| (nearest.q[i] - q[i]).abs() < {:e}));",
                q.len(),
                10.0 * compiled.model.scalar.tolerances().same,
            ),
        ]),
    }
    lines.push("```".into());
    lines
}

/// From a configuration to the platform's pose and back.
fn example_of_mechanism(compiled: &CompiledMechanism, name: &Ident) -> Vec<String> {
    let n = compiled.mechanism.joints();
    let mut lines: Vec<String> = section("Example").into();
    lines.push("```ignore".into());
    lines.push(format!("let home = [0.0; {n}]; // closes the loops"));
    if compiled.inverse.is_some() {
        lines.push(format!("let pose = {name}.platform(&home);"));
        lines.push(format!("let postures = {name}.ik(&pose);"));
        lines.push(format!(
            "let q = postures.nearest(&home, &{name}::LIMITS).unwrap();"
        ));
        lines.push(format!("assert!({name}.gap(&q) < 1e-9); // metres"));
    }
    lines.push(format!("let driven = {name}.actuated(&home);"));
    lines.push(format!(
        "let assembly = {name}.fk_near(&driven, &home).unwrap();"
    ));
    lines.push("assert!(assembly.residual < 1e-9); // metres".into());
    lines.push("```".into());
    lines
}

/// Joint values of two digits inside of the limits, and how many solutions
/// their pose has, themselves among them; none without inverse kinematics, and
/// where no values were found that are regular.
fn instance(compiled: &CompiledArm) -> (Vec<f64>, Option<usize>) {
    let model = &compiled.model;
    let mut random = Random(0xbb67_ae85_84ca_a73b);
    let mut draw = || -> Vec<f64> {
        let variables = model.variables.iter().enumerate();
        variables
            .map(|(i, variable)| within(variable, model.turns(i), &mut random))
            .collect()
    };
    let first = draw();
    let Some(form) = compiled.form() else {
        return (first, None);
    };
    let chain = model.chain();
    let found = std::iter::once(first.clone())
        .chain(std::iter::repeat_with(draw).take(EXAMPLES))
        .find_map(|q| {
            let (parameters, solved) = form.split(&q);
            let solutions = form.solutions_at(&chain.fk(&model.joint_values(&q)), &parameters);
            let near = |a: &[f64]| a.iter().zip(&solved).all(|(a, b)| (a - b).abs() < 1e-8);
            let regular = solutions.iter().all(|solution| !solution.singular);
            let back = solutions.iter().any(|solution| near(&solution.q));
            (regular && back).then_some((q, Some(solutions.len())))
        });
    found.unwrap_or((first, None))
}

/// A value of two digits inside of the limits, and of a joint that turns inside
/// of half a turn each way.
fn within(variable: &Variable, turns: bool, random: &mut Random) -> f64 {
    let [lower, upper] = variable.limits.unwrap_or([-1.5, 1.5]);
    let (lower, upper) = match turns {
        true => (lower.max(-1.5), upper.min(1.5)),
        false => (lower.max(-1.0), upper.min(1.0)),
    };
    let (lower, upper) = if lower < upper {
        (lower, upper)
    } else {
        (-0.5, 0.5)
    };
    let x = random.between(lower, upper);
    ((100.0 * x).round() / 100.0).clamp(lower, upper) + 0.0
}
