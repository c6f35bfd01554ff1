//! What an angle is worth beside a length.

use crate::linear::vector::{add, cross, norm};
use crate::{Pose, Twist};

/// A body that is nearer to all axes is where they are meant to meet, metres: calibrated ones miss by
/// a tenth of a millimetre.
const MEETING: f64 = 1e-4;
/// Or nearer than this of how far the axes are from the base's origin.
const ROUNDING: f64 = 1e-12;

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
    // The velocity there of one radian per second.
    let distance = |twist: &Twist| {
        let around = cross(twist.angular, home.translation);
        norm(add(twist.linear, around))
    };
    let largest = |most: f64, x: f64| most.max(x);
    let length = turning.clone().map(distance).fold(0.0, largest);
    let from_base = turning.map(|twist| norm(twist.linear)).fold(0.0, largest);
    match length > largest(MEETING, ROUNDING * from_base) {
        true => length,
        false => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of two axes 0.3 and 0.5 m from the body, and a slide, which has none.
    #[test]
    fn it_does_not_depend_on_where_the_base_is() {
        let axis = |direction, point: [f64; 3]| Twist {
            linear: cross(point, direction),
            angular: direction,
        };
        let twists = [
            axis([0.0, 0.0, 1.0], [0.3, 0.0, 7.0]),
            axis([0.0, 1.0, 0.0], [0.0, -4.0, 0.5]),
            Twist {
                linear: [9.0, 0.0, 0.0],
                angular: [0.0; 3],
            },
        ];
        for [x, y, z] in [[0.0; 3], [2.0, -1.0, 0.7], [-30.0, 5.0, 11.0]] {
            let moved = Pose::from_axis_angle([0.6, 0.0, 0.8], 1.1, [x, y, z]);
            let seen = |twists: &[Twist]| {
                let twists: [Twist; 3] = core::array::from_fn(|i| moved.adjoint(&twists[i]));
                characteristic_length(&twists, &moved)
            };
            assert!((seen(&twists) - 0.5).abs() < 1e-12);
            // On the axis alone.
            let alone = axis([0.0, 0.0, 1.0], [0.0; 3]);
            assert_eq!(seen(&[alone; 3]), 1.0);
        }
        // All through the base's origin, but for rounding, or for few digits.
        for off in [1e-17, 1e-12, 1e-5] {
            let near = |direction| axis(direction, [off, -2.0 * off, 3.0 * off]);
            let wrist = [near([0.0, 0.0, 1.0]), near([0.0, 1.0, 0.0])];
            assert_eq!(characteristic_length(&wrist, &Pose::IDENTITY), 1.0);
        }
    }
}
