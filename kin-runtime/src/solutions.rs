//! The answer of inverse kinematics: all branches, without allocation.

/// One configuration that reaches the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<const N: usize> {
    /// Joint values: radians in (−π, π] for revolute joints, metres for
    /// prismatic ones.
    pub q: [f64; N],
    /// How far the forward kinematics of `q` is from the target: the largest
    /// of the translation error (metres) and the rotation error (radians
    /// times the arm's size, metres).
    pub residual: f64,
    /// Which combination of the plan's choices this is; the rustdoc of the
    /// robot names them. Stable along a path that crosses no singularity.
    pub branch: u32,
    /// The Jacobian loses rank here: `q` stands for a family of solutions, or
    /// for two that have met.
    pub singular: bool,
}
/// All solutions of one target.
#[derive(Clone, Copy, Debug)]
pub struct Solutions<const N: usize> {
    items: [Solution<N>; 16],
    len: usize,
}
impl<const N: usize> Solutions<N> {
    /// The solutions found, in order of their branch.
    pub fn iter(&self) -> core::slice::Iter<'_, Solution<N>> {
        self.items[..self.len].iter()
    }
}
