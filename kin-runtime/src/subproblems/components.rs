//! Subproblem 6: two components of two vectors that turn.

use super::SolutionSet;
use super::radial::Radial;
use super::refine::{Local, Refined};
use super::torus::{Plane, meet};
use crate::linear::vector::dot;

/// Two components of the sum of two turned vectors: [t₁, t₂], radians in
/// (−π, π], with
///
/// ```text
/// h₁ · R(k₁, t₁) p₁ + h₂ · R(k₂, t₂) p₂ = d₁
/// h₃ · R(k₃, t₁) p₃ + h₄ · R(k₄, t₂) p₄ = d₂
/// ```
///
/// for unit vectors `h` and `k`, vectors `p` and components `d`. Each equation
/// has its own unit, metres if its vectors are places and none if they are
/// directions; their sizes need not agree.
///
/// Up to four solutions, a double root once. Infinitely many if the equations
/// are dependent, if an angle is in neither of them, or if the two conics into
/// which they bind the angles are the same; then one member is given. Dependent
/// equations that hold only where all terms are at their extremes have an
/// isolated solution. Else none: [`SolutionSet::None`] if the components are out of
/// reach or contradict each other.
///
/// Each equation is met to a few units of rounding of the size of its terms,
/// |pᵢ| + |pⱼ| + |d|, and to 1e-10 of it where two roots have just ceased to be
/// real. Angles are as accurate as that makes them: to rounding over the slope,
/// double roots to its square root.
///
/// Source: arXiv 2211.05737, subproblem 6, where two ellipses are intersected.
/// Here the four sines and cosines are bound to a circle, whose angle has a
/// trigonometric quartic; no coefficient block has to be regular.
///
/// ```
/// use kin_runtime::subproblems::subproblem6;
/// let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// // A planar arm of links 1 and 1: cos t₁ + cos t₂ = 1, sin t₁ + sin t₂ = 1.
/// let solutions = subproblem6([x, x, y, y], [z; 4], [x; 4], [1.0, 1.0]);
/// assert_eq!(solutions.exact().len(), 2);
/// // cos t₁ = ½ and cos t₂ = ½ decouple.
/// let far = [x, y, y, x].map(|p| p.map(|c| 2.0 * c));
/// let solutions = subproblem6([x; 4], [z, y, z, z], [far[0], y, z, far[3]], [1.0, 1.0]);
/// assert_eq!(solutions.exact().len(), 4);
/// ```
pub fn subproblem6(
    h: [[f64; 3]; 4],
    k: [[f64; 3]; 4],
    p: [[f64; 3]; 4],
    d: [f64; 2],
) -> SolutionSet<[f64; 2]> {
    let planes = [0, 1].map(|i| {
        let (j, l) = (2 * i, 2 * i + 1);
        component(&[h[j], h[l]], &[k[j], k[l]], &[p[j], p[l]], d[i])
    });
    let equations = |t: &[f64; 2]| {
        let [(a, [a1, a2]), (b, [b1, b2])] = planes.map(|plane| plane.at(*t));
        Local {
            off: [a, b],
            slopes: [[a1, b1], [a2, b2]],
        }
    };
    let mut refined = Refined::new();
    match meet(planes, |t| refined.add(t, equations)) {
        Some(member) => SolutionSet::Any(member),
        None => refined.solutions(),
    }
}

/// h₁ · R(k₁, t₁) p₁ + h₂ · R(k₂, t₂) p₂ = d, relative to the size of its terms.
fn component(h: &[[f64; 3]; 2], k: &[[f64; 3]; 2], p: &[[f64; 3]; 2], d: f64) -> Plane {
    let largest = p
        .as_flattened()
        .iter()
        .fold(d.abs(), |most, x| most.max(x.abs()));
    let unit = if largest > 0.0 { largest } else { 1.0 };
    let (p, d) = (p.map(|p| p.map(|x| x / unit)), d / unit);
    let parts = [0, 1].map(|i| Radial::new(k[i], p[i]));
    let [[a, b], [c, e]] = [0, 1].map(|i| {
        // What h and p have along the axis takes no part.
        let h = Radial::new(k[i], h[i]).across;
        [dot(h, parts[i].across), dot(h, parts[i].ahead(k[i]))]
    });
    let fixed: f64 = [0, 1]
        .map(|i| dot(h[i], k[i]) * parts[i].height)
        .iter()
        .sum();
    Plane {
        row: [a, b, c, e],
        level: d - fixed,
    }
}
