use super::{DIGITS, L0, L1, ROUNDING, assert_close, contains, determinant};
use crate::random::Random;
use crate::zoo::Stanford;

const GOLDEN: [f64; 6] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
const ALL_ROWS: [usize; 6] = [0, 1, 2, 3, 4, 5];

fn configurations() -> impl Iterator<Item = [f64; 6]> {
    let mut random = Random::new(3);
    (0..100).map(move |_| std::array::from_fn(|_| random.angle()))
}

#[test]
fn the_wrist_centre_is_that_of_the_book() {
    for q in configurations() {
        let (s1, c1) = q[0].sin_cos();
        let (s2, c2) = q[1].sin_cos();
        let length = L1 + q[2];
        let expected = [-length * s1 * c2, length * c1 * c2, L0 - length * s2];
        assert_close(Stanford.fk(&q).translation, expected, ROUNDING);
    }
}

#[test]
fn the_golden_position() {
    let expected = [-0.068490377, 0.682619229, 0.360931468];
    assert_close(Stanford.fk(&GOLDEN).translation, expected, DIGITS);
}

#[test]
fn the_second_column_of_the_spatial_jacobian() {
    for q in configurations() {
        let (s1, c1) = q[0].sin_cos();
        let expected = [L0 * s1, -L0 * c1, 0.0, -c1, -s1, 0.0];
        let found = Stanford.spatial_jacobian(&q).column(1).to_array();
        assert_close(found, expected, ROUNDING);
    }
}

#[test]
fn the_determinant_is_that_of_the_book() {
    for q in configurations() {
        let length = L1 + q[2];
        let expected = length * length * q[1].cos() * q[4].cos();
        let found = determinant(&Stanford.spatial_jacobian(&q), ALL_ROWS);
        assert_close([found.abs()], [expected.abs()], 1e-13);
    }
    let golden = determinant(&Stanford.spatial_jacobian(&GOLDEN), ALL_ROWS);
    assert_close([golden.abs()], [0.421443776], DIGITS);
}

/// Shoulder left or right, the slide out or drawn back through the shoulder,
/// the wrist flipped or not.
#[test]
fn it_has_eight_solutions() {
    let solutions = Stanford.ik(&Stanford.fk(&GOLDEN));
    assert_eq!(solutions.len(), 8);
    assert!(contains(&solutions, &GOLDEN, 1e-12));
}
