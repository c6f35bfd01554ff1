//! The solutions near a singular configuration.
//!
//! There the tip can hardly be moved along one of the directions in which it
//! may miss the target. Keep the equations along all others: the
//! configurations that satisfy them form a curve, and what is missed along the
//! last direction is a function on it, whose zeros are the solutions. Where an
//! exact arm has a family of solutions, the curve is the family and the miss
//! vanishes; on an arm that is slightly off, the miss is small and has a few
//! zeros anywhere on the curve. Near the edge of the reach the curve runs
//! through the two solutions that are about to meet. Newton's method from one
//! start finds one of them; following the curve once around finds all.
//!
//! The curve is followed by tangents, with the joint that moves most held while
//! the others return to the curve (Rheinboldt and Burkardt, "A locally
//! parameterized continuation process", ACM TOMS 9, 1983).

use super::super::super::linear::vector::{dot, norm};
use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose, math};
use super::linearization::{Linearization, Problem, idle};

/// Steps along the curve, radians or metres in joint space.
const STEP: Real = 0.2;
/// A step shorter than this leads nowhere.
const LEAST_STEP: Real = 0.01;
/// Enough for a turn of every joint.
const STEPS: usize = 150;
/// Returns to the curve take a few of Newton's steps.
const RETURNS: usize = 6;
/// Points are this near to the curve.
const ON: Real = 1e-7;
/// Zeros are handed out when the miss is below this.
const ZERO: Real = 1e-9;
/// Halvings of an interval with a zero.
const HALVINGS: usize = 20;
/// A column of the Jacobian with less than this of its own, besides the weak
/// one, makes a second weak direction.
const WEAK: Real = 1e-6;
/// With less than this another curve may be near.
const CROSSING: Real = 0.2;

/// Where a start for Newton's method was seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum On {
    /// At a zero of the miss.
    Curve,
    /// Where another curve comes near: the solution may be on that one.
    Crossing,
}

/// Calls `found` near every solution on the curve through `q`, as far as the
/// miss is within `reach` (radians, or lengths in units of the arm's size).
/// `weak` is the motion of the joints that moves the tip least.
pub(super) fn follow<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    q: [Real; N],
    weak: [Real; N],
    reach: Real,
    mut found: impl FnMut([Real; N], On),
) {
    if N + idle(problem.counts) != 6 {
        return;
    }
    let Some(home) = Point::returned(problem, q, &weak, None) else {
        return;
    };
    for start in [home, home.reversed()] {
        let (mut here, mut step) = (start, STEP);
        for steps in 0..STEPS {
            if here.miss.abs() > reach {
                break;
            }
            let Some(there) = here.next(problem, step) else {
                step *= 0.5;
                if step < LEAST_STEP {
                    break;
                }
                continue;
            };
            crossings(problem, &here, &there, &mut found);
            if there.second < CROSSING {
                found(there.q, On::Crossing);
            }
            if steps > 2 && there.meets(&start, step) {
                return;
            }
            here = there;
            step = STEP;
        }
    }
}

/// A point on the curve.
#[derive(Clone, Copy)]
struct Point<const N: usize> {
    q: [Real; N],
    /// What is missing along the normal.
    miss: Real,
    /// Its derivative along the tangent.
    slope: Real,
    /// Of unit length.
    tangent: [Real; N],
    /// The direction in which the tip can hardly be moved.
    normal: [Real; 6],
    /// How much the other joints have of their own, at least.
    second: Real,
}

impl<const N: usize> Point<N> {
    /// The point on the curve near `q` with the same value of the joint that
    /// moves most along `tangent`.
    fn returned(
        problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
        mut q: [Real; N],
        tangent: &[Real; N],
        normal: Option<&[Real; 6]>,
    ) -> Option<Self> {
        let held = (0..N).max_by(|&i, &j| tangent[i].abs().total_cmp(&tangent[j].abs()))?;
        for _ in 0..RETURNS {
            let place = Linearization::new(q, problem);
            let split = Split::new(&place, held, idle(problem.counts), normal)?;
            let (step, off) = split.solve(&place.error);
            if off < ON {
                return Some(split.point(&place, tangent));
            }
            if step.iter().any(|x| x.abs() > 3.0 * STEP) {
                return None;
            }
            (0..N).for_each(|i| q[i] += step[i]);
        }
        None
    }

    fn next(
        &self,
        problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
        step: Real,
    ) -> Option<Self> {
        let q = core::array::from_fn(|i| self.q[i] + step * self.tangent[i]);
        Self::returned(problem, q, &self.tangent, Some(&self.normal))
    }

    /// The point on the curve at a share of the way to another.
    fn between(
        &self,
        problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
        other: &Self,
        share: Real,
    ) -> Option<Self> {
        let q = core::array::from_fn(|i| self.q[i] + share * (other.q[i] - self.q[i]));
        Self::returned(problem, q, &self.tangent, Some(&self.normal))
    }

    fn reversed(self) -> Self {
        Self {
            tangent: self.tangent.map(|x| -x),
            slope: -self.slope,
            ..self
        }
    }

    /// Whether the curve has come back to its start.
    fn meets(&self, start: &Self, step: Real) -> bool {
        let apart = |i: usize| math::wrap(self.q[i] - start.q[i]);
        let square: Real = (0..N).map(|i| apart(i) * apart(i)).sum();
        let along: Real = (0..N).map(|i| self.tangent[i] * start.tangent[i]).sum();
        square < step * step && along > 0.5
    }
}

/// Finds the zeros of the miss between two points, a step apart.
fn crossings<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    a: &Point<N>,
    b: &Point<N>,
    found: &mut impl FnMut([Real; N], On),
) {
    if a.slope * b.slope < 0.0
        && let Some(extreme) = zero(problem, a, b, |point| point.slope)
    {
        if extreme.miss.abs() < ZERO {
            found(extreme.q, On::Curve);
        }
        for (a, b) in [(a, &extreme), (&extreme, b)] {
            solution(problem, a, b, found);
        }
    } else {
        solution(problem, a, b, found);
    }
}

/// Finds the zero of the miss between two points, if there is one.
fn solution<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    a: &Point<N>,
    b: &Point<N>,
    found: &mut impl FnMut([Real; N], On),
) {
    if let Some(point) = zero(problem, a, b, |point| point.miss) {
        found(point.q, On::Curve);
    }
}

/// Where a function on the curve changes its sign, by regula falsi with the
/// Illinois rule.
fn zero<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    a: &Point<N>,
    b: &Point<N>,
    value: impl Fn(&Point<N>) -> Real,
) -> Option<Point<N>> {
    let (mut low, mut high) = (0.0, 1.0);
    let (mut below, mut above) = (value(a), value(b));
    if below * above >= 0.0 {
        return None;
    }
    let mut best = None;
    for _ in 0..HALVINGS {
        let share = (low * above - high * below) / (above - below);
        let point = a.between(problem, b, share)?;
        let here = value(&point);
        best = Some(point);
        if here.abs() < ZERO {
            break;
        }
        if here * above < 0.0 {
            (low, below) = (high, above);
        } else {
            below *= 0.5;
        }
        (high, above) = (share, here);
    }
    best
}

/// The Jacobian with one joint held: an orthonormal basis of what the others
/// can do, and the direction that is left.
struct Split<const N: usize> {
    held: usize,
    /// By joint: what its column adds to those before it.
    basis: [[Real; 6]; N],
    /// Column by column, in that basis.
    upper: [[Real; N]; N],
    normal: [Real; 6],
    /// The least share that a column adds to those before it.
    second: Real,
}

impl<const N: usize> Split<N> {
    fn new(
        place: &Linearization<N>,
        held: usize,
        idle: usize,
        normal: Option<&[Real; 6]>,
    ) -> Option<Self> {
        let idle = &place.idle[..idle];
        let mut split = Self {
            held,
            basis: [[0.0; 6]; N],
            upper: [[0.0; N]; N],
            normal: [0.0; 6],
            second: 1.0,
        };
        for j in (0..N).filter(|&j| j != held) {
            let mut column: [Real; 6] = core::array::from_fn(|i| place.rows[i][j]);
            let whole = norm(column);
            for k in (0..j).filter(|&k| k != held) {
                split.upper[j][k] = remove(&mut column, &split.basis[k]);
            }
            let own = norm(column);
            if own.is_nan() || own < WEAK * whole {
                return None;
            }
            split.second = split.second.min(own / whole);
            split.upper[j][j] = own;
            split.basis[j] = column.map(|x| x / own);
        }
        split.normal = split.left_over(idle, normal)?;
        Some(split)
    }

    /// The unit vector that is normal to the basis and the idle directions, on
    /// the side of `like`.
    fn left_over(&self, idle: &[[Real; 6]], like: Option<&[Real; 6]>) -> Option<[Real; 6]> {
        let cleared = |mut x: [Real; 6]| {
            // Twice, because what is left may be small.
            for _ in 0..2 {
                for other in idle.iter().chain(&self.basis) {
                    remove(&mut x, other);
                }
            }
            x
        };
        let unit = |i: usize| core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
        let candidates = (0..6).map(|i| cleared(unit(i)));
        let like = like.map(|like| cleared(*like));
        let best = like
            .filter(|x| norm(*x) > 0.5)
            .or_else(|| candidates.max_by(|a, b| norm(*a).total_cmp(&norm(*b))))?;
        let whole = norm(best);
        (whole > WEAK).then(|| best.map(|x| x / whole))
    }

    /// How the other joints make what is missing, except along the normal, and
    /// how much that is.
    fn solve(&self, error: &[Real; 6]) -> ([Real; N], Real) {
        let mut x: [Real; N] = core::array::from_fn(|j| dot(self.basis[j], *error));
        let off = math::sqrt(x.iter().map(|x| x * x).sum());
        for j in (0..N).rev().filter(|&j| j != self.held) {
            x[j] /= self.upper[j][j];
            for k in 0..j {
                x[k] -= self.upper[j][k] * x[j];
            }
        }
        x[self.held] = 0.0;
        (x, off)
    }

    fn point(&self, place: &Linearization<N>, forwards: &[Real; N]) -> Point<N> {
        let column = core::array::from_fn(|i| -place.rows[i][self.held]);
        let (mut tangent, _) = self.solve(&column);
        tangent[self.held] = 1.0;
        let along: Real = (0..N).map(|i| tangent[i] * forwards[i]).sum();
        let whole = math::sqrt(tangent.iter().map(|x| x * x).sum());
        let share = if along < 0.0 {
            -1.0 / whole
        } else {
            1.0 / whole
        };
        Point {
            q: place.q,
            miss: dot(self.normal, place.error),
            slope: share * dot(self.normal, column),
            tangent: tangent.map(|x| share * x),
            normal: self.normal,
            second: self.second,
        }
    }
}

/// Takes the part of x along a unit vector away, and returns how much it was.
fn remove(x: &mut [Real; 6], unit: &[Real; 6]) -> Real {
    let along = dot(*x, *unit);
    x.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
    along
}
