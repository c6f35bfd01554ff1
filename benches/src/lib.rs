//! Benchmarks of the kinematics compiler beside its peers.
//!
//! ```sh
//! cd benches
//! cargo run --release --bin compare
//! RUSTFLAGS="-C target-cpu=native" cargo run --release --bin compare
//! cargo run --release --bin batch         # a million at once
//! cargo run --release --bin c             # the same robots as C
//! cargo run --release --bin generate      # what compiling a robot costs
//! cargo run --release --bin tail          # the slowest calls
//! ```
//!
//! `python_peers.py` has packages from PyPI on the same inputs (`--bin inputs`).
//!
//! `--features ik-geo` adds one more peer, which needs CMake.
//!
//! Inputs are random and larger together than the first-level cache; all
//! contestants of a table run in turn, many times, and their medians are
//! compared: ratios travel between machines, nanoseconds do not. Before
//! anything is timed, every peer has to give the same results.

pub mod contest;
pub mod inputs;
pub mod peers;
pub mod redundant;
