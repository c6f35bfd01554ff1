use super::{DIGITS, L0, L1, L2, ROUNDING, assert_close, contains, determinant};
use crate::random::Random;
use crate::zoo::{Elbow, InverseElbow};

const GOLDEN: [f64; 6] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
const ALL_ROWS: [usize; 6] = [0, 1, 2, 3, 4, 5];

fn configurations() -> impl Iterator<Item = [f64; 6]> {
    let mut random = Random::new(2);
    (0..100).map(move |_| std::array::from_fn(|_| random.angle()))
}

#[test]
fn the_position_is_that_of_the_book() {
    for q in configurations() {
        let (s1, c1) = q[0].sin_cos();
        let (s2, c2) = q[1].sin_cos();
        let (s23, c23) = (q[1] + q[2]).sin_cos();
        let reach = L1 * c2 + L2 * c23;
        let expected = [-s1 * reach, c1 * reach, L0 - L1 * s2 - L2 * s23];
        assert_close(Elbow.fk(&q).translation, expected, ROUNDING);
    }
}

#[test]
fn the_golden_pose() {
    let pose = Elbow.fk(&GOLDEN);
    let position = [-0.065420978, 0.652027622, 0.276704606];
    assert_close(pose.translation, position, DIGITS);
    let row = [0.878680246, -0.387910292, 0.278292347];
    assert_close(pose.rotation[0], row, DIGITS);
}

#[test]
fn the_determinant_is_that_of_the_book() {
    for q in configurations() {
        let reach = L1 * q[1].cos() + L2 * (q[1] + q[2]).cos();
        let expected = L1 * L2 * (q[2].sin() * reach * q[4].cos()).abs();
        let found = determinant(&Elbow.spatial_jacobian(&q), ALL_ROWS);
        assert_close([found.abs()], [expected], ROUNDING);
    }
    let golden = determinant(&Elbow.spatial_jacobian(&GOLDEN), ALL_ROWS);
    assert_close([golden], [-0.020393770], DIGITS);
}

#[test]
fn it_has_eight_solutions() {
    let solutions = Elbow.ik(&Elbow.fk(&GOLDEN));
    assert_eq!(solutions.len(), 8);
    assert!(contains(&solutions, &GOLDEN, 1e-12));
    let other = [
        0.1,
        0.456825217,
        5.983185307,
        0.517850781,
        0.808784714,
        0.790954174,
    ];
    assert!(contains(&solutions, &other, DIGITS), "{solutions:#?}");
}

/// Read from tip to base, the arm has the same solutions: the target is
/// inverted, the joints reversed and negated.
#[test]
fn the_inverse_elbow_has_the_same_solutions() {
    for q in configurations() {
        let target = Elbow.fk(&q);
        let (here, there) = (Elbow.ik(&target), InverseElbow.ik(&target.inverse()));
        assert_eq!(here.len(), there.len(), "{q:?}");
        for solution in &there {
            let mut read_backwards = solution.q.map(|x| -x);
            read_backwards.reverse();
            assert!(
                contains(&here, &read_backwards, 1e-8),
                "{solution:?} of {q:?}"
            );
        }
    }
}
