//! Robots whose files are read while the program runs.
//!
//! The same compiler as behind the macro, up to its expressions: they run as a tape over array
//! lanes in place of generated code, and give what it gives.

mod answers;
mod arm;
mod batch;
mod forward;
mod inverse;
mod load;
mod motion;
mod of_joints;
mod posture;
mod redundant;

pub use answers::{Answer, Answers};
pub use arm::{Arm, OfSlices};
pub use load::Robot;
pub use posture::NamedPosture;
pub use redundant::{AlongParameter, Interval};
