//! The run-time half of the kinematics compiler.
//!
//! Generated robots lean on the types and the branch-free numerics of this
//! crate; nothing they use allocates or needs `std`.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "alloc")]
mod chain;
#[cfg(feature = "alloc")]
mod cholesky;
#[cfg(feature = "alloc")]
mod descent;
mod exponential;
#[cfg(feature = "glam")]
mod glam;
mod jacobian;
mod kinematics;
mod limits;
pub mod math;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;
mod orientation;
mod placement;
mod pose;
#[cfg(feature = "alloc")]
mod search;
mod solutions;
pub mod subproblems;
mod twist;
mod vector;

#[cfg(feature = "alloc")]
pub use chain::Chain;
pub use jacobian::Jacobian;
pub use kinematics::Kinematics;
pub use limits::JointLimit;
pub use placement::{WithBase, WithTool};
pub use pose::Pose;
#[cfg(feature = "alloc")]
pub use search::{ChainSolution, Goal, SearchOptions};
pub use solutions::{IntoIter, Solution, Solutions, Windings};
pub use twist::{Twist, Wrench};
