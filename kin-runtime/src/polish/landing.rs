//! All branches of a snapped arm, landed on the literal one.

use super::curve::follow;
use super::place::Problem;
use super::settle::settle;
use super::{Polished, polish};
use crate::branches::Acceptance;
use crate::{Jacobian, Pose, Solution, Solutions, math};

/// How far the miss along a curve is followed, in multiples of the blur.
const REACH: f64 = 2.0;

/// Lands every branch on the literal arm. Where the Jacobian is as near to
/// losing rank as the arms differ, the branches of the snapped arm do not tell
/// how many solutions there are, and all others are looked for on the curve
/// through the one that was found.
pub fn land<const N: usize>(
    problem: &Problem<impl Fn(&[f64; N]) -> (Pose, Jacobian<N>)>,
    starts: impl Iterator<Item = Solution<N>>,
    accept: &Acceptance,
    steps: usize,
) -> Solutions<N> {
    Solutions::build_with_prismatic(accept.prismatic, |solutions| {
        // Bit i is set where the curve through solution i was followed.
        let mut followed = 0_u32;
        for start in starts {
            let landed = polish(problem, start.q, steps);
            let place = insert(solutions, &start, &landed, accept);
            let known = place.is_some_and(|i| followed >> i & 1 == 1);
            if landed.independence >= accept.blur || known {
                continue;
            }
            let mut follow_from = |from: &Polished<N>| {
                if let Some(i) = insert(solutions, &start, from, accept) {
                    followed |= 1 << i;
                }
                follow(problem, from.q, from.weak, REACH * accept.blur, |q| {
                    let landed = polish(problem, q, steps);
                    if let Some(i) = insert(solutions, &start, &landed, accept) {
                        followed |= 1 << i;
                    }
                });
            };
            follow_from(&landed);
            if place.is_none() {
                // Newton's method has left the branch, or has got stuck.
                follow_from(&polish(problem, start.q, 1));
                follow_from(&settle(problem, start.q));
            }
        }
    })
}

/// Where the solution is among the others; none if it is none.
fn insert<const N: usize>(
    solutions: &mut Solutions<N>,
    start: &Solution<N>,
    landed: &Polished<N>,
    accept: &Acceptance,
) -> Option<usize> {
    if landed.residual > accept.tolerance || landed.residual.is_nan() {
        return None;
    }
    let q = core::array::from_fn(|i| {
        let slides = accept.prismatic >> i & 1 == 1;
        math::select(slides, landed.q[i], math::wrap(landed.q[i]))
    });
    solutions.insert_distinct(Solution {
        q,
        residual: landed.residual,
        singular: landed.singular(),
        ..*start
    })
}
