//! Inverse kinematics by a polynomial in one joint: the arm's numbers, for what is the same for every
//! arm.

use super::language::{array, numbers, object, signed};
use crate::closed_form::ClosedForm;
use crate::emit::curly::data::{PARTS, is_whole, nonzero_functionals, rows, twist};
use crate::geometry::Carried;
use crate::univariate::Arm;
use kin_runtime::__private::Completion;
use kin_runtime::__private::univariate::{
    Between, Elimination, coefficients_on_arc, cosine_of_turn,
};
use kin_runtime::Twist;

/// The object that says what is searched.
pub fn search(solver: &ClosedForm, arm: &Arm) -> String {
    let Carried { front, behind, .. } = &Carried::new(&solver.given);
    let completion = match solver.completion() {
        Completion::Never => "never",
        Completion::Unanswered => "unanswered",
        Completion::Degenerate => "degenerate",
    };
    let twists = |twists: &[Twist]| array(twists.iter().map(|it| numbers(twist(it))));
    object(&[
        ("size", signed(arm.size)),
        (
            "fixed",
            lines(arm.frames.fixed.iter().map(|it| numbers(rows(it)))),
        ),
        (
            "slides",
            array((0..6).map(|joint| arm.frames.slides(joint).to_string())),
        ),
        ("is_whole", is_whole(solver, arm).to_string()),
        ("completion", format!("{completion:?}")),
        ("near_singular", signed(solver.acceptance().near_singular)),
        ("front", twists(front)),
        ("between", array(arm.between.iter().map(between))),
        ("behind", twists(behind)),
        (
            "eliminations",
            array(arm.kept.iter().map(|kept| elimination(&kept.elimination))),
        ),
    ])
}

/// A joint that is given between those that are solved for.
fn between(joint: &Between) -> String {
    object(&[
        ("behind", joint.behind.to_string()),
        ("twist", numbers(twist(&joint.twist))),
    ])
}

fn elimination(elimination: &Elimination) -> String {
    let Elimination {
        joints,
        backwards,
        degree,
        moved,
        functionals: _,
        half,
        third,
        fold,
        powers,
        rows,
        columns,
    } = elimination;
    let vectors = |all: &[[f64; 15]]| lines(all.iter().map(|row| numbers(*row)));
    object(&[
        ("joints", integers(joints)),
        ("backwards", backwards.to_string()),
        ("degree", degree.to_string()),
        ("moved", moved.to_string()),
        ("half", half.to_string()),
        ("functionals", vectors(nonzero_functionals(elimination))),
        ("third", vectors(third)),
        ("fold", fold.map_or_else(|| "null".into(), signed)),
        ("powers", integers(powers)),
        ("rows", array(rows.iter().map(|row| integers(row)))),
        ("columns", integers(columns)),
    ])
}

fn integers(values: &[u8]) -> String {
    array(values.iter().map(u8::to_string))
}

/// An array, each item on a line of its own.
fn lines(items: impl IntoIterator<Item = String>) -> String {
    let items: String = items
        .into_iter()
        .map(|item| format!("    {item},\n"))
        .collect();
    format!("[\n{items}]")
}

/// Tables of numbers that Rust computes as constants; those of degrees above 8 where code has any.
pub fn tables(code: &str) -> String {
    let cosines: Vec<f64> = (0..PARTS).map(|i| cosine_of_turn(i, PARTS)).collect();
    let cosines = cosines.chunks(4).map(|line| {
        let line: Vec<String> = line.iter().copied().map(signed).collect();
        format!("    {},\n", line.join(", "))
    });
    let is_high = (9..=12).any(|degree| code.contains(&format!("degree: {degree},")));
    let degrees = [Some(8), is_high.then_some(12)];
    let bases = degrees.into_iter().flatten().map(basis);
    format!(
        "/* Cosines of parts of a turn. */\nconst $cosines = [\n{}];\n\n\
         /* By degree, the coefficients of cos k a and of sin k a in Bernstein's basis on an arc about\n \
         * a = 0: by place, one half of all, and k. */\nconst $bernstein = {{\n{}}};\n",
        cosines.collect::<String>(),
        bases.collect::<String>()
    )
}

fn basis(degree: usize) -> String {
    let places = (0..=degree).map(|i| {
        let each = (0..=degree).map(|k| numbers(coefficients_on_arc(degree > 8, i, k)));
        format!("        {},\n", array(each))
    });
    format!("    {degree}: [\n{}    ],\n", places.collect::<String>())
}
