//! The methods of `Kinematics` on a generated robot.

/// Implements [`Kinematics`](crate::Kinematics) for a robot by its inherent
/// methods, and gives it the trait's provided methods as inherent ones, so that
/// its users import nothing.
///
/// The robot has the trait's constants and the methods `fk`, `fk_links`,
/// `fk_jacobian` and those of the three Jacobians. Of the further groups of
/// methods, each is its `own`, `provided` by the trait, or left out (`none`).
///
/// ```
/// use kin_runtime::{Frame, Jacobian, JointLimit, Pose, Posture, Target, Twist};
///
/// /// A turntable 0.5 m above the floor.
/// pub struct Turntable;
///
/// impl Turntable {
///     pub const JOINT_NAMES: [&'static str; 1] = ["yaw"];
///     pub const LIMITS: [JointLimit; 1] = [JointLimit::Continuous];
///     pub const VELOCITY_LIMITS: [f64; 1] = [f64::INFINITY];
///     pub const EFFORT_LIMITS: [f64; 1] = [f64::INFINITY];
///     pub const LINK_NAMES: [&'static str; 1] = ["table"];
///     pub const FRAMES: &'static [Frame] = &[];
///     pub const BASE: &'static str = "floor";
///     pub const TIP: &'static str = "table";
///     pub const TARGET: Target = Target::Pose;
///     pub const POSTURES: &'static [Posture] = &[];
///     pub const BRANCHES: usize = 0;
///
///     pub fn fk(&self, q: &[f64; 1]) -> Pose {
///         Pose::from_axis_angle([0.0, 0.0, 1.0], q[0], [0.0, 0.0, 0.5])
///     }
///     // ...
/// #     pub fn fk_links(&self, q: &[f64; 1]) -> [Pose; 1] { [self.fk(q)] }
/// #     pub fn spatial_jacobian(&self, _: &[f64; 1]) -> Jacobian<1> {
/// #         Jacobian::from_columns([Twist::revolute([0.0, 0.0, 1.0], [0.0; 3])])
/// #     }
/// #     pub fn body_jacobian(&self, q: &[f64; 1]) -> Jacobian<1> { self.spatial_jacobian(q) }
/// #     pub fn geometric_jacobian(&self, q: &[f64; 1]) -> Jacobian<1> { self.spatial_jacobian(q) }
/// #     pub fn fk_jacobian(&self, q: &[f64; 1]) -> (Pose, Jacobian<1>) {
/// #         (self.fk(q), self.spatial_jacobian(q))
/// #     }
/// }
/// kin_runtime::__private::implement_kinematics! {
///     Turntable, 1, batches: provided, inverse: none, derivatives: provided, determinant: none, singularities: none
/// }
///
/// assert_eq!(Turntable.body_velocity(&[0.3], &[2.0]).angular, [0.0, 0.0, 2.0]);
/// ```
#[doc(hidden)]
#[macro_export]
macro_rules! implement_kinematics {
    ($robot:ident, $n:tt, scalar: f32, $($groups:tt)*) => {
        $crate::implement_kinematics! { f32 of ($crate::single), $robot, $n, $($groups)* }
    };
    ($robot:ident, $n:tt, $($groups:tt)*) => {
        $crate::implement_kinematics! { f64 of ($crate), $robot, $n, $($groups)* }
    };
    (
        $real:ident of $root:tt, $robot:ident, $n:tt, batches: $batches:ident, inverse: $inverse:ident,
        derivatives: $derivatives:ident, determinant: $determinant:ident,
        singularities: $singularities:ident
    ) => {
        $crate::kinematics_methods! {
            implement_kinematics, $real of $root,
            $n $real $root $robot $batches $inverse $derivatives $determinant $singularities
        }
    };
    (
        [
            $n:tt $real:ident ($($root:tt)*) $robot:ident $batches:ident $inverse:ident
            $derivatives:ident $determinant:ident $singularities:ident
        ]
        required $required:tt
        jacobians $jacobians:tt
        batches $batch_methods:tt
        inverse $inverse_methods:tt
        inverse_batches $inverse_batches:tt
        reachable $reachable:tt
        derivatives $derivative_methods:tt
        determinant $determinant_methods:tt
        singularities $singularity_methods:tt
        provided $provided:tt
    ) => {
        // A user's lints are not for code that only passes on.
        #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
        impl $($root)*::Kinematics<$n> for $robot {
            const JOINT_NAMES: [&'static str; $n] = $robot::JOINT_NAMES;
            const LIMITS: [$($root)*::JointLimit; $n] = $robot::LIMITS;
            const VELOCITY_LIMITS: [$real; $n] = $robot::VELOCITY_LIMITS;
            const EFFORT_LIMITS: [$real; $n] = $robot::EFFORT_LIMITS;
            const LINK_NAMES: [&'static str; $n] = $robot::LINK_NAMES;
            const FRAMES: &'static [$($root)*::Frame] = $robot::FRAMES;
            const BASE: &'static str = $robot::BASE;
            const TIP: &'static str = $robot::TIP;
            const TARGET: $($root)*::Target = $robot::TARGET;
            const POSTURES: &'static [$($root)*::Posture] = $robot::POSTURES;
            const BRANCHES: usize = $robot::BRANCHES;
            $crate::pass_on! { to $robot: own $required }
            $crate::pass_on! { to $robot: own $jacobians }
            $crate::compute_in_batches! { $real of ($($root)*), $robot $n $batches }
            $crate::pass_on! { to $robot: $inverse $inverse_methods }
            $crate::pass_on! { to $robot: $derivatives $derivative_methods }
            $crate::pass_on! { to $robot: $determinant $determinant_methods }
            $crate::pass_on! { to $robot: $singularities $singularity_methods }
        }

        #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
        impl $robot {
            $crate::pass_on! { from $robot as ($($root)*::Kinematics<$n>): batches $batch_methods }
            $crate::pass_on! {
                from $robot as ($($root)*::Kinematics<$n>): batches with $inverse $inverse_batches
            }
            $crate::pass_on! { from $robot as ($($root)*::Kinematics<$n>): with $inverse $reachable }
            $crate::pass_on! {
                from $robot as ($($root)*::Kinematics<$n>): $derivatives $derivative_methods
            }
            $crate::pass_on! { from $robot as ($($root)*::Kinematics<$n>): provided $provided }
        }
    };
}

/// The methods of a group as functions that pass on what they are given: from
/// the trait `to` the robot's own, or `from` the robot to those that the trait
/// provides.
#[doc(hidden)]
#[macro_export]
macro_rules! pass_on {
    (to $robot:ident: own { $(
        $(#[$attribute:meta])*
        fn $method:ident(&$self:ident $(, $argument:ident: $type:ty)*) -> $result:ty;
    )* }) => { $(
        #[inline]
        fn $method(&$self $(, $argument: $type)*) -> $result {
            $robot::$method($self $(, $argument)*)
        }
    )* };
    (to $robot:ident: own { $(
        $(#[$attribute:meta])*
        fn $method:ident(&$self:ident $(, $argument:ident: $type:ty)*) -> $result:ty $body:block
    )* }) => { $(
        #[inline]
        fn $method(&$self $(, $argument: $type)*) -> $result {
            ::core::convert::Into::into($robot::$method($self $(, $argument)*))
        }
    )* };
    (from $robot:ident as ($trait:path): required { $(
        $(#[$attribute:meta])*
        fn $method:ident(&$self:ident $(, $argument:ident: $type:ty)*) -> $result:ty;
    )* }) => { $(
        $(#[$attribute])*
        #[inline]
        #[must_use]
        pub fn $method(&$self $(, $argument: $type)*) -> $result {
            <Self as $trait>::$method($self $(, $argument)*)
        }
    )* };
    (from $robot:ident as ($trait:path): provided { $(
        $(#[$attribute:meta])*
        fn $method:ident(&$self:ident $(, $argument:ident: $type:ty)*) -> $result:ty $body:block
    )* }) => { $(
        $(#[$attribute])*
        #[inline]
        #[must_use]
        pub fn $method(&$self $(, $argument: $type)*) -> $result {
            <Self as $trait>::$method($self $(, $argument)*)
        }
    )* };
    (from $robot:ident as ($trait:path): batches { $(
        $(#[$attribute:meta])*
        fn $method:ident(&$self:ident $(, $argument:ident: $type:ty)* $(,)?) $body:block
    )* }) => { $(
        $(#[$attribute])*
        #[inline]
        pub fn $method(&$self $(, $argument: $type)*) {
            <Self as $trait>::$method($self $(, $argument)*)
        }
    )* };
    (from $robot:ident as ($trait:path): batches with own $group:tt) => {
        $crate::pass_on! { from $robot as ($trait): batches $group }
    };
    (from $robot:ident as ($trait:path): with own $group:tt) => {
        $crate::pass_on! { from $robot as ($trait): provided $group }
    };
    (to $robot:ident: $other:ident $group:tt) => {};
    (from $robot:ident as ($trait:path): $other:ident $group:tt) => {};
    (from $robot:ident as ($trait:path): with $other:ident $group:tt) => {};
    (from $robot:ident as ($trait:path): batches with $other:ident $group:tt) => {};
}

/// The batches of a robot in lanes: `forward` by its straight-line code, `inverse` by
/// its closed form as well, or as the trait has them (`provided`).
#[doc(hidden)]
#[macro_export]
macro_rules! compute_in_batches {
    ($real:ident of $root:tt, $robot:ident $n:tt provided) => {};
    ($real:ident of ($($root:tt)*), $robot:ident $n:tt inverse) => {
        $crate::compute_in_batches! { $real of ($($root)*), $robot $n forward }
        #[inline]
        fn ik_batch(&self, targets: &[$($root)*::Pose], solutions: &mut [$($root)*::Solutions<$n>]) {
            $($root)*::__private::batch::inverse::<$robot, $n, _, _, _>(
                targets,
                solutions,
                |target| self.ik(target),
            )
        }
    };
    ($real:ident of ($($root:tt)*), $robot:ident $n:tt forward) => {
        #[inline]
        fn fk_batch(&self, q: &[[$real; $n]], poses: &mut [$($root)*::Pose]) {
            $($root)*::__private::batch::forward::<$robot, _, $n, _>(q, poses)
        }
        #[inline]
        fn fk_jacobian_batch(
            &self,
            q: &[[$real; $n]],
            results: &mut [($($root)*::Pose, $($root)*::Jacobian<$n>)],
        ) {
            $($root)*::__private::batch::forward::<$robot, _, $n, _>(q, results)
        }
    };
}
