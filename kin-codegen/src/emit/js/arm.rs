//! An arm: what the file says of it, and its functions of q.

use super::form;
use super::language::{JavaScript, array, filling, numbers, object, signed};
use super::text::string;
use crate::arm::CompiledArm;
use crate::emit::curly::data::rows;
use crate::emit::curly::forward::{body, jacobian, links_of_joints, pose};
use crate::emit::curly::indented;
use crate::emit::straight::Writer;
use crate::expr::forward::Outputs;
use crate::expr::jacobian::Columns;
use crate::expr::{Expr, Graph};
use crate::geometry::{size, without_noise};
use crate::model::Model;
use crate::singularity::Singular;

/// The expression that is an arm.
pub fn arm(compiled: &CompiledArm) -> String {
    let model = &compiled.model;
    let n = model.variables.len();
    let f = compiled.forward();
    let (g, both) = (&f.graph, &f.both);
    let all: Vec<usize> = (0..model.joints.len()).collect();
    let form = compiled.form().map(|form| form::form(compiled, form));
    let none = || "null".to_owned();
    let aim = [
        ("size", signed(size(model))),
        ("counts_translation", "true".into()),
        ("counts_rotation", (model.variables.len() > 3).to_string()),
        ("counts_axis", "false".into()),
    ];
    let fields = [
        ("name", string(&model.name)),
        ("file", string(&compiled.file)),
        ("base", string(&model.base)),
        ("tip", string(&model.tip)),
        ("joints", joints(model)),
        (
            "moves",
            array(model.joints.iter().map(|it| string(&it.link))),
        ),
        ("frames", frames(model)),
        ("home", numbers(rows(&model.home))),
        ("aim", object(&aim)),
        ("form", form.unwrap_or_else(none)),
        (
            "fk",
            function("pose", 12, g, &f.tip.expressions(), n, |w| {
                pose(w, "pose", 0, &f.tip)
            }),
        ),
        (
            "poses",
            filling(
                "q",
                "poses",
                12 * all.len(),
                &links_of_joints::<JavaScript>(compiled, &all).0,
            ),
        ),
        ("spatial_jacobian", of_jacobian(g, &f.spatial, n)),
        ("body_jacobian", of_jacobian(g, &f.body, n)),
        ("geometric_jacobian", of_jacobian(g, &f.geometric, n)),
        ("fk_jacobian", {
            let (statements, _) = body::<JavaScript>(g, &both.expressions(), n, |w| {
                pose(w, "pose", 0, &both.tip) + &jacobian(w, &both.columns)
            });
            format!(
                "(q) => {{\n{}}}",
                indented(&format!(
                    "const pose = new Float64Array(12);\n\
                     const jacobian = new Float64Array({});\n{statements}\
                     return {{ pose, jacobian }};\n",
                    6 * n
                ))
            )
        }),
        (
            "singularities",
            compiled
                .singular()
                .map_or_else(none, |it| singularities(it, n)),
        ),
    ];
    format!("$arm({})", object(&fields))
}

/// What q is of.
fn joints(model: &Model) -> String {
    let joint = |i: usize| {
        let variable = &model.variables[i];
        let [lower, upper] = variable
            .limits
            .unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let rating = &variable.rating;
        object(&[
            ("name", string(&variable.name)),
            ("turns", model.turns(i).to_string()),
            ("repeats", model.repeats(i).to_string()),
            ("lower", signed(lower)),
            ("upper", signed(upper)),
            ("velocity", signed(rating.velocity.unwrap_or(f64::INFINITY))),
            ("effort", signed(rating.effort.unwrap_or(f64::INFINITY))),
            ("link", model.joint_of(i).to_string()),
        ])
    };
    array((0..model.variables.len()).map(joint))
}

/// The links that are fixed to others.
fn frames(model: &Model) -> String {
    let frame = |frame: &crate::model::Frame| {
        let carrier = frame.joint.map_or("null".into(), |joint| joint.to_string());
        object(&[
            ("name", string(&frame.name)),
            ("carrier", carrier),
            ("pose", numbers(rows(&without_noise(&frame.pose)))),
        ])
    };
    array(model.frames.iter().map(frame))
}

/// A function of q that gives back an array.
fn function(
    name: &str,
    count: usize,
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    write: impl FnOnce(&Writer<JavaScript>) -> String,
) -> String {
    let (statements, _) = body::<JavaScript>(g, outputs, n, write);
    filling("q", name, count, &statements)
}

fn of_jacobian(g: &Graph, columns: &Columns, n: usize) -> String {
    function("jacobian", 6 * n, g, &columns.expressions(), n, |w| {
        jacobian(w, columns)
    })
}

/// How far from singular: a value for each singularity, and the determinant before them.
fn singularities(singular: &Singular, n: usize) -> String {
    let values: Vec<Expr> = [vec![singular.determinant.product], singular.values()].concat();
    let function = function("values", values.len(), &singular.graph, &values, n, |w| {
        let values = values.iter().enumerate();
        values
            .map(|(i, &value)| format!("values[{i}] = {};\n", w.output(value)))
            .collect()
    });
    let each = singular
        .singularities
        .iter()
        .map(|it| object(&[("name", string(&it.name)), ("unit", string(&it.unit()))]));
    object(&[("each", array(each)), ("values", function)])
}
