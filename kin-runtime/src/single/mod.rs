//! The types of this crate in single precision, `f32`: what robots generated with
//! `scalar = f32` take and give, for processors whose unit for floating point has no `f64`.
//!
//! These are the same files, compiled with another [`Real`] and other tolerances, so that what
//! is said of [`Pose`], [`Solutions`] and the others at the root of the crate holds of these;
//! their examples are those of `f64`. What differs:
//!
//! | | `f64` | `f32` |
//! |---|---|---|
//! | a solution misses its target by at most, relative to the arm's size | 1e-9 | 2e-5 |
//! | a target's rotation may be off one by | 1e-9 | 2e-5 |
//! | a value this far beyond a stop rests on it, radians or metres | 1e-9 | 1e-5 |
//! | two roots nearer than this are one, flagged as singular, radians | 3e-7 | 1.4e-3 |
//!
//! Nothing here computes in `f64`. `From` converts poses from one precision to the other, and to
//! and from nalgebra and mint (features of these names).
//!
//! ```
//! use kin_runtime::{Pose, single};
//! let exact = Pose::from_axis_angle([0.0, 0.0, 1.0], 0.3, [0.1, 0.2, 0.3]);
//! let rounded = single::Pose::from(exact);
//! assert_eq!(rounded.translation, [0.1, 0.2, 0.3_f32]);
//! assert!(Pose::from(rounded).rotation_distance(&exact) < 1e-7);
//! ```
#![allow(
    clippy::duplicate_mod,
    reason = "one source for two precisions, as types with a parameter would have no constants"
)]
#![allow(dead_code, reason = "some of it is for what is there in f64 alone")]

#[path = "../analysis/mod.rs"]
mod analysis;
mod convert;
mod generated;
#[path = "../linear/mod.rs"]
mod linear;
mod robot;
mod scalar;
#[path = "../types/mod.rs"]
mod types;

use scalar::math;

pub use analysis::{
    Ellipsoid, Manipulability, RANK_TOLERANCE, Singularities, Singularity, centering_gradient,
    null_space,
};
pub use robot::{Body, Following, Frame, Kinematics, NoSolution};
pub use scalar::Real;
pub use types::{
    Basis, FullTurns, Hessian, IntoIter, Jacobian, JointLimit, Nearest, Pose, Posture, Solution,
    Solutions, Swivel, Target, Twist, Wrench,
};

/// What generated code calls. No part of the public interface: it changes with every minor
/// version.
#[doc(hidden)]
pub mod __private {
    pub use super::generated::acceptance::Acceptance;
    pub use super::generated::arithmetic::{Arithmetic, Fused};
    pub use super::generated::batch;
    pub use super::generated::branches::Branches;
    pub use super::generated::forward::{
        BodyJacobian, Forward, GeometricJacobian, SpatialJacobian, evaluate,
    };
    pub use super::generated::free_joint::{self, FREE_BELOW, FreeJoint};
    pub use super::generated::inverse::{
        Inverse, Lanes, solve, solve_given, solve_nearest, solve_seeded,
    };
    pub use super::generated::lanes;
    pub use super::generated::locked::Locked;
    pub use super::generated::refinement::{self, AtSwivel};
    pub use super::generated::sin_cos::{SideBySide, SinCos};
    pub use super::scalar::math;
    pub use super::scalar::tolerance;
    pub use crate::{aligned, widen};
}
