//! Twists and wrenches, in the coordinates of MLS: linear part first.

use core::ops::{Add, Mul, Neg, Sub};

use crate::vector::{add, cross, dot, scale, sub};

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
pub struct Twist {
    /// v: for a revolute axis ω through the point r, v = −ω × r.
    pub linear: [f64; 3],
    /// ω: zero for a prismatic joint.
    pub angular: [f64; 3],
}

impl Twist {
    /// The unit twist of a revolute joint: `axis` is a unit vector, `point`
    /// any point on the axis, metres.
    #[inline]
    pub fn revolute(axis: [f64; 3], point: [f64; 3]) -> Twist {
        Twist {
            linear: cross(point, axis),
            angular: axis,
        }
    }

    /// The unit twist of a prismatic joint: `direction` is a unit vector.
    #[inline]
    pub fn prismatic(direction: [f64; 3]) -> Twist {
        Twist {
            linear: direction,
            angular: [0.0; 3],
        }
    }

    /// The six coordinates (v, ω).
    #[inline]
    pub fn to_array(self) -> [f64; 6] {
        let (v, w) = (self.linear, self.angular);
        [v[0], v[1], v[2], w[0], w[1], w[2]]
    }

    /// From the six coordinates (v, ω).
    #[inline]
    pub fn from_array([vx, vy, vz, wx, wy, wz]: [f64; 6]) -> Twist {
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

impl Mul<f64> for Twist {
    type Output = Twist;
    #[inline]
    fn mul(self, k: f64) -> Twist {
        Twist {
            linear: scale(k, self.linear),
            angular: scale(k, self.angular),
        }
    }
}

/// A wrench F = (f, τ): force and moment (MLS section 2.5). Newtons and newton
/// metres.
///
/// ```
/// use kin_runtime::{Twist, Wrench};
/// let weight = Wrench { force: [0.0, 0.0, -9.81], moment: [0.0; 3] };
/// let lift = Twist::prismatic([0.0, 0.0, 0.1]);
/// assert!((weight.power(&lift) + 0.981).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// f.
    pub force: [f64; 3],
    /// τ.
    pub moment: [f64; 3],
}

impl Wrench {
    /// The instantaneous work F · V that the wrench does on a body moving with
    /// `velocity`, both in the same coordinates; watts.
    #[inline]
    pub fn power(&self, velocity: &Twist) -> f64 {
        dot(self.force, velocity.linear) + dot(self.moment, velocity.angular)
    }

    /// The six coordinates (f, τ).
    #[inline]
    pub fn to_array(self) -> [f64; 6] {
        let (f, t) = (self.force, self.moment);
        [f[0], f[1], f[2], t[0], t[1], t[2]]
    }

    /// From the six coordinates (f, τ).
    #[inline]
    pub fn from_array([fx, fy, fz, tx, ty, tz]: [f64; 6]) -> Wrench {
        Wrench {
            force: [fx, fy, fz],
            moment: [tx, ty, tz],
        }
    }
}
