//! The run-time half of the kinematics compiler.
//!
//! Generated robots lean on the types and the branch-free numerics of this
//! crate; nothing they use allocates or needs `std`.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod jacobian;
mod kinematics;
pub mod math;
mod pose;
mod solutions;
mod twist;

pub use jacobian::Jacobian;
pub use kinematics::Kinematics;
pub use pose::Pose;
pub use solutions::{Solution, Solutions};
pub use twist::{Twist, Wrench};
