//! Chains and mechanisms that are known only at run time, and their inverse
//! kinematics by numerical search: what generated code is checked against.

mod assembly_modes;
pub(crate) mod chain;
mod characteristic_length;
mod descent;
mod given;
mod half_plane;
mod mechanism;
mod neighbours;
mod search;
mod starts;

pub use chain::Chain;
pub use mechanism::Mechanism;
pub use search::{ChainSolution, SearchOptions};
