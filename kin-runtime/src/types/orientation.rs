//! Poses from and to the usual ways of writing an orientation.

use super::super::linear::vector::{norm, scale};
use super::super::scalar::Real;
use super::super::{Pose, math};

impl Pose {
    /// From a quaternion (x, y, z, w), the scalar last as in ROS messages, and
    /// a translation in metres. The quaternion need not be normalized, but not
    /// be zero.
    ///
    /// ```
    /// use kin_runtime::Pose;
    /// let half_turn = Pose::from_quaternion([0.0, 0.0, 2.0, 0.0], [0.0; 3]);
    /// assert_eq!(half_turn.rotate([1.0, 0.0, 0.0]), [-1.0, 0.0, 0.0]);
    /// ```
    pub fn from_quaternion(quaternion: [Real; 4], translation: [Real; 3]) -> Pose {
        let [x, y, z, w] = quaternion;
        let s = 2.0 / (x * x + y * y + z * z + w * w);
        Pose {
            rotation: [
                [
                    1.0 - s * (y * y + z * z),
                    s * (x * y - z * w),
                    s * (x * z + y * w),
                ],
                [
                    s * (x * y + z * w),
                    1.0 - s * (x * x + z * z),
                    s * (y * z - x * w),
                ],
                [
                    s * (x * z - y * w),
                    s * (y * z + x * w),
                    1.0 - s * (x * x + y * y),
                ],
            ],
            translation,
        }
    }

    /// The unit quaternion (x, y, z, w), scalar last, w ≥ 0.
    ///
    /// Method: of the four ways to divide by a component, the one with the
    /// largest divisor (S. W. Shepperd, "Quaternion from rotation matrix",
    /// Journal of Guidance and Control 1, 1978).
    pub fn quaternion(&self) -> [Real; 4] {
        let r = &self.rotation;
        let trace = r[0][0] + r[1][1] + r[2][2];
        let largest = (0..3)
            .max_by(|&i, &j| r[i][i].total_cmp(&r[j][j]))
            .unwrap_or(0);
        let mut q = if trace >= r[largest][largest] {
            [
                r[2][1] - r[1][2],
                r[0][2] - r[2][0],
                r[1][0] - r[0][1],
                1.0 + trace,
            ]
        } else {
            let (i, j, k) = (largest, (largest + 1) % 3, (largest + 2) % 3);
            let mut q = [0.0; 4];
            q[i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
            q[j] = r[i][j] + r[j][i];
            q[k] = r[i][k] + r[k][i];
            q[3] = r[k][j] - r[j][k];
            q
        };
        let length = math::sqrt(q.iter().map(|x| x * x).sum());
        let signed = if q[3] < 0.0 { -length } else { length };
        q.iter_mut().for_each(|x| *x /= signed);
        q
    }

    /// From a rotation by `angle` radians about `axis` through the moving
    /// frame's origin, and a translation in metres. The axis need not be a unit
    /// vector; the zero axis gives no rotation.
    pub fn from_axis_angle(axis: [Real; 3], angle: Real, translation: [Real; 3]) -> Pose {
        let length = norm(axis);
        let (sine, cosine) = math::sin_cos(0.5 * angle);
        if length == 0.0 {
            return Pose::from_translation(translation);
        }
        let [x, y, z] = scale(sine / length, axis);
        Pose::from_quaternion([x, y, z, cosine], translation)
    }

    /// From roll, pitch and yaw in radians, as in URDF: a rotation about the
    /// fixed x axis by `roll`, then y by `pitch`, then z by `yaw`; and a
    /// translation in metres.
    ///
    /// ```
    /// use kin_runtime::Pose;
    /// let pose = Pose::from_rpy([0.1, -0.2, 0.3], [0.0; 3]);
    /// let rpy = pose.rpy();
    /// assert!((rpy[1] + 0.2).abs() < 1e-15);
    /// ```
    pub fn from_rpy([roll, pitch, yaw]: [Real; 3], translation: [Real; 3]) -> Pose {
        let (sr, cr) = math::sin_cos(roll);
        let (sp, cp) = math::sin_cos(pitch);
        let (sy, cy) = math::sin_cos(yaw);
        Pose {
            rotation: [
                [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                [-sp, cp * sr, cp * cr],
            ],
            translation,
        }
    }

    /// Roll, pitch and yaw in radians, pitch in [−π/2, π/2]. At pitch ±π/2,
    /// where only the sum or difference of the other two is determined, one of
    /// the pairs that reproduce the orientation.
    pub fn rpy(&self) -> [Real; 3] {
        let r = &self.rotation;
        let yaw = math::atan2(r[1][0], r[0][0]);
        let (s, c) = math::sin_cos(yaw);
        let roll = math::atan2(s * r[0][2] - c * r[1][2], c * r[1][1] - s * r[0][1]);
        [roll, math::atan2(-r[2][0], c * r[0][0] + s * r[1][0]), yaw]
    }
}
