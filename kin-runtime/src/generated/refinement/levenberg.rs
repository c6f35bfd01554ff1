//! Arriving where the Jacobian has lost more than one rank.

use super::super::super::linear::normal_equations::Factor;
use super::super::super::linear::vector::norm;
use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose};
use super::linearization::{Linearization, Problem};
use super::newton::{ROUNDING, Refined};

/// Levenberg's method from a configuration that nearly reaches the target, for
/// at most `steps` evaluations.
///
/// At home, say, a stretched arm may be singular in two ways at once. Newton's
/// steps are at a loss there: each weak direction asks for a large one. Damped
/// by the square of what is missing they arrive, and in the end as fast as
/// Newton's (Yamashita and Fukushima, "On the rate of convergence of the
/// Levenberg-Marquardt method", Computing Supplement 15, 2001).
pub fn levenberg<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    q: [Real; N],
    steps: usize,
) -> Refined<N> {
    let mut here = Linearization::new(q, problem);
    let mut miss = norm(here.error);
    let mut weight = 1.0;
    for _ in 0..steps {
        if here.residual < ROUNDING * problem.size || weight > 1e12 {
            break;
        }
        let step = Factor::new(&here.rows, weight * miss * miss).solve(&here.error);
        let there = Linearization::new(core::array::from_fn(|i| here.q[i] + step[i]), problem);
        let next = norm(there.error);
        if next < miss {
            weight *= if next < 0.5 * miss { 0.1 } else { 1.0 };
            (here, miss) = (there, next);
        } else {
            weight *= 8.0;
        }
    }
    Refined::at(&here)
}
