//! An arm whose tip is held at a target.

use super::options::SelfMotionOptions;
use crate::linear::span::Span;
use crate::linear::vector::{add, cross, dot, norm, scale};
use crate::{JointLimit, Kinematics, Pose, RANK_TOLERANCE, math};

/// Newton's method from a good prediction takes 3 or 4 steps.
const NEWTON_STEPS: usize = 10;
/// How exactly the target is met, relative to its distance from the base or the arm's; angles
/// to that in metres, or to one. Rounding in forward kinematics is a hundredth of this.
const MET: f64 = 1e-12;

pub(super) struct Held<'a, K, const N: usize> {
    pub robot: &'a K,
    pub target: Pose,
    pub options: &'a SelfMotionOptions<N>,
}

/// A hyperplane n · (q − p) = 0 that cuts the curve.
pub(super) struct Cut<const N: usize> {
    pub normal: [f64; N],
    pub point: [f64; N],
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

impl<K: Kinematics<N>, const N: usize> Held<'_, K, N> {
    /// The rows that have to rest, and how far they are from where they should.
    fn task(&self, q: &[f64; N]) -> ([[f64; N]; 6], [f64; 6]) {
        let (pose, spatial) = self.robot.fk_jacobian(q);
        let counts = self.options.target;
        let geometric = spatial.spatial_to_geometric(&pose);
        let rows = counts.counting_rows(&pose, &geometric).rows;
        (rows, counts.missing(&pose, &self.target).to_array())
    }

    /// The independent internal motions at a configuration.
    pub fn internal(&self, q: &[f64; N]) -> Internal<N> {
        let space = span(&self.task(q).0);
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
        let mut q = guess;
        for _ in 0..NEWTON_STEPS {
            let (task, rest) = self.task(&q);
            let beyond = core::array::from_fn(|i| q[i] - cut.point[i]);
            let off = -dot(cut.normal, beyond);
            let error = [rest[0], rest[1], rest[2], rest[3], rest[4], rest[5], off];
            // A small arm is as exact for its size.
            let links = self.robot.fk_links(&q).map(|link| norm(link.translation));
            let size = links
                .iter()
                .fold(norm(self.target.translation), |a, x| math::max(a, *x));
            let met = [size, size.max(1.0)].map(|size| MET * size);
            if error
                .iter()
                .enumerate()
                .all(|(i, x)| x.abs() <= met[usize::from(i >= 3)])
            {
                return Some(q);
            }
            let rows: [[f64; N]; 7] =
                core::array::from_fn(|i| if i < 6 { task[i] } else { cut.normal });
            let space = span(&rows);
            let change = space.least_norm(|i| error[i]);
            q = core::array::from_fn(|i| q[i] + change[i]);
        }
        None
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

/// Of the rows that are to rest, or more.
fn span<const R: usize, const N: usize>(rows: &[[f64; N]; R]) -> Span<N> {
    Span::of(R, |i| rows[i], RANK_TOLERANCE)
}

/// q + t d.
pub(super) fn along<const N: usize>(q: &[f64; N], d: &[f64; N], t: f64) -> [f64; N] {
    core::array::from_fn(|i| q[i] + t * d[i])
}
