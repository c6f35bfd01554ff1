//! What a serial arm offers, and the same with a tool or on another base.

mod define;
mod follow;
mod frame;
mod inherent;
mod kinematics;
mod methods;
#[cfg(feature = "rayon")]
mod multithreaded;
mod no_solution;
mod placement;
mod redundant;
mod several;

pub(crate) use define::define_kinematics;
pub use follow::{Follow, PathStep};
pub use frame::{Body, Following, Frame};
pub use kinematics::Kinematics;
#[cfg(feature = "rayon")]
pub use multithreaded::Multithreaded;
pub use no_solution::NoSolution;
pub use placement::{WithBase, WithTool};
pub use redundant::{Parameter, RedundantKinematics};
pub use several::{Along, HighlyRedundantKinematics};
