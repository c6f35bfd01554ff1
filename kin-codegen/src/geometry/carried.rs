//! Targets without the motions of locked joints at the ends of a chain.
//!
//! T = e^(ξ̂₁ q₁) ⋯ e^(ξ̂ₙ qₙ) T₀ is, with the first joint known, a chain of one joint
//! less for the target e^(−ξ̂₁ q₁) T, and with the last one known for T e^(−ξ̂ₙ' qₙ),
//! where ξₙ' is seen from the tip at home. Nothing else of the arm depends on what is
//! locked.

use super::Linkage;
use kin_runtime::{Pose, Twist};
use std::ops::Range;

/// The twists of the locked joints of a linkage that stand at its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// Of those in front of all joints that are not locked, from the base; in base
    /// coordinates.
    pub front: Vec<Twist>,
    /// Of those behind, from the first to the tip; in the coordinates of the tip.
    pub behind: Vec<Twist>,
    /// How many joints are locked, at the ends and between.
    count: usize,
}

impl Carried {
    /// Of the locked joints at the ends; others are not seen.
    pub fn new(linkage: &Linkage) -> Self {
        let n = linkage.links.len();
        let is_locked = |joint: &usize| linkage.locked.contains(joint);
        let front = (0..n).take_while(is_locked).count();
        let behind = (front..n).rev().take_while(is_locked).count();
        let tip = linkage.tip_home();
        let seen = |joint| tip.adjoint_inverse(&linkage.twist(joint));
        Self {
            front: (0..front).map(|joint| linkage.twist(joint)).collect(),
            behind: (n - behind..n).map(seen).collect(),
            count: linkage.locked.len(),
        }
    }

    /// Which of the locked joints stand between joints that are not locked, by their places
    /// among the locked ones.
    pub fn between(&self) -> Range<usize> {
        self.front.len()..self.count - self.behind.len()
    }

    /// The target of the joints in between, from the values of all locked ones.
    pub fn target(&self, target: &Pose, parameters: &[f64]) -> Pose {
        let between = self.between();
        let front = self.front.iter().zip(parameters);
        let behind = self.behind.iter().zip(&parameters[between.end..]).rev();
        let carried = front.fold(*target, |target, (twist, &q)| Pose::exp(twist, -q) * target);
        behind.fold(carried, |target, (twist, &q)| target * Pose::exp(twist, -q))
    }
}
