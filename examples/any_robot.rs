//! Code that works for every generated robot, with a tool in its hand and
//! standing somewhere.

use kinematics::{Kinematics, Pose, WithBase, WithTool};

kinematics::kinematics!("robots/puma560.yaml");
kinematics::kinematics!("robots/ur10e.yaml");

fn main() {
    let drill = Pose::from_translation([0.0, 0.0, 0.12]);
    let table = Pose::from_translation([1.0, 0.0, 0.8]);
    let q = [0.2, -1.0, 0.9, 0.4, 0.7, -0.3];
    report("Puma 560", &Puma560, &q);
    report("UR10e", &Ur10e, &q);

    let drilling = WithTool {
        robot: Ur10e,
        tool: drill,
    };
    report("UR10e with a drill", &drilling, &q);
    let standing = WithBase {
        robot: drilling,
        base: table,
    };
    report("the same on a table", &standing, &q);
}

/// Where the tool is, and how many of the ways to get there a robot can use.
fn report<const N: usize, K: Kinematics<N>>(name: &str, robot: &K, q: &[f64; N]) {
    let pose = robot.fk(q);
    let solutions = robot.ik(&pose);
    println!(
        "{name}: tool at {:.3?} m; {} solutions, {} within limits",
        pose.translation,
        solutions.len(),
        solutions.within_limits(&K::LIMITS).len()
    );
}
