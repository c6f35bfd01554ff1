//! The methods of `ParallelKinematics` on a generated mechanism.

/// Gives a mechanism that implements the trait its constants and methods as
/// inherent ones, so that its users import nothing. Inverse and forward kinematics
/// are its `own` or left out (`none`).
#[doc(hidden)]
#[macro_export]
macro_rules! inherent_parallel_methods {
    (
        $robot:ident, $n:tt, $m:tt, $k:tt, inverse: $inverse:ident, forward: $forward:ident
    ) => {
        $crate::parallel_methods! {
            inherent_parallel_methods, $n $m $k $robot $inverse $forward
        }
    };
    (
        [$n:tt $m:tt $k:tt $robot:ident $inverse:ident $forward:ident]
        constants { $(
            $(#[$attribute:meta])*
            const $constant:ident: $of:ty $(= $default:expr)?;
        )* }
        required $required:tt
        inverse $inverse_methods:tt
        forward $forward_methods:tt
        provided $provided:tt
    ) => {
        // A user's lints are not for code that only passes on.
        #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
        impl $robot {
            $(
                $(#[$attribute])*
                pub const $constant: $of =
                    <Self as $crate::ParallelKinematics<$n, $m, $k>>::$constant;
            )*
            $crate::pass_on! {
                from $robot as ($crate::ParallelKinematics<$n, $m, $k>): required $required
            }
            $crate::pass_on! {
                from $robot as ($crate::ParallelKinematics<$n, $m, $k>):
                with $inverse $inverse_methods
            }
            $crate::pass_on! {
                from $robot as ($crate::ParallelKinematics<$n, $m, $k>):
                with $forward $forward_methods
            }
            $crate::pass_on! {
                from $robot as ($crate::ParallelKinematics<$n, $m, $k>): provided $provided
            }
        }
    };
}
