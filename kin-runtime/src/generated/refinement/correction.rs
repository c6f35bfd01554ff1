//! Branches that rounding keeps from their target, or that the arm is off its design.
//!
//! Where two roots meet, an angle is known to the square root of rounding only,
//! and what follows from it misses the target by as much. A step of Newton's
//! method makes up for that; it is damped, because these are singular
//! configurations (see [`levenberg`]).

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::scalar::{Real, tolerance};
use super::super::super::{Jacobian, Pose, Solution, Solutions, math};
use super::levenberg::{Arrived, arrive, levenberg};
use super::linearization::{Linearization, Problem};

/// Evaluations at most; a regular branch of an exact arm takes two.
const STEPS: usize = 12;

/// The same of branches of an arm's design.
const STEPS_OF_DESIGN: usize = 60;

/// The same from a seed: most take four, some beside a fold, where each halves what is left, many.
const STEPS_FROM_SEED: usize = 40;

/// A seed that misses the target by no more, in units of the arm's size, is taken to be beside a solution.
const BESIDE: Real = 2e-2;

/// How far the joints move, radians and metres, for a tip that moves by one in units of the arm's size;
/// near singularities they move farther.
const FAR: Real = 100.0;

/// What misses its target by no more, in units of the arm's size, does so by rounding alone.
const REACHED: Real = 10.0 * tolerance::ROUNDING;

/// The branches that reach their target, those that nearly do after a
/// correction; of singular ones those that are next to `seed`.
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
        let linearize = |q| Linearization::new(q, problem);
        stay_at_seed(solutions, seed, linearize, Some, accept);
    })
}

/// A singular solution stands for its neighbours as well, which rounding does not tell apart. Where none
/// is next to a seed that all but reaches the target, the one to which Levenberg's method leads from there
/// takes the place of the nearest; `finished` tells whether it is one.
#[inline(never)]
pub(super) fn stay_at_seed<const N: usize, const R: usize>(
    solutions: &mut Solutions<N>,
    seed: &[Real; N],
    linearize: impl Fn([Real; N]) -> Linearization<N, R>,
    finished: impl Fn(Arrived<N>) -> Option<Arrived<N>>,
    accept: &Acceptance,
) {
    if solutions.iter().all(|it| !it.singular) {
        return;
    }
    let missed = linearize(*seed).residual;
    let is_near = |it: &Solution<N>| it.singular && is_next_to(&it.q, seed, missed, accept.size);
    let is_beside = missed <= BESIDE * accept.size;
    if !is_beside || solutions.iter().any(is_near) {
        return;
    }
    let Some(there) = finished(arrive(linearize, accept.size, *seed, STEPS_FROM_SEED)) else {
        return;
    };
    let q = wrapped(there.q, accept);
    let singular = (0..solutions.len()).filter(|&place| solutions[place].singular);
    let apart = |place: usize| solutions.squared_distance(&solutions[place].q, &q);
    // Of two that mirror each other, as near as rounding tells, the first.
    let nearer = |one, other| match apart(other) < 0.9 * apart(one) {
        true => other,
        false => one,
    };
    let Some(nearest) = singular.reduce(nearer) else {
        return;
    };
    let moved = |q: &[Real; N]| solutions.squared_distance(q, seed);
    let known = solutions.place_of(&q);
    // One that is known may be a whole turn away, which limits may leave no other answer than.
    if there.singular
        && there.residual <= REACHED * accept.size
        && moved(&q) <= moved(&solutions[nearest].q)
        && known.is_none_or(|known| known == nearest)
    {
        solutions.replace(nearest, q, there.residual);
    }
}

/// Whether a solution is no farther from a seed, radians and metres, than what this misses the target by,
/// metres, accounts for in an arm of this size.
#[inline(always)]
pub(crate) fn is_next_to<const N: usize>(
    q: &[Real; N],
    seed: &[Real; N],
    missed: Real,
    size: Real,
) -> bool {
    let far = tolerance::SAME + missed * (FAR / size);
    let mut square = 0.0;
    for i in 0..N {
        square += (q[i] - seed[i]) * (q[i] - seed[i]);
    }
    square <= far * far
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
