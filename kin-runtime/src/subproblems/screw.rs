//! The Paden-Kahan subproblems in the form of MLS section 3.3.2: with unit twists
//! for the axes and points of space for the vectors.

use super::{SOLVED, SolutionSet, subproblem1, subproblem2, subproblem3};
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::math;
use crate::{Pose, Twist};

/// Paden-Kahan 1: t, radians in (−π, π], with e^(ξ̂ t) p = q for the unit twist
/// `xi` of zero pitch and points `p`, `q` in metres.
///
/// One solution, or infinitely many if both points lie on the axis, or none;
/// see [`subproblem1`].
///
/// ```
/// use core::f64::consts::FRAC_PI_2;
/// use kin_runtime::{Twist, subproblems::paden_kahan1};
/// let hinge = Twist::revolute([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
/// let solutions = paden_kahan1(&hinge, [0.0; 3], [1.0, -1.0, 0.0]);
/// assert_eq!(solutions.exact(), [FRAC_PI_2]);
/// ```
pub fn paden_kahan1(xi: &Twist, p: [f64; 3], q: [f64; 3]) -> SolutionSet<f64> {
    let r = point_on(xi);
    subproblem1(xi.angular, sub(p, r), sub(q, r))
}

/// Paden-Kahan 2: [t₁, t₂], radians in (−π, π], with e^(ξ̂₁ t₁) e^(ξ̂₂ t₂) p = q
/// for unit twists `xi1`, `xi2` of zero pitch whose axes meet, and points `p`,
/// `q` in metres.
///
/// Up to two solutions, infinitely many if the axes are one line or if a point
/// lies on the axis next to it; see [`subproblem2`]. Axes that pass each other
/// have no solution here: a pair computed as if they met half way is given as
/// [`SolutionSet::Closest`], with what it really leaves between the points.
///
/// ```
/// use kin_runtime::{Twist, subproblems::paden_kahan2};
/// let shoulder = [0.0, 0.0, 0.5];
/// let yaw = Twist::revolute([0.0, 0.0, 1.0], shoulder);
/// let pitch = Twist::revolute([-1.0, 0.0, 0.0], shoulder);
/// // Two ways to point at a target: straight, and over the shoulder.
/// let solutions = paden_kahan2(&yaw, &pitch, [0.0, 1.0, 0.5], [0.6, 0.0, 1.3]);
/// assert_eq!(solutions.exact().len(), 2);
/// ```
pub fn paden_kahan2(xi1: &Twist, xi2: &Twist, p: [f64; 3], q: [f64; 3]) -> SolutionSet<[f64; 2]> {
    let r = meeting_point(xi1, xi2);
    let (from, to) = (sub(q, r), sub(p, r));
    // Undone from q, the first rotation turns backwards.
    let solutions =
        subproblem2(xi1.angular, xi2.angular, from, to).map(|[back, t2]| [math::wrap(-back), t2]);
    let gap = |[t1, t2]: [f64; 2]| {
        let moved = (Pose::exp(xi1, t1) * Pose::exp(xi2, t2)).transform_point(p);
        norm(sub(moved, q))
    };
    let Some(&value) = solutions.values().first() else {
        return solutions;
    };
    let size = norm(from).max(norm(to)).max(norm(p)).max(norm(q));
    // Twice: once for the subproblem, once for the distance of the axes.
    if gap(value) <= 2.0 * SOLVED * size {
        solutions
    } else {
        SolutionSet::Closest {
            value,
            residual: gap(value),
        }
    }
}

/// Paden-Kahan 3: t, radians in (−π, π], with ‖e^(ξ̂ t) p − q‖ = δ for the unit
/// twist `xi` of zero pitch, points `p`, `q` and the distance `delta` ≥ 0 in
/// metres.
///
/// Up to two solutions, or infinitely many if one of the points lies on the
/// axis; see [`subproblem3`].
///
/// ```
/// use kin_runtime::{Twist, subproblems::paden_kahan3};
/// let elbow = Twist::revolute([-1.0, 0.0, 0.0], [0.0, 0.5, 0.0]);
/// // Upper arm 0.5 m, forearm 0.4 m, hand 0.7 m from the shoulder.
/// let solutions = paden_kahan3(&elbow, [0.0, 0.9, 0.0], [0.0; 3], 0.7);
/// assert_eq!(solutions.exact().len(), 2);
/// ```
pub fn paden_kahan3(xi: &Twist, p: [f64; 3], q: [f64; 3], delta: f64) -> SolutionSet<f64> {
    let r = point_on(xi);
    subproblem3(xi.angular, sub(p, r), sub(q, r), delta)
}

/// The point of the axis nearest to the origin, ω × v.
pub(super) fn point_on(xi: &Twist) -> [f64; 3] {
    cross(xi.angular, xi.linear)
}

/// The middle of the common perpendicular of two axes; of parallel ones, a
/// point of the first.
fn meeting_point(xi1: &Twist, xi2: &Twist) -> [f64; 3] {
    let (r1, r2) = (point_on(xi1), point_on(xi2));
    let (k1, k2) = (xi1.angular, xi2.angular);
    let normal = cross(k1, k2);
    let square = dot(normal, normal);
    if square <= super::ON_AXIS * super::ON_AXIS {
        return r1;
    }
    let between = sub(r2, r1);
    let along1 = dot(cross(between, k2), normal) / square;
    let along2 = dot(cross(between, k1), normal) / square;
    let feet = add(add(r1, scale(along1, k1)), add(r2, scale(along2, k2)));
    scale(0.5, feet)
}
