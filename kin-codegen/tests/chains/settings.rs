//! How many cases, and which.

use proptest::test_runner::{Config, RngSeed};

const SEED: u64 = 1994;

/// `cases` that are always the same, unless the environment asks for others.
pub fn cases(cases: u32) -> Config {
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
