//! The run-time half of the kinematics compiler.
//!
//! Generated robots lean on the types and the branch-free numerics of this
//! crate; nothing they use allocates or needs `std`. The same mathematics for a
//! chain that is known only at run time checks them.
//!
//! Notation and conventions are those of Murray, Li and Sastry, "A Mathematical
//! Introduction to Robotic Manipulation", 1994, here called MLS: twists are
//! (v, ω), poses take tool coordinates to base coordinates. Units are metres
//! and radians.
//!
//! | feature | adds |
//! |---|---|
//! | `alloc` | `Chain`, the generic product of exponentials, its numerical search, self-motions, and `Mechanism` |
//! | `std` (default) | the processor's square root instead of `libm`'s; implies `alloc` |
//! | `nalgebra` (default), `glam`, `mint` | conversions |
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod basis;
pub mod branches;
#[cfg(feature = "alloc")]
mod chain;
#[cfg(feature = "alloc")]
mod cholesky;
mod derivative;
#[cfg(feature = "alloc")]
mod descent;
mod exponential;
pub mod free_angle;
#[cfg(feature = "glam")]
mod glam;
mod inherent;
mod jacobian;
mod kinematics;
pub mod lanes;
mod limits;
mod manipulability;
pub mod math;
mod mechanism;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;
mod orientation;
mod placement;
pub mod polish;
mod pose;
pub mod quartic;
mod redundancy;
mod resolved_rate;
mod row_space;
#[cfg(feature = "alloc")]
mod search;
#[cfg(feature = "alloc")]
mod self_motion;
mod singular_values;
mod singularity;
mod solutions;
mod statics;
pub mod subproblems;
mod target;
mod twist;
mod vector;
#[cfg(feature = "alloc")]
mod workspace;
mod wrench;

pub use basis::Basis;
#[cfg(feature = "alloc")]
pub use chain::Chain;
pub use derivative::Hessian;
pub use jacobian::Jacobian;
pub use kinematics::Kinematics;
pub use limits::JointLimit;
pub use manipulability::{Ellipsoid, Manipulability};
#[cfg(feature = "alloc")]
pub use mechanism::Mechanism;
pub use mechanism::{ParallelKinematics, Postures, three_spheres};
pub use placement::{WithBase, WithTool};
pub use pose::Pose;
pub use redundancy::{centering_gradient, null_space};
#[cfg(feature = "alloc")]
pub use search::{ChainSolution, SearchOptions};
#[cfg(feature = "alloc")]
pub use self_motion::{
    SelfMotion, SelfMotionError, SelfMotionOptions, SelfMotions, Stop, self_motion, self_motions,
};
pub use singularity::Singularity;
pub use solutions::{IntoIter, Solution, Solutions, Windings};
pub use statics::RANK_TOLERANCE;
pub use target::Target;
pub use twist::Twist;
#[cfg(feature = "alloc")]
pub use workspace::{Workspace, WorkspaceMethod, scattered_rotations};
pub use wrench::Wrench;
