//! The tip as a projected target sees it.

use super::super::linear::vector::{dot, scale, sub};
use super::super::scalar::Real;
use super::super::{Jacobian, Pose, Target, Twist, math};

/// What targets read of the tip of an arm: of [`Target::PositionYaw`] and [`Target::Planar`] the
/// pose that it [stands for](Target::stands_for), and the motions that change that. Axes that are
/// parallel but for noise tilt and lift the tip by as little, which such targets do not see. All
/// others see the tip as it is.
///
/// ```
/// use kin_runtime::{Pose, Target, __private::Projection};
/// let up = [0.0, 0.0, 1.0];
/// let projection = Projection { counts: Target::PositionYaw, axis: up, home: Pose::IDENTITY };
/// let turned = Pose::from_axis_angle(up, 0.7, [0.3, 0.2, 0.1]);
/// let tilted = turned * Pose::from_axis_angle([1.0, 0.0, 0.0], 1e-5, [0.0; 3]);
/// let seen = projection.pose(&tilted);
/// assert!(Target::Pose.distance(&seen, &turned, 1.0) < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// What of a target counts.
    pub counts: Target,
    /// The unit direction of the first axis, in the base frame.
    pub axis: [Real; 3],
    /// The tip at q = 0, in the base frame.
    pub home: Pose,
}

impl Projection {
    /// A pose of the tip as it is seen.
    #[inline]
    pub fn pose(&self, pose: &Pose) -> Pose {
        self.counts.stands_for(pose, self.axis, &self.home)
    }

    /// A target as it is seen: one that is no rotation by some
    /// [error](Pose::rotation_error) is none by as much.
    #[inline]
    pub fn target(&self, target: &Pose) -> Pose {
        if !self.counts.is_projected() {
            return *target;
        }
        // A stretched rotation has the error √3 times the stretch.
        let stretch = 1.0 + target.rotation_error() / math::sqrt(3.0);
        let seen = self.pose(target);
        Pose {
            rotation: seen.rotation.map(|row| scale(stretch, row)),
            ..seen
        }
    }

    /// What is seen of a velocity, given by that of the tip's origin and the angular velocity in
    /// base axes: the rate of the pose that is seen, but for terms of the second order in the
    /// tilt.
    #[inline]
    pub fn velocity(&self, velocity: &Twist) -> Twist {
        let Twist { linear, angular } = *velocity;
        let along = |v| scale(dot(self.axis, v), self.axis);
        match self.counts {
            Target::PositionYaw => Twist {
                linear,
                angular: along(angular),
            },
            Target::Planar => Twist {
                linear: sub(linear, along(linear)),
                angular: along(angular),
            },
            _ => *velocity,
        }
    }

    /// The pose and the spatial Jacobian of a configuration as they are seen.
    #[inline]
    pub fn fk_jacobian<const N: usize>(
        &self,
        (pose, spatial): (Pose, Jacobian<N>),
    ) -> (Pose, Jacobian<N>) {
        if !self.counts.is_projected() {
            return (pose, spatial);
        }
        let geometric = spatial.spatial_to_geometric(&pose).columns();
        let seen = Jacobian::from_columns(geometric.map(|column| self.velocity(&column)));
        let pose = self.pose(&pose);
        (pose, seen.geometric_to_spatial(&pose))
    }
}
