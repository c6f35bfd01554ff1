//! Symmetric positive definite systems, as n×n row-major slices.

use super::super::math;
use super::super::scalar::Real;

/// Overwrites the lower triangle of a matrix by its Cholesky factor L, with the
/// reciprocals of L's diagonal on the diagonal. A square of a pivot that is not
/// above `least` is taken for `least`; `false` if there is one, and the factor
/// is of use only if `least` is above 0.
#[inline(always)]
pub(crate) fn factor(matrix: &mut [Real], n: usize, least: Real) -> bool {
    let mut definite = true;
    for i in 0..n {
        for j in 0..i {
            let mut rest = matrix[i * n + j];
            for k in 0..j {
                rest -= matrix[i * n + k] * matrix[j * n + k];
            }
            let entry = rest * matrix[j * n + j];
            matrix[i * n + j] = entry;
            matrix[i * n + i] -= entry * entry;
        }
        let square = matrix[i * n + i];
        definite &= square > least;
        matrix[i * n + i] = 1.0 / math::sqrt(square.max(least));
    }
    definite
}

/// Solves L Lᵀ x = b in place, by what [`factor`] leaves.
#[inline(always)]
pub(crate) fn solve(factor: &[Real], x: &mut [Real]) {
    let n = x.len();
    for i in 0..n {
        for k in 0..i {
            x[i] -= factor[i * n + k] * x[k];
        }
        x[i] *= factor[i * n + i];
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            x[i] -= factor[k * n + i] * x[k];
        }
        x[i] *= factor[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_definite_system_and_refuses_an_indefinite_one() {
        let mut matrix = [4.0, 2.0, 2.0, 3.0];
        assert!(factor(&mut matrix, 2, 0.0));
        let mut x = [2.0, -1.0];
        solve(&matrix, &mut x);
        assert!(
            (x[0] - 1.0).abs() < 8.0 * Real::EPSILON && (x[1] + 1.0).abs() < 8.0 * Real::EPSILON
        );
        assert!(!factor(&mut [1.0, 2.0, 2.0, 1.0], 2, 0.0));
        assert!(!factor(&mut [1.0, Real::NAN, Real::NAN, 1.0], 2, 0.0));
    }
}
