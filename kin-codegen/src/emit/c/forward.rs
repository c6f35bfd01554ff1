//! Forward kinematics and Jacobians as C functions.

use super::language::{Writer, bound, indented};
use crate::arm::CompiledArm;
use crate::emit::straight::Place;
use crate::expr::forward::{JointTrig, Outputs, link_frames};
use crate::expr::jacobian::Columns;
use crate::expr::linear::Motion;
use crate::expr::{Expr, Graph, Node};

/// All functions of q.
pub fn functions(compiled: &CompiledArm) -> String {
    let f = &compiled.forward;
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

/// The poses of the links of joints that follow coordinates, in this order, if there are any.
pub fn following(compiled: &CompiledArm, joints: &[usize]) -> String {
    let mut g: Graph = compiled.forward.graph.clone();
    let n = compiled.model.variables.len();
    let q = (0..n).map(|i| g.find(Node::Input(i as u16)));
    let q: Vec<Expr> = q.flatten().collect();
    let trig = JointTrig::at(&mut g, &compiled.linkage, &q);
    let links = link_frames(&mut g, &compiled.linkage, &trig, joints);
    let outputs: Vec<Expr> = links.iter().flat_map(Outputs::expressions).collect();
    let result = format!("poses[12 * {}]", joints.len());
    let heading = "/* The poses of the links whose joints follow others. */\n";
    let function = function(
        "static void kin_fk_following",
        &result,
        &g,
        &outputs,
        n,
        |w| poses(w, &links),
    );
    format!("{heading}{function}")
}

/// A function of q that writes `result`.
fn function(
    name: &str,
    result: &str,
    g: &Graph,
    outputs: &[Expr],
    n: usize,
    write: impl FnOnce(&Writer) -> String,
) -> String {
    let inputs: Vec<String> = (0..usize::from(g.inputs()))
        .map(|i| format!("q[{i}]"))
        .collect();
    let stages = vec![0; g.nodes().len()];
    let mut writer = Writer::new(g, outputs, &inputs, &stages);
    let mut body = bound(writer.sines_and_cosines());
    let statements = writer.statements(Place::Scalar, |_| true, |_| Vec::new(), |_, _| ());
    body += &statements.concat();
    if !(0..n).any(|i| writer.needs_input(i)) {
        body += "(void)q;\n";
    }
    body += &write(&writer);
    let body = indented(&body);
    format!("{name}(const double q[KIN_JOINTS], double {result})\n{{\n{body}}}\n")
}

fn of_jacobian(name: &str, g: &Graph, columns: &Columns, n: usize) -> String {
    let result = "jacobian[6 * KIN_JOINTS]";
    function(name, result, g, &columns.expressions(), n, |w| {
        jacobian(w, columns)
    })
}

/// The twelve numbers of a pose, by rows, from a place of an array on.
fn pose(writer: &Writer, array: &str, from: usize, motion: &Motion) -> String {
    let entry =
        |(place, e): (usize, Expr)| format!("{array}[{}] = {};\n", from + place, writer.output(e));
    let rows = (0..3).flat_map(|i| {
        let [a, b, c] = motion.rotation[i];
        [a, b, c, motion.translation[i]]
    });
    rows.enumerate().map(entry).collect()
}

fn poses(writer: &Writer, motions: &[Motion]) -> String {
    let all = motions.iter().enumerate();
    all.map(|(i, motion)| pose(writer, "poses", 12 * i, motion))
        .collect()
}

/// A Jacobian by rows.
fn jacobian(writer: &Writer, columns: &Columns) -> String {
    let n = columns.0.len();
    let mut out = String::new();
    for row in 0..6 {
        for (j, column) in columns.0.iter().enumerate() {
            let value = writer.output(column[row / 3][row % 3]);
            out += &format!("jacobian[{}] = {value};\n", row * n + j);
        }
    }
    out
}
