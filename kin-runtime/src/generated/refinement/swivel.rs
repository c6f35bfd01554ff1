//! Branches at a swivel angle, corrected.
//!
//! The angle has the elbow in a half plane: how far it is from that is one more coordinate of the
//! target, linear in the elbow. Where the elbow is on the line of shoulder and wrist, and the angle
//! says nothing, so does that.

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::linear::vector::{add, cross, dot, sub};
use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose, Solution, Solutions, Swivel, Target, math};
use super::correction::{stay_at_seed, steps};
use super::levenberg::{Arrived, arrive};
use super::linearization::{Linearization, Problem};

/// An arm of seven joints at an angle of its swivel.
#[derive(Clone, Copy, Debug)]
pub struct AtSwivel<'a, Links, FkJacobian> {
    /// What tells the angle.
    pub swivel: &'a Swivel,
    /// Radians.
    pub angle: Real,
    /// Gives the poses of the links.
    pub links: Links,
    /// Gives the pose and the spatial Jacobian.
    pub fk_jacobian: FkJacobian,
}

impl<Links, FkJacobian> AtSwivel<'_, Links, FkJacobian>
where
    Links: Fn(&[Real; 7]) -> [Pose; 7],
    FkJacobian: Fn(&[Real; 7]) -> (Pose, Jacobian<7>),
{
    /// The branches that reach the target, those that nearly do after a correction; of
    /// singular ones those that are next to `seed`.
    pub fn corrected(
        &self,
        target: &Pose,
        branches: impl Iterator<Item = Solution<7>> + Clone,
        seed: &[Real; 7],
        accept: &Acceptance,
    ) -> Solutions<7> {
        let reaches = |branch: &Solution<7>| branch.residual <= accept.taken;
        let nearly = |branch: &Solution<7>| branch.residual <= accept.nearly;
        let problem = Problem::new(&self.fk_jacobian, target, Target::Pose, accept);
        let wrist = target.transform_point(self.swivel.wrist);
        let [direction, normal] = self.swivel.half_plane(self.angle, wrist);
        let beside = |q: &[Real; 7], along: [Real; 3]| {
            let elbow = (self.links)(q)[self.swivel.link].transform_point(self.swivel.elbow);
            (elbow, dot(along, sub(elbow, self.swivel.shoulder)))
        };
        let linearize = |q: [Real; 7]| {
            let of_pose = Linearization::new(q, &problem);
            let (_, spatial) = (self.fk_jacobian)(&q);
            let (elbow, off) = beside(&q, normal);
            let mut rows = [[0.0; 7]; 7];
            let mut error = [0.0; 7];
            rows[..6].copy_from_slice(&of_pose.rows);
            error[..6].copy_from_slice(&of_pose.error);
            error[6] = -off / accept.size;
            for i in 0..=self.swivel.link {
                let twist = spatial.column(i);
                let moved = add(twist.linear, cross(twist.angular, elbow));
                rows[6][i] = dot(normal, moved) / accept.size;
            }
            Linearization {
                q,
                residual: math::sqrt(of_pose.residual * of_pose.residual + off * off),
                error,
                rows,
            }
        };
        let reached = |found: Arrived<7>| {
            let q = found.q.map(math::wrap);
            let (_, ahead) = beside(&q, direction);
            let (pose, _) = (self.fk_jacobian)(&q);
            let residual = Target::Pose.distance(&pose, target, accept.size);
            let reaches = found.residual <= accept.tolerance && ahead >= -accept.tolerance;
            let singular = found.singular;
            reaches.then_some(Arrived {
                q,
                residual,
                singular,
            })
        };
        Solutions::build_with_prismatic(accept.prismatic, |solutions| {
            for branch in branches.clone().filter(reaches) {
                solutions.push_if(true, branch);
            }
            if target.rotation_error() * accept.size > accept.tolerance {
                return;
            }
            for branch in branches.filter(|branch| !reaches(branch) && nearly(branch)) {
                let found = arrive(linearize, accept.size, branch.q, steps(accept));
                if let Some(found) = reached(found) {
                    solutions.insert_distinct(Solution {
                        q: found.q,
                        residual: found.residual,
                        singular: found.singular || branch.singular && !accept.is_of_design(),
                        ..branch
                    });
                }
            }
            stay_at_seed(solutions, seed, linearize, reached, accept);
        })
    }
}
