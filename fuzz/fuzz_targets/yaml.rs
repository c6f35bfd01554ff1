//! Robot files in YAML.
#![no_main]

use kin_codegen::random::Random;
use kin_fuzz::{mutate, readers};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

fuzz_target!(|text: &str| {
    readers::read("a.yaml", text);
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    mutate(data, size, max_size, &mut Random(u64::from(seed) + 1))
});
