//! Symmetric positive definite systems of a size known at run time.

/// Overwrites the lower triangle of the n×n row-major matrix by its Cholesky
/// factor; `false` if it is not positive definite.
pub(crate) fn factor(matrix: &mut [f64], n: usize) -> bool {
    for j in 0..n {
        for i in j..n {
            let known: f64 = (0..j).map(|k| matrix[i * n + k] * matrix[j * n + k]).sum();
            let rest = matrix[i * n + j] - known;
            if i > j {
                matrix[i * n + j] = rest / matrix[j * n + j];
            } else if rest > 0.0 {
                matrix[j * n + j] = libm::sqrt(rest);
            } else {
                return false;
            }
        }
    }
    true
}

/// Solves L Lᵀ x = b in place.
pub(crate) fn solve(factor: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        let known: f64 = (0..i).map(|k| factor[i * n + k] * x[k]).sum();
        x[i] = (x[i] - known) / factor[i * n + i];
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|k| factor[k * n + i] * x[k]).sum();
        x[i] = (x[i] - known) / factor[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_definite_system_and_refuses_an_indefinite_one() {
        let mut matrix = [4.0, 2.0, 2.0, 3.0];
        assert!(factor(&mut matrix, 2));
        let mut x = [2.0, -1.0];
        solve(&matrix, &mut x);
        assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] + 1.0).abs() < 1e-15);
        assert!(!factor(&mut [1.0, 2.0, 2.0, 1.0], 2));
    }
}
