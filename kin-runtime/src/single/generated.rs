//! What generated code calls, in `f32`.

#[path = "../generated/acceptance.rs"]
pub mod acceptance;
#[path = "../generated/arithmetic.rs"]
pub mod arithmetic;
#[path = "../generated/batch/mod.rs"]
pub mod batch;
#[path = "../generated/branches.rs"]
pub mod branches;
#[path = "../generated/forward.rs"]
pub mod forward;
#[path = "../generated/free_joint.rs"]
pub mod free_joint;
#[path = "../generated/inverse.rs"]
pub mod inverse;
#[path = "../generated/lanes.rs"]
pub mod lanes;
#[path = "../generated/locked.rs"]
pub mod locked;
#[path = "../generated/refinement/mod.rs"]
pub mod refinement;
#[path = "../generated/sin_cos.rs"]
pub mod sin_cos;

pub use crate::generated::dispatch;
