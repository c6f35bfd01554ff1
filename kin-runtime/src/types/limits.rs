//! What a joint may reach.

use super::super::math;
use super::super::scalar::Real;
use super::super::scalar::consts::TAU;
use super::super::scalar::tolerance::STOP;
use super::travel::{Travel, excess, wound};

/// The kind of a joint and its travel: radians for revolute joints, metres for
/// prismatic ones. Bounds are inclusive and may be infinite.
///
/// ```
/// use kin_runtime::JointLimit;
/// let elbow = JointLimit::Revolute { lower: 0.0, upper: 4.0 };
/// // −3 rad is outside, but the same posture is reached at −3 + 2π.
/// assert!((elbow.nearest(-3.0, 0.0).unwrap() - 3.283185).abs() < 1e-6);
/// assert_eq!(elbow.nearest(-1.0, 0.0), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointLimit {
    /// A rotation between two stops, radians. They may be more than a turn
    /// apart.
    Revolute {
        /// Lower stop.
        lower: Real,
        /// Upper stop.
        upper: Real,
    },
    /// A rotation without stops.
    Continuous,
    /// A translation between two stops, metres; or a coordinate that turns joints at ratios of which
    /// a full turn is none of its own, as of a joint and one that mimics it by 1.5: radians.
    Prismatic {
        /// Lower stop.
        lower: Real,
        /// Upper stop.
        upper: Real,
    },
}

impl JointLimit {
    /// How far beyond a stop a value still counts as resting on it, radians or
    /// metres: the accuracy of inverse kinematics, so that a posture at a stop
    /// is not lost to rounding. It is put on the stop, by which the tip moves as much farther from the
    /// target than a solution's residual says.
    pub const TOLERANCE: Real = STOP;

    /// A revolute joint between two stops, radians.
    pub const fn revolute(lower: Real, upper: Real) -> Self {
        JointLimit::Revolute { lower, upper }
    }

    /// A prismatic joint between two stops, metres.
    pub const fn prismatic(lower: Real, upper: Real) -> Self {
        JointLimit::Prismatic { lower, upper }
    }

    /// Whether the joint turns, so that values 2π apart are one posture.
    pub const fn is_revolute(self) -> bool {
        !matches!(self, JointLimit::Prismatic { .. })
    }

    /// Lower stop, −∞ if there is none.
    pub const fn lower(self) -> Real {
        match self {
            JointLimit::Revolute { lower, .. } | JointLimit::Prismatic { lower, .. } => lower,
            JointLimit::Continuous => Real::NEG_INFINITY,
        }
    }

    /// Upper stop, +∞ if there is none.
    pub const fn upper(self) -> Real {
        match self {
            JointLimit::Revolute { upper, .. } | JointLimit::Prismatic { upper, .. } => upper,
            JointLimit::Continuous => Real::INFINITY,
        }
    }

    /// The value inside the limits that gives the same posture as `q` and is
    /// nearest to `seed`, or to `q` if the seed is not a number; `None` if there
    /// is none. A value beyond a stop by no
    /// more than [`JointLimit::TOLERANCE`] is moved onto it.
    pub fn nearest(self, q: Real, seed: Real) -> Option<Real> {
        let seed = math::select(seed.is_finite(), seed, q);
        let travel = Travel::new([self.lower()], [self.upper()], [self.is_revolute()]);
        let value = wound(q, travel.toward(0, seed), travel.turn[0]);
        let inside = excess(value, travel.lower[0], travel.upper[0]) <= Self::TOLERANCE;
        inside.then(|| travel.at_most_at_a_stop(0, value))
    }

    /// The least and greatest k for which q + 2πk is inside; the least is the
    /// greater one if none is.
    pub(crate) fn turns(self, q: Real) -> (Real, Real) {
        let below = self.lower() - Self::TOLERANCE - q;
        let above = self.upper() + Self::TOLERANCE - q;
        if self.is_revolute() {
            (math::ceil(below / TAU), -math::ceil(-above / TAU))
        } else if below <= 0.0 && above >= 0.0 {
            (0.0, 0.0)
        } else {
            (1.0, 0.0)
        }
    }

    /// q + 2πk, not beyond a stop.
    pub(crate) fn turned(self, q: Real, k: Real) -> Real {
        (q + TAU * k).max(self.lower()).min(self.upper())
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::scalar::consts::PI;
    use super::*;

    #[test]
    fn a_value_inside_stays() {
        let limit = JointLimit::Revolute {
            lower: -6.3,
            upper: 6.3,
        };
        assert_eq!(limit.nearest(1.0, 1.0), Some(1.0));
        assert_eq!(JointLimit::Continuous.nearest(1.0, 1.0), Some(1.0));
    }

    #[test]
    fn the_winding_nearest_the_seed_is_taken() {
        let limit = JointLimit::Revolute {
            lower: -6.3,
            upper: 6.3,
        };
        assert_eq!(limit.nearest(1.0, -20.0), Some(1.0 - TAU));
        assert_eq!(
            JointLimit::Continuous.nearest(1.0, -20.0),
            Some(1.0 - 3.0 * TAU)
        );
    }

    #[test]
    fn a_stop_is_not_lost_to_rounding() {
        let limit = JointLimit::Revolute {
            lower: 0.0,
            upper: PI,
        };
        assert_eq!(limit.nearest(-1e-17, 0.0), Some(0.0));
        assert_eq!(limit.nearest(-100.0 * STOP, 0.0), None);
    }

    #[test]
    fn metres_do_not_wrap() {
        let rail = JointLimit::Prismatic {
            lower: 0.0,
            upper: 8.0,
        };
        assert_eq!(rail.nearest(-1.0, 3.0), None);
        assert_eq!(rail.nearest(7.0, 0.0), Some(7.0));
    }
}
