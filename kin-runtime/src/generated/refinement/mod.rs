//! From nearly right configurations to solutions of the arm as given.
//!
//! An arm whose geometry is a little off an ideal one is solved in the ideal
//! one's closed form; what that answers is refined here.

mod branches;
mod correction;
mod curve;
mod levenberg;
mod linearization;
mod newton;
mod swivel;

pub use branches::refine_branches;
pub use correction::correct_branches;
pub use levenberg::levenberg;
pub use linearization::Problem;
pub use newton::{Refined, newton};
pub use swivel::AtSwivel;
