//! Where three spheres meet.

use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::math;
use crate::subproblems::SolutionSet;

/// The points at distances `radii` from three `centres`, metres: trilateration,
/// the forward kinematics of a Delta robot, whose platform hangs on three rods.
///
/// Two points, mirror images in the plane of the centres; the first lies on the
/// side that (c₂ − c₁) × (c₃ − c₁) points to. One if the spheres touch, to
/// within 1e-13 of the largest length. If they fail to meet, the point of the
/// plane that has the same power to all three, with the distance by which it
/// misses a sphere at most. [`SolutionSet::None`] if the centres lie on a line.
///
/// ```
/// use kin_runtime::__private::three_spheres;
/// let centres = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// let found = three_spheres(centres, [3.0, 3.0, 3.0]);
/// assert_eq!(found.exact().len(), 2);
/// assert!((found.exact()[0][2] - 1.0).abs() < 1e-14);
/// ```
pub fn three_spheres(centres: [[f64; 3]; 3], radii: [f64; 3]) -> SolutionSet<[f64; 3]> {
    let [u, v] = [sub(centres[1], centres[0]), sub(centres[2], centres[0])];
    let normal = cross(u, v);
    let square = dot(normal, normal);
    let size = norm(u)
        .max(norm(v))
        .max(radii[0])
        .max(radii[1])
        .max(radii[2]);
    if square.is_nan() || math::sqrt(square) <= 1e-12 * norm(u) * norm(v) {
        return SolutionSet::None;
    }
    // x with u · x = a and v · x = b, in the plane.
    let radical =
        |w: [f64; 3], radius: f64| 0.5 * (dot(w, w) + (radii[0] - radius) * (radii[0] + radius));
    let (a, b) = (radical(u, radii[1]), radical(v, radii[2]));
    let x = scale(
        1.0 / square,
        add(scale(a, cross(v, normal)), scale(b, cross(normal, u))),
    );
    let foot = add(centres[0], x);
    let height = (radii[0] - norm(x)) * (radii[0] + norm(x));
    if height.abs() <= 1e-13 * size * size {
        return SolutionSet::one(foot);
    }
    if height < 0.0 {
        let miss = |i: usize| (norm(sub(foot, centres[i])) - radii[i]).abs();
        let residual = miss(0).max(miss(1)).max(miss(2));
        return SolutionSet::Closest {
            value: foot,
            residual,
        };
    }
    let up = scale(math::sqrt(height / square), normal);
    SolutionSet::two(add(foot, up), sub(foot, up))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_found_again() {
        let centres = [[0.1, 0.2, -0.3], [1.0, 0.4, 0.0], [-0.3, 0.9, 0.2]];
        let normal = cross(sub(centres[1], centres[0]), sub(centres[2], centres[0]));
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64 * 4.0 - 2.0
        };
        for _ in 0..1000 {
            let point = [next(), next(), next()];
            let radii = centres.map(|c| norm(sub(point, c)));
            let found = three_spheres(centres, radii);
            let off = |p: &[f64; 3]| norm(sub(*p, point));
            // The two meet in the plane, where their height is a small root.
            let height = dot(sub(point, centres[0]), normal).abs() / norm(normal);
            let tolerance = 1e-14 / height.min(1.0);
            assert!(
                found.exact().iter().any(|p| off(p) < tolerance),
                "{point:?}"
            );
            for p in found.exact() {
                assert!((0..3).all(|i| (norm(sub(*p, centres[i])) - radii[i]).abs() < 1e-13));
            }
        }
    }

    #[test]
    fn touching_missing_and_collinear_spheres_are_told_apart() {
        let centres = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let touching = [8_f64.sqrt(); 3];
        assert_eq!(three_spheres(centres, touching).exact().len(), 1);
        assert!(matches!(
            three_spheres(centres, [1.0; 3]),
            SolutionSet::Closest { .. }
        ));
        let line = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        assert_eq!(three_spheres(line, [1.5; 3]), SolutionSet::None);
    }
}
