//! The last resort of the plan: one joint is kept, all others are eliminated.

mod arm;
mod choose;
mod eliminate;
mod fold;
mod frames;
mod order;
mod turning;

pub use arm::Arm;
pub use choose::{Kept, MOST, choose};
pub use eliminate::eliminate;
pub use frames::{Family, frames};
