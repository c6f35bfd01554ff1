//! The methods of [`ParallelKinematics`](crate::ParallelKinematics) as inherent
//! ones, so that users of a mechanism import nothing.

/// Writes the methods of the trait as methods of a generated mechanism with the
/// given numbers of joints, actuated joints and chains.
#[doc(hidden)]
#[macro_export]
macro_rules! inherent_parallel_methods {
    ($robot:ident, $n:literal, $m:literal, $k:literal) => {
        impl $robot {
            /// The joints' names, chain after chain, from base to platform.
            pub const JOINT_NAMES: [&'static str; $n] =
                <Self as $crate::ParallelKinematics<$n, $m, $k>>::JOINT_NAMES;
            /// The joints' kinds and travel, radians and metres.
            pub const LIMITS: [$crate::JointLimit; $n] =
                <Self as $crate::ParallelKinematics<$n, $m, $k>>::LIMITS;
            /// The first joint of every chain, and one past its last.
            pub const CHAINS: [[usize; 2]; $k] =
                <Self as $crate::ParallelKinematics<$n, $m, $k>>::CHAINS;
            /// Which joints are actuated, by number.
            pub const ACTUATED: [usize; $m] =
                <Self as $crate::ParallelKinematics<$n, $m, $k>>::ACTUATED;
            /// The link that poses are given in.
            pub const BASE: &'static str =
                <Self as $crate::ParallelKinematics<$n, $m, $k>>::BASE;
            /// The link that poses are of.
            pub const PLATFORM: &'static str =
                <Self as $crate::ParallelKinematics<$n, $m, $k>>::PLATFORM;
            /// What an angle of one radian is worth beside lengths, metres.
            pub const LENGTH: f64 = <Self as $crate::ParallelKinematics<$n, $m, $k>>::LENGTH;
            /// How many independent motions the mechanism has.
            pub const MOBILITY: usize =
                <Self as $crate::ParallelKinematics<$n, $m, $k>>::MOBILITY;
        }
        $crate::inherent_parallel_methods! { @ $robot, $n, $m, $k:
            /// Where each chain puts the platform, and the displaced spatial
            /// twist of each joint.
            fn chains(q: &[f64; $n]) -> ([$crate::Pose; $k], [$crate::Twist; $n]);
            /// The platform's pose by the first chain.
            fn platform(q: &[f64; $n]) -> $crate::Pose;
            /// The values of the actuated joints.
            fn actuated(q: &[f64; $n]) -> [f64; $m];
            /// The assembly that Newton's method finds from a seed.
            fn fk_near(actuated: &[f64; $m], seed: &[f64; $n])
                -> ::core::option::Option<$crate::Solution<$n>>;
            /// The spatial twist that takes each chain's end to that of the
            /// first: zero where the loops are closed.
            fn structure_equation(q: &[f64; $n]) -> [$crate::Twist; $k];
            /// J₁, J₂, … side by side.
            fn structure_jacobian(q: &[f64; $n]) -> $crate::Jacobian<$n>;
            /// How far the ends of the chains are apart, metres.
            fn gap(q: &[f64; $n]) -> f64;
            /// From actuated rates to the platform's spatial velocity.
            fn forward_jacobian(q: &[f64; $n]) -> ::core::option::Option<$crate::Jacobian<$m>>;
            /// From the platform's spatial velocity to actuated rates, by rows.
            fn inverse_jacobian(q: &[f64; $n]) -> ::core::option::Option<[[f64; 6]; $m]>;
            /// The rates of all joints while the actuated ones move at the given
            /// rates.
            fn joint_rates(q: &[f64; $n], actuated: &[f64; $m])
                -> ::core::option::Option<[f64; $n]>;
            /// How far from a kinematic singularity.
            fn kinematic_singularity(q: &[f64; $n]) -> f64;
            /// How far from an actuator singularity.
            fn actuator_singularity(q: &[f64; $n]) -> f64;
        }
    };
    (ik: $robot:ident, $n:literal, $m:literal, $k:literal) => {
        $crate::inherent_parallel_methods! { @ $robot, $n, $m, $k:
            /// All configurations that hold the platform at `target`, chain by
            /// chain.
            fn ik(target: &$crate::Pose) -> $crate::Postures<$n, $k>;
            /// The same; an angle that a singular target leaves free keeps its
            /// value in `seed`.
            fn ik_near(target: &$crate::Pose, seed: &[f64; $n]) -> $crate::Postures<$n, $k>;
        }
    };
    (fk: $robot:ident, $n:literal, $m:literal, $k:literal) => {
        $crate::inherent_parallel_methods! { @ $robot, $n, $m, $k:
            /// All assembly modes with the given values of the actuated joints.
            fn fk(actuated: &[f64; $m]) -> $crate::Solutions<$n>;
        }
    };
    (@ $robot:ident, $n:literal, $m:literal, $k:literal: $(
        $(#[$attribute:meta])*
        fn $method:ident($($argument:ident: $type:ty),*) -> $result:ty;
    )*) => {
        impl $robot {
            $(
                $(#[$attribute])*
                ///
                /// A method of `kinematics::ParallelKinematics`, which says more.
                #[inline]
                #[must_use]
                pub fn $method(&self, $($argument: $type),*) -> $result {
                    <Self as $crate::ParallelKinematics<$n, $m, $k>>::$method(
                        self, $($argument),*
                    )
                }
            )*
        }
    };
}
