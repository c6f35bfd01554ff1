//! The normal equations of Newton's and Levenberg's steps.

use crate::math;

pub(super) fn norm<const N: usize>(x: &[f64; N]) -> f64 {
    math::sqrt(x.iter().map(|x| x * x).sum())
}

/// The normal equations (JᵀJ + μ) x = Jᵀe, factored.
pub(super) struct Factor<const N: usize> {
    rows: [[f64; N]; 6],
    /// Cholesky's L below the diagonal.
    lower: [[f64; N]; N],
    /// One over its diagonal.
    inverse: [f64; N],
}

impl<const N: usize> Factor<N> {
    pub fn new(rows: &[[f64; N]; 6], damping: f64) -> Self {
        let mut a = [[0.0; N]; N];
        (0..N).for_each(|i| a[i][i] = damping);
        for row in rows {
            for i in 0..N {
                for k in 0..=i {
                    a[i][k] += row[i] * row[k];
                }
            }
        }
        let mut inverse = [0.0; N];
        for i in 0..N {
            for k in 0..i {
                let mut sum = a[i][k];
                for m in 0..k {
                    sum -= a[i][m] * a[k][m];
                }
                a[i][k] = sum * inverse[k];
                a[i][i] -= a[i][k] * a[i][k];
            }
            // Rounding may leave a singular pivot below zero.
            inverse[i] = 1.0 / math::sqrt(a[i][i].max(1e-20));
        }
        Self {
            rows: *rows,
            lower: a,
            inverse,
        }
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
        for i in 0..N {
            for k in 0..i {
                x[i] -= self.lower[i][k] * x[k];
            }
            x[i] *= self.inverse[i];
        }
        for i in (0..N).rev() {
            for k in i + 1..N {
                x[i] -= self.lower[k][i] * x[k];
            }
            x[i] *= self.inverse[i];
        }
        x
    }

    /// The least pivot of J relative to the largest.
    pub fn independence(&self) -> f64 {
        let least = self.inverse.iter().fold(0.0, |most: f64, x| most.max(*x));
        let largest = self
            .inverse
            .iter()
            .fold(f64::INFINITY, |least: f64, x| least.min(*x));
        largest / least
    }

    /// The eigenvector of JᵀJ to its least eigenvalue, by inverse iteration.
    pub fn weak(&self) -> [f64; N] {
        // A start that no arm is square to.
        let mut x: [f64; N] = core::array::from_fn(|i| 1.0 + 0.3 * i as f64);
        for _ in 0..3 {
            x = self.solve_square(x);
            let whole = norm(&x);
            x = x.map(|x| x / whole);
        }
        x
    }
}
