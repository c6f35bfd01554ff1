//! The normal equations of Newton's and Levenberg's steps.

use super::super::scalar::{Real, tolerance::PIVOT};
use super::cholesky;

/// The normal equations (JᵀJ + μ) x = Jᵀe, factored.
pub(crate) struct Factor<const N: usize, const R: usize> {
    rows: [[Real; N]; R],
    /// As [`cholesky::factor`] leaves it.
    lower: [[Real; N]; N],
}

impl<const N: usize, const R: usize> Factor<N, R> {
    pub fn new(rows: &[[Real; N]; R], damping: Real) -> Self {
        let mut lower = [[0.0; N]; N];
        (0..N).for_each(|i| lower[i][i] = damping);
        for row in rows {
            for i in 0..N {
                for k in 0..=i {
                    lower[i][k] += row[i] * row[k];
                }
            }
        }
        cholesky::factor(lower.as_flattened_mut(), N, PIVOT);
        Self { rows: *rows, lower }
    }

    pub fn solve(&self, error: &[Real; R]) -> [Real; N] {
        let mut x = [0.0; N];
        for (row, e) in self.rows.iter().zip(error) {
            for i in 0..N {
                x[i] += row[i] * e;
            }
        }
        cholesky::solve(self.lower.as_flattened(), &mut x);
        x
    }

    /// The least pivot of J relative to the largest.
    pub fn independence(&self) -> Real {
        let inverses = (0..N).map(|i| self.lower[i][i]);
        let least = inverses.clone().fold(0.0, Real::max);
        inverses.fold(Real::INFINITY, Real::min) / least
    }
}
