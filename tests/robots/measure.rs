//! How far apart things are.

use kin_codegen::Target;
use kinematics::{Pose, Twist};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Translation and rotation as far as they count, the angle as the way at the
/// distance of `size`, as the legs of a right triangle. Metres.
pub fn distance(a: &Pose, b: &Pose, counts: Target, size: f64) -> f64 {
    let way = a.translation_distance(b);
    match counts {
        Target::Position => way,
        Target::PositionAxis => way.hypot(size * tilt(a, b)),
        Target::Direction => size * tilt(a, b),
        Target::Orientation => size * a.rotation_distance(b),
        Target::Pose | Target::PositionYaw | Target::Planar => {
            way.hypot(size * a.rotation_distance(b))
        }
    }
}

/// The angle between the z axes.
fn tilt(a: &Pose, b: &Pose) -> f64 {
    let z = |pose: &Pose| nalgebra::Vector3::from(pose.rotate([0.0, 0.0, 1.0]));
    let (a, b) = (z(a), z(b));
    a.cross(&b).norm().atan2(a.dot(&b))
}

/// The largest difference of two entries of the homogeneous matrices.
pub fn entrywise(a: &Pose, b: &Pose) -> f64 {
    let entries = a.to_matrix().into_iter().flatten();
    let others = b.to_matrix().into_iter().flatten();
    largest(entries.zip(others).map(|(x, y)| x - y))
}

/// The largest magnitude; NaN if there is one.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| {
        if b.abs() > a || b.is_nan() {
            b.abs()
        } else {
            a
        }
    };
    values.into_iter().fold(0.0, larger)
}

/// The distance of two angles on the circle.
pub fn angle_between(a: f64, b: f64) -> f64 {
    let d = (a - b).abs() % TAU;
    d.min(TAU - d)
}

/// The singular values of the Jacobian of whole poses or of positions, the largest first, lengths
/// in units of `size`. `columns` are those of the geometric Jacobian.
pub fn singular_values(columns: &[Twist], counts: Target, size: f64) -> Vec<f64> {
    let rows = if counts == Target::Position { 3 } else { 6 };
    let column = |twist: &Twist| {
        let linear = twist.linear.map(|x| x / size);
        DVector::from_iterator(rows, linear.into_iter().chain(twist.angular).take(rows))
    };
    let columns: Vec<_> = columns.iter().map(column).collect();
    singular_values::of(DMatrix::from_columns(&columns))
}
