//! What every generated robot can do.
/// Placeholder.
pub trait Kinematics<const N: usize> {}
