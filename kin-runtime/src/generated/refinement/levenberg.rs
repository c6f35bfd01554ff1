//! Levenberg's method, which arrives where the Jacobian loses rank.

use super::super::super::linear::normal_equations::Factor;
use super::super::super::linear::vector::norm;
use super::super::super::scalar::{Real, tolerance};
use super::super::super::{Jacobian, Pose};
use super::linearization::{Linearization, Problem};

/// Where [`levenberg`] has arrived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrived<const N: usize> {
    /// The last configuration; angles are not wrapped.
    pub q: [Real; N],
    /// Its distance from the target, metres: the translation error and the
    /// angle times the arm's size, as the legs of a right triangle.
    pub residual: Real,
    /// The Jacobian loses rank there.
    pub singular: bool,
}

/// Levenberg's method from a configuration that nearly reaches the target, for
/// at most `steps` evaluations.
///
/// At home, say, a stretched arm may be singular in two ways at once. Newton's
/// steps are at a loss there: each weak direction asks for a large one. Damped
/// by the square of what is missing they arrive, and in the end as fast as
/// Newton's (Yamashita and Fukushima, "On the rate of convergence of the
/// Levenberg-Marquardt method", Computing Supplement 15, 2001).
///
/// ```
/// use kin_runtime::{Jacobian, Pose, Target, Twist, __private::refinement::{Problem, levenberg}};
/// // One joint about z, with the tip one metre out.
/// let arm = |q: &[f64; 1]| {
///     let turn = Pose::from_axis_angle([0.0, 0.0, 1.0], q[0], [0.0; 3]);
///     let out = Pose { translation: [1.0, 0.0, 0.0], ..Pose::IDENTITY };
///     (turn * out, Jacobian::from_columns([Twist::revolute([0.0, 0.0, 1.0], [0.0; 3])]))
/// };
/// let (target, _) = arm(&[0.5]);
/// let problem = Problem { fk_jacobian: arm, target: &target, size: 1.0, counts: Target::Pose };
/// let arrived = levenberg(&problem, [0.501], 4);
/// assert!((arrived.q[0] - 0.5).abs() < 1e-15 && arrived.residual < 1e-15);
/// ```
pub fn levenberg<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    q: [Real; N],
    steps: usize,
) -> Arrived<N> {
    let linearize = |q| Linearization::new(q, problem);
    arrive(linearize, problem.size, q, steps)
}

/// The same of whatever is missing, of an arm of this size.
pub(super) fn arrive<const N: usize, const R: usize>(
    linearize: impl Fn([Real; N]) -> Linearization<N, R>,
    size: Real,
    q: [Real; N],
    steps: usize,
) -> Arrived<N> {
    let mut here = linearize(q);
    let mut miss = norm(here.error);
    let mut weight = 1.0;
    for _ in 0..steps {
        if here.residual < tolerance::ROUNDING * size || weight > 1e12 {
            break;
        }
        let step = Factor::new(&here.rows, weight * miss * miss).solve(&here.error);
        let there = linearize(core::array::from_fn(|i| here.q[i] + step[i]));
        let next = norm(there.error);
        if next < miss {
            weight *= if next < 0.5 * miss { 0.1 } else { 1.0 };
            (here, miss) = (there, next);
        } else {
            weight *= 8.0;
        }
    }
    Arrived {
        q: here.q,
        residual: here.residual,
        singular: Factor::new(&here.rows, 0.0).independence() < tolerance::SINGULAR,
    }
}
