//! What every generated robot can do, in one precision.

use super::super::scalar::{Real, tolerance::SAME};
use super::super::types::hessian::Change;
use super::super::{
    Body, Following, Frame, Jacobian, JointLimit, Nearest, NoSolution, Pose, Posture,
    Singularities, Solutions, Target,
};

crate::kinematics_methods!(define_kinematics, Real of (super::super), N);

/// Makes it a compile error to call inverse kinematics that a robot does not have.
const fn has_inverse(branches: usize) {
    assert!(
        branches > 0,
        "this robot has no inverse kinematics by a target alone: it was generated with \
         `ik = none` (forward kinematics and Jacobians alone), or has more joints than its \
         targets have coordinates. Remove that option to have a closed form searched for, \
         give such a robot its parameter (`ik_at`), or solve numerically with \
         `Chain::ik_all`"
    );
    assert!(branches == 0, "a robot with branches has to implement `ik`");
}

/// The time derivative at the joint rates of what the spatial Jacobian is seen
/// as.
fn changing<K: Kinematics<N> + ?Sized, const N: usize>(
    robot: &K,
    q: &[Real; N],
    rates: &[Real; N],
    seen: impl Fn(&Change<N>) -> Jacobian<N>,
) -> Jacobian<N> {
    let (pose, spatial) = robot.fk_jacobian(q);
    seen(&Change {
        pose: &pose,
        spatial: &spatial,
        derivative: &robot.jacobian_dot(q, rates),
        velocity: spatial.velocity(rates),
    })
}
