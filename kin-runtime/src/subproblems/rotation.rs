//! Subproblems whose unknowns are rotations about axes through the origin.

use super::radial::Radial;
use super::{DOUBLE, ON_AXIS, SOLVED, SolutionSet};
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::math;

/// Rotation of a vector onto another (Paden-Kahan 1, MLS section 3.3.2): t,
/// radians in (−π, π], with R(k, t) p₁ = p₂ for the unit vector `k` and vectors
/// `p1`, `p2` in metres.
///
/// One solution if the two agree in length and in their component along k,
/// otherwise the t that brings them closest. Infinitely many if both lie on
/// the axis (t = 0 is given).
///
/// ```
/// use core::f64::consts::FRAC_PI_2;
/// use kin_runtime::subproblems::subproblem1;
/// let solutions = subproblem1([0.0, 0.0, 1.0], [1.0, 0.0, 0.2], [0.0, 1.0, 0.2]);
/// assert_eq!(solutions.exact(), [FRAC_PI_2]);
/// ```
pub fn subproblem1(k: [f64; 3], p1: [f64; 3], p2: [f64; 3]) -> SolutionSet<f64> {
    let (from, to) = (Radial::new(k, p1), Radial::new(k, p2));
    let tolerance = SOLVED * from.norm().max(to.norm());
    let (radial, axial) = (from.length - to.length, from.height - to.height);
    let residual = math::sqrt(radial * radial + axial * axial);
    if from.on_axis() || to.on_axis() {
        return SolutionSet::whatever(0.0, residual, tolerance);
    }
    SolutionSet::one_or_closest(from.angle_to(&to, k), residual, tolerance)
}

/// Rotation about two axes (Paden-Kahan 2, MLS section 3.3.2): [t₁, t₂], radians
/// in (−π, π], with R(k₁, t₁) p₁ = R(k₂, t₂) p₂ for unit vectors `k1`, `k2` and
/// vectors `p1`, `p2` in metres.
///
/// Up to two solutions; one where the two circles touch. Infinitely many if
/// the axes are parallel (t₂ = 0 is given) or if a vector lies on its own axis
/// (its angle is given as 0), provided that the other angle solves the
/// equation. If no pair does, the one that brings the vectors closest.
///
/// ```
/// use kin_runtime::subproblems::subproblem2;
/// let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// // The circles x = 0 about x and z = 0 about z meet at y and −y.
/// assert_eq!(subproblem2(z, x, x, y).exact().len(), 2);
/// ```
pub fn subproblem2(
    k1: [f64; 3],
    k2: [f64; 3],
    p1: [f64; 3],
    p2: [f64; 3],
) -> SolutionSet<[f64; 2]> {
    let (from, to) = (Radial::new(k1, p1), Radial::new(k2, p2));
    // One angle is free: solve for the other with the free one at 0.
    if from.on_axis() {
        return family(subproblem1(k2, p2, p1), |t| [0.0, t]);
    }
    if to.on_axis() || norm(cross(k1, k2)) <= ON_AXIS {
        return family(subproblem1(k1, p1, p2), |t| [t, 0.0]);
    }
    circles(k1, k2, &from, &to)
}

/// A family of which the solution for the remaining angle is a member.
pub(super) fn family<const N: usize>(
    solutions: SolutionSet<f64>,
    place: impl Fn(f64) -> [f64; N],
) -> SolutionSet<[f64; N]> {
    match solutions.map(place) {
        SolutionSet::Exact(roots) => SolutionSet::Any(roots[0]),
        other => other,
    }
}

/// Subproblem 2 in general position: where do the circles that the two vectors
/// sweep meet? Both are scaled to the unit sphere, which changes neither the
/// angles nor, if the lengths differ, what comes closest.
fn circles(k1: [f64; 3], k2: [f64; 3], from: &Radial, to: &Radial) -> SolutionSet<[f64; 2]> {
    let size = from.norm().max(to.norm());
    let (h1, h2) = (from.height / from.norm(), to.height / to.norm());
    let angles = |c1, c2| {
        [
            from.angle_to(&Radial::new(k1, c1), k1),
            to.angle_to(&Radial::new(k2, c2), k2),
        ]
    };
    // The points with components h₁ and h₂ are h₁ k₁ + across aside ± γ normal, where aside is at
    // right angles to k₁ and sine above it along k₂.
    let (normal, cosine) = (cross(k1, k2), dot(k1, k2));
    let sine = norm(normal);
    let aside = scale(1.0 / sine, cross(normal, k1));
    let across = (h2 - cosine * h1) / sine;
    let middle = add(scale(h1, k1), scale(across, aside));
    let excess = 1.0 - (h1 * h1 + across * across);
    if excess <= DOUBLE {
        let [c1, c2] = nearest_points(k1, k2, h1, h2);
        let residual = norm(sub(scale(from.norm(), c1), scale(to.norm(), c2)));
        return SolutionSet::one_or_closest(angles(c1, c2), residual, SOLVED * size);
    }
    let rise = scale(math::sqrt(excess) / sine, normal);
    let roots = [sub(middle, rise), add(middle, rise)].map(|c| angles(c, c));
    let residual = (from.norm() - to.norm()).abs();
    if residual <= SOLVED * size {
        SolutionSet::two(roots[0], roots[1])
    } else {
        SolutionSet::Closest {
            value: roots[0],
            residual,
        }
    }
}

/// The closest points of two circles on the unit sphere that do not cross:
/// they lie in the plane of the axes, on one of two sides of each axis.
fn nearest_points(k1: [f64; 3], k2: [f64; 3], h1: f64, h2: f64) -> [[f64; 3]; 2] {
    let sides = |k: [f64; 3], other: [f64; 3], h: f64| {
        let across = sub(other, scale(dot(k, other), k));
        let radius = math::sqrt((1.0 - h * h).max(0.0)) / norm(across);
        [radius, -radius].map(|r| add(scale(h, k), scale(r, across)))
    };
    let (first, second) = (sides(k1, k2, h1), sides(k2, k1, h2));
    let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| [first[i], second[j]]);
    let closer = |best: [[f64; 3]; 2], pair: [[f64; 3]; 2]| {
        if dot(pair[0], pair[1]) > dot(best[0], best[1]) {
            pair
        } else {
            best
        }
    };
    pairs.into_iter().fold(pairs[0], closer)
}

/// Rotation to a given distance (Paden-Kahan 3, MLS section 3.3.2): t, radians
/// in (−π, π], with ‖R(k, t) p₁ − p₂‖ = d for the unit vector `k`, vectors
/// `p1`, `p2` and the distance d ≥ 0 in metres.
///
/// Up to two solutions; one where the circle touches the sphere of radius d,
/// or at d = 0. Infinitely many if one of the vectors lies on the axis and the
/// distance is right (t = 0 is given). If no t gives the distance, the one
/// that comes nearest to it.
///
/// ```
/// use kin_runtime::subproblems::subproblem3;
/// let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
/// // Two radii of a unit circle whose tips are 1 apart enclose 60 degrees.
/// let solutions = subproblem3(z, x, x, 1.0);
/// assert!((solutions.exact()[1].to_degrees() - 60.0).abs() < 1e-12);
/// ```
pub fn subproblem3(k: [f64; 3], p1: [f64; 3], p2: [f64; 3], d: f64) -> SolutionSet<f64> {
    let (from, to) = (Radial::new(k, p1), Radial::new(k, p2));
    let size = from.norm() + to.norm() + d.abs();
    let axial = from.height - to.height;
    let distance_at = |radial: f64| math::sqrt(radial * radial + axial * axial);
    let least = distance_at(from.length - to.length);
    let greatest = distance_at(from.length + to.length);
    if from.on_axis() || to.on_axis() {
        return SolutionSet::whatever(0.0, (d - least).abs(), SOLVED * size);
    }
    // By the law of cosines, written so that nothing cancels near the ends.
    let (near, far) = (d - least, greatest - d);
    let half_tangent = (near * (d + least), far * (d + greatest));
    symmetric_roots(from.angle_to(&to, k), near, far, half_tangent, size)
}

/// Rotation to a given component: t, radians in (−π, π], with
/// h · R(k, t) p = d for the unit vectors `h` and `k`, the vector `p` and the
/// component `d` in metres.
///
/// Up to two solutions; one where the component is extremal. Infinitely many
/// if `h` or `p` lies along the axis and the component is right (t = 0 is
/// given). If no t gives the component, the one that comes nearest to it.
/// Source: arXiv 2211.05737, subproblem 4.
///
/// ```
/// use kin_runtime::subproblems::subproblem4;
/// let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// assert_eq!(subproblem4(y, z, x, 1.0).exact(), [core::f64::consts::FRAC_PI_2]);
/// ```
pub fn subproblem4(h: [f64; 3], k: [f64; 3], p: [f64; 3], d: f64) -> SolutionSet<f64> {
    let (from, to) = (Radial::new(k, p), Radial::new(k, h));
    let size = from.norm() * to.norm() + d.abs();
    let level = d - from.height * to.height;
    if from.on_axis() || to.on_axis() {
        return SolutionSet::whatever(0.0, level.abs(), SOLVED * size);
    }
    let amplitude = from.length * to.length;
    let (near, far) = (amplitude - level, amplitude + level);
    symmetric_roots(from.angle_to(&to, k), near, far, (near, far), size)
}

/// The angles `phase` ± φ at which a quantity that varies monotonically from
/// φ = 0 to φ = π takes the wanted value, `near` away from its value at the
/// first end and `far` from that at the second; tan² φ/2 is given as a
/// quotient.
fn symmetric_roots(
    phase: f64,
    near: f64,
    far: f64,
    half_tangent: (f64, f64),
    size: f64,
) -> SolutionSet<f64> {
    let (end, excess) = if near < far {
        (phase, near)
    } else {
        (math::wrap(phase + core::f64::consts::PI), far)
    };
    if excess <= DOUBLE * size {
        return SolutionSet::one_or_closest(end, (-excess).max(0.0), SOLVED * size);
    }
    let (sine, cosine) = (math::sqrt(half_tangent.0), math::sqrt(half_tangent.1));
    let offset = 2.0 * math::atan2(sine, cosine);
    SolutionSet::two(math::wrap(phase - offset), math::wrap(phase + offset))
}
