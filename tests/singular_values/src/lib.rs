//! nalgebra's singular values, an oracle beside the runtime's own. Tests ask for them more than for
//! anything else, and their own packages are not optimized.

use nalgebra::DMatrix;

/// The singular values of a matrix, the largest first: as many as the fewer of rows and columns.
#[must_use]
pub fn of(matrix: DMatrix<f64>) -> Vec<f64> {
    let values = matrix.singular_values();
    let mut values = values.as_slice().to_vec();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}
