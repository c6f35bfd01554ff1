//! Arms of any number of joints behind one interface.

use super::{Answers, Robot};
use kin_codegen::closed_form::BranchSolution;
use kin_runtime::{JointLimit, Kinematics, Pose, Twist};

/// An arm on slices, for programs that choose among several: a [`Robot`], or a generated one as
/// [`OfSlices`].
///
/// ```
/// use kinematics::{Arm, OfSlices, Robot};
/// kinematics::kinematics!("robots/ur5e.urdf");
/// let arms: [Box<dyn Arm>; 2] =
///     [Box::new(Robot::from_yaml("robots/puma560.yaml")?), Box::new(OfSlices(Ur5e))];
/// for arm in &arms {
///     let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
///     assert_eq!(arm.ik(&arm.fk(&q)).len(), 8);
///     let nearest = arm.ik_nearest(&arm.fk(&q), &q).expect("a solution within limits");
///     assert!(nearest.q.iter().zip(q).all(|(found, q)| (found - q).abs() < 1e-9));
/// }
/// # Ok::<(), kinematics::LoadError>(())
/// ```
pub trait Arm {
    /// The joints' kinds and travel.
    fn limits(&self) -> &[JointLimit];
    /// The pose of the tip in the base frame, metres, at joint values, radians and metres.
    fn fk(&self, q: &[f64]) -> Pose;
    /// The pose of every link that a joint moves, in the base frame.
    fn fk_links(&self, q: &[f64]) -> Vec<Pose>;
    /// The columns of the geometric Jacobian.
    fn geometric_jacobian(&self, q: &[f64]) -> Vec<Twist>;
    /// All solutions for a pose of the tip; none of an arm that takes parameters beside a
    /// target.
    fn ik(&self, pose: &Pose) -> Answers;
    /// The solution that moves the joints least from a seed, inside the limits, with full turns;
    /// none of an arm that takes parameters beside a target.
    fn ik_nearest(&self, pose: &Pose, seed: &[f64]) -> Option<BranchSolution>;
}

impl Arm for Robot {
    fn limits(&self) -> &[JointLimit] {
        self.limits()
    }

    fn fk(&self, q: &[f64]) -> Pose {
        self.fk(q)
    }

    fn fk_links(&self, q: &[f64]) -> Vec<Pose> {
        self.fk_links(q)
    }

    fn geometric_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        self.geometric_jacobian(q)
    }

    fn ik(&self, pose: &Pose) -> Answers {
        self.ik(pose)
    }

    fn ik_nearest(&self, pose: &Pose, seed: &[f64]) -> Option<BranchSolution> {
        self.ik_nearest(pose, seed)
    }
}

/// A generated robot as an [`Arm`].
#[derive(Clone, Copy, Debug)]
pub struct OfSlices<K, const N: usize>(pub K);

/// The values of N joints.
///
/// # Panics
///
/// There are more or fewer.
fn array<const N: usize>(q: &[f64]) -> &[f64; N] {
    q.try_into().expect("one value for each joint")
}

impl<K: Kinematics<N>, const N: usize> Arm for OfSlices<K, N> {
    fn limits(&self) -> &[JointLimit] {
        &K::LIMITS
    }

    fn fk(&self, q: &[f64]) -> Pose {
        self.0.fk(array(q))
    }

    fn fk_links(&self, q: &[f64]) -> Vec<Pose> {
        self.0.fk_links(array(q)).to_vec()
    }

    fn geometric_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        self.0.geometric_jacobian(array(q)).columns().to_vec()
    }

    fn ik(&self, pose: &Pose) -> Answers {
        (&self.0.ik(pose)).into()
    }

    fn ik_nearest(&self, pose: &Pose, seed: &[f64]) -> Option<BranchSolution> {
        let nearest = self.0.ik_nearest(pose, array(seed))?;
        Some(BranchSolution::of(&nearest))
    }
}
