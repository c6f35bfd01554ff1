//! Forward kinematics and Jacobians equal those of the generic chain.

use crate::measure::{entrywise, largest};
use crate::subject::Subject;
use kinematics::{Jacobian, Kinematics, Pose, Twist};

for_every_robot!(poses_agree);
for_every_robot!(jacobians_agree);
for_every_robot!(jacobians_are_derivatives);

/// Rounding of a few dozen operations on numbers of the arm's size.
const ROUNDING: f64 = 1e-12;

fn configurations<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) -> impl Iterator<Item = [f64; N]> {
    robot.random(100).chain(robot.structured())
}

pub fn poses_agree<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in configurations(robot) {
        let expected = robot.chain.fk(&q);
        assert!(entrywise(&robot.arm.fk(&q), &expected) < ROUNDING, "{q:?}");
        let with_jacobian = robot.arm.fk_jacobian(&q).0;
        assert!(entrywise(&with_jacobian, &expected) < ROUNDING, "{q:?}");
        let links = robot.arm.fk_links(&q);
        for (link, expected) in links.iter().zip(robot.chain.fk_links(&q)) {
            assert!(entrywise(link, &expected) < ROUNDING, "{q:?}");
        }
    }
}

pub fn jacobians_agree<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let (arm, chain) = (&robot.arm, &robot.chain);
    for q in configurations(robot) {
        let spatial = chain.spatial_jacobian(&q);
        assert_columns(&arm.spatial_jacobian(&q), &spatial, &q);
        assert_columns(&arm.fk_jacobian(&q).1, &spatial, &q);
        assert_columns(&arm.body_jacobian(&q), &chain.body_jacobian(&q), &q);
        let geometric = chain.geometric_jacobian(&q);
        assert_columns(&arm.geometric_jacobian(&q), &geometric, &q);
    }
}

fn assert_columns<const N: usize>(jacobian: &Jacobian<N>, columns: &[Twist], q: &[f64; N]) {
    for (j, expected) in columns.iter().enumerate() {
        let difference = jacobian.column(j) - *expected;
        assert!(largest(difference.to_array()) < ROUNDING, "{q:?}, {j}");
    }
}

fn jacobians_are_derivatives<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    const STEP: f64 = 1e-5;
    for q in robot.random(20) {
        let pose = robot.arm.fk(&q);
        let spatial = robot.arm.spatial_jacobian(&q);
        for j in 0..N {
            let moved = |by: f64| {
                let mut q = q;
                q[j] += by;
                robot.arm.fk(&q)
            };
            let derivative = spatial_velocity(&moved(-STEP), &pose, &moved(STEP), 2.0 * STEP);
            let difference = spatial.column(j) - derivative;
            assert!(largest(difference.to_array()) < 1e-8, "{q:?}, {j}");
        }
    }
}

/// The twist of ġ g⁻¹ by a central difference.
fn spatial_velocity(before: &Pose, pose: &Pose, after: &Pose, time: f64) -> Twist {
    let inverse = pose.inverse();
    let (a, b) = ((*after * inverse), (*before * inverse));
    let rate = |i: usize, j: usize| (a.rotation[i][j] - b.rotation[i][j]) / time;
    Twist {
        linear: std::array::from_fn(|i| (a.translation[i] - b.translation[i]) / time),
        angular: [rate(2, 1), rate(0, 2), rate(1, 0)],
    }
}
