//! Least squares by rows, and singular values: matrices as n×n slices.

use crate::math;

/// Takes one more row into the upper triangle R of a QR factorization, by
/// Givens rotations; `tail` is what stands to the right of the row, and `tails`
/// holds as many entries for each row of R. Both are used up.
pub(crate) fn absorb(r: &mut [f64], tails: &mut [f64], row: &mut [f64], tail: &mut [f64]) {
    let (n, m) = (row.len(), tail.len());
    for i in 0..n {
        let (a, b) = (r[i * n + i], row[i]);
        let length = math::sqrt(a * a + b * b);
        if b == 0.0 || length == 0.0 {
            continue;
        }
        let (c, s) = (a / length, b / length);
        let turn = |x: &mut f64, y: &mut f64| (*x, *y) = (c * *x + s * *y, c * *y - s * *x);
        (i..n).for_each(|j| turn(&mut r[i * n + j], &mut row[j]));
        (0..m).for_each(|j| turn(&mut tails[i * m + j], &mut tail[j]));
    }
}

/// The singular values of an n×n matrix, largest first, into `values`: one-sided
/// Jacobi rotations, which find small ones to the rounding of the large ones
/// (Golub and Van Loan, "Matrix Computations", section 8.6). Overwrites the
/// matrix.
pub(crate) fn singular_values(a: &mut [f64], values: &mut [f64]) {
    let n = values.len();
    for _ in 0..SWEEPS {
        let mut turned = false;
        for p in 0..n {
            for q in p + 1..n {
                turned |= turn_apart(a, n, p, q);
            }
        }
        if !turned {
            break;
        }
    }
    for (j, value) in values.iter_mut().enumerate() {
        *value = math::sqrt((0..n).map(|i| a[i * n + j] * a[i * n + j]).sum());
    }
    values.sort_unstable_by(|a, b| b.total_cmp(a));
}

/// Convergence is quadratic: six to ten sweeps.
const SWEEPS: usize = 30;

/// Makes two columns perpendicular; `false` if they are.
fn turn_apart(a: &mut [f64], n: usize, p: usize, q: usize) -> bool {
    let product = |p: usize, q: usize| -> f64 { (0..n).map(|i| a[i * n + p] * a[i * n + q]).sum() };
    let (alpha, beta, gamma) = (product(p, p), product(q, q), product(p, q));
    if gamma.abs() <= 1e-16 * math::sqrt(alpha * beta) || gamma.is_nan() {
        return false;
    }
    let zeta = (beta - alpha) / (2.0 * gamma);
    let t = 1.0_f64.copysign(zeta) / (zeta.abs() + math::sqrt(1.0 + zeta * zeta));
    let c = 1.0 / math::sqrt(1.0 + t * t);
    let s = c * t;
    for i in 0..n {
        let (x, y) = (a[i * n + p], a[i * n + q]);
        a[i * n + p] = c * x - s * y;
        a[i * n + q] = s * x + c * y;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_give_the_least_squares_triangle() {
        // x + y = 3, x − y = 1, 2x + y = 5 has the solution (2, 1).
        let (mut r, mut tails) = ([0.0; 4], [0.0; 2]);
        for ([a, b], d) in [([1.0, 1.0], 3.0), ([1.0, -1.0], 1.0), ([2.0, 1.0], 5.0)] {
            absorb(&mut r, &mut tails, &mut [a, b], &mut [d]);
        }
        let y = tails[1] / r[3];
        let x = (tails[0] - r[1] * y) / r[0];
        assert!((x - 2.0).abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
    }

    #[test]
    fn singular_values_of_a_known_matrix() {
        // [[3, 0], [4, 5]] has √45 and √5.
        let mut values = [0.0; 2];
        singular_values(&mut [3.0, 0.0, 4.0, 5.0], &mut values);
        assert!((values[0] - 45_f64.sqrt()).abs() < 1e-14);
        assert!((values[1] - 5_f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn a_lost_rank_is_a_zero() {
        let mut values = [0.0; 3];
        singular_values(
            &mut [1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 1.0],
            &mut values,
        );
        assert!(values[2] < 1e-15, "{values:?}");
    }
}
