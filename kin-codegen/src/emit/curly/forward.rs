//! Forward kinematics and Jacobians: statements that fill arrays.

use super::Curly;
use crate::arm::CompiledArm;
use crate::emit::straight::{Place, Writer};
use crate::expr::forward::{JointTrig, Outputs, link_frames};
use crate::expr::jacobian::Columns;
use crate::expr::linear::Motion;
use crate::expr::{Expr, Graph, Node};

/// The statements of a function of q, and whether they read it.
pub fn body<L: Curly>(
    g: &Graph,
    outputs: &[Expr],
    joints: usize,
    write: impl FnOnce(&Writer<L>) -> String,
) -> (String, bool) {
    let inputs: Vec<String> = (0..usize::from(g.inputs()))
        .map(|i| format!("q[{i}]"))
        .collect();
    let stages = vec![0; g.nodes().len()];
    let mut writer = Writer::<L>::new(g, outputs, &inputs, &stages, None);
    let mut body = L::bound(&writer.sines_and_cosines());
    let statements = writer.statements(Place::Scalar, |_| true, |_| Vec::new(), |_, _| ());
    body += &statements.concat();
    body += &write(&writer);
    let reads = (0..joints).any(|i| writer.needs_input(i));
    (body, reads)
}

/// The twelve numbers of a pose, by rows, from a place of an array on.
pub fn pose<L: Curly>(writer: &Writer<L>, array: &str, from: usize, motion: &Motion) -> String {
    let entry =
        |(place, e): (usize, Expr)| format!("{array}[{}] = {};\n", from + place, writer.output(e));
    let rows = (0..3).flat_map(|i| {
        let [a, b, c] = motion.rotation[i];
        [a, b, c, motion.translation[i]]
    });
    rows.enumerate().map(entry).collect()
}

/// Poses, one behind the other.
pub fn poses<L: Curly>(writer: &Writer<L>, motions: &[Motion]) -> String {
    let all = motions.iter().enumerate();
    all.map(|(i, motion)| pose(writer, "poses", 12 * i, motion))
        .collect()
}

/// A Jacobian by rows.
pub fn jacobian<L: Curly>(writer: &Writer<L>, columns: &Columns) -> String {
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

/// The statements that fill `poses` with those of the links of some joints, in this order, and
/// whether they read q.
pub fn links_of_joints<L: Curly>(compiled: &CompiledArm, joints: &[usize]) -> (String, bool) {
    let mut g: Graph = compiled.forward().graph.clone();
    let n = compiled.model.variables.len();
    let q = (0..n).map(|i| g.find(Node::Input(i as u16)));
    let q: Vec<Expr> = q.flatten().collect();
    let trig = JointTrig::at(&mut g, &compiled.linkage, &q);
    let links = link_frames(&mut g, &compiled.linkage, &trig, joints);
    let outputs: Vec<Expr> = links.iter().flat_map(Outputs::expressions).collect();
    body::<L>(&g, &outputs, n, |w| poses(w, &links))
}
