//! The normal equations of Newton's and Levenberg's steps.

use crate::linear::cholesky;
use crate::linear::vector::norm;

/// Rounding may leave the square of a singular pivot below zero.
const LEAST: f64 = 1e-20;

/// The normal equations (JᵀJ + μ) x = Jᵀe, factored.
pub(super) struct Factor<const N: usize> {
    rows: [[f64; N]; 6],
    /// As [`cholesky::factor`] leaves it.
    lower: [[f64; N]; N],
}

impl<const N: usize> Factor<N> {
    pub fn new(rows: &[[f64; N]; 6], damping: f64) -> Self {
        let mut lower = [[0.0; N]; N];
        (0..N).for_each(|i| lower[i][i] = damping);
        for row in rows {
            for i in 0..N {
                for k in 0..=i {
                    lower[i][k] += row[i] * row[k];
                }
            }
        }
        cholesky::factor(lower.as_flattened_mut(), N, LEAST);
        Self { rows: *rows, lower }
    }

    pub fn solve(&self, error: &[f64; 6]) -> [f64; N] {
        let mut x = [0.0; N];
        for (row, e) in self.rows.iter().zip(error) {
            for i in 0..N {
                x[i] += row[i] * e;
            }
        }
        self.solve_square(x)
    }

    /// x of JᵀJ x = b.
    fn solve_square(&self, mut x: [f64; N]) -> [f64; N] {
        cholesky::solve(self.lower.as_flattened(), &mut x);
        x
    }

    /// The least pivot of J relative to the largest.
    pub fn independence(&self) -> f64 {
        let inverses = (0..N).map(|i| self.lower[i][i]);
        let least = inverses.clone().fold(0.0, f64::max);
        inverses.fold(f64::INFINITY, f64::min) / least
    }

    /// The eigenvector of JᵀJ to its least eigenvalue, by inverse iteration.
    pub fn weak(&self) -> [f64; N] {
        // A start that no arm is square to.
        let mut x: [f64; N] = core::array::from_fn(|i| 1.0 + 0.3 * i as f64);
        for _ in 0..3 {
            x = self.solve_square(x);
            let whole = norm(x);
            x = x.map(|x| x / whole);
        }
        x
    }
}
