//! Numbers: the scalar and what depends on its precision, elementary functions without
//! branches, and the roots of quartics.
//!
//! What is compiled for both precisions names the scalar [`Real`] and takes functions and
//! tolerances from here; `single` has its own in their place.

pub(crate) mod angle;
#[cfg(feature = "alloc")]
pub(crate) mod golden_section;
pub mod math;
pub mod quartic;
pub mod tolerance;

pub use angle::{angle, angle_of_unit};
pub use core::f64::consts;

/// The scalar of quantities: `f64`, and `f32` in [`single`](crate::single).
pub type Real = f64;
