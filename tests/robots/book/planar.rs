use super::{ROUNDING, assert_close, determinant};
use crate::random::Random;
use crate::zoo::{Planar2r, Planar3r};
use kinematics::Pose;
use std::f64::consts::{PI, SQRT_2};

kinematics::kinematics!("robots/book/isotropic_2r.yaml");

#[test]
fn two_joints_are_singular_where_the_elbow_is_stretched() {
    let mut random = Random::new(4);
    for _ in 0..100 {
        let q = [random.angle(), random.angle()];
        let found = determinant(&Planar2r.geometric_jacobian(&q), [0, 1]);
        assert_close([found.abs()], [0.4 * 0.3 * q[1].sin().abs()], ROUNDING);
    }
}

/// With l1 = √2 l2 and the elbow at ±135°, all directions are alike: both
/// singular values are l2.
#[test]
fn two_joints_are_isotropic_at_135_degrees() {
    for elbow in [-0.75 * PI, 0.75 * PI] {
        let rows = Isotropic2r.geometric_jacobian(&[0.7, elbow]).rows;
        let jacobian = nalgebra::Matrix2::from_fn(|i, j| rows[i][j]);
        let values = jacobian.singular_values();
        assert_close([values[0], values[1]], [0.3, 0.3], ROUNDING);
    }
    assert_close(
        Isotropic2r.fk(&[0.0; 2]).translation,
        [0.3 * (1.0 + SQRT_2), 0.0, 0.0],
        1e-9,
    );
}

/// How many of 72 orientations the 3R arm, with links of 0.5, 0.3 and 0.1 m,
/// reaches at a distance from its first axis.
fn orientations(distance: f64) -> usize {
    let reached = |k: &i32| {
        let turn = f64::from(*k) * PI / 36.0 + 0.01;
        let target = Pose::from_axis_angle([0.0, 0.0, 1.0], turn, [0.0; 3]);
        let translation = [0.0, distance, 0.0];
        !Planar3r
            .ik(&Pose {
                translation,
                ..target
            })
            .is_empty()
    };
    (0..72).filter(reached).count()
}

#[test]
fn three_joints_reach_an_annulus() {
    assert!(
        [0.02, 0.09, 0.91, 2.0]
            .map(orientations)
            .iter()
            .all(|&n| n == 0)
    );
    assert!(
        [0.11, 0.2, 0.5, 0.8, 0.89]
            .map(orientations)
            .iter()
            .all(|&n| n > 0)
    );
}

#[test]
fn three_joints_are_dextrous_in_a_smaller_annulus() {
    assert!(
        [0.301, 0.4, 0.5, 0.6, 0.699]
            .map(orientations)
            .iter()
            .all(|&n| n == 72)
    );
    assert!([0.29, 0.71].map(orientations).iter().all(|&n| n < 72));
}

#[test]
fn both_have_two_solutions() {
    assert_eq!(Planar2r.ik(&Planar2r.fk(&[0.3, -0.8])).len(), 2);
    assert_eq!(Planar3r.ik(&Planar3r.fk(&[0.3, -0.8, 1.1])).len(), 2);
}
