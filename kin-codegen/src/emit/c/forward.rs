//! Forward kinematics and Jacobians as C functions.

use super::language::C;
use crate::arm::CompiledArm;
use crate::emit::curly::forward::{body, jacobian, links_of_joints, pose, poses};
use crate::emit::curly::indented;
use crate::emit::straight::Writer;
use crate::expr::forward::Outputs;
use crate::expr::jacobian::Columns;
use crate::expr::{Expr, Graph};

/// All functions of q.
pub fn functions(compiled: &CompiledArm) -> String {
    let f = compiled.forward();
    let n = compiled.model.variables.len();
    let (g, both) = (&f.graph, &f.both);
    let links: Vec<Expr> = f.links.iter().flat_map(Outputs::expressions).collect();
    let functions = [
        function("void kin_fk", "pose[12]", g, &f.tip.expressions(), n, |w| {
            pose(w, "pose", 0, &f.tip)
        }),
        function(
            "void kin_fk_links",
            "poses[12 * KIN_JOINTS]",
            g,
            &links,
            n,
            |w| poses(w, &f.links),
        ),
        of_jacobian("void kin_spatial_jacobian", g, &f.spatial, n),
        of_jacobian("void kin_body_jacobian", g, &f.body, n),
        of_jacobian("void kin_geometric_jacobian", g, &f.geometric, n),
        function(
            "void kin_fk_jacobian",
            "pose[12], double jacobian[6 * KIN_JOINTS]",
            g,
            &both.expressions(),
            n,
            |w| pose(w, "pose", 0, &both.tip) + &jacobian(w, &both.columns),
        ),
    ];
    functions.join("\n")
}

/// The poses of the links of joints that follow coordinates, in this order.
pub fn following(compiled: &CompiledArm, joints: &[usize]) -> String {
    let heading = "/* The poses of the links whose joints follow others. */\n";
    let result = format!("poses[12 * {}]", joints.len());
    let body = links_of_joints::<C>(compiled, joints);
    let function = defined("static void kin_fk_following", &result, body);
    format!("{heading}{function}")
}

/// A function of q that writes `result`.
fn function(
    name: &str,
    result: &str,
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    write: impl FnOnce(&Writer<C>) -> String,
) -> String {
    defined(name, result, body(g, outputs, n, write))
}

/// The same of its statements, and whether they read q.
fn defined(name: &str, result: &str, (statements, reads): (String, bool)) -> String {
    let unread = if reads { "" } else { "    (void)q;\n" };
    let body = indented(&statements);
    format!("{name}(const double q[KIN_JOINTS], double {result})\n{{\n{unread}{body}}}\n")
}

fn of_jacobian(name: &str, g: &Graph, columns: &Columns, n: usize) -> String {
    let result = "jacobian[6 * KIN_JOINTS]";
    function(name, result, g, &columns.expressions(), n, |w| {
        jacobian(w, columns)
    })
}
