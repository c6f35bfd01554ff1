//! Branches that rounding keeps from their target, or that the arm is off its design.
//!
//! Where two roots meet, an angle is known to the square root of rounding only,
//! and what follows from it misses the target by as much. A step of Newton's
//! method makes up for that; it is damped, because these are singular
//! configurations (see [`levenberg`]).

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose, Solution, Solutions, math};
use super::levenberg::levenberg;
use super::linearization::Problem;

/// Evaluations at most; a regular branch of an exact arm takes two.
const STEPS: usize = 12;

/// The same of branches of an arm's design.
const STEPS_OF_DESIGN: usize = 60;

/// The branches that reach their target, those that nearly do after a
/// correction.
pub fn correct_branches<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    branches: impl Iterator<Item = Solution<N>> + Clone,
    accept: &Acceptance,
) -> Solutions<N> {
    let reaches = |branch: &Solution<N>| branch.residual <= accept.taken;
    let nearly = |branch: &Solution<N>| branch.residual <= accept.nearly;
    Solutions::build_with_prismatic(accept.prismatic, |solutions| {
        for branch in branches.clone().filter(reaches) {
            solutions.push_if(true, branch);
        }
        if problem.target.rotation_error() * accept.size > accept.tolerance {
            return;
        }
        for branch in branches.filter(|branch| !reaches(branch) && nearly(branch)) {
            let found = levenberg(problem, branch.q, steps(accept));
            let q = core::array::from_fn(|i| {
                let slides = accept.prismatic >> i & 1 == 1;
                math::select(slides, found.q[i], math::wrap(found.q[i]))
            });
            if found.residual <= accept.tolerance {
                solutions.insert_distinct(Solution {
                    q,
                    residual: found.residual,
                    // Of a design it says where the arm may be singular.
                    singular: found.singular || branch.singular && !accept.is_of_design(),
                    ..branch
                });
            }
        }
    })
}

/// Evaluations at most.
pub(super) fn steps(accept: &Acceptance) -> usize {
    match accept.is_of_design() {
        true => STEPS_OF_DESIGN,
        false => STEPS,
    }
}
