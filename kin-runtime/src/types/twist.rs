//! Twists, in the coordinates of MLS: linear part first.

use super::super::scalar::Real;
use core::ops::{Add, Mul, Neg, Sub};

use super::super::Pose;
use super::super::linear::vector::{add, cross, scale, sub};

/// A twist ξ = (v, ω): the velocity of a rigid body, or the axis of a joint
/// (MLS section 2.3.2). Metres and radians (per second, for a velocity).
///
/// ```
/// use kin_runtime::Twist;
/// // A vertical axis through (1, 0, 0) moves the origin towards −y.
/// let hinge = Twist::revolute([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
/// assert_eq!(hinge.linear, [0.0, -1.0, 0.0]);
/// assert_eq!((hinge * 2.0).angular, [0.0, 0.0, 2.0]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Twist {
    /// v: for a revolute axis ω through the point r, v = −ω × r.
    pub linear: [Real; 3],
    /// ω: zero for a prismatic joint.
    pub angular: [Real; 3],
}

impl Twist {
    /// The unit twist of a revolute joint: `axis` is a unit vector, `point`
    /// any point on the axis, metres.
    #[inline]
    pub fn revolute(axis: [Real; 3], point: [Real; 3]) -> Twist {
        Twist {
            linear: cross(point, axis),
            angular: axis,
        }
    }

    /// The unit twist of a prismatic joint: `direction` is a unit vector.
    #[inline]
    pub fn prismatic(direction: [Real; 3]) -> Twist {
        Twist {
            linear: direction,
            angular: [0.0; 3],
        }
    }

    /// The Lie bracket [ξ₁, ξ₂] = (ω₁ × v₂ − ω₂ × v₁, ω₁ × ω₂) (MLS appendix
    /// A): how fast the second twist changes when it is carried along with unit
    /// velocity of the first.
    ///
    /// ```
    /// use kin_runtime::Twist;
    /// let turn = Twist::revolute([0.0, 0.0, 1.0], [0.0; 3]);
    /// let slide = Twist::prismatic([1.0, 0.0, 0.0]);
    /// assert_eq!(turn.bracket(&slide), Twist::prismatic([0.0, 1.0, 0.0]));
    /// ```
    #[inline]
    pub fn bracket(&self, other: &Twist) -> Twist {
        let turned = cross(self.angular, other.linear);
        Twist {
            linear: add(turned, cross(self.linear, other.angular)),
            angular: cross(self.angular, other.angular),
        }
    }

    /// V_b = Ad_g⁻¹ V_s: the body velocity of a tip at `pose` that has this
    /// spatial velocity (MLS section 2.4).
    #[inline]
    pub fn spatial_to_body(&self, pose: &Pose) -> Twist {
        pose.adjoint_inverse(self)
    }

    /// V_s = Ad_g V_b: the inverse of [`Twist::spatial_to_body`].
    #[inline]
    pub fn body_to_spatial(&self, pose: &Pose) -> Twist {
        pose.adjoint(self)
    }

    /// The velocity of the tip's origin, and the angular velocity, both in
    /// base axes, of a tip at `pose` that has this spatial velocity.
    ///
    /// ```
    /// use kin_runtime::{Pose, Twist};
    /// let turning = Twist::revolute([0.0, 0.0, 1.0], [0.0; 3]);
    /// let tip = Pose::from_translation([0.8, 0.0, 0.0]);
    /// assert_eq!(turning.spatial_to_geometric(&tip).linear, [0.0, 0.8, 0.0]);
    /// ```
    #[inline]
    pub fn spatial_to_geometric(&self, pose: &Pose) -> Twist {
        Twist {
            linear: add(self.linear, cross(self.angular, pose.translation)),
            ..*self
        }
    }

    /// The inverse of [`Twist::spatial_to_geometric`].
    #[inline]
    pub fn geometric_to_spatial(&self, pose: &Pose) -> Twist {
        Twist {
            linear: sub(self.linear, cross(self.angular, pose.translation)),
            ..*self
        }
    }

    /// The six coordinates (v, ω).
    #[inline]
    pub fn to_array(self) -> [Real; 6] {
        let (v, w) = (self.linear, self.angular);
        [v[0], v[1], v[2], w[0], w[1], w[2]]
    }

    /// From the six coordinates (v, ω).
    #[inline]
    pub fn from_array([vx, vy, vz, wx, wy, wz]: [Real; 6]) -> Twist {
        Twist {
            linear: [vx, vy, vz],
            angular: [wx, wy, wz],
        }
    }
}

impl Add for Twist {
    type Output = Twist;
    #[inline]
    fn add(self, other: Twist) -> Twist {
        Twist {
            linear: add(self.linear, other.linear),
            angular: add(self.angular, other.angular),
        }
    }
}

impl Sub for Twist {
    type Output = Twist;
    #[inline]
    fn sub(self, other: Twist) -> Twist {
        Twist {
            linear: sub(self.linear, other.linear),
            angular: sub(self.angular, other.angular),
        }
    }
}

impl Neg for Twist {
    type Output = Twist;
    #[inline]
    fn neg(self) -> Twist {
        self * -1.0
    }
}

impl Mul<Real> for Twist {
    type Output = Twist;
    #[inline]
    fn mul(self, k: Real) -> Twist {
        Twist {
            linear: scale(k, self.linear),
            angular: scale(k, self.angular),
        }
    }
}
