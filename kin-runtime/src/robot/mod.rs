//! What a serial arm offers, and the same with a tool or on another base.

mod inherent;
mod kinematics;
mod placement;

pub use kinematics::Kinematics;
pub use placement::{WithBase, WithTool};
