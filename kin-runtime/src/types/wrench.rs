//! Wrenches, in the coordinates of MLS: force first.

use super::super::scalar::Real;
use core::ops::{Add, Mul, Neg, Sub};

use super::super::linear::vector::{add, cross, dot, scale, sub};
use super::super::{Pose, Twist};

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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wrench {
    /// f.
    pub force: [Real; 3],
    /// τ.
    pub moment: [Real; 3],
}

impl Wrench {
    /// The instantaneous work F · V that the wrench does on a body moving with
    /// `velocity`, both in the same coordinates; watts.
    #[inline]
    pub fn power(&self, velocity: &Twist) -> Real {
        dot(self.force, velocity.linear) + dot(self.moment, velocity.angular)
    }

    /// F_t = Ad_gᵀ F_s: as seen from a tip at `pose` (MLS section 2.5), given
    /// in base coordinates, with the moment about the base's origin.
    ///
    /// ```
    /// use kin_runtime::{Pose, Wrench};
    /// let tip = Pose::from_translation([0.2, 0.0, 0.0]);
    /// let push = Wrench { force: [0.0, 5.0, 0.0], moment: [0.0, 0.0, 1.0] };
    /// assert_eq!(push.spatial_to_body(&tip).moment, [0.0; 3]);
    /// assert_eq!(push.spatial_to_body(&tip).body_to_spatial(&tip), push);
    /// ```
    #[inline]
    pub fn spatial_to_body(&self, pose: &Pose) -> Wrench {
        pose.adjoint_transpose(self)
    }

    /// F_s: the inverse of [`Wrench::spatial_to_body`].
    #[inline]
    pub fn body_to_spatial(&self, pose: &Pose) -> Wrench {
        pose.adjoint_inverse_transpose(self)
    }

    /// From base coordinates to the force in base axes and the moment about the
    /// tip's origin, also in base axes; `pose` is the tip's.
    #[inline]
    pub fn spatial_to_geometric(&self, pose: &Pose) -> Wrench {
        Wrench {
            moment: sub(self.moment, cross(pose.translation, self.force)),
            ..*self
        }
    }

    /// The inverse of [`Wrench::spatial_to_geometric`].
    #[inline]
    pub fn geometric_to_spatial(&self, pose: &Pose) -> Wrench {
        Wrench {
            moment: add(self.moment, cross(pose.translation, self.force)),
            ..*self
        }
    }

    /// The six coordinates (f, τ).
    #[inline]
    pub fn to_array(self) -> [Real; 6] {
        let (f, t) = (self.force, self.moment);
        [f[0], f[1], f[2], t[0], t[1], t[2]]
    }

    /// From the six coordinates (f, τ).
    #[inline]
    pub fn from_array([fx, fy, fz, tx, ty, tz]: [Real; 6]) -> Wrench {
        Wrench {
            force: [fx, fy, fz],
            moment: [tx, ty, tz],
        }
    }
}

impl Add for Wrench {
    type Output = Wrench;
    #[inline]
    fn add(self, other: Wrench) -> Wrench {
        Wrench {
            force: add(self.force, other.force),
            moment: add(self.moment, other.moment),
        }
    }
}

impl Sub for Wrench {
    type Output = Wrench;
    #[inline]
    fn sub(self, other: Wrench) -> Wrench {
        Wrench {
            force: sub(self.force, other.force),
            moment: sub(self.moment, other.moment),
        }
    }
}

impl Neg for Wrench {
    type Output = Wrench;
    #[inline]
    fn neg(self) -> Wrench {
        self * -1.0
    }
}

impl Mul<Real> for Wrench {
    type Output = Wrench;
    #[inline]
    fn mul(self, k: Real) -> Wrench {
        Wrench {
            force: scale(k, self.force),
            moment: scale(k, self.moment),
        }
    }
}
