//! What a Jacobian tells of one configuration (MLS section 3.4): singularities
//! and how far they are, forces, internal motions, joint rates.

mod manipulability;
mod redundancy;
mod resolved_rate;
mod singularity;
mod statics;

pub use manipulability::{Ellipsoid, Manipulability};
pub use redundancy::{centering_gradient, null_space};
pub use singularity::{Singularities, Singularity};
pub use statics::RANK_TOLERANCE;
