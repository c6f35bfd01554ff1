//! Random arms: every structure that has a closed form, and arbitrary chains.
//!
//! The cases are always the same. To try others:
//! `PROPTEST_CASES=1000 PROPTEST_RNG_SEED=7 cargo test --release --test chains`.

mod arm;
mod check;
mod settings;
#[macro_use]
mod structures;

mod arbitrary;
mod fewer_joints;
mod nearly_parallel_slides;
mod noisy;
mod sliding;
mod spherical_wrist;
mod table;
mod targets;
mod three_parallel;
