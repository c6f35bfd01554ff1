//! What a serial arm offers, in `f32`.

#[path = "../robot/frame.rs"]
mod frame;
#[path = "../robot/kinematics.rs"]
mod kinematics;
#[path = "../robot/no_solution.rs"]
mod no_solution;

pub use frame::{Body, Following, Frame};
pub use kinematics::Kinematics;
pub use no_solution::NoSolution;
