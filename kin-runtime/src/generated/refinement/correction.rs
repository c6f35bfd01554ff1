//! Branches that rounding keeps from their target, or that the arm is off its design.
//!
//! Where two roots meet, an angle is known to the square root of rounding only,
//! and what follows from it misses the target by as much. A step of Newton's
//! method makes up for that; it is damped, because these are singular
//! configurations (see [`levenberg`]).

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::scalar::{Real, tolerance};
use super::super::super::{Jacobian, Pose, Solution, Solutions, math};
use super::levenberg::{Arrived, levenberg};
use super::linearization::Problem;

/// Evaluations at most; a regular branch of an exact arm takes two.
const STEPS: usize = 12;

/// The same of branches of an arm's design.
const STEPS_OF_DESIGN: usize = 60;

/// The branches that reach their target, those that nearly do after a
/// correction; where one is singular, `seed` may be as well.
pub fn correct_branches<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    branches: impl Iterator<Item = Solution<N>> + Clone,
    seed: &[Real; N],
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
            if found.residual <= accept.tolerance {
                solutions.insert_distinct(Solution {
                    q: wrapped(found.q, accept),
                    residual: found.residual,
                    // Of a design it says where the arm may be singular.
                    singular: found.singular || branch.singular && !accept.is_of_design(),
                    ..branch
                });
            }
        }
        if solutions.iter().any(|it| it.singular) {
            stay_at_seed(solutions, levenberg(problem, *seed, 0), accept);
        }
    })
}

/// A singular solution stands for its neighbours as well, which rounding does not tell apart: if the seed
/// is one that reaches the target, it takes the place of the nearest.
pub(super) fn stay_at_seed<const N: usize>(
    solutions: &mut Solutions<N>,
    seed: Arrived<N>,
    accept: &Acceptance,
) {
    let q = wrapped(seed.q, accept);
    let singular = (0..solutions.len()).filter(|&place| solutions[place].singular);
    let apart = |place: &usize| solutions.squared_distance(&solutions[*place].q, &q);
    let Some(nearest) = singular.min_by(|a, b| apart(a).total_cmp(&apart(b))) else {
        return;
    };
    let reached = math::max(
        solutions[nearest].residual,
        tolerance::ROUNDING * accept.size,
    );
    let known = solutions.place_of(&q);
    // One that is known may be a whole turn away, which limits may leave no other answer than.
    if seed.singular && seed.residual <= reached && known.is_none_or(|known| known == nearest) {
        solutions.replace(nearest, q, seed.residual);
    }
}

/// Angles in (−π, π].
fn wrapped<const N: usize>(q: [Real; N], accept: &Acceptance) -> [Real; N] {
    core::array::from_fn(|i| {
        let slides = accept.prismatic >> i & 1 == 1;
        math::select(slides, q[i], math::wrap(q[i]))
    })
}

/// Evaluations at most.
pub(super) fn steps(accept: &Acceptance) -> usize {
    match accept.is_of_design() {
        true => STEPS_OF_DESIGN,
        false => STEPS,
    }
}
