//! Many configurations or targets at once: one in each lane, where vectors have more
//! than two; otherwise one after the other, which is as fast.

mod entries;
mod forward;
mod inverse;

pub use forward::forward;
pub use inverse::inverse;

/// How many are computed side by side: a vector of AVX-512.
const LANES: usize = 8;
