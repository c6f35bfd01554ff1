//! Subproblems whose unknown is a translation.

use super::{DOUBLE, ON_AXIS, SOLVED, SolutionSet};
use crate::linear::vector::{dot, norm, scale, sub};
use crate::math;

/// Translation to a given distance: t, metres, with ‖p + t v − q‖ = d for the
/// unit vector `v`, points `p` and `q` and the distance d ≥ 0, all in metres.
///
/// Up to two solutions, the smaller first; one where the line of motion
/// touches the sphere about `q`; otherwise the foot of the perpendicular from
/// `q`, with how far its distance is from `d`. Never infinitely many.
///
/// ```
/// use kin_runtime::subproblems::translation1;
/// let solutions = translation1([1.0, 0.0, 0.0], [0.0; 3], [4.0, 3.0, 0.0], 5.0);
/// assert_eq!(solutions.exact(), [0.0, 8.0]);
/// ```
pub fn translation1(v: [f64; 3], p: [f64; 3], q: [f64; 3], d: f64) -> SolutionSet<f64> {
    let to_goal = sub(q, p);
    let foot = dot(v, to_goal);
    let height = norm(sub(to_goal, scale(foot, v)));
    let size = norm(to_goal) + d.abs();
    // d < 0 leaves a negative excess, hence no solution.
    let excess = d - height;
    if excess <= DOUBLE * size {
        return SolutionSet::one_or_closest(foot, (-excess).max(0.0), SOLVED * size);
    }
    let half_chord = math::sqrt(excess * (d + height));
    SolutionSet::two(foot - half_chord, foot + half_chord)
}

/// Translation to a given component: t, metres, with h · (p + t v) = d for the
/// unit vectors `v` and `h`, the point `p` and the component `d`, metres.
///
/// One solution. If `h` is perpendicular to `v`, infinitely many when p
/// already has the component (t = 0 is given), else none.
///
/// ```
/// use kin_runtime::subproblems::translation2;
/// let up = [0.0, 0.0, 1.0];
/// assert_eq!(translation2(up, up, [0.3, 0.2, 0.1], 0.6).exact(), [0.5]);
/// ```
pub fn translation2(h: [f64; 3], v: [f64; 3], p: [f64; 3], d: f64) -> SolutionSet<f64> {
    let missing = d - dot(h, p);
    let slope = dot(h, v);
    if slope.abs() <= ON_AXIS {
        return SolutionSet::whatever(0.0, missing.abs(), SOLVED * (norm(p) + d.abs()));
    }
    SolutionSet::one(missing / slope)
}
