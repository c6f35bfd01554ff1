//! An arm whose tip is held at a target.

use super::options::SelfMotionOptions;
use crate::continuation::{Cut, Equations, meet};
use crate::linear::vector::{add, cross, dot, scale};
use crate::{JointLimit, Kinematics, Pose, RANK_TOLERANCE, math};

pub(super) struct FixedTip<'a, K, const N: usize> {
    pub robot: &'a K,
    pub target: Pose,
    pub options: &'a SelfMotionOptions<N>,
}

/// How an arm can move while its tip rests.
pub(super) struct Internal<const N: usize> {
    /// How many independent motions there are.
    pub dimension: usize,
    /// One of them, a unit vector.
    pub tangent: [f64; N],
    /// How far along it the nearest singularity may be, where the curve may
    /// cross another: that far the Jacobian keeps its rank if it goes on to
    /// change as it does here. ∞ if it does not change.
    pub reach: f64,
}

impl<K: Kinematics<N>, const N: usize> FixedTip<'_, K, N> {
    fn equations(&self, q: &[f64; N]) -> Equations<N, 6> {
        let (pose, spatial) = self.robot.fk_jacobian(q);
        let counts = self.options.target;
        let geometric = spatial.spatial_to_geometric(&pose);
        Equations {
            rows: counts.counting_rows(&pose, &geometric).rows,
            missing: counts.missing(&pose, &self.target).to_array(),
            size: Equations::<N, 6>::size(&self.target, &spatial, q),
        }
    }

    /// The independent internal motions at a configuration.
    pub fn internal(&self, q: &[f64; N]) -> Internal<N> {
        let space = self.equations(q).span(&[], None, RANK_TOLERANCE);
        let tangent = space.complement().next().unwrap_or([0.0; N]);
        let change = self.task_dot(q, &tangent);
        let rate = math::sqrt(change.iter().map(|row| dot(*row, *row)).sum());
        Internal {
            dimension: N - space.rank,
            tangent,
            reach: space.least_pivot() / rate,
        }
    }

    /// How the rows change along a motion of the joints.
    fn task_dot(&self, q: &[f64; N], rates: &[f64; N]) -> [[f64; N]; 6] {
        let counts = self.options.target;
        let (pose, spatial) = self.robot.fk_jacobian(q);
        let change = self.robot.geometric_jacobian_dot(q, rates);
        let mut rows = counts.counting_rows(&pose, &change).rows;
        if counts.fixes_axis() {
            // The z axis, along which turns do not count, moves.
            let z = [0, 1, 2].map(|i| pose.rotation[i][2]);
            let moving = cross(spatial.velocity(rates).angular, z);
            for j in 0..N {
                let w = spatial.column(j).angular;
                let lost = add(scale(dot(z, w), moving), scale(dot(moving, w), z));
                (0..3).for_each(|i| rows[3 + i][j] -= lost[i]);
            }
        }
        rows
    }

    /// Where the curve meets a hyperplane, by Newton's method; none if it does
    /// not get there.
    pub fn meet(&self, cut: &Cut<N>, guess: [f64; N]) -> Option<[f64; N]> {
        meet(|q| self.equations(q), &[], cut, guess)
    }

    /// The shortest way in joint space from one posture to another.
    pub fn way(&self, from: &[f64; N], to: &[f64; N]) -> [f64; N] {
        core::array::from_fn(|i| {
            let limit = self.limit(i);
            let stops = self.options.limits.is_some() && limit != JointLimit::Continuous;
            let way = to[i] - from[i];
            if limit.is_revolute() && !stops {
                math::wrap(way)
            } else {
                way
            }
        })
    }

    /// The first joint that is beyond its limits.
    pub fn beyond(&self, q: &[f64; N]) -> Option<usize> {
        let stops = self.options.limits?;
        (0..N).find(|&i| {
            let slack = JointLimit::TOLERANCE;
            !(stops[i].lower() - slack <= q[i] && q[i] <= stops[i].upper() + slack)
        })
    }

    fn limit(&self, i: usize) -> JointLimit {
        self.options.limits.map_or(K::LIMITS[i], |limits| limits[i])
    }
}
