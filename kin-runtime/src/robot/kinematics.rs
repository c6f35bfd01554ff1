//! What every generated robot can do.

use crate::types::hessian::Change;
use crate::{
    Basis, Hessian, Jacobian, JointLimit, Manipulability, Pose, Solution, Solutions, Twist, Wrench,
};

/// The kinematics of one serial arm with N moving joints.
///
/// Generated robots are zero-sized types that implement this trait and offer
/// the same methods inherently; the trait is for code that treats all robots
/// alike. Joint values are radians for revolute joints and metres for
/// prismatic ones. The base frame is [`Kinematics::BASE`], the tool frame
/// [`Kinematics::TIP`].
///
/// ```
/// use kin_runtime::{Jacobian, JointLimit, Kinematics, Pose, Twist};
///
/// /// A turntable 0.5 m above the floor.
/// struct Turntable;
///
/// impl Kinematics<1> for Turntable {
///     const JOINT_NAMES: [&'static str; 1] = ["yaw"];
///     const LIMITS: [JointLimit; 1] = [JointLimit::Continuous];
///     const BASE: &'static str = "floor";
///     const TIP: &'static str = "table";
///     const BRANCHES: usize = 0;
///
///     fn fk(&self, q: &[f64; 1]) -> Pose {
///         Pose::from_axis_angle([0.0, 0.0, 1.0], q[0], [0.0, 0.0, 0.5])
///     }
///     fn fk_links(&self, q: &[f64; 1]) -> [Pose; 1] {
///         [self.fk(q)]
///     }
///     fn fk_jacobian(&self, q: &[f64; 1]) -> (Pose, Jacobian<1>) {
///         let axis = Twist::revolute([0.0, 0.0, 1.0], [0.0; 3]);
///         (self.fk(q), Jacobian::from_columns([axis]))
///     }
/// }
///
/// fn height<const N: usize>(robot: &impl Kinematics<N>, q: &[f64; N]) -> f64 {
///     robot.fk(q).translation[2]
/// }
/// assert_eq!(height(&Turntable, &[0.3]), 0.5);
/// ```
pub trait Kinematics<const N: usize> {
    /// The joints' names, from base to tool.
    const JOINT_NAMES: [&'static str; N];
    /// The joints' kinds and travel.
    const LIMITS: [JointLimit; N];
    /// The frame that poses are given in.
    const BASE: &'static str;
    /// The frame that poses are of.
    const TIP: &'static str;
    /// How many branches inverse kinematics looks at, which bounds the number
    /// of isolated solutions; 0 for an arm generated with `ik = none`.
    const BRANCHES: usize;

    /// The tool's pose in the base frame.
    fn fk(&self, q: &[f64; N]) -> Pose;

    /// The pose, in the base frame, of the link behind every joint: the frame
    /// that moves with joint i, for all i. What is fixed behind the last joint
    /// is not included.
    fn fk_links(&self, q: &[f64; N]) -> [Pose; N];

    /// The tool's pose and the spatial Jacobian, which share most of the work.
    fn fk_jacobian(&self, q: &[f64; N]) -> (Pose, Jacobian<N>);

    /// The spatial Jacobian (MLS section 3.4): times the joint rates, it gives
    /// the spatial velocity (v, ω) of the tool, in base axes, v being that of
    /// the point of the tool that passes through the base's origin.
    fn spatial_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        self.fk_jacobian(q).1
    }

    /// The body Jacobian (MLS section 3.4): the velocity of the tool's origin
    /// and the angular velocity, both in tool axes.
    fn body_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        let (pose, spatial) = self.fk_jacobian(q);
        spatial.spatial_to_body(&pose)
    }

    /// The geometric Jacobian, also called hybrid or local world aligned: the
    /// velocity of the tool's origin and the angular velocity, both in base
    /// axes. What ROS users expect.
    fn geometric_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        let (pose, spatial) = self.fk_jacobian(q);
        spatial.spatial_to_geometric(&pose)
    }

    /// All configurations that put the tool at `target` (in the base frame):
    /// every isolated one once, a representative, flagged singular, of each
    /// family, and none if the target is out of reach.
    ///
    /// For an arm without closed form ([`Kinematics::BRANCHES`] is 0), a call
    /// does not compile:
    ///
    /// ```compile_fail
    /// # use kin_runtime::*;
    /// # struct Turntable;
    /// # impl Kinematics<1> for Turntable {
    /// #     const JOINT_NAMES: [&'static str; 1] = ["yaw"];
    /// #     const LIMITS: [JointLimit; 1] = [JointLimit::Continuous];
    /// #     const BASE: &'static str = "floor";
    /// #     const TIP: &'static str = "table";
    /// #     const BRANCHES: usize = 0;
    /// #     fn fk(&self, q: &[f64; 1]) -> Pose { Pose::IDENTITY }
    /// #     fn fk_links(&self, q: &[f64; 1]) -> [Pose; 1] { [Pose::IDENTITY] }
    /// #     fn fk_jacobian(&self, q: &[f64; 1]) -> (Pose, Jacobian<1>) {
    /// #         (Pose::IDENTITY, Jacobian::from_columns([Twist::default()]))
    /// #     }
    /// # }
    /// let solutions = Turntable.ik(&Pose::IDENTITY);
    /// ```
    fn ik(&self, target: &Pose) -> Solutions<N> {
        const {
            assert!(
                Self::BRANCHES > 0,
                "this robot has no inverse kinematics: it was generated with `ik = none` \
                 (forward kinematics and Jacobians alone). Remove that option to have a \
                 closed form searched for, or solve numerically with `Chain::ik_all`"
            );
            assert!(
                Self::BRANCHES == 0,
                "a robot with branches has to implement `ik`"
            );
        }
        let _ = target;
        Solutions::new()
    }

    /// As [`Kinematics::ik`]; an angle that a singular target leaves free keeps
    /// its value in `seed`, so that answers along a path are continuous.
    fn ik_near(&self, target: &Pose, seed: &[f64; N]) -> Solutions<N> {
        let _ = seed;
        self.ik(target)
    }

    /// Whether the target is in the complete workspace: whether [`Kinematics::ik`]
    /// has an answer. Positions alone are asked of a `Workspace`.
    fn is_reachable_pose(&self, target: &Pose) -> bool {
        !self.ik(target).is_empty()
    }

    /// A solution if there is one, and for a target out of reach what comes
    /// nearest, with its distance as the residual; none if the target is not a
    /// number. Generated robots give the least-squares answer of their
    /// subproblems.
    fn ik_closest(&self, target: &Pose) -> Option<Solution<N>> {
        self.ik(target).iter().next().copied()
    }

    /// V_s = J_s q̇: the tool's spatial velocity (MLS section 3.4) at the joint
    /// rates, rad/s and m/s.
    fn spatial_velocity(&self, q: &[f64; N], rates: &[f64; N]) -> Twist {
        self.spatial_jacobian(q).velocity(rates)
    }

    /// V_b = J_b q̇: the velocity of the tool's origin and the angular velocity,
    /// both in tool axes.
    fn body_velocity(&self, q: &[f64; N], rates: &[f64; N]) -> Twist {
        self.body_jacobian(q).velocity(rates)
    }

    /// The velocity of the tool's origin and the angular velocity, both in base
    /// axes.
    fn geometric_velocity(&self, q: &[f64; N], rates: &[f64; N]) -> Twist {
        self.geometric_jacobian(q).velocity(rates)
    }

    /// τ = J_sᵀ F_s (MLS section 3.4.2): the joint torques and forces, N m and
    /// N, that balance a wrench on the tool given in base coordinates, with the
    /// moment about the base's origin.
    fn spatial_torques(&self, q: &[f64; N], wrench: &Wrench) -> [f64; N] {
        self.spatial_jacobian(q).torques(wrench)
    }

    /// τ = J_bᵀ F_t: as [`Kinematics::spatial_torques`], with the wrench in tool
    /// coordinates, as a sensor at the tool reads it.
    fn body_torques(&self, q: &[f64; N], wrench: &Wrench) -> [f64; N] {
        self.body_jacobian(q).torques(wrench)
    }

    /// As [`Kinematics::spatial_torques`], with force and moment in base axes
    /// and the moment about the tool's origin.
    fn geometric_torques(&self, q: &[f64; N], wrench: &Wrench) -> [f64; N] {
        self.geometric_jacobian(q).torques(wrench)
    }

    /// J̇_s: the time derivative of the spatial Jacobian at the joint rates. The
    /// tool's spatial acceleration is V̇_s = J_s q̈ + J̇_s q̇.
    ///
    /// Robots with joints that mimic others have to implement it, because the
    /// Jacobian does not tell those joints apart.
    fn jacobian_dot(&self, q: &[f64; N], rates: &[f64; N]) -> Jacobian<N> {
        self.spatial_jacobian(q).spatial_dot(rates)
    }

    /// J̇_b: the time derivative of the body Jacobian at the joint rates.
    fn body_jacobian_dot(&self, q: &[f64; N], rates: &[f64; N]) -> Jacobian<N> {
        let (pose, spatial) = self.fk_jacobian(q);
        let change = Change {
            pose: &pose,
            spatial: &spatial,
            derivative: &self.jacobian_dot(q, rates),
            velocity: spatial.velocity(rates),
        };
        change.of_body()
    }

    /// The time derivative of the geometric Jacobian at the joint rates. The
    /// tool's origin accelerates by the linear part of J q̈ + J̇ q̇.
    fn geometric_jacobian_dot(&self, q: &[f64; N], rates: &[f64; N]) -> Jacobian<N> {
        let (pose, spatial) = self.fk_jacobian(q);
        let change = Change {
            pose: &pose,
            spatial: &spatial,
            derivative: &self.jacobian_dot(q, rates),
            velocity: spatial.velocity(rates),
        };
        change.of_geometric()
    }

    /// The Hessian of forward kinematics: the derivatives of the spatial
    /// Jacobian by every joint.
    ///
    /// As [`Kinematics::jacobian_dot`], to be implemented where joints mimic
    /// others.
    fn hessian(&self, q: &[f64; N]) -> Hessian<N> {
        self.spatial_jacobian(q).spatial_hessian()
    }

    /// The derivatives of the body Jacobian by every joint.
    fn body_hessian(&self, q: &[f64; N]) -> Hessian<N> {
        let (pose, spatial) = self.fk_jacobian(q);
        self.hessian(q)
            .seen(&pose, &spatial, |change| change.of_body())
    }

    /// The derivatives of the geometric Jacobian by every joint.
    fn geometric_hessian(&self, q: &[f64; N]) -> Hessian<N> {
        let (pose, spatial) = self.fk_jacobian(q);
        self.hessian(q)
            .seen(&pose, &spatial, |change| change.of_geometric())
    }

    /// The wrenches that the structure bears without joint torques, see
    /// [`Jacobian::structural_wrenches`], in base coordinates with the moment
    /// about the base's origin.
    fn structural_wrenches(&self, q: &[f64; N]) -> Basis<Wrench, 6> {
        self.spatial_jacobian(q).structural_wrenches()
    }

    /// How far the arm is from a singularity: the measures of the geometric
    /// Jacobian (and of the body Jacobian, which has the same).
    fn manipulability(&self, q: &[f64; N]) -> Manipulability {
        self.geometric_jacobian(q).manipulability()
    }

    /// As [`Kinematics::manipulability`], for the velocity of the tool's origin
    /// alone.
    fn translational_manipulability(&self, q: &[f64; N]) -> Manipulability {
        self.geometric_jacobian(q).translational_manipulability()
    }

    /// As [`Kinematics::manipulability`], for the angular velocity alone.
    fn rotational_manipulability(&self, q: &[f64; N]) -> Manipulability {
        self.geometric_jacobian(q).rotational_manipulability()
    }

    /// How the volume of [`Kinematics::manipulability`] changes with every
    /// joint; 0 at a singularity, where it has a kink.
    fn manipulability_gradient(&self, q: &[f64; N]) -> [f64; N] {
        let jacobian = self.geometric_jacobian(q);
        jacobian.manipulability_gradient(&self.geometric_hessian(q))
    }

    /// As [`Kinematics::manipulability_gradient`], for the velocity of the
    /// tool's origin alone.
    fn translational_manipulability_gradient(&self, q: &[f64; N]) -> [f64; N] {
        let jacobian = self.geometric_jacobian(q);
        jacobian.translational_manipulability_gradient(&self.geometric_hessian(q))
    }

    /// As [`Kinematics::manipulability_gradient`], for the angular velocity
    /// alone.
    fn rotational_manipulability_gradient(&self, q: &[f64; N]) -> [f64; N] {
        let jacobian = self.geometric_jacobian(q);
        jacobian.rotational_manipulability_gradient(&self.geometric_hessian(q))
    }

    /// The joint rates that leave the tool at rest; see
    /// [`Jacobian::internal_motions`]. One vector for an arm of seven joints
    /// that is not singular.
    fn internal_motions(&self, q: &[f64; N]) -> Basis<[f64; N], N> {
        self.geometric_jacobian(q).internal_motions()
    }

    /// The internal motion nearest to some joint rates; see
    /// [`Jacobian::null_space_projection`].
    fn null_space_projection(&self, q: &[f64; N], rates: &[f64; N]) -> [f64; N] {
        self.geometric_jacobian(q).null_space_projection(rates)
    }
}
