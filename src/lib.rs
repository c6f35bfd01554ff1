// In the repository, links of README.md and of the guides lead to files, here to modules: of two
// definitions of a link the first counts. Examples are named after the first file, and need no links.
#![cfg_attr(not(doctest), doc = include_str!("links.md"))]
#![doc = include_str!("../README.md")]
#![cfg_attr(not(feature = "runtime"), no_std)]

// What the macro expands to names this crate.
#[cfg(docsrs)]
extern crate self as kinematics;

/// ```
/// kinematics::kinematics!("robots/ur5e.urdf");
/// // The first three joints of the same arm, under a name of their own.
/// kinematics::kinematics!(
///     "robots/ur5e.urdf",
///     name = Shoulder,
///     tip = "forearm_link",
///     ik = none,
/// );
///
/// let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
/// let target = Ur5e.fk(&q);
/// assert_eq!(Ur5e.ik(&target).len(), 8);
/// assert_eq!(Shoulder.fk(&[0.3, -1.2, 1.5]).translation, Ur5e.fk_links(&q)[2].translation);
/// ```
pub use kin_macros::kinematics;
#[doc(hidden)]
pub use kin_runtime::__private;
#[cfg(feature = "rayon")]
pub use kin_runtime::Multithreaded;
pub use kin_runtime::{
    Along, Basis, Body, Ellipsoid, Follow, Following, Frame, FullTurns, Hessian,
    HighlyRedundantKinematics, Jacobian, JointLimit, Kinematics, Manipulability, Nearest,
    NoSolution, ParallelKinematics, Parameter, PathStep, Pose, Posture, Postures, RANK_TOLERANCE,
    RedundantKinematics, Singularities, Singularity, Solution, Solutions, Swivel, Target, Twist,
    WithBase, WithTool, Wrench, centering_gradient, null_space, single, subproblems,
};
#[cfg(feature = "alloc")]
pub use kin_runtime::{
    BranchEnd, Chain, ChainSolution, Criterion, FeasibleInterval, Mechanism, NoPath, Path,
    SearchOptions, SelfMotion, SelfMotionError, SelfMotionOptions, SelfMotions, Stop, Workspace,
    WorkspaceMethod, ik_path, least_motion, scattered_rotations, self_motion, self_motions,
};

#[cfg(feature = "runtime")]
mod robot;
#[cfg(feature = "runtime")]
pub use kin_codegen::closed_form::BranchSolution;
#[cfg(feature = "runtime")]
pub use kin_codegen::{Error as LoadError, Ik, Options as RobotOptions, Source as RobotSource};
#[cfg(feature = "runtime")]
pub use robot::{AlongParameter, Answer, Answers, Arm, Interval, NamedPosture, OfSlices, Robot};

/// What `kinematics!("robots/ur5e.urdf")` leaves: a sample, in this
/// documentation alone.
#[cfg(docsrs)]
pub mod sample {
    crate::kinematics!("robots/ur5e.urdf");
}

/// A guide for each name, whose text is the file in `docs`. Its examples are tested as those here.
#[cfg(doc)]
macro_rules! guides {
    ($($name:ident)*) => {$(
        #[cfg_attr(not(doctest), doc = include_str!("links.md"))]
        #[doc = include_str!(concat!("../docs/", stringify!($name), ".md"))]
        pub mod $name {}
    )*};
}

/// Guides, one subject each, for what the front page only mentions: in this documentation alone.
#[cfg(doc)]
pub mod guide {
    guides! {
        methods solutions redundancy singularities closed_forms single_precision
        files mechanisms noise verification speed tables run_time c javascript pictures
    }
}
