//! Subproblem 5: a point that three axes carry.

use super::radial::{Radial, toward, turned};
use super::refine::{Local, Refined, refine};
use super::torus::{Plane, meet};
use super::{DOUBLE, SOLVED, SolutionSet};
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use core::f64::consts::FRAC_PI_4;

/// Rotation about three axes: [t₁, t₂, t₃], radians in (−π, π], with
///
/// ```text
/// p₀ + R(k₁, t₁) p₁ = R(k₂, t₂) (p₂ + R(k₃, t₃) p₃)
/// ```
///
/// for unit vectors `k` = [k₁, k₂, k₃] and vectors `p` = [p₀, p₁, p₂, p₃] in
/// metres. Three joints in general position place a point so, as the first
/// three of an arm place its wrist.
///
/// Up to four solutions, a double root once. Infinitely many if an angle moves
/// nothing (its vector lies on the axis, t₂ when both sides lie on k₂), if all
/// axes are parallel and the arm is not stretched, or if the conics below
/// coincide; then one member is given. Else none: [`SolutionSet::None`].
///
/// The rotation about k₂ changes neither the component along k₂ nor the
/// length. Both are linear in the sines and cosines of t₁ and t₃, which makes
/// two equations as in [`subproblem6`](super::subproblem6), and they are solved
/// like those: on a circle, with no division that parallel or perpendicular
/// axes, equal lengths or a biquadratic could turn into one by zero. Then t₂
/// follows by [`subproblem1`](super::subproblem1), and the three angles are refined on the
/// equation itself, because lengths squared do not determine t₂ well near k₂.
///
/// The equation is met to a few units of rounding of the largest vector, and to
/// 1e-10 of it where two roots have just ceased to be real; double roots are
/// accurate to the square root of rounding. Source: arXiv 2211.05737,
/// subproblem 5, where a quartic in the height along k₂ is solved instead.
///
/// ```
/// use kin_runtime::subproblems::subproblem5;
/// let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// // Unit vectors after a yaw and a roll, their feet half a unit off.
/// let p = [[0.5, 0.0, 0.0], x, [0.0, 0.5, 0.0], x];
/// assert_eq!(subproblem5([z, x, y], p).exact().len(), 4);
/// ```
pub fn subproblem5(k: [[f64; 3]; 3], p: [[f64; 3]; 4]) -> SolutionSet<[f64; 3]> {
    let size = p
        .as_flattened()
        .iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    let unit = if size > 0.0 { size } else { 1.0 };
    let arm = Arm {
        k,
        p: p.map(|p| p.map(|x| x / unit)),
    };
    let mut refined = Refined::new();
    let mut free = None;
    let family = meet(arm.heights_and_lengths(), |pair| {
        for start in arm.starts(pair) {
            match arm.land(start) {
                Some((t, true)) => free = Some(t),
                Some((t, false)) => refined.add(t, |t| arm.equations(t)),
                None => {}
            }
        }
    });
    let member = family.and_then(|pair| arm.starts(pair).find_map(|start| arm.land(start)));
    match member.map(|(t, _)| t).or(free) {
        Some(member) => SolutionSet::Any(member),
        None => refined.solutions(),
    }
}

/// Nearer to k₂ than this, relative to the largest vector, heights and lengths
/// leave t₂ open: their rounding errors move the point by 1e-8.
const NEAR_AXIS: f64 = 1e-6;

/// The vectors, of order one.
struct Arm {
    k: [[f64; 3]; 3],
    p: [[f64; 3]; 4],
}

impl Arm {
    /// The two sides of the equation, without the rotation about k₂.
    fn sides(&self, t1: f64, t3: f64) -> [[f64; 3]; 2] {
        let [k1, _, k3] = self.k;
        let [p0, p1, p2, p3] = self.p;
        [add(p0, turned(k1, t1, p1)), add(p2, turned(k3, t3, p3))]
    }

    /// The greater distance of the sides from the axis k₂.
    fn off_axis(&self, t1: f64, t3: f64) -> f64 {
        let [left, right] = self.sides(t1, t3).map(|p| Radial::new(self.k[1], p).length);
        left.max(right)
    }

    /// t₁ and t₃ with t₂, or near the axis with values of t₂ all around.
    fn starts(&self, [t1, t3]: [f64; 2]) -> impl Iterator<Item = [f64; 3]> {
        let [left, right] = self.sides(t1, t3);
        let t2 = toward(self.k[1], right, left);
        let count = if self.off_axis(t1, t3) < NEAR_AXIS {
            8
        } else {
            1
        };
        (0..count).map(move |i| [t1, t2 + f64::from(i) * FRAC_PI_4, t3])
    }

    /// The solution near a start, and whether any t₂ would do there.
    fn land(&self, start: [f64; 3]) -> Option<([f64; 3], bool)> {
        let t = refine(start, &|t: &[f64; 3]| self.equations(t));
        let off_axis = self.off_axis(t[0], t[2]);
        // Near the axis no t₂ is much off, and only the best are solutions.
        let tolerance = (SOLVED * off_axis).max(DOUBLE);
        let solved = norm(self.equations(&t).off) <= tolerance;
        solved.then_some((t, off_axis <= 0.5 * SOLVED))
    }

    /// The equation and its slopes.
    fn equations(&self, t: &[f64; 3]) -> Local<3, 3> {
        let (k, p) = (&self.k, &self.p);
        let left = turned(k[0], t[0], p[1]);
        let right = turned(k[2], t[2], p[3]);
        let carried = turned(k[1], t[1], add(p[2], right));
        Local {
            off: sub(add(p[0], left), carried),
            slopes: [
                cross(k[0], left),
                cross(carried, k[1]),
                turned(k[1], t[1], cross(right, k[2])),
            ],
        }
    }

    /// Both sides have the same component along k₂ and the same length.
    fn heights_and_lengths(&self) -> [Plane; 2] {
        let [k1, k2, k3] = self.k;
        let (axes, feet) = ([k1, k3], [self.p[0], self.p[2]]);
        let parts = [Radial::new(k1, self.p[1]), Radial::new(k3, self.p[3])];
        // The centres of the circles on which the sides run. Lengths are
        // measured from that point of the axis k₂ which is half way between
        // them: it keeps the equations apart however far up they are.
        let [c1, c3] = [0, 1].map(|i| add(feet[i], scale(parts[i].height, axes[i])));
        let (sum, difference) = (add(c1, c3), sub(c3, c1));
        let middle = scale(0.5 * dot(k2, sum), k2);
        let rays = [c1, c3].map(|c| sub(c, middle));
        let row = |h: [[f64; 3]; 2]| {
            let [[a, b], [c, d]] = [0, 1].map(|i| {
                [
                    dot(h[i], parts[i].across),
                    dot(h[i], parts[i].ahead(axes[i])),
                ]
            });
            [a, b, -c, -d]
        };
        let (l1, l3) = (parts[0].length, parts[1].length);
        let squares = dot(difference, add(rays[0], rays[1])) + (l3 - l1) * (l3 + l1);
        [
            Plane {
                row: row([k2, k2]),
                level: dot(k2, difference),
            },
            Plane {
                row: row(rays),
                level: 0.5 * squares,
            },
        ]
    }
}
