//! Subproblem 2E: two circles in space.

use super::radial::{Radial, toward, turned};
use super::refine::{Local, Refined, refine};
use super::{ON_AXIS, SOLVED, SolutionSet};
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::math;

/// Rotation about two axes that need not meet (subproblem 2 extended):
/// [t₁, t₂], radians in (−π, π], with p₀ + R(k₁, t₁) p₁ = R(k₂, t₂) p₂ for unit
/// vectors `k1`, `k2` and vectors `p0`, `p1`, `p2` in metres.
///
/// Three equations for two angles: as a rule there is one solution if the
/// vectors have been made so that there is any, and two where the circles lie
/// on one sphere or in one plane; touching circles meet once. Infinitely many
/// if a vector lies on its axis (its angle is given as 0) or the circles are
/// the same, provided that the other angle solves the equation; what comes
/// closest if it does not. Otherwise none: [`SolutionSet::None`].
///
/// The circles meet where the first has the component along k₂ and the distance
/// from the second's centre that the second has everywhere. Both conditions
/// are linear in (cos t₁, sin t₁); of their combinations the one that says most
/// about t₁ gives two candidates, and what fails the equation is no solution.
/// Met to a few units of rounding of the largest vector, and to 1e-10 of it
/// where circles just fail to touch. Source: arXiv 2211.05737, section on
/// subproblem 2 extended, where a linear system is solved that is singular for
/// parallel axes; not here.
///
/// ```
/// use kin_runtime::subproblems::subproblem2e;
/// let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
/// // Unit circles in a plane, their centres 1 apart.
/// assert_eq!(subproblem2e(z, z, x, x, x).exact().len(), 2);
/// // Unit circles linked like a chain, through the centre of each other.
/// assert_eq!(subproblem2e(z, [0.0, 1.0, 0.0], x, x, x).exact().len(), 0);
/// ```
pub fn subproblem2e(
    k1: [f64; 3],
    k2: [f64; 3],
    p0: [f64; 3],
    p1: [f64; 3],
    p2: [f64; 3],
) -> SolutionSet<[f64; 2]> {
    let given = [p0, p1, p2];
    let size = given
        .as_flattened()
        .iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    let unit = if size > 0.0 { size } else { 1.0 };
    let [p0, p1, p2] = given.map(|p| p.map(|x| x / unit));
    let equations = |t: &[f64; 2]| {
        let (left, right) = (turned(k1, t[0], p1), turned(k2, t[1], p2));
        Local {
            off: sub(add(p0, left), right),
            slopes: [cross(k1, left), cross(right, k2)],
        }
    };
    match meet(k1, k2, p0, p1, p2) {
        Meeting::Free(value) => {
            let value = refine(value, &equations);
            let residual = norm(equations(&value).off);
            SolutionSet::whatever(value, unit * residual, unit * SOLVED)
        }
        Meeting::Places(places) => {
            let mut refined = Refined::new();
            places.iter().for_each(|t| refined.add(*t, equations));
            refined.solutions()
        }
    }
}

/// Where two circles may meet.
pub(super) enum Meeting {
    /// One angle is free. If any pair solves the equation this one does, and
    /// otherwise it comes closest.
    Free([f64; 2]),
    /// Near every solution.
    Places([[f64; 2]; 2]),
}

/// Candidates for p₀ + R(k₁, t₁) p₁ = R(k₂, t₂) p₂, with vectors of order one.
pub(super) fn meet(
    k1: [f64; 3],
    k2: [f64; 3],
    p0: [f64; 3],
    p1: [f64; 3],
    p2: [f64; 3],
) -> Meeting {
    let (first, second) = (Radial::new(k1, p1), Radial::new(k2, p2));
    let at = |t1| [t1, toward(k2, p2, add(p0, turned(k1, t1, p1)))];
    if first.length <= ON_AXIS {
        return Meeting::Free(at(0.0));
    }
    if second.length <= ON_AXIS {
        return Meeting::Free([toward(k1, p1, sub(p2, p0)), 0.0]);
    }
    // The centre of the first circle, seen from that of the second.
    let between = sub(add(p0, scale(first.height, k1)), scale(second.height, k2));
    let squares = (second.length - first.length) * (second.length + first.length);
    let ahead = first.ahead(k1);
    let rows = [k2, between].map(|h| [dot(h, first.across), dot(h, ahead)]);
    let levels = [-dot(k2, between), 0.5 * (squares - dot(between, between))];
    let (row, level) = strongest(rows, levels);
    let amplitude = math::sqrt(row[0] * row[0] + row[1] * row[1]);
    // Circles about one axis: the same everywhere or nowhere.
    if amplitude <= ON_AXIS {
        return Meeting::Free(at(0.0));
    }
    let phase = math::atan2(row[1], row[0]);
    // Touching circles are approached from both sides.
    let rise = (amplitude - level) * (amplitude + level);
    let offset = math::atan2(math::sqrt(rise.max(0.0)).max(1e-8 * amplitude), level);
    Meeting::Places([at(phase - offset), at(phase + offset)])
}

/// Of all combinations, with a unit vector, of two equations in the same two
/// unknowns the one with the longest row.
fn strongest(rows: [[f64; 2]; 2], levels: [f64; 2]) -> ([f64; 2], f64) {
    let [[a, b], [c, d]] = rows;
    // The axis of the ellipse of all rows.
    let angle = 0.5 * math::atan2(2.0 * (a * c + b * d), (a * a + b * b) - (c * c + d * d));
    let (s, t) = math::sin_cos(angle);
    (
        [t * a + s * c, t * b + s * d],
        t * levels[0] + s * levels[1],
    )
}
