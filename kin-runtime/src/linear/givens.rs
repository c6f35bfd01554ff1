//! Least squares by rows: triangles as n×n slices.

use super::super::math;
use super::super::scalar::Real;

/// Takes one more row into the upper triangle R of a QR factorization, by
/// Givens rotations; `tail` is what stands to the right of the row, and `tails`
/// holds as many entries for each row of R. Both are used up.
pub(crate) fn absorb(r: &mut [Real], tails: &mut [Real], row: &mut [Real], tail: &mut [Real]) {
    let (n, m) = (row.len(), tail.len());
    for i in 0..n {
        let (a, b) = (r[i * n + i], row[i]);
        let length = math::sqrt(a * a + b * b);
        if b == 0.0 || length == 0.0 {
            continue;
        }
        let (c, s) = (a / length, b / length);
        let turn = |x: &mut Real, y: &mut Real| (*x, *y) = (c * *x + s * *y, c * *y - s * *x);
        (i..n).for_each(|j| turn(&mut r[i * n + j], &mut row[j]));
        (0..m).for_each(|j| turn(&mut tails[i * m + j], &mut tail[j]));
    }
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
        assert!((x - 2.0).abs() < 8.0 * Real::EPSILON && (y - 1.0).abs() < 8.0 * Real::EPSILON);
    }
}
