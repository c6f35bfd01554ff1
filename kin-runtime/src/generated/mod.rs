//! What generated code calls. It is no part of the public interface:
//! [`generated_by`](crate::generated_by) holds generated code to the version
//! of the compiler that this is made for.

pub mod acceptance;
pub mod arithmetic;
pub mod arrays;
pub mod batch;
pub mod branches;
pub mod dispatch;
pub mod forward;
pub mod free_joint;
pub mod inverse;
pub mod lanes;
pub mod locked;
pub mod refinement;
pub mod reproducible;
pub mod sin_cos;
pub mod univariate;
mod version;
