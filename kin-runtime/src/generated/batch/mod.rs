//! Many configurations or targets at once: one in each lane.

mod forward;

pub use forward::{Forward, forward};

/// How many are computed side by side: a vector of AVX-512.
const LANES: usize = 8;
