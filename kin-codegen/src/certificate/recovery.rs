//! Whether a configuration is among the solutions to its target.

use super::Failure;
use crate::closed_form::BranchSolution;
use crate::model::Model;

/// The configuration is among the solutions, to what its conditioning allows,
/// and no solution comes twice.
///
/// # Errors
///
/// Which of the two does not hold.
pub fn recovered(
    model: &Model,
    q: &[f64],
    solutions: &[BranchSolution],
    conditioning: f64,
) -> Result<(), Failure> {
    let to = model.scalar.tolerances();
    let tolerance = (to.recovered / conditioning.powi(2)).clamp(to.same, to.different);
    if !is_among(model, q, solutions, tolerance) {
        return Err(Failure::Lost(q.to_vec()));
    }
    for (i, a) in solutions.iter().enumerate() {
        if is_among(model, &a.q, &solutions[..i], to.same) {
            return Err(Failure::Doubled(q.to_vec()));
        }
    }
    Ok(())
}

pub(super) fn is_among(
    model: &Model,
    q: &[f64],
    solutions: &[BranchSolution],
    tolerance: f64,
) -> bool {
    let same = |a: &[f64]| (0..q.len()).all(|i| model.joint_distance(i, a[i], q[i]) < tolerance);
    solutions.iter().any(|solution| same(&solution.q))
}
