//! The closed form of an arm.

use super::language::{JavaScript, array, numbers, object, signed};
use super::text::string;
use super::univariate;
use crate::arm::CompiledArm;
use crate::closed_form::{ClosedForm, Inverse};
use crate::emit::curly::data::{counts, rows, size};
use crate::emit::curly::indented;
use crate::emit::curly::lanes::body;
use crate::emit::postures::Postures;
use crate::expr::inverse::InverseGraph;
use crate::plan::Target;
use kin_runtime::__private::Projection;
use kin_runtime::{Solutions, Swivel};

/// The object that says how the arm is solved.
pub fn form(compiled: &CompiledArm, solver: &ClosedForm) -> String {
    let inverse = solver.expressions();
    let search = solver.elimination();
    let model = &compiled.model;
    let redundancy = compiled.redundancy.as_ref();
    let accept = solver.acceptance();
    let locked = solver.given.locked.clone();
    let solved = (0..model.variables.len()).filter(|i| !locked.contains(i));
    let places = |places: Vec<usize>| array(places.iter().map(usize::to_string));
    let swivel = redundancy.and_then(|it| it.swivel);
    let free_joints = inverse.iter().flat_map(|it| &it.free_joints);
    let free_joints = free_joints.map(|it| {
        let slide = it.slide.map_or_else(|| "null".into(), signed);
        format!("{{ coordinate: {}, slide: {slide} }}", it.turn.coordinate)
    });
    let most = match search {
        Some(_) => Solutions::<6>::CAPACITY,
        None => solver.plan.branches(),
    };
    let solve = match (&solver.inverse, search) {
        (Inverse::Univariate(_), _) => "$solve_by_roots",
        (Inverse::Expressions(_), Some(_)) => "$solve_refining",
        (Inverse::Expressions(_), None) => "$solve",
    };
    let none = || "null".to_owned();
    let mut fields = vec![
        ("plan", string(&solver.plan.to_string())),
        ("target", string(compiled.target().phrase())),
        ("branches", solver.plan.branches().to_string()),
        ("most", most.to_string()),
        ("postures", postures(solver)),
        ("parameters", parameters(compiled)),
        ("solved", places(solved.collect())),
        ("locked", places(locked)),
        (
            "turns_tool",
            redundancy.is_some_and(|it| it.turn).to_string(),
        ),
        (
            "swivel",
            swivel.map_or_else(none, |it| points(&it.at_run_time(model))),
        ),
        ("size", signed(size(solver))),
        ("tolerance", signed(accept.tolerance)),
        ("taken", signed(accept.taken)),
        ("nearly", signed(accept.nearly)),
        ("free_joints", array(free_joints)),
    ];
    let counted = ["counts_translation", "counts_rotation", "counts_axis"];
    let counts = counts(solver.plan.target).map(|counts| counts.to_string());
    fields.extend(counted.into_iter().zip(counts));
    let is_projected = solver.plan.target.is_projected();
    let corrects = !(is_projected && solver.is_exact());
    let projection = is_projected.then(|| solver.projection());
    fields.extend([
        ("corrects", corrects.to_string()),
        (
            "projection",
            projection.map_or_else(none, |it| projected(&it)),
        ),
    ]);
    fields.push(("solve", solve.into()));
    fields.push((
        "search",
        search.map_or_else(none, |arm| univariate::search(solver, arm)),
    ));
    fields.push((
        "lanes",
        inverse.map_or_else(none, |inverse| lanes(solver, inverse)),
    ));
    object(&fields)
}

/// The function that computes all branches: lane k is the branch whose i-th choice is + where bit
/// i of k is clear.
fn lanes(solver: &ClosedForm, inverse: &InverseGraph) -> String {
    let found = body::<JavaScript>(solver, inverse);
    let width = found.width;
    let array = format!("new Float64Array({width})");
    let all = |count: usize| format!("Array.from({{ length: {count} }}, () => {array})");
    let (q, free) = (all(solver.given.variables()), all(found.free_joints));
    let room = format!(
        "const lanes = {{\n    q: {q},\n    residual: {array}, invalid: {array}, \
         singular: {array},\n    level: {free}, no_root: {free},\n}};\n"
    );
    let body = indented(&format!("{room}{}return lanes;\n", found.statements));
    format!("(target, seed, given, free_below) => {{\n{body}}}")
}

/// What every branch is called, and what the words mean.
fn postures(solver: &ClosedForm) -> String {
    let Some(postures) = Postures::of(solver) else {
        return "[]".into();
    };
    let column = |column: &crate::emit::postures::Posture| {
        let words = (0..solver.plan.branches() as u32).map(|branch| string(column.word(branch)));
        object(&[
            ("name", string(&column.name)),
            ("words", array(words)),
            ("meaning", string(column.meaning.trim())),
        ])
    };
    array(postures.columns.iter().map(column))
}

/// What is given beside a target: names, whether they are angles, and where they can be.
fn parameters(compiled: &CompiledArm) -> String {
    let Some(redundancy) = &compiled.redundancy else {
        return "[]".into();
    };
    let model = &compiled.model;
    let parameter = |name: &str, turns: bool, joint: Option<usize>| {
        let joint = joint.map_or("null".into(), |joint| joint.to_string());
        object(&[
            ("name", string(name)),
            ("turns", turns.to_string()),
            ("joint", joint),
        ])
    };
    let joints = redundancy.joints.iter().map(|&joint| {
        let name = &model.variables[joint].name;
        parameter(name, model.turns(joint), Some(joint))
    });
    let swivel = redundancy
        .swivel
        .map(|_| parameter("swivel angle", true, None));
    let turn = redundancy
        .turn
        .then(|| parameter("turn of the tool", true, None));
    array(joints.chain(swivel).chain(turn))
}

/// The points by which a swivel angle is told: shoulder and reference direction in base
/// coordinates, the elbow in those of the link that carries it, the wrist in those of the tip.
fn points(swivel: &Swivel) -> String {
    object(&[
        ("link", swivel.link.to_string()),
        ("shoulder", numbers(swivel.shoulder)),
        ("elbow", numbers(swivel.elbow)),
        ("wrist", numbers(swivel.wrist)),
        ("reference", numbers(swivel.reference)),
    ])
}

/// How projected targets see the tip.
fn projected(projection: &Projection) -> String {
    let Projection { counts, axis, home } = projection;
    let fields = object(&[
        ("axis", numbers(*axis)),
        ("home", numbers(rows(home))),
        ("planar", (*counts == Target::Planar).to_string()),
    ]);
    format!("$projection({fields})")
}
