//! Two distances: a point that two axes through the origin carry.

use super::circles::{Meeting, meet};
use super::radial::{Radial, turned};
use super::refine::{Local, Refined, refine};
use super::{DOUBLE, ON_AXIS, SOLVED, SolutionSet, subproblem4};
use crate::linear::vector::{add, cross, dot, norm, scale, sub};
use crate::math;

/// Rotation to two given distances: [t₁, t₂], radians in (−π, π], with
/// ‖R(k₁, t₁) R(k₂, t₂) p − qᵢ‖ = dᵢ for unit vectors `k` = [k₁, k₂] whose axes
/// meet in the origin, the point `p`, two points `q` and two distances `d` ≥ 0,
/// all in metres.
///
/// Up to four solutions: the spheres about the origin, q₁ and q₂ meet in up to
/// two points (trilateration), and each can be reached in up to two ways
/// ([`subproblem2`](super::subproblem2)). Double ones, where spheres touch or the arm is stretched,
/// are given once. Infinitely many if the axes are parallel, if p lies on k₂,
/// if a point where the spheres meet lies on k₁, or if q₁, q₂ and the origin lie
/// on one line, so that the spheres meet in a circle, and that circle can be
/// reached; then one member is given. Else none: [`SolutionSet::None`].
///
/// Distances are met to a few units of rounding of the largest length, and to
/// 1e-10 of it where spheres just fail to touch. Source: MLS section 3.3 and
/// the intersection of three spheres.
///
/// ```
/// use kin_runtime::subproblems::two_distances;
/// let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// let q = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
/// let d = [3.0_f64.sqrt(); 2];
/// // x on a gimbal: ½, ½ and ± √½, each in two ways.
/// assert_eq!(two_distances([z, y], x, q, d).exact().len(), 4);
/// ```
pub fn two_distances(
    k: [[f64; 3]; 2],
    p: [f64; 3],
    q: [[f64; 3]; 2],
    d: [f64; 2],
) -> SolutionSet<[f64; 2]> {
    let lengths = p.iter().chain(q.as_flattened()).chain(&d);
    let size = lengths.fold(0.0, |most: f64, x| most.max(x.abs()));
    let unit = if size > 0.0 { size } else { 1.0 };
    let (p, q, d) = (
        p.map(|x| x / unit),
        q.map(|q| q.map(|x| x / unit)),
        d.map(|x| x / unit),
    );
    if d.iter().any(|d| *d < 0.0) {
        return SolutionSet::None;
    }
    let equations = |t: &[f64; 2]| misses(&k, p, &q, &d, t);
    let solved = |t: &[f64; 2]| norm(equations(t).off) <= SOLVED;
    match trilaterate(norm(p), q, d) {
        Place::Nowhere => SolutionSet::None,
        Place::Points(points) => {
            let mut refined = Refined::new();
            let mut free = None;
            for x in points {
                // R(k₁, −t₁) x = R(k₂, t₂) p.
                match meet(k[0], k[1], [0.0; 3], x, p) {
                    Meeting::Free([back, t2]) => {
                        let member = refine([-back, t2], &equations);
                        free = free.or(Some(member).filter(solved));
                    }
                    Meeting::Places(places) => {
                        places
                            .iter()
                            .for_each(|[back, t2]| refined.add([-back, *t2], equations));
                    }
                }
            }
            match free {
                Some(member) => SolutionSet::Any(member),
                None => refined.solutions(),
            }
        }
        Place::Circle { normal, level } => {
            let on_circle = reach_circle(k, p, normal, level);
            match on_circle {
                SolutionSet::Any(t) if solved(&t) => on_circle,
                SolutionSet::Exact(roots) => {
                    let mut refined = Refined::new();
                    refined.add(roots[0], equations);
                    refined.solutions()
                }
                _ => SolutionSet::None,
            }
        }
        Place::Anywhere => SolutionSet::Any([0.0; 2]),
    }
}

/// Where three spheres meet, one of them about the origin.
enum Place {
    Nowhere,
    /// Two points, or one twice.
    Points([[f64; 3]; 2]),
    /// All points of the sphere with this component along a unit vector.
    Circle {
        normal: [f64; 3],
        level: f64,
    },
    /// Wherever the angles take the point.
    Anywhere,
}

/// The points at `radius` from the origin and at distances `d` from the `q`.
/// With the square of the radius known, each distance fixes q · x.
fn trilaterate(radius: f64, q: [[f64; 3]; 2], d: [f64; 2]) -> Place {
    let [mut far, mut near] = [0, 1].map(|i| {
        let length = norm(q[i]);
        (
            q[i],
            length,
            0.5 * ((radius - d[i]) * (radius + d[i]) + length * length),
        )
    });
    if near.1 > far.1 {
        (far, near) = (near, far);
    }
    // The origin itself, or three spheres about it.
    if radius <= ON_AXIS || far.1 <= ON_AXIS {
        let holds = |i: usize| (d[i] - norm(q[i]).max(radius)).abs() <= SOLVED;
        return if holds(0) && holds(1) {
            Place::Anywhere
        } else {
            Place::Nowhere
        };
    }
    let normal = scale(1.0 / far.1, far.0);
    let level = far.2 / far.1;
    let share = dot(near.0, normal);
    let aside = sub(near.0, scale(share, normal));
    let width = norm(aside);
    let rest = near.2 - share * level;
    let foot = scale(level, normal);
    let excess = (radius - level) * (radius + level);
    if width <= ON_AXIS {
        return if rest.abs() > SOLVED || excess < -SOLVED {
            Place::Nowhere
        } else if excess <= DOUBLE {
            Place::Points([foot; 2])
        } else {
            Place::Circle { normal, level }
        };
    }
    let side = scale(1.0 / width, aside);
    let second = rest / width;
    let foot = add(foot, scale(second, side));
    let excess = excess - second * second;
    if !excess.is_finite() {
        return Place::Nowhere;
    }
    // Touching spheres: whether they really do, the distances will tell.
    let rise = if excess > DOUBLE {
        math::sqrt(excess)
    } else {
        0.0
    };
    let rise = scale(rise, cross(normal, side));
    Place::Points([sub(foot, rise), add(foot, rise)])
}

/// A pair of angles that turns p to a component along a direction. There are
/// infinitely many, except where two extremes meet.
fn reach_circle(
    k: [[f64; 3]; 2],
    p: [f64; 3],
    normal: [f64; 3],
    level: f64,
) -> SolutionSet<[f64; 2]> {
    let radius = norm(p);
    // The heights along k₁ on the circle, and those that the second joint
    // gives to p.
    let (onto, along) = (Radial::new(k[0], normal), Radial::new(k[1], p));
    let half = onto.length * math::sqrt(((radius - level) * (radius + level)).max(0.0));
    let second = Radial::new(k[1], k[0]);
    let (reach, mean) = (along.length * second.length, along.height * second.height);
    let centre = onto.height * level;
    let (low, high) = (
        (centre - half).max(mean - reach),
        (centre + half).min(mean + reach),
    );
    if high - low < -SOLVED {
        return SolutionSet::None;
    }
    let height = 0.5 * (low + high);
    let t2 = subproblem4(k[0], k[1], p, height);
    let Some(&t2) = t2.values().first() else {
        return SolutionSet::None;
    };
    let moved = turned(k[1], t2, p);
    let Some(&t1) = subproblem4(normal, k[0], moved, level).values().first() else {
        return SolutionSet::None;
    };
    let touches = high - low <= DOUBLE && half > ON_AXIS && reach > ON_AXIS;
    if touches {
        SolutionSet::one([t1, t2])
    } else {
        SolutionSet::Any([t1, t2])
    }
}

/// How far the distances are from the given ones, and the slopes.
fn misses(
    k: &[[f64; 3]; 2],
    p: [f64; 3],
    q: &[[f64; 3]; 2],
    d: &[f64; 2],
    t: &[f64; 2],
) -> Local<2, 2> {
    let swung = turned(k[1], t[1], p);
    let x = turned(k[0], t[0], swung);
    let motions = [cross(k[0], x), turned(k[0], t[0], cross(k[1], swung))];
    let rays = q.map(|q| sub(x, q));
    let distances = rays.map(norm);
    Local {
        off: [distances[0] - d[0], distances[1] - d[1]],
        slopes: motions.map(|motion| {
            [0, 1].map(|i| {
                if distances[i] > 0.0 {
                    dot(rays[i], motion) / distances[i]
                } else {
                    0.0
                }
            })
        }),
    }
}
