//! Singular values of a matrix of a few rows by one-sided Jacobi rotations.
//!
//! M. R. Hestenes, "Inversion of matrices by biorthogonalization and related
//! results", J. SIAM 6, 1958: pairs of rows are rotated until all are
//! orthogonal. Nothing is squared, so that small singular values keep their
//! digits, and a matrix of fewer columns than rows needs no special case.

use super::super::math::sqrt;
use super::super::scalar::Real;
use super::vector::norm;

/// Jacobians take 4 to 6 sweeps; this bounds those that hold no numbers.
const SWEEPS: usize = 30;

/// The cosine between rows that counts as 0. A singular value is off by no more
/// than its square, but inner products of ten terms cannot be had more exactly.
const ORTHOGONAL: Real = 8.0 * Real::EPSILON;

/// A = Σ uᵢ σᵢ vᵢᵀ, the largest σ first.
pub struct SingularValues<const R: usize, const N: usize> {
    /// σ; those that are not above rounding are 0.
    pub values: [Real; R],
    /// The rows are u, a complete orthonormal basis.
    pub left: [[Real; R]; R],
    /// The rows are σ v.
    scaled_right: [[Real; N]; R],
}

impl<const R: usize, const N: usize> SingularValues<R, N> {
    /// How many there are; any further ones are 0.
    pub const COUNT: usize = if R < N { R } else { N };

    /// Of a matrix by its rows.
    pub fn new(rows: &[[Real; N]; R]) -> Self {
        let mut rows = *rows;
        let mut left = [[0.0; R]; R];
        for i in 0..R {
            left[i][i] = 1.0;
        }
        let rounding = orthogonalize(rows.as_flattened_mut(), N, |i, j, cosine, sine| {
            rotate(left.as_flattened_mut(), R, i, j, cosine, sine);
        });
        let values = rows.map(norm);
        let order = descending(&values);
        SingularValues {
            values: order.map(|i| {
                if values[i] <= rounding {
                    0.0
                } else {
                    values[i]
                }
            }),
            left: order.map(|i| left[i]),
            scaled_right: order.map(|i| rows[i]),
        }
    }

    /// vᵢ; zero where σᵢ is 0.
    pub fn right(&self, i: usize) -> [Real; N] {
        let value = self.values[i];
        self.scaled_right[i].map(|x| if value > 0.0 { x / value } else { 0.0 })
    }

    /// How many are above `tolerance` times the largest.
    pub fn rank(&self, tolerance: Real) -> usize {
        let least = tolerance * self.values[0];
        self.values.iter().filter(|&&value| value > least).count()
    }
}

/// The singular values of an n×n matrix, largest first, into `values`.
/// Overwrites the matrix.
pub(crate) fn singular_values(square: &mut [Real], values: &mut [Real]) {
    let n = values.len();
    orthogonalize(square, n, |_, _, _, _| {});
    for (i, value) in values.iter_mut().enumerate() {
        let row = &square[i * n..][..n];
        *value = sqrt(inner(row, row));
    }
    values.sort_unstable_by(|a, b| b.total_cmp(a));
}

/// Rotates pairs of rows of the given width until all are orthogonal, tells
/// every rotation, and returns the length of a row that is rounding.
#[inline(always)]
fn orthogonalize(
    rows: &mut [Real],
    width: usize,
    mut rotated: impl FnMut(usize, usize, Real, Real),
) -> Real {
    let count = rows.len().checked_div(width).unwrap_or(0);
    let rounding = 4.0 * Real::EPSILON * sqrt(inner(rows, rows));
    let mut turned = true;
    for _ in 0..SWEEPS {
        if !core::mem::take(&mut turned) {
            break;
        }
        for i in 0..count {
            for j in i + 1..count {
                let (a, b) = (&rows[i * width..][..width], &rows[j * width..][..width]);
                if let Some((cosine, sine)) = rotation(a, b, rounding) {
                    rotate(rows, width, i, j, cosine, sine);
                    rotated(i, j, cosine, sine);
                    turned = true;
                }
            }
        }
    }
    rounding
}

/// The rotation that makes two rows orthogonal; none if they are, or if one of
/// them is zero to rounding.
#[inline(always)]
fn rotation(a: &[Real], b: &[Real], rounding: Real) -> Option<(Real, Real)> {
    let (aa, bb, ab) = (inner(a, a), inner(b, b), inner(a, b));
    let zero = rounding * rounding;
    if ab.abs() <= ORTHOGONAL * sqrt(aa * bb) || aa <= zero || bb <= zero {
        return None;
    }
    let zeta = (bb - aa) / (2.0 * ab);
    let tangent = Real::copysign(1.0, zeta) / (zeta.abs() + sqrt(1.0 + zeta * zeta));
    let cosine = 1.0 / sqrt(1.0 + tangent * tangent);
    Some((cosine, cosine * tangent))
}

/// Rotates rows i < j.
#[inline(always)]
fn rotate(rows: &mut [Real], width: usize, i: usize, j: usize, cosine: Real, sine: Real) {
    let (before, after) = rows.split_at_mut(j * width);
    let pairs = before[i * width..][..width].iter_mut().zip(after);
    for (x, y) in pairs {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
}

fn descending<const R: usize>(values: &[Real; R]) -> [usize; R] {
    let mut order = core::array::from_fn(|i| i);
    order.sort_unstable_by(|&i, &j| values[j].total_cmp(&values[i]));
    order
}

#[inline(always)]
fn inner(a: &[Real], b: &[Real]) -> Real {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Vandermonde-like rows of a matrix whose inverse is known to be bad:
    /// A = Σ uᵢ σᵢ vᵢᵀ must hold to rounding.
    #[test]
    fn the_factors_multiply_to_the_matrix() {
        let rows: [[Real; 4]; 3] = [
            [1.0, 0.5, 1.0 / 3.0, 0.25],
            [0.5, 1.0 / 3.0, 0.25, 0.2],
            [1.0 / 3.0, 0.25, 0.2, 1.0 / 6.0],
        ];
        let found = SingularValues::new(&rows);
        for i in 0..3 {
            for j in 0..4 {
                let term = |k: usize| found.left[k][i] * found.values[k] * found.right(k)[j];
                let entry: Real = (0..3).map(term).sum();
                assert!((entry - rows[i][j]).abs() < 8.0 * Real::EPSILON);
            }
        }
        assert!(found.values[0] > found.values[1] && found.values[1] > found.values[2]);
    }

    #[test]
    fn more_rows_than_columns_leave_zeros_and_a_complete_basis() {
        let found = SingularValues::new(&[[3.0, 4.0], [6.0, 8.0], [0.0, 0.0], [4.0, -3.0]]);
        assert!((found.values[0] - Real::sqrt(125.0)).abs() < 90.0 * Real::EPSILON);
        assert!((found.values[1] - 5.0).abs() < 90.0 * Real::EPSILON);
        assert_eq!(found.values[2..], [0.0; 2]);
        for i in 0..4 {
            for j in 0..4 {
                let expected = Real::from(u8::from(i == j));
                assert!(
                    (inner(&found.left[i], &found.left[j]) - expected).abs() < 8.0 * Real::EPSILON
                );
            }
        }
    }

    #[test]
    fn what_is_no_number_ends() {
        assert!(SingularValues::new(&[[Real::NAN, 1.0], [1.0, 2.0]]).values[0].is_nan());
    }

    #[test]
    fn singular_values_of_a_known_matrix() {
        // [[3, 0], [4, 5]] has √45 and √5.
        let mut values = [0.0; 2];
        singular_values(&mut [3.0, 0.0, 4.0, 5.0], &mut values);
        assert!((values[0] - Real::sqrt(45.0)).abs() < 90.0 * Real::EPSILON);
        assert!((values[1] - Real::sqrt(5.0)).abs() < 90.0 * Real::EPSILON);
    }

    #[test]
    fn a_lost_rank_is_a_zero() {
        let mut values = [0.0; 3];
        singular_values(
            &mut [1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 1.0],
            &mut values,
        );
        assert!(values[2] < 8.0 * Real::EPSILON, "{values:?}");
    }
}
