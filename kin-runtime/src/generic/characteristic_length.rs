//! What an angle is worth beside a length.

use crate::linear::vector::{cross, norm, sub};
use crate::{Pose, Twist};

/// The characteristic length of joints that carry a body: how far the body's origin
/// is at home from the farthest axis of rotation, metres; 1 if it is on all of them.
/// An angle of one radian counts as much as this length. The word is Angeles's
/// (*Fundamentals of Robotic Mechanical Systems*), who chooses the length by the
/// condition of the Jacobian.
///
/// It weighs; the size that an arm has, how far it reaches when stretched, is
/// another number, and the compiler's.
pub fn characteristic_length(twists: &[Twist], home: &Pose) -> f64 {
    let turning = twists.iter().filter(|twist| twist.angular != [0.0; 3]);
    let points = turning.map(|twist| cross(twist.angular, twist.linear));
    let from = |point: [f64; 3]| norm(sub(point, home.translation));
    let length = points.map(from).fold(0.0, f64::max);
    if length > 0.0 { length } else { 1.0 }
}
