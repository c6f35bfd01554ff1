//! Newton's method from a configuration that nearly reaches the target.

use super::super::super::linear::normal_equations::Factor;
use super::super::super::linear::vector::norm;
use super::super::super::scalar::{Real, tolerance};
use super::super::super::{Jacobian, Pose};
use super::linearization::{Linearization, Problem};

/// Relative to the arm's size, a residual below this is rounding.
pub(super) const ROUNDING: Real = tolerance::ROUNDING;

/// No joint moves by more than this in one step; radians or metres. Short
/// steps follow Newton's flow and so stay on the branch that they are on.
const STRIDE: Real = 0.3;

/// A step shorter than this share of Newton's leads nowhere.
const LEAST_SHARE: Real = 1e-3;

/// Below this a pivot of the Jacobian, relative to the largest, is that of a
/// singular configuration.
const SINGULAR: Real = tolerance::SINGULAR;

/// Where [`newton`] has arrived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refined<const N: usize> {
    /// The last configuration; angles are not wrapped.
    pub q: [Real; N],
    /// Its distance from the target, metres: the translation error and the
    /// angle times the arm's size, as the legs of a right triangle.
    pub residual: Real,
    /// How far the Jacobian there is from losing rank: its least pivot by the
    /// largest.
    pub independence: Real,
    /// The motion of the joints that moves the tip least, at unit speed.
    pub weak: [Real; N],
}

impl<const N: usize> Refined<N> {
    pub(super) fn at(place: &Linearization<N>) -> Self {
        let factor = Factor::new(&place.rows, 0.0);
        Self {
            q: place.q,
            residual: place.residual,
            independence: factor.independence(),
            weak: factor.weak(),
        }
    }

    /// The Jacobian loses rank.
    pub fn singular(&self) -> bool {
        self.independence < SINGULAR
    }
}

/// Newton from a configuration that nearly reaches the target, until it is
/// there to rounding, for at most `steps` evaluations.
///
/// Steps are damped by
/// the natural monotonicity test (Deuflhard, Newton Methods for Nonlinear
/// Problems, section 3.3): what has to shrink is the next correction of the
/// joints, not the residual, which near a singular configuration has to grow
/// on the way to a solution that is a tenth of a radian off.
///
/// ```
/// use kin_runtime::{Jacobian, Pose, Target, Twist, __private::refinement::{Problem, newton}};
/// // One joint about z, with the tip one metre out.
/// let arm = |q: &[f64; 1]| {
///     let turn = Pose::from_axis_angle([0.0, 0.0, 1.0], q[0], [0.0; 3]);
///     let out = Pose { translation: [1.0, 0.0, 0.0], ..Pose::IDENTITY };
///     (turn * out, Jacobian::from_columns([Twist::revolute([0.0, 0.0, 1.0], [0.0; 3])]))
/// };
/// let (target, _) = arm(&[0.5]);
/// let problem = Problem { fk_jacobian: arm, target: &target, size: 1.0, counts: Target::Pose };
/// let refined = newton(&problem, [0.501], 4);
/// assert!((refined.q[0] - 0.5).abs() < 1e-15 && refined.residual < 1e-15);
/// ```
#[inline]
pub fn newton<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    q: [Real; N],
    steps: usize,
) -> Refined<N> {
    let size = problem.size;
    let look = |q: [Real; N]| Linearization::new(q, problem);
    let mut here = look(q);
    let mut factor = Factor::new(&here.rows, 0.0);
    let mut step = factor.solve(&here.error);
    let mut share: Real = 1.0;
    for _ in 1..steps {
        if here.residual < ROUNDING * size {
            break;
        }
        let length = norm(step);
        share = share.min(STRIDE / length.max(STRIDE));
        let there = look(core::array::from_fn(|i| here.q[i] + share * step[i]));
        // The correction that the same Jacobian would make next.
        let next = factor.solve(&there.error);
        let unforeseen: [Real; N] = core::array::from_fn(|i| next[i] - (1.0 - share) * step[i]);
        let bend = 2.0 * norm(unforeseen) / (share * share * length).max(Real::MIN_POSITIVE);
        if norm(next) <= (1.0 - 0.25 * share) * length || there.residual < ROUNDING * size {
            here = there;
            factor = Factor::new(&here.rows, 0.0);
            step = factor.solve(&here.error);
            share = (1.0 / bend.max(Real::MIN_POSITIVE)).clamp(share, 1.0);
        } else {
            share = (1.0 / bend).min(0.5 * share);
            if share < LEAST_SHARE {
                break;
            }
        }
    }
    Refined::at(&here)
}
