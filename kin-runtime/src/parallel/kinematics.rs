//! What every generated mechanism can do.

use super::newton::{Limb, Task, close};
use super::posture::Posture;
use super::postures::Postures;
use crate::{Jacobian, Pose, Solution, Solutions, Twist};

macro_rules! define_parallel_kinematics {
    ([$n:ident $m:ident $k:ident]
        constants { $(
            $(#[$constant_attribute:meta])*
            const $constant:ident: $of:ty $(= $default:expr)?;
        )* }
        required { $(
            $(#[$required_attribute:meta])*
            fn $required:ident(&$this:ident $(, $given:ident: $given_type:ty)*) -> $found:ty;
        )* }
        $($group:ident { $(
            $(#[$attribute:meta])*
            fn $method:ident(&$self:ident $(, $argument:ident: $type:ty)*) -> $result:ty $body:block
        )* })*
    ) => {
        /// The kinematics of a parallel mechanism: K chains from one base to one
        /// platform, with N joints together, M of them actuated (MLS section 3.5).
        ///
        /// Generated mechanisms are zero-sized types that implement this trait and
        /// offer the same methods inherently. A configuration q lists the joints of the
        /// first chain, then those of the second, and so on; radians and metres.
        /// Velocities are spatial twists (v, ω) of the platform.
        ///
        /// ```
        /// use kin_runtime::{JointLimit, ParallelKinematics, Pose, Twist};
        ///
        /// /// A parallelogram: two cranks of 1 m, 2 m apart, and a coupler that does
        /// /// not turn. The first crank is driven.
        /// struct Parallelogram;
        ///
        /// impl ParallelKinematics<4, 1, 2> for Parallelogram {
        ///     const JOINT_NAMES: [&'static str; 4] = ["crank", "pin", "rocker", "other_pin"];
        ///     const LIMITS: [JointLimit; 4] = [JointLimit::Continuous; 4];
        ///     const CHAINS: [[usize; 2]; 2] = [[0, 2], [2, 4]];
        ///     const ACTUATED: [usize; 1] = [0];
        ///     const BASE: &'static str = "frame";
        ///     const PLATFORM: &'static str = "coupler";
        ///     const LENGTH: f64 = 2.0;
        ///     const MOBILITY: usize = 1;
        ///     const BRANCHES: [usize; 2] = [0, 0];
        ///     const ASSEMBLY_MODES: usize = 0;
        ///
        ///     fn chains(&self, q: &[f64; 4]) -> ([Pose; 2], [Twist; 4]) {
        ///         let arm = |x: f64, a: f64, b: f64| {
        ///             let z = [0.0, 0.0, 1.0];
        ///             let crank = Twist::revolute(z, [x, 0.0, 0.0]);
        ///             let turned = Pose::exp(&crank, a);
        ///             let pin = Twist::revolute(z, [x, 1.0, 0.0]);
        ///             let home = Pose::from_translation([1.0, 1.0, 0.0]);
        ///             (turned * Pose::exp(&pin, b) * home, [crank, turned.adjoint(&pin)])
        ///         };
        ///         let (left, [a, b]) = arm(0.0, q[0], q[1]);
        ///         let (right, [c, d]) = arm(2.0, q[2], q[3]);
        ///         ([left, right], [a, b, c, d])
        ///     }
        /// }
        ///
        /// let turned = Parallelogram.fk_near(&[0.3], &[0.0; 4]).unwrap();
        /// assert!(turned.residual < 1e-12 && (turned.q[2] - 0.3).abs() < 1e-12);
        /// // The coupler moves at right angles to the crank.
        /// let forward = Parallelogram.forward_jacobian(&[0.0; 4]).unwrap();
        /// assert!((forward.rows[0][0] + 1.0).abs() < 1e-15);
        /// // Stretched flat, it may turn into an antiparallelogram: the structure
        /// // equation's Jacobian loses rank.
        /// let flat = core::f64::consts::FRAC_PI_2;
        /// assert!(Parallelogram.kinematic_singularity(&[flat, -flat, flat, -flat]) < 1e-15);
        /// ```
        pub trait ParallelKinematics<const $n: usize, const $m: usize, const $k: usize> {
            $(
                $(#[$constant_attribute])*
                const $constant: $of $(= $default)?;
            )*

            $(
                $(#[$required_attribute])*
                fn $required(&$this $(, $given: $given_type)*) -> $found;
            )*

            $($(
                $(#[$attribute])*
                fn $method(&$self $(, $argument: $type)*) -> $result $body
            )*)*
        }
    };
}
pub(crate) use define_parallel_kinematics;

crate::parallel_methods!(define_parallel_kinematics, N M K);

/// Looks at one configuration.
fn posture<P, R, const N: usize, const M: usize, const K: usize>(
    mechanism: &P,
    q: &[f64; N],
    look: impl FnOnce(&Posture) -> R,
) -> R
where
    P: ParallelKinematics<N, M, K> + ?Sized,
{
    let (poses, twists) = mechanism.chains(q);
    look(&Posture {
        poses: &poses,
        twists: &twists,
        chains: &P::CHAINS,
        actuated: &P::ACTUATED,
        length: P::LENGTH,
    })
}
