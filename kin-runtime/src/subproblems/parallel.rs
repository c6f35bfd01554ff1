//! The parallel pair: a planar arm of two links.

use super::radial::{Radial, toward, turned};
use super::screw::point_on;
use super::{ON_AXIS, SOLVED, SolutionSet, subproblem3};
use crate::linear::vector::{add, dot, norm, scale, sub};
use crate::math;
use crate::{Pose, Twist};

/// Rotation about two parallel axes: [t₁, t₂], radians in (−π, π], with
/// e^(ξ̂₁ t₁) e^(ξ̂₂ t₂) p = q for unit twists `xi1`, `xi2` of zero pitch whose
/// axes are parallel, in the same or in opposite directions, and points `p`,
/// `q` in metres.
///
/// Up to two solutions, elbow to one side and to the other; one with the arm
/// stretched or folded. Infinitely many if q lies on the first axis, p on the
/// second, or the axes are one line, provided that the equation can be solved;
/// the free angle is given as 0. If the points differ in height or q is out of
/// reach, the pair that comes closest. Axes that are not parallel have no
/// solution here: a pair computed as if the second were is given as
/// [`SolutionSet::Closest`], with what it really leaves between the points, and only
/// if it leaves nothing as [`SolutionSet::Exact`].
///
/// Subproblem 3 for t₂, in the plane that the axes are normal to, then
/// [`subproblem1`](super::subproblem1) for t₁ (MLS section 3.3, where the same is said of an elbow).
/// Roots are accurate to rounding over the slope, a stretched arm's to the
/// square root of rounding where it is not quite stretched.
///
/// ```
/// use kin_runtime::{Twist, subproblems::parallel_pair};
/// let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
/// let (shoulder, elbow) = (Twist::revolute(z, [0.0; 3]), Twist::revolute(z, x));
/// // Links 1 and 0.5, the hand to (0.5, 1).
/// let solutions = parallel_pair(&shoulder, &elbow, [1.5, 0.0, 0.0], [0.5, 1.0, 0.0]);
/// assert_eq!(solutions.exact().len(), 2);
/// ```
pub fn parallel_pair(xi1: &Twist, xi2: &Twist, p: [f64; 3], q: [f64; 3]) -> SolutionSet<[f64; 2]> {
    let (r1, r2) = (point_on(xi1), point_on(xi2));
    let size = [p, q, r1, r2].map(norm).into_iter().fold(0.0, f64::max);
    let solutions = planar(xi1, xi2, [sub(r2, r1), sub(p, r2), sub(q, r1)], size);
    // What the plane does not show: heights, and axes that are not parallel.
    let Some(&value) = solutions.values().first() else {
        return solutions;
    };
    let moved = (Pose::exp(xi1, value[0]) * Pose::exp(xi2, value[1])).transform_point(p);
    let residual = norm(sub(moved, q));
    if residual.is_nan() {
        SolutionSet::None
    } else if residual > 2.0 * SOLVED * size {
        SolutionSet::Closest { value, residual }
    } else {
        solutions
    }
}

/// The pair in the plane that the axes are normal to.
fn planar(xi1: &Twist, xi2: &Twist, links: [[f64; 3]; 3], size: f64) -> SolutionSet<[f64; 2]> {
    let k = xi1.angular;
    let [upper, forearm, reach] = links.map(|v| Radial::new(k, v).across);
    let vanishes = |v| norm(v) <= ON_AXIS * size;
    // The second axis points the same way or the other.
    let sense = if dot(k, xi2.angular) < 0.0 { -1.0 } else { 1.0 };
    let with_shoulder = |t2| {
        let hand = add(upper, turned(k, t2, forearm));
        let t1 = if vanishes(reach) {
            0.0
        } else {
            toward(k, hand, reach)
        };
        [t1, math::wrap(sense * t2)]
    };
    if vanishes(upper) || vanishes(forearm) {
        return SolutionSet::Any(with_shoulder(0.0));
    }
    let solutions = subproblem3(k, forearm, scale(-1.0, upper), norm(reach)).map(with_shoulder);
    match solutions {
        SolutionSet::Exact(roots) if vanishes(reach) => SolutionSet::Any(roots[0]),
        other => other,
    }
}
