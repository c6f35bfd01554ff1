//! Rotations as robot files write them.

use crate::vector::dot;
use kin_runtime::Pose;

/// Rotation entries below this are what cos(pi/2) leaves in double precision.
/// The nearest values that a file can mean, such as the 4e-6 of `1.5708`, are
/// a billion times larger and stay as they are.
const ROUNDING: f64 = 1e-15;

/// Larger angles are degrees: no file turns a frame more than once around.
pub(crate) const FULL_TURN: f64 = std::f64::consts::TAU + 0.01;

/// A row-major rotation matrix.
pub(super) type Rotation = [[f64; 3]; 3];

/// Rz(yaw) Ry(pitch) Rx(roll), radians.
pub(super) fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> Rotation {
    let ((sr, cr), (sp, cp), (sy, cy)) = (sin_cos(roll), sin_cos(pitch), sin_cos(yaw));
    exact([
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ])
}

/// The rotation of a quaternion of any length but 0, scalar last.
pub(super) fn from_quaternion(q: [f64; 4]) -> Rotation {
    exact(Pose::from_quaternion(q, [0.0; 3]).rotation)
}

/// A quaternion's length, if it is not the 1 of a rounded unit quaternion.
pub(super) fn check_quaternion(q: [f64; 4]) -> Result<(), f64> {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (length - 1.0).abs() < 0.01 {
        Ok(())
    } else {
        Err(length)
    }
}

/// The rotation that is next to a matrix, by Gram-Schmidt on its rows; `None` if the matrix is
/// off by more than 1e-4 or turns right hands into left ones.
pub(super) fn from_matrix(m: Rotation) -> Option<Rotation> {
    let x = unit(m[0])?;
    let y = unit(std::array::from_fn(|i| m[1][i] - dot(x, m[1]) * x[i]))?;
    let z = [
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    ];
    let r = exact([x, y, z]);
    let close = (0..3).all(|i| (0..3).all(|j| (r[i][j] - m[i][j]).abs() <= 1e-4));
    close.then_some(r)
}

/// The rotation by an angle about x or z, the ones that Denavit-Hartenberg
/// parameters use.
pub(super) fn about_x(angle: f64) -> Pose {
    Pose {
        rotation: from_rpy([angle, 0.0, 0.0]),
        ..Pose::IDENTITY
    }
}

/// See [`about_x`].
pub(super) fn about_z(angle: f64) -> Pose {
    Pose {
        rotation: from_rpy([0.0, 0.0, angle]),
        ..Pose::IDENTITY
    }
}

/// A pure translation.
pub(super) fn shift(translation: [f64; 3]) -> Pose {
    Pose {
        translation,
        ..Pose::IDENTITY
    }
}

/// The direction of a vector; `None` if it is too short to have one.
pub(super) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    // Scaled first: the square of a large number need not be one.
    let largest = v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest < 1e-9 {
        return None;
    }
    let v = v.map(|x| x / largest);
    let length = dot(v, v).sqrt();
    Some(v.map(|x| x / length))
}

fn sin_cos(angle: f64) -> (f64, f64) {
    let (s, c) = angle.sin_cos();
    (snap(s), snap(c))
}

fn exact(r: Rotation) -> Rotation {
    r.map(|row| row.map(snap))
}

/// x, or the 0 or ±1 that it is up to rounding.
fn snap(x: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    let nearest = x.round() + 0.0;
    if (x - nearest).abs() < ROUNDING {
        nearest
    } else {
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn right_angles_are_exact() {
        assert_eq!(
            from_rpy([FRAC_PI_2, 0.0, 0.0]),
            [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
        );
        assert_eq!(
            from_rpy([PI, 0.0, PI]),
            [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]
        );
        assert_eq!(
            from_quaternion([0.5, 0.5, 0.5, 0.5]),
            [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        );
        let half = 0.5_f64.sqrt();
        assert_eq!(
            from_quaternion([half, 0.0, 0.0, half]),
            from_rpy([FRAC_PI_2, 0.0, 0.0])
        );
    }

    #[test]
    #[allow(clippy::approx_constant)] // The rounding is the point.
    fn a_rounded_right_angle_stays_literal() {
        assert_eq!(from_rpy([1.5708, 0.0, 0.0])[2][2], 1.5708_f64.cos());
        assert_eq!(from_rpy([0.0, 0.0, 3.141])[0][0], 3.141_f64.cos());
    }

    #[test]
    fn rpy_and_quaternion_agree() {
        let (r, p, y) = (0.3_f64, -0.8_f64, 2.1_f64);
        let ((sr, cr), (sp, cp), (sy, cy)) = (
            (r / 2.0).sin_cos(),
            (p / 2.0).sin_cos(),
            (y / 2.0).sin_cos(),
        );
        let q = [
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ];
        let (a, b) = (from_rpy([r, p, y]), from_quaternion(q.map(|x| -2.0 * x)));
        assert!((0..9).all(|i| (a[i / 3][i % 3] - b[i / 3][i % 3]).abs() < 1e-15));
    }

    #[test]
    fn matrices_must_be_rotations() {
        let r = from_rpy([0.1, 0.2, 0.3]);
        let rounded = r.map(|row| row.map(|x| (x * 1e5).round() / 1e5));
        assert!(from_matrix(rounded).is_some());
        assert_eq!(
            from_matrix([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]),
            None
        );
        assert_eq!(
            from_matrix([[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
            None
        );
        assert_eq!(from_matrix([[0.0; 3]; 3]), None);
    }

    #[test]
    fn directions_survive_extreme_lengths() {
        assert_eq!(unit([0.0, 0.0, -1e300]), Some([0.0, 0.0, -1.0]));
        assert_eq!(unit([0.0, 2e-5, 0.0]), Some([0.0, 1.0, 0.0]));
        assert_eq!(unit([0.0; 3]), None);
    }
}
