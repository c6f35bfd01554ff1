//! The exponential coordinates of rigid motions.

use super::super::linear::vector::{add, cross, norm, scale};
use super::super::scalar::Real;
use super::super::{Pose, Twist, math};

impl Pose {
    /// e^(ξ̂ θ) (MLS section 2.3.2): the motion along the screw `twist` by
    /// `theta`, radians for a unit revolute twist and metres for a unit
    /// prismatic one. The twist need not be a unit twist.
    ///
    /// ```
    /// use core::f64::consts::FRAC_PI_2;
    /// use kin_runtime::{Pose, Twist};
    /// let hinge = Twist::revolute([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    /// let opened = Pose::exp(&hinge, FRAC_PI_2);
    /// assert!(opened.translation_distance(&Pose::from_translation([1.0, -1.0, 0.0])) < 1e-15);
    /// ```
    pub fn exp(twist: &Twist, theta: Real) -> Pose {
        let (v, w) = (scale(theta, twist.linear), scale(theta, twist.angular));
        let angle = norm(w);
        // p = v + b ŵ v + c ŵ² v with b = (1 − cos φ)/φ², c = (φ − sin φ)/φ³;
        // the half angle avoids the cancellation in b, and that in c is
        // multiplied by φ².
        let half = ratio(math::sin_cos(0.5 * angle).0, 0.5 * angle, 1.0);
        let c = ratio(
            angle - math::sin_cos(angle).0,
            angle * angle * angle,
            1.0 / 6.0,
        );
        let once = cross(w, v);
        let curved = add(scale(0.5 * half * half, once), scale(c, cross(w, once)));
        Pose::from_axis_angle(w, angle, add(v, curved))
    }

    /// log g: the twist ξθ, with rotation angle in [0, π], for which
    /// `Pose::exp(&twist, 1.0)` is this motion. At a half turn, where two
    /// twists do, one of them. Accurate to some 1e-15 at any angle.
    ///
    /// ```
    /// use kin_runtime::{Pose, Twist};
    /// let screw = Twist::from_array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    /// let back = Pose::exp(&screw, 1.0).log();
    /// assert!((back - screw).to_array().iter().all(|x| x.abs() < 1e-15));
    /// ```
    pub fn log(&self) -> Twist {
        let [x, y, z, cosine] = self.quaternion();
        let sine = norm([x, y, z]);
        let half = math::atan2(sine, cosine);
        let w = scale(ratio(2.0 * half, sine, 2.0), [x, y, z]);
        // v = p − ½ ŵ p + k ŵ² p with k = (1 − ½φ cot ½φ)/φ².
        let cotangent = ratio(half * cosine, sine, 1.0);
        let k = ratio(1.0 - cotangent, 4.0 * half * half, 1.0 / 12.0);
        let once = cross(w, self.translation);
        let straightened = add(scale(-0.5, once), scale(k, cross(w, once)));
        Twist {
            linear: add(self.translation, straightened),
            angular: w,
        }
    }
}

/// a / b, or its limit where the division would be 0/0.
fn ratio(a: Real, b: Real, limit: Real) -> Real {
    if b == 0.0 { limit } else { a / b }
}
