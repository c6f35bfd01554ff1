//! Targets with their axes along the base's, among them those that point
//! straight down.

use crate::complete::assert_matched;
use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::Kinematics;

for_every_robot!(axis_aligned_targets_have_all_answers);

/// All 24 rotations that take axes to axes.
fn aligned_rotations() -> Vec<[[f64; 3]; 3]> {
    let units = [0, 1, 2].map(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    let signed = units
        .into_iter()
        .flat_map(|u: [f64; 3]| [u, u.map(|x| 0.0 - x)]);
    let axes: Vec<[f64; 3]> = signed.collect();
    let dot = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
    let mut rotations = Vec::new();
    for x in &axes {
        for y in axes.iter().filter(|y| dot(x, y) == 0.0) {
            let cross = |i: usize, j: usize| x[i] * y[j] - x[j] * y[i];
            rotations.push([*x, *y, [cross(1, 2), cross(2, 0), cross(0, 1)]]);
        }
    }
    rotations
}

#[test]
fn there_are_24_rotations() {
    assert_eq!(aligned_rotations().len(), 24);
}

fn axis_aligned_targets_have_all_answers<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    if N < 6 || robot.counts == Target::Position {
        return;
    }
    let places = robot.random(24).map(|q| robot.chain.fk(&q));
    for (mut target, rotation) in places.zip(aligned_rotations()) {
        target.rotation = rotation;
        let answers = robot.ik(&target);
        for solution in robot.search(&target) {
            if robot.conditioning(&solution.q) > 1e-4 {
                assert_matched(robot, &solution, &answers, &target);
            }
        }
    }
}
