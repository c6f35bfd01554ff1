//! Targets with more coordinates than the arm has joints are met within reach
//! and nowhere beside it.

use crate::subject::Subject;
use kinematics::{Kinematics, Pose};
use nalgebra::DMatrix;

for_every_aimed_robot!(beside_its_reach_there_is_no_answer);

/// Moves the target in a direction in which no joint does.
fn beside_its_reach_there_is_no_answer<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    if N >= robot.counts.coordinates() {
        return;
    }
    for q in robot.random(50).filter(|q| robot.conditioning(q) > 0.01) {
        let target = robot.chain.fk(&q);
        assert!(!robot.ik(&target).is_empty(), "{q:?}");
        for step in [1e-8, 1e-6, 1e-3] {
            for step in [step, -step] {
                let moved = aside(robot, &q, step);
                let answers = robot.ik(&moved);
                assert!(answers.is_empty(), "{q:?} by {step:e}: {answers:?}");
            }
        }
    }
}

/// The tip of `q` moved by a step perpendicular to all that the joints can do,
/// lengths in units of the arm's size.
fn aside<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>, q: &[f64; N], step: f64) -> Pose {
    let columns = robot.chain.geometric_jacobian(q);
    let rows = robot.counts.coordinates();
    let entry =
        |i: usize, j: usize| columns[j].to_array()[i] / if i < 3 { robot.size } else { 1.0 };
    let jacobian = DMatrix::from_fn(rows, N, entry);
    // The unit target coordinate that the joints can do least about, without
    // what they can.
    let projector =
        DMatrix::identity(rows, rows) - &jacobian * jacobian.clone().pseudo_inverse(1e-9).unwrap();
    let free = projector
        .column_iter()
        .max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let direction = free.unwrap().normalize() * step;
    let part = |i: usize| if i < rows { direction[i] } else { 0.0 };
    let target = robot.chain.fk(q);
    let turn = [part(3), part(4), part(5)];
    let angle = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
    let shift = |i: usize| target.translation[i] + robot.size * part(i);
    Pose {
        translation: std::array::from_fn(shift),
        ..Pose::from_axis_angle(turn, angle, [0.0; 3]) * target
    }
}
