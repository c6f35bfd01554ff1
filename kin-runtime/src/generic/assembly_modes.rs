//! All assembly modes of a small mechanism.

use alloc::{vec, vec::Vec};
use core::f64::consts::PI;

use super::mechanism::Mechanism;
use super::starts::{Effort, Starts};
use crate::math;

const EFFORT: Effort = Effort {
    first: 64,
    stable_doublings: 2,
    most: 1 << 13,
};
/// Configurations are the same if no joint differs by more.
const SAME: f64 = 1e-6;

impl Mechanism {
    /// All real assembly modes with the given values of the actuated joints, by
    /// Newton's method from starts that fill the space of the passive joints
    /// evenly, until doubling their number has found nothing new twice: complete
    /// with high probability for mechanisms of up to six or so passive joints,
    /// not with certainty, and always the same. In the order of their first
    /// joint values, angles in (−π, π].
    ///
    /// # Panics
    /// If there is not one value for each actuated joint.
    pub fn assembly_modes(&self, actuated: &[f64]) -> Vec<Vec<f64>> {
        let n = self.joints();
        let passive: Vec<usize> = (0..n).filter(|i| !self.actuated().contains(i)).collect();
        let mut starts = Starts::new(passive.iter().map(|&i| self.range(i)).collect());
        let mut start = vec![0.0; n];
        let mut found: Vec<Vec<f64>> = Vec::new();
        EFFORT.search(|| {
            for (&i, value) in passive.iter().zip(starts.next()) {
                start[i] = *value;
            }
            if let Some(mut q) = self.fk_near(actuated, &start) {
                (0..n).for_each(|i| q[i] = self.reduced(i, q[i]));
                if !found.iter().any(|other| self.same(other, &q)) {
                    found.push(q);
                }
            }
            Some(found.len())
        });
        found.sort_by(|a, b| a.partial_cmp(b).unwrap_or(core::cmp::Ordering::Equal));
        found
    }

    /// Half the width of what a joint's starts fill.
    fn range(&self, joint: usize) -> f64 {
        if self.is_prismatic(joint) {
            2.0 * self.length()
        } else {
            PI
        }
    }

    fn reduced(&self, joint: usize, value: f64) -> f64 {
        if self.is_prismatic(joint) {
            value
        } else {
            math::wrap(value)
        }
    }

    fn same(&self, a: &[f64], b: &[f64]) -> bool {
        (0..a.len()).all(|i| self.reduced(i, a[i] - b[i]).abs() <= SAME)
    }
}
