//! From branches that nearly reach their target to solutions: rounding keeps some of an exact
//! arm from it, and those of an arm that is a little off its design are the design's.

mod correction;
mod levenberg;
mod linearization;
mod swivel;

pub use correction::correct_branches;
pub(super) use correction::is_next_to;
pub use levenberg::{Arrived, levenberg};
pub use linearization::Problem;
pub use swivel::AtSwivel;
