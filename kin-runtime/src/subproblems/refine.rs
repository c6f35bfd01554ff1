//! From candidates to roots: refined, checked, each once.

use super::solution_set::Roots;
use super::{DOUBLE, SOLVED, SolutionSet};
use crate::linear::cholesky;
use crate::linear::vector::{dot, norm};
use crate::math;

/// M equations in N angles at some place: what they are off by, relative to
/// the size of their terms, and their derivatives, one column for each angle.
pub(super) struct Local<const N: usize, const M: usize> {
    pub off: [f64; M],
    pub slopes: [[f64; M]; N],
}

/// Candidates whose midpoint solves the equations are the same root only if
/// they are nearer than this; radians.
const NEIGHBOURS: f64 = 1e-2;

/// The most steps of a refinement. Simple roots need two or three; where the slopes
/// are dependent, each step only halves the distance.
const STEPS: usize = 30;

/// Of the unit on the diagonal of the normal equations: rounding.
const UNDAMPED: f64 = 1e-14;

/// Candidates that are further off than this are no solutions.
const NEARLY: f64 = 1e-4;

/// Residuals below this are rounding.
const ROUNDING: f64 = 1e-16;

/// The roots found so far.
pub(super) struct Refined<const N: usize> {
    roots: [[f64; N]; 4],
    count: usize,
}

impl<const N: usize> Refined<N> {
    pub fn new() -> Self {
        Refined {
            roots: [[0.0; N]; 4],
            count: 0,
        }
    }

    /// Takes the candidate in if it solves the equations once refined. Two
    /// that the equations cannot tell apart are a double root: half way
    /// between them the equations hold as well.
    pub fn add<const M: usize>(
        &mut self,
        candidate: [f64; N],
        equations: impl Fn(&[f64; N]) -> Local<N, M>,
    ) {
        let root = refine(candidate, &equations);
        let residual = norm(equations(&root).off);
        if residual > SOLVED || residual.is_nan() {
            return;
        }
        for known in &mut self.roots[..self.count] {
            let apart: [f64; N] = core::array::from_fn(|i| math::wrap(root[i] - known[i]));
            let middle = core::array::from_fn(|i| math::wrap(known[i] + 0.5 * apart[i]));
            let near = apart.iter().all(|a| a.abs() < NEIGHBOURS);
            if near && norm(equations(&middle).off) <= DOUBLE {
                *known = middle;
                return;
            }
        }
        if self.count < 4 {
            self.roots[self.count] = root;
            self.count += 1;
        }
    }

    pub fn solutions(&self) -> SolutionSet<[f64; N]> {
        let [a, b, c, d] = self.roots;
        match self.count {
            0 => SolutionSet::None,
            1 => SolutionSet::Exact(Roots::One([a])),
            2 => SolutionSet::Exact(Roots::Two([a, b])),
            3 => SolutionSet::Exact(Roots::Three([a, b, c])),
            _ => SolutionSet::Exact(Roots::Four([a, b, c, d])),
        }
    }
}

/// Levenberg and Marquardt: Gauss-Newton that may fall short but never rises.
///
/// Every angle is measured by what it moves. So an angle about an axis that
/// the point nearly lies on, which moves next to nothing, is as well
/// determined as the others; one that moves nothing stays.
pub(super) fn refine<const N: usize, const M: usize>(
    start: [f64; N],
    equations: &impl Fn(&[f64; N]) -> Local<N, M>,
) -> [f64; N] {
    let mut best = start.map(math::wrap);
    let mut here = equations(&best);
    let mut damping = UNDAMPED;
    for _ in 0..STEPS {
        let off = norm(here.off);
        if !(ROUNDING..NEARLY).contains(&off) || damping > 1.0 {
            break;
        }
        let Some(step) = step(&here, damping) else {
            break;
        };
        let trial = core::array::from_fn(|i| math::wrap(best[i] + step[i]));
        let there = equations(&trial);
        if norm(there.off) < norm(here.off) {
            (best, here) = (trial, there);
            damping = (damping * 1e-4).max(UNDAMPED);
        } else {
            damping *= 1e4;
        }
    }
    best
}

/// The damped normal equations with columns of unit length.
fn step<const N: usize, const M: usize>(local: &Local<N, M>, damping: f64) -> Option<[f64; N]> {
    let weights = local.slopes.map(|slope| {
        let length = norm(slope);
        if length > 1e-14 { 1.0 / length } else { 0.0 }
    });
    let mut matrix = [[0.0; N]; N];
    let mut right = [0.0; N];
    for i in 0..N {
        for j in 0..N {
            matrix[i][j] = weights[i] * weights[j] * dot(local.slopes[i], local.slopes[j]);
        }
        matrix[i][i] += if weights[i] > 0.0 { damping } else { 1.0 };
        right[i] = -weights[i] * dot(local.slopes[i], local.off);
    }
    if !cholesky::factor(matrix.as_flattened_mut(), N, 0.0) {
        return None;
    }
    cholesky::solve(matrix.as_flattened(), &mut right);
    Some(core::array::from_fn(|i| {
        (weights[i] * right[i]).clamp(-0.5, 0.5)
    }))
}
