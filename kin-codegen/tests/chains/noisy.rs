//! Files are not exact: right angles of few digits, axes that nearly meet,
//! calibrated arms. No branch is lost, and all reach the target on the literal
//! arm.

use crate::arm::{MEET, MEET_THERE, PARALLEL, SKEW, Step, configuration, noisy_arm};
use crate::check::{Check, Solved};
use crate::settings::cases;
use proptest::prelude::*;

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

proptest! {
    #![proptest_config(cases(16))]

    #[test]
    fn spherical_wrist(
        arm in noisy_arm(SPHERICAL_WRIST, LEVELS),
        q in configuration(SPHERICAL_WRIST),
    ) {
        away_from_singularities(&Solved::new(&arm)?, &q)?;
    }

    #[test]
    fn three_parallel(
        arm in noisy_arm(THREE_PARALLEL, LEVELS),
        q in configuration(THREE_PARALLEL),
    ) {
        away_from_singularities(&Solved::new(&arm)?, &q)?;
    }
}

/// Where all answers are many times farther from singular ones than the noise.
fn away_from_singularities(solved: &Solved, q: &[f64]) -> Check {
    prop_assume!(solved.least_conditioning(q) > 0.01);
    solved.check(q)
}
