//! The scalar, and what depends on its precision.

#[path = "math.rs"]
pub mod math;
#[path = "tolerance.rs"]
pub mod tolerance;

pub use core::f32::consts;
pub use math::{angle, angle_of_unit};

/// The scalar of quantities: `f32`.
pub type Real = f32;
