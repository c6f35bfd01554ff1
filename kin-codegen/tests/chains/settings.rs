//! How many cases, and which.

use crate::check::Check;
use proptest::strategy::BoxedStrategy;
use proptest::test_runner::{Config, RngSeed, TestRunner};
use std::fmt::Debug;

const SEED: u64 = 1994;

/// A check holds in so many cases. Not the macro of proptest: what it wraps around a test is compiled
/// again for each.
#[track_caller]
pub fn in_cases<T: Debug>(cases: u32, strategy: BoxedStrategy<T>, check: &dyn Fn(T) -> Check) {
    let mut runner = TestRunner::new(config(cases));
    if let Err(failed) = runner.run(&strategy, check) {
        panic!("{failed}\n{runner}");
    }
}

/// `cases` that are always the same, unless the environment asks for others.
fn config(cases: u32) -> Config {
    let asked = |name| std::env::var_os(name).is_some();
    let mut config = Config {
        failure_persistence: None,
        ..Config::default()
    };
    if !asked("PROPTEST_CASES") {
        config.cases = cases;
    }
    if !asked("PROPTEST_RNG_SEED") {
        config.rng_seed = RngSeed::Fixed(SEED);
    }
    config
}
