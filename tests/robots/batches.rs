//! A batch is single calls, to the last bit.

use crate::random::Random;
use crate::subject::Subject;
use kinematics::{Kinematics, Pose, WithBase, WithTool};

for_every_robot!(forward_batches);

/// More than two blocks of lanes, and every rest.
const LENGTHS: std::ops::Range<usize> = 0..26;

pub fn forward_batches<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for length in LENGTHS {
        forward_batch(&robot.arm, &robot.random(length).collect::<Vec<_>>());
    }
}

fn forward_batch<K: Kinematics<N>, const N: usize>(arm: &K, q: &[[f64; N]]) {
    let mut poses = vec![Pose::IDENTITY; q.len()];
    arm.fk_batch(q, &mut poses);
    let mut both = vec![arm.fk_jacobian(&[0.0; N]); q.len()];
    arm.fk_jacobian_batch(q, &mut both);
    for (q, (pose, both)) in q.iter().zip(poses.iter().zip(&both)) {
        assert_eq!(*pose, arm.fk(q), "{q:?}");
        assert_eq!(*both, arm.fk_jacobian(q), "{q:?}");
    }
}

#[test]
fn tools_and_bases_come_with_batches() {
    let tool = Pose::from_rpy([1.3, 0.2, -0.4], [0.1, 0.0, 0.2]);
    let robot = WithTool {
        robot: crate::zoo::Ur5e,
        tool,
    };
    let base = Pose::from_rpy([0.3, -0.7, 1.1], [1.0, 2.0, 3.0]);
    let mut random = Random::new(5);
    let q: Vec<[f64; 6]> = (0..19)
        .map(|_| std::array::from_fn(|_| random.angle()))
        .collect();
    forward_batch(&robot, &q);
    forward_batch(&WithBase { robot, base }, &q);
}

#[test]
#[should_panic(expected = "a result for each configuration")]
fn too_few_places_panic() {
    crate::zoo::Ur5e.fk_batch(&[[0.0; 6]; 9], &mut [Pose::IDENTITY; 8]);
}
