//! The provided methods of `Kinematics`, inherent on generated robots.

/// Gives a robot that implements [`Kinematics`](crate::Kinematics) the trait's
/// provided methods as inherent ones, so that its users import nothing.
/// Generated code calls this; it keeps what is the same for all robots out of
/// their files.
///
/// ```
/// use kin_runtime::{Jacobian, JointLimit, Kinematics, Pose, Twist};
///
/// /// A turntable 0.5 m above the floor.
/// pub struct Turntable;
///
/// impl Kinematics<1> for Turntable {
/// #     const JOINT_NAMES: [&'static str; 1] = ["yaw"];
/// #     const LIMITS: [JointLimit; 1] = [JointLimit::Continuous];
/// #     const BASE: &'static str = "floor";
/// #     const TIP: &'static str = "table";
/// #     const BRANCHES: usize = 0;
/// #     fn fk(&self, q: &[f64; 1]) -> Pose {
/// #         Pose::from_axis_angle([0.0, 0.0, 1.0], q[0], [0.0, 0.0, 0.5])
/// #     }
/// #     fn fk_links(&self, q: &[f64; 1]) -> [Pose; 1] { [self.fk(q)] }
/// #     fn fk_jacobian(&self, q: &[f64; 1]) -> (Pose, Jacobian<1>) {
/// #         let axis = Twist::revolute([0.0, 0.0, 1.0], [0.0; 3]);
/// #         (self.fk(q), Jacobian::from_columns([axis]))
/// #     }
///     // ...
/// }
/// kin_runtime::inherent_methods!(Turntable, 1);
///
/// assert_eq!(Turntable.body_velocity(&[0.3], &[2.0]).angular, [0.0, 0.0, 2.0]);
/// ```
#[macro_export]
macro_rules! inherent_methods {
    ($robot:ident, $n:literal) => {
        $crate::inherent_methods! { $robot, $n:
            /// The tool's spatial velocity J_s q̇.
            fn spatial_velocity(q: &[f64; $n], rates: &[f64; $n]) -> $crate::Twist;
            /// The tool's body velocity J_b q̇.
            fn body_velocity(q: &[f64; $n], rates: &[f64; $n]) -> $crate::Twist;
            /// The velocity of the tip's origin and the angular velocity, both
            /// in base axes.
            fn geometric_velocity(q: &[f64; $n], rates: &[f64; $n]) -> $crate::Twist;
            /// The joint torques that balance a wrench on the tip, given in
            /// base coordinates: J_sᵀ F_s.
            fn spatial_torques(q: &[f64; $n], wrench: &$crate::Wrench) -> [f64; $n];
            /// The joint torques that balance a wrench on the tip, given in tip
            /// coordinates: J_bᵀ F_t.
            fn body_torques(q: &[f64; $n], wrench: &$crate::Wrench) -> [f64; $n];
            /// The joint torques that balance a wrench on the tip, in base axes
            /// and with the moment about the tip's origin.
            fn geometric_torques(q: &[f64; $n], wrench: &$crate::Wrench) -> [f64; $n];
            /// The time derivative of the spatial Jacobian.
            fn jacobian_dot(q: &[f64; $n], rates: &[f64; $n]) -> $crate::Jacobian<$n>;
            /// The time derivative of the body Jacobian.
            fn body_jacobian_dot(q: &[f64; $n], rates: &[f64; $n]) -> $crate::Jacobian<$n>;
            /// The time derivative of the geometric Jacobian.
            fn geometric_jacobian_dot(q: &[f64; $n], rates: &[f64; $n]) -> $crate::Jacobian<$n>;
            /// The derivatives of the spatial Jacobian by every joint.
            fn hessian(q: &[f64; $n]) -> $crate::Hessian<$n>;
            /// The derivatives of the body Jacobian by every joint.
            fn body_hessian(q: &[f64; $n]) -> $crate::Hessian<$n>;
            /// The derivatives of the geometric Jacobian by every joint.
            fn geometric_hessian(q: &[f64; $n]) -> $crate::Hessian<$n>;
            /// The wrenches that the structure bears without joint torques, in
            /// base coordinates.
            fn structural_wrenches(q: &[f64; $n]) -> $crate::Basis<$crate::Wrench, 6>;
            /// How far the arm is from a singularity.
            fn manipulability(q: &[f64; $n]) -> $crate::Manipulability;
            /// The same for the velocity of the tip's origin alone.
            fn translational_manipulability(q: &[f64; $n]) -> $crate::Manipulability;
            /// The same for the angular velocity alone.
            fn rotational_manipulability(q: &[f64; $n]) -> $crate::Manipulability;
            /// How the volume of `manipulability` changes with every joint.
            fn manipulability_gradient(q: &[f64; $n]) -> [f64; $n];
            /// The same for the velocity of the tip's origin alone.
            fn translational_manipulability_gradient(q: &[f64; $n]) -> [f64; $n];
            /// The same for the angular velocity alone.
            fn rotational_manipulability_gradient(q: &[f64; $n]) -> [f64; $n];
            /// The joint rates that leave the tip at rest.
            fn internal_motions(q: &[f64; $n]) -> $crate::Basis<[f64; $n], $n>;
            /// The internal motion nearest to some joint rates.
            fn null_space_projection(q: &[f64; $n], rates: &[f64; $n]) -> [f64; $n];
        }
    };
    ($robot:ident, $n:literal: $(
        $(#[$attribute:meta])*
        fn $method:ident($($argument:ident: $type:ty),*) -> $result:ty;
    )*) => {
        impl $robot {
            $(
                $(#[$attribute])*
                ///
                /// A provided method of `kinematics::Kinematics`, which says more.
                #[inline]
                #[must_use]
                pub fn $method(&self, $($argument: $type),*) -> $result {
                    <Self as $crate::Kinematics<$n>>::$method(self, $($argument),*)
                }
            )*
        }
    };
}
