//! Numbers: elementary functions without branches, and the roots of quartics.

pub mod math;
pub mod quartic;
