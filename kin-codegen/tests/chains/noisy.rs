//! Files are not exact: right angles of few digits, axes that nearly meet,
//! calibrated arms. No branch is lost, and all reach the target on the literal
//! arm.

use crate::arm::{MEET, MEET_THERE, PARALLEL, SKEW, Step, noisy_arm, placed};
use crate::check::Solved;
use crate::settings::in_cases;
use proptest::prop_assume;

const SPHERICAL_WRIST: &[Step] = &[SKEW, MEET, PARALLEL, MEET, MEET, MEET_THERE];
const THREE_PARALLEL: &[Step] = &[SKEW, MEET, PARALLEL, PARALLEL, MEET, MEET];

/// The last digit of a file, right angles of 6 and 4 digits, stray offsets, a
/// calibrated arm.
const LEVELS: &[[f64; 2]] = &[
    [1e-9, 0.0],
    [1e-9, 1e-9],
    [4e-6, 0.0],
    [4e-6, 1e-6],
    [0.0, 8.8e-5],
    [2e-4, 0.0],
    [2e-4, 2e-4],
];

#[test]
fn spherical_wrist() {
    away_from_singularities(SPHERICAL_WRIST);
}

#[test]
fn three_parallel() {
    away_from_singularities(THREE_PARALLEL);
}

/// Where all answers are many times farther from singular ones than the noise.
fn away_from_singularities(steps: &[Step]) {
    in_cases(16, placed(noisy_arm(steps, LEVELS), steps), &|(arm, q)| {
        let solved = Solved::new(&arm)?;
        prop_assume!(solved.least_conditioning(&q) > 0.01);
        solved.check(&q)
    });
}
