//! The trait of serial arms, of the list of its methods, for either precision: it is made where
//! `Real` and the types are those of one.

macro_rules! define_kinematics {
    ([$n:ident]
        required { $(
            $(#[$required_attribute:meta])*
            fn $required:ident(&$this:ident $(, $given:ident: $of:ty)*) -> $answer:ty;
        )* }
        $($group:ident { $(
            $(#[$attribute:meta])*
            fn $method:ident(&$self:ident $(, $argument:ident: $type:ty)* $(,)?)
                $(-> $result:ty)? $body:block
        )* })*
    ) => {
        /// The kinematics of one serial arm with N moving joints.
        ///
        /// Generated robots are zero-sized types that implement this trait and offer
        /// the same methods inherently; the trait is for code that treats all robots
        /// alike. Joint values are radians for revolute joints and metres for
        /// prismatic ones. The base frame is [`Kinematics::BASE`], the tip frame
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
        pub trait Kinematics<const $n: usize> {
            /// The joints' names, from base to tip.
            const JOINT_NAMES: [&'static str; $n];
            /// The joints' kinds and travel.
            const LIMITS: [JointLimit; $n];
            /// How fast the joints may move, rad/s, and m/s of prismatic joints;
            /// infinity where that is not known.
            const VELOCITY_LIMITS: [Real; $n] = [Real::INFINITY; $n];
            /// What the joints' drives may exert, N m, and N of prismatic joints;
            /// infinity where that is not known.
            const EFFORT_LIMITS: [Real; $n] = [Real::INFINITY; $n];
            /// The links whose poses [`Kinematics::fk_links`] gives, in its order;
            /// empty names where they have none.
            const LINK_NAMES: [&'static str; $n] = [""; $n];
            /// The other links that do not move against the base or a link that
            /// a joint moves: cameras, flanges, tool changers.
            const FRAMES: &'static [Frame] = &[];
            /// The frame that poses are given in.
            const BASE: &'static str;
            /// The frame that poses are of.
            const TIP: &'static str;
            /// What of a target counts for inverse kinematics.
            const TARGET: Target = Target::Pose;
            /// What the branches of inverse kinematics are called, by
            /// [`Solution::branch`](crate::Solution::branch); empty where they
            /// have no names.
            const POSTURES: &'static [Posture] = &[];
            /// How many branches inverse kinematics looks at, which bounds the number
            /// of isolated solutions of an arm that is as its design; 0 for an arm with parameters or
            /// generated with `ik = none`.
            const BRANCHES: usize;

            /// [`Kinematics::LIMITS`], or those of a robot that is known when the program runs.
            #[doc(hidden)]
            fn own_limits(&self) -> [JointLimit; $n] {
                Self::LIMITS
            }

            /// [`Kinematics::TARGET`], in the same way.
            #[doc(hidden)]
            fn own_target(&self) -> Target {
                Self::TARGET
            }

            $(
                $(#[$required_attribute])*
                fn $required(&$this $(, $given: $of)*) -> $answer;
            )*

            $($(
                $(#[$attribute])*
                fn $method(&$self $(, $argument: $type)*) $(-> $result)? $body
            )*)*
        }
    };
}
pub(crate) use define_kinematics;
