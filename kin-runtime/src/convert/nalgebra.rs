//! Conversions to and from nalgebra.

use nalgebra::{
    Isometry3, Matrix4, Quaternion, SMatrix, Translation3, UnitQuaternion, Vector4, Vector6,
};

use super::super::scalar::Real;
use super::super::{Jacobian, Pose, Twist, Wrench};

// The isometry is put together from its parts: nalgebra's own constructors ask
// for its `std` or `libm` feature, which would bind every user to one.
impl From<Pose> for Isometry3<Real> {
    fn from(pose: Pose) -> Self {
        let quaternion = Quaternion {
            coords: Vector4::from(pose.quaternion()),
        };
        Isometry3 {
            rotation: UnitQuaternion::new_unchecked(quaternion),
            translation: Translation3::from(pose.translation),
        }
    }
}

impl From<Isometry3<Real>> for Pose {
    fn from(isometry: Isometry3<Real>) -> Self {
        let quaternion = isometry.rotation.as_ref().coords.into();
        Pose::from_quaternion(quaternion, isometry.translation.vector.into())
    }
}

impl From<Pose> for Matrix4<Real> {
    fn from(pose: Pose) -> Self {
        let matrix = pose.to_matrix();
        Matrix4::from_fn(|i, j| matrix[i][j])
    }
}

impl From<Matrix4<Real>> for Pose {
    /// Takes the upper three rows as they are.
    fn from(matrix: Matrix4<Real>) -> Self {
        let row = |i: usize| core::array::from_fn(|j| matrix[(i, j)]);
        Pose::from_matrix(&core::array::from_fn(row))
    }
}

impl<const N: usize> From<Jacobian<N>> for SMatrix<Real, 6, N> {
    fn from(jacobian: Jacobian<N>) -> Self {
        SMatrix::from_fn(|i, j| jacobian.rows[i][j])
    }
}

impl<const N: usize> From<SMatrix<Real, 6, N>> for Jacobian<N> {
    fn from(matrix: SMatrix<Real, 6, N>) -> Self {
        Jacobian {
            rows: core::array::from_fn(|i| core::array::from_fn(|j| matrix[(i, j)])),
        }
    }
}

impl From<Twist> for Vector6<Real> {
    /// (v, ω).
    fn from(twist: Twist) -> Self {
        twist.to_array().into()
    }
}

impl From<Vector6<Real>> for Twist {
    /// (v, ω).
    fn from(coordinates: Vector6<Real>) -> Self {
        Twist::from_array(coordinates.into())
    }
}

impl From<Wrench> for Vector6<Real> {
    /// (f, τ).
    fn from(wrench: Wrench) -> Self {
        wrench.to_array().into()
    }
}

impl From<Vector6<Real>> for Wrench {
    /// (f, τ).
    fn from(coordinates: Vector6<Real>) -> Self {
        Wrench::from_array(coordinates.into())
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::scalar::consts::{FRAC_1_SQRT_2, PI};
    use super::*;

    #[test]
    fn isometries_have_the_scalar_last_and_survive_the_round_trip() {
        let pose = Pose::from_axis_angle([0.0, 0.0, 1.0], 0.5 * PI, [1.0; 3]);
        let isometry = Isometry3::from(pose);
        let quarter_turn = Vector4::new(0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2);
        assert!(
            (isometry.rotation.as_ref().coords - quarter_turn)
                .abs()
                .max()
                < 8.0 * Real::EPSILON
        );

        let pose = Pose::from_rpy([0.3, -0.4, 2.0], [1.0, 2.0, 3.0]);
        let back = Pose::from(Isometry3::from(pose));
        assert!(back.rotation_distance(&pose) < 8.0 * Real::EPSILON);
        assert_eq!(back.translation, pose.translation);
    }

    #[test]
    fn matrices_act_as_the_pose_does() {
        let pose = Pose::from_rpy([0.3, -0.4, 2.0], [1.0, 2.0, 3.0]);
        let [x, y, z] = pose.transform_point([0.1, 0.2, 0.3]);
        let point = Matrix4::from(pose) * Vector4::new(0.1, 0.2, 0.3, 1.0);
        assert!((point - Vector4::new(x, y, z, 1.0)).abs().max() < 8.0 * Real::EPSILON);
        assert_eq!(Pose::from(Matrix4::from(pose)), pose);
    }

    #[test]
    fn jacobians_keep_rows_and_columns() {
        let jacobian = Jacobian {
            rows: core::array::from_fn(|i| [i as Real, -(i as Real)]),
        };
        let matrix = SMatrix::<Real, 6, 2>::from(jacobian);
        assert_eq!(matrix[(4, 1)], -4.0);
        assert_eq!(Jacobian::from(matrix), jacobian);
    }
}
