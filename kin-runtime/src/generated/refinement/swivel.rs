//! Branches at a swivel angle, corrected.
//!
//! The angle tells one of the joints that turn the elbow from the others, so that what is
//! corrected is an arm of six joints, as any other.

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::linear::vector::{add, cross, dot};
use super::super::super::scalar::{Real, tolerance};
use super::super::super::{Jacobian, Pose, Solution, Solutions, Swivel, Target, Twist, math};
use super::{Problem, correct_branches};

/// Newton's method for one angle, from one that is right but for noise, doubles the digits.
const STEPS: usize = 8;
/// No step is longer, radians.
const STRIDE: Real = 0.5;
/// What an angle may be off, radians.
const OFF: Real = tolerance::ANGLE;
/// A solution whose swivel angle is off by more is of another.
const ELSEWHERE: Real = tolerance::SOLVED;

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
    /// The branches that reach the target, the others by [`correct_branches`].
    pub fn corrected(
        &self,
        target: &Pose,
        branches: impl Iterator<Item = Solution<7>> + Clone,
        accept: &Acceptance,
    ) -> Solutions<7> {
        let wrist = target.transform_point(self.swivel.wrist);
        Solutions::build_with_prismatic(accept.prismatic, |solutions| {
            // What is corrected may come together with one that reaches its target as it is.
            let reaches = |branch: &Solution<7>| branch.residual <= accept.taken;
            for branch in branches.clone().filter(reaches) {
                solutions.push_if(true, branch);
            }
            for branch in branches.filter(|branch| !reaches(branch)) {
                let arm = self.without_joint(&branch.q, wrist);
                let others = core::iter::once(arm.without(&branch));
                let fk_jacobian = |q: &[Real; 6]| arm.fk_jacobian(q);
                let problem = Problem::new(fk_jacobian, target, Target::Pose, accept);
                let found = correct_branches(&problem, others, accept);
                for found in &found {
                    let q = arm.whole(&found.q).map(math::wrap);
                    // Where the angle hardly tells its joint, nothing was solved.
                    let (_, off) = arm.slopes(&q);
                    let (pose, _) = (self.fk_jacobian)(&q);
                    let residual = Target::Pose.distance(&pose, target, accept.size);
                    if off.abs() <= ELSEWHERE && residual <= accept.tolerance {
                        solutions.insert_distinct(Solution {
                            q,
                            residual,
                            branch: found.branch,
                            singular: found.singular || branch.singular,
                        });
                    }
                }
            }
        })
    }

    /// Which joint the angle tells next to a configuration: the one that it depends on most.
    fn without_joint(
        &self,
        q: &[Real; 7],
        wrist: [Real; 3],
    ) -> WithoutJoint<'_, Links, FkJacobian> {
        let mut arm = WithoutJoint {
            arm: self,
            wrist,
            joint: 0,
            near: 0.0,
        };
        let (slopes, _) = arm.slopes(q);
        arm.joint = usize::from(slopes[1].abs() > slopes[0].abs());
        arm.near = q[arm.joint];
        arm
    }
}

/// The arm of six joints that the angle leaves, the seventh found by it.
struct WithoutJoint<'a, Links, FkJacobian> {
    arm: &'a AtSwivel<'a, Links, FkJacobian>,
    /// Where the target has it.
    wrist: [Real; 3],
    joint: usize,
    /// Of the values of that joint with the same angle, the one next to this is meant.
    near: Real,
}

impl<Links, FkJacobian> WithoutJoint<'_, Links, FkJacobian>
where
    Links: Fn(&[Real; 7]) -> [Pose; 7],
    FkJacobian: Fn(&[Real; 7]) -> (Pose, Jacobian<7>),
{
    fn without(&self, solution: &Solution<7>) -> Solution<6> {
        let q = solution.q;
        Solution {
            q: core::array::from_fn(|i| q[i + usize::from(i >= self.joint)]),
            residual: solution.residual,
            branch: solution.branch,
            singular: solution.singular,
        }
    }

    /// How the angle changes with the joints that turn the elbow, and how far it is off.
    fn slopes(&self, q: &[Real; 7]) -> ([Real; 7], Real) {
        let swivel = self.arm.swivel;
        let (_, spatial) = (self.arm.fk_jacobian)(q);
        let elbow = (self.arm.links)(q)[swivel.link].transform_point(swivel.elbow);
        let (gradient, _) = swivel.gradient(elbow, self.wrist);
        let slope = |twist: Twist| dot(gradient, add(twist.linear, cross(twist.angular, elbow)));
        let slopes = core::array::from_fn(|i| match i <= swivel.link {
            true => slope(spatial.column(i)),
            false => 0.0,
        });
        let own = swivel.of_points(elbow, self.wrist);
        (slopes, math::wrap(self.arm.angle - own))
    }

    /// All joint values, from those of the others.
    fn whole(&self, others: &[Real; 6]) -> [Real; 7] {
        let mut q: [Real; 7] = core::array::from_fn(|i| match i.cmp(&self.joint) {
            core::cmp::Ordering::Less => others[i],
            core::cmp::Ordering::Equal => self.near,
            core::cmp::Ordering::Greater => others[i - 1],
        });
        for _ in 0..STEPS {
            let (slopes, off) = self.slopes(&q);
            let step = off / slopes[self.joint];
            if step.is_nan() {
                break;
            }
            q[self.joint] += step.clamp(-STRIDE, STRIDE);
            if step.abs() < OFF {
                break;
            }
        }
        q
    }

    /// The pose, and the spatial Jacobian of the others: they take the joint that is told
    /// along.
    fn fk_jacobian(&self, others: &[Real; 6]) -> (Pose, Jacobian<6>) {
        let q = self.whole(others);
        let (pose, spatial) = (self.arm.fk_jacobian)(&q);
        let (slopes, _) = self.slopes(&q);
        let along = spatial.column(self.joint);
        let columns = core::array::from_fn(|i| {
            let i = i + usize::from(i >= self.joint);
            spatial.column(i) + along * (-slopes[i] / slopes[self.joint])
        });
        (pose, Jacobian::from_columns(columns))
    }
}
