//! What comes nearest to targets out of reach.

use super::{ClosedForm, Inverse};
use kin_runtime::{Pose, Solution};

impl ClosedForm {
    /// A solution, or for a target out of reach what comes nearest, with its distance as the
    /// residual; none if the target is not a number. The arm is given by its forward kinematics.
    pub fn approximate<const N: usize>(
        &self,
        target: &Pose,
        fk: impl Fn(&[f64; N]) -> Pose,
    ) -> Option<Solution<N>> {
        if let Inverse::Univariate(arm) = &self.inverse {
            return arm.closest(target);
        }
        let counts = self.plan.target;
        let projection = self.projection();
        let seen = projection.target(target);
        let exact = self.is_exact();
        let reached = || self.solved::<N>(target, &[]).first().copied();
        let solution = if exact { None } else { reached() };
        solution.or_else(|| {
            let distance = |solution: &Solution<N>| match exact && counts.is_projected() {
                true => solution.residual,
                false => {
                    let tip = projection.pose(&fk(&solution.q));
                    counts.distance(&tip, &seen, self.linkage.size)
                }
            };
            let mut nearest = None;
            let mut least = f64::INFINITY;
            for (exists, solution) in self.all_branches(target, &[], &[0.0; N]) {
                let residual = distance(&solution);
                // One that repeats another is no solution, however near it comes.
                let counted = match !exists && residual < self.acceptance().tolerance {
                    true => self.acceptance().tolerance,
                    false => residual,
                };
                if counted < least {
                    least = counted;
                    nearest = Some(Solution {
                        residual,
                        ..solution
                    });
                }
            }
            nearest
        })
    }
}
