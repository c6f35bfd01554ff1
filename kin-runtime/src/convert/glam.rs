//! Conversions to and from glam.

use glam::{DAffine3, DMat3, DMat4, DVec3};

use crate::Pose;

impl From<Pose> for DAffine3 {
    fn from(pose: Pose) -> Self {
        DAffine3 {
            matrix3: DMat3::from_cols_array_2d(&pose.rotation).transpose(),
            translation: DVec3::from_array(pose.translation),
        }
    }
}

impl From<DAffine3> for Pose {
    /// Takes the linear part as it is; it should be a rotation.
    fn from(affine: DAffine3) -> Self {
        Pose {
            rotation: affine.matrix3.transpose().to_cols_array_2d(),
            translation: affine.translation.to_array(),
        }
    }
}

impl From<Pose> for DMat4 {
    fn from(pose: Pose) -> Self {
        DMat4::from_cols_array_2d(&pose.to_matrix()).transpose()
    }
}

impl From<DMat4> for Pose {
    /// Takes the upper three rows as they are.
    fn from(matrix: DMat4) -> Self {
        Pose::from_matrix(&matrix.transpose().to_cols_array_2d())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_survive_the_round_trip_and_act_alike() {
        let pose = Pose::from_rpy([0.3, -0.4, 2.0], [1.0, 2.0, 3.0]);
        let ours = DVec3::from_array(pose.transform_point([0.1, 0.2, 0.3]));
        let point = DVec3::new(0.1, 0.2, 0.3);
        assert!((DAffine3::from(pose).transform_point3(point) - ours).length() < 1e-15);
        assert!((DMat4::from(pose).transform_point3(point) - ours).length() < 1e-15);
        assert_eq!(Pose::from(DAffine3::from(pose)), pose);
        assert_eq!(Pose::from(DMat4::from(pose)), pose);
    }
}
