//! The quantities of rigid-body kinematics: poses, twists, wrenches, Jacobians,
//! and what is said of joints, targets and solutions.

mod basis;
mod exponential;
pub(crate) mod hessian;
mod jacobian;
mod limits;
mod orientation;
mod pose;
mod solutions;
mod target;
mod twist;
mod wrench;

pub use basis::Basis;
pub use hessian::Hessian;
pub use jacobian::Jacobian;
pub use limits::JointLimit;
pub use pose::Pose;
pub use solutions::{IntoIter, Solution, Solutions, Windings};
pub use target::Target;
pub use twist::Twist;
pub use wrench::Wrench;
