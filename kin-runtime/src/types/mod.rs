//! The quantities of rigid-body kinematics: poses, twists, wrenches, Jacobians,
//! and what is said of joints, targets and solutions.

mod basis;
mod exponential;
mod full_turns;
pub(crate) mod hessian;
mod jacobian;
mod limits;
pub(crate) mod nearest;
mod orientation;
mod pose;
mod posture;
pub(crate) mod projection;
mod solutions;
mod swivel;
mod target;
pub(crate) mod travel;
mod twist;
mod wrench;

pub use basis::Basis;
pub use full_turns::FullTurns;
pub use hessian::Hessian;
pub use jacobian::Jacobian;
pub use limits::JointLimit;
pub use nearest::Nearest;
pub use pose::Pose;
pub use posture::Posture;
pub use solutions::{IntoIter, Solution, Solutions};
pub use swivel::Swivel;
pub use target::Target;
pub use twist::Twist;
pub use wrench::Wrench;
