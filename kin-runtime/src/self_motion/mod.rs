//! Self-motion manifolds: what a redundant arm can do while its tip rests.
//!
//! The configurations that reach one target form, at a regular point of an arm
//! with one joint more than the target asks for, a curve. It has components
//! between which the arm cannot pass without moving the tip (J. W. Burdick,
//! "On the inverse kinematics of redundant manipulators", 1989). They are
//! followed here by prediction along the internal motion and correction back.

mod component;
mod fixed_tip;
mod options;
mod trace;

pub use component::{SelfMotion, SelfMotions, self_motion, self_motions};
pub use options::{SelfMotionError, SelfMotionOptions, Stop};
