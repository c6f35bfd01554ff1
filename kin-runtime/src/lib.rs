//! The run-time half of the kinematics compiler.
//!
//! Generated robots lean on the types and the branch-free numerics of this
//! crate; nothing they use allocates or needs `std`. The same mathematics for a
//! chain that is known only at run time checks them.
//!
//! Notation and conventions are those of Murray, Li and Sastry, "A Mathematical
//! Introduction to Robotic Manipulation", 1994, here called MLS: twists are
//! (v, ω), poses take tip coordinates to base coordinates. Units are metres
//! and radians.
//!
//! | feature | adds |
//! |---|---|
//! | `alloc` | `Chain`, the generic product of exponentials, its numerical search, self-motions, `Mechanism`, `ik_path`, and the intervals of a parameter (`feasible`, `ik_best`) |
//! | `std` (default) | the processor's square root instead of `libm`'s; implies `alloc` |
//! | `nalgebra` (default), `glam`, `mint` | conversions |
//! | `rayon` | batches on all cores; implies `std` |
//! | `serde` | serialization, see below; without an allocator |
//!
//! # Serialized
//!
//! The form is that of the types: fields by their names, radians and metres, arrays of fixed
//! length, numbers to the last bit where the format keeps them, as `serde_json` does with its feature
//! `float_roundtrip`.
//!
//! | | in JSON |
//! |---|---|
//! | [`Pose`] | `{"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "translation": [0, 0, 0.5]}` |
//! | [`Twist`], [`Wrench`] | `{"linear": [0, 0, 0], "angular": [0, 0, 1]}`, `{"force": .., "moment": ..}` |
//! | [`Jacobian`] | `{"rows": [[..], ..]}`, six of N numbers |
//! | [`Solution`] | `{"q": [..], "residual": 0, "branch": 3, "singular": false}` |
//! | [`Solutions`] | a sequence of these; to be read into any collection |
//! | [`JointLimit`] | `{"revolute": {"lower": -1, "upper": null}}`, also `prismatic`; `"continuous"`; `null` where there is no stop. Both are there, the lower one not above the upper |
//! | [`Target`] | its word in options: `"position_axis"` |
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod analysis;
#[cfg(feature = "alloc")]
mod continuation;
mod convert;
#[cfg(feature = "alloc")]
mod feasible;
mod generated;
#[cfg(feature = "alloc")]
mod generic;
mod linear;
mod parallel;
#[cfg(feature = "alloc")]
mod path;
mod robot;
mod scalar;
#[cfg(feature = "alloc")]
mod self_motion;
pub mod single;
pub mod subproblems;
mod types;
#[cfg(feature = "alloc")]
mod workspace;

use parallel::define_parallel_kinematics;
use robot::define_kinematics;
use scalar::math;

pub use analysis::{
    Ellipsoid, Manipulability, RANK_TOLERANCE, Singularities, Singularity, centering_gradient,
    null_space,
};
#[cfg(feature = "alloc")]
pub use feasible::{Criterion, FeasibleInterval};
#[cfg(feature = "alloc")]
pub use generic::{Chain, ChainSolution, Mechanism, SearchOptions};
pub use parallel::{ParallelKinematics, Postures};
#[cfg(feature = "alloc")]
pub use path::{BranchEnd, NoPath, Path, ik_path, least_motion};
#[cfg(feature = "rayon")]
pub use robot::Multithreaded;
pub use robot::{
    Along, Body, Follow, Following, Frame, HighlyRedundantKinematics, Kinematics, NoSolution,
    Parameter, PathStep, RedundantKinematics, WithBase, WithTool,
};
pub use scalar::Real;
#[cfg(feature = "alloc")]
pub use self_motion::{
    SelfMotion, SelfMotionError, SelfMotionOptions, SelfMotions, Stop, self_motion, self_motions,
};
pub use types::{
    Basis, FullTurns, Hessian, IntoIter, Jacobian, JointLimit, Nearest, Pose, Posture, Solution,
    Solutions, Swivel, Target, Twist, Wrench,
};
#[cfg(feature = "alloc")]
pub use workspace::{Workspace, WorkspaceMethod, scattered_rotations};

/// What generated code calls, and the compiler that checks it. No part of the
/// public interface: it changes with every minor version.
#[doc(hidden)]
pub mod __private {
    pub use crate::generated::acceptance::{Acceptance, Completion};
    pub use crate::generated::arithmetic::{Arithmetic, Fused};
    pub use crate::generated::arrays;
    pub use crate::generated::batch;
    pub use crate::generated::branches::Branches;
    pub use crate::generated::dispatch::{self, Dispatched, dispatch};
    pub use crate::generated::forward::{
        BodyJacobian, Forward, GeometricJacobian, SpatialJacobian, evaluate,
    };
    pub use crate::generated::free_joint::{self, FREE_BELOW, FreeJoint};
    pub use crate::generated::inverse::{
        Inverse, Lanes, solve, solve_given, solve_nearest, solve_seeded,
    };
    pub use crate::generated::lanes;
    pub use crate::generated::locked::Locked;
    pub use crate::generated::refinement::{self, AtSwivel};
    pub use crate::generated::reproducible;
    pub use crate::generated::sin_cos::{SideBySide, SinCos};
    pub use crate::generated::univariate::{
        self, Between, Eliminant, Elimination, Frames, Univariate,
    };
    pub use crate::linear::singular_values::SingularValues;
    pub use crate::linear::span::Span;
    pub use crate::parallel::three_spheres;
    #[cfg(feature = "alloc")]
    pub use crate::path::Joints;
    pub use crate::scalar::math;
    pub use crate::scalar::quartic::{self, trig_roots};
    pub use crate::scalar::tolerance;
    pub use crate::types::projection::Projection;
    pub use crate::{
        aligned, generated_by, implement_kinematics, inherent_parallel_methods, widen,
    };
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
