//! Conversions to and from mint's matrices.

use mint::{ColumnMatrix4, RowMatrix4};

use super::super::Pose;
use super::super::scalar::Real;

impl From<Pose> for RowMatrix4<Real> {
    fn from(pose: Pose) -> Self {
        pose.to_matrix().into()
    }
}

impl From<RowMatrix4<Real>> for Pose {
    /// Takes the upper three rows as they are.
    fn from(matrix: RowMatrix4<Real>) -> Self {
        Pose::from_matrix(&matrix.into())
    }
}

impl From<Pose> for ColumnMatrix4<Real> {
    fn from(pose: Pose) -> Self {
        let rows = pose.to_matrix();
        let column = |j: usize| core::array::from_fn(|i| rows[i][j]);
        core::array::from_fn::<[Real; 4], 4, _>(column).into()
    }
}

impl From<ColumnMatrix4<Real>> for Pose {
    /// Takes the upper three rows as they are.
    fn from(matrix: ColumnMatrix4<Real>) -> Self {
        let columns: [[Real; 4]; 4] = matrix.into();
        let row = |i: usize| core::array::from_fn(|j| columns[j][i]);
        Pose::from_matrix(&core::array::from_fn(row))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_survive_the_round_trip() {
        let pose = Pose::from_rpy([0.3, -0.4, 2.0], [1.0, 2.0, 3.0]);
        assert_eq!(Pose::from(RowMatrix4::from(pose)), pose);
        assert_eq!(Pose::from(ColumnMatrix4::from(pose)), pose);
        assert_eq!(RowMatrix4::from(pose).x.w, 1.0);
        assert_eq!(ColumnMatrix4::from(pose).w.x, 1.0);
    }
}
