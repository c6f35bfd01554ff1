use super::{DIGITS, L0, L1, L2, ROUNDING, assert_close, contains, determinant, yaw};
use crate::random::Random;
use crate::zoo::Scara;
use kinematics::Wrench;

const GOLDEN: [f64; 4] = [0.3, -0.5, 0.7, 0.1];

fn configurations() -> impl Iterator<Item = [f64; 4]> {
    let mut random = Random::new(1);
    (0..100).map(move |_| std::array::from_fn(|_| random.angle()))
}

#[test]
fn the_pose_is_that_of_the_book() {
    for q in configurations() {
        let pose = Scara.fk(&q);
        let (a, ab) = (q[0], q[0] + q[1]);
        let x = -L1 * a.sin() - L2 * ab.sin();
        let y = L1 * a.cos() + L2 * ab.cos();
        assert_close(pose.translation, [x, y, L0 + q[3]], ROUNDING);
        let (s, c) = (ab + q[2]).sin_cos();
        assert_close(pose.rotation[0], [c, -s, 0.0], ROUNDING);
        assert_close(pose.rotation[1], [s, c, 0.0], ROUNDING);
        assert_close(pose.rotation[2], [0.0, 0.0, 1.0], ROUNDING);
    }
}

#[test]
fn the_golden_pose() {
    let pose = Scara.fk(&GOLDEN);
    assert_close(pose.translation, [-0.058607283, 0.676154569, 0.6], DIGITS);
    assert_close([yaw(&pose)], [0.5], ROUNDING);
}

#[test]
fn the_columns_of_the_spatial_jacobian() {
    for q in configurations() {
        let jacobian = Scara.spatial_jacobian(&q);
        let (s1, c1) = q[0].sin_cos();
        let (s12, c12) = (q[0] + q[1]).sin_cos();
        let turn = |x: f64, y: f64| [x, y, 0.0, 0.0, 0.0, 1.0];
        let columns = [
            turn(0.0, 0.0),
            turn(L1 * c1, L1 * s1),
            turn(L1 * c1 + L2 * c12, L1 * s1 + L2 * s12),
            [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        ];
        for (j, column) in columns.into_iter().enumerate() {
            assert_close(jacobian.column(j).to_array(), column, ROUNDING);
        }
    }
}

#[test]
fn it_is_singular_where_the_elbow_is_stretched() {
    for q in configurations() {
        let determinant = determinant(&Scara.spatial_jacobian(&q), [0, 1, 2, 5]);
        assert_close([determinant.abs()], [L1 * L2 * q[1].sin().abs()], ROUNDING);
    }
}

#[test]
fn it_resists_moments_about_x_and_y_by_structure() {
    for q in configurations() {
        let jacobian = Scara.spatial_jacobian(&q);
        for moment in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
            let force = [0.0; 3];
            assert_close(
                jacobian.torques(&Wrench { force, moment }),
                [0.0; 4],
                ROUNDING,
            );
        }
    }
}

#[test]
fn it_has_two_solutions() {
    let solutions = Scara.ik(&Scara.fk(&GOLDEN));
    assert_eq!(solutions.len(), 2);
    assert!(contains(&solutions, &GOLDEN, 1e-12));
    // The elbow on the other side: mirrored in the line to the wrist.
    let wrist = |q: &[f64; 4]| {
        let pose = Scara.fk(q);
        pose.translation[1].atan2(pose.translation[0])
    };
    let other = solutions.iter().find(|s| s.q[1] > 0.0).unwrap();
    assert_close([other.q[1]], [-GOLDEN[1]], 1e-12);
    assert_close([wrist(&other.q)], [wrist(&GOLDEN)], 1e-12);
}
