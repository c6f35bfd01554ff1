//! Parallel mechanisms: several chains from one base to one platform.
//!
//! A mechanism walks through the rooms of the compiler as an arm does, and each
//! of its chains is compiled as the arm that it is:
//!
//! ```text
//! robot file
//!   -> spec::MechanismSpec   chains, or a tree with loops; which joints are actuated
//!   -> chains                from base to platform
//!   -> model                 every chain as a Model; at home they end together
//!   -> rounding              few digits: the exact mechanism that the file stands for
//!   -> freedom               Grübler's formula and the rank; what cannot work is refused
//!   -> inverse               chain by chain through the plan search, aimed at the platform
//!   -> forward               closed form, if there is one; otherwise Newton's method
//!   -> compiled              closed configurations come back both ways, or there is no code
//!   -> emit                  one type for every chain, one for the mechanism
//! ```
//!
//! **Inverse kinematics.** Once the platform is placed, its chains know nothing
//! of each other. What can be asked of the platform depends on its freedoms:
//! all six make whole poses; a platform that only translates is asked for
//! positions, with the orientation that it always has (told next to home: the
//! loops may close in modes in which it turns, which are left out, but for those
//! of a single loop, whose assembly modes are known); and where one chain is
//! fixed by a position (the two links of a five-bar), that chain goes first and
//! tells the others the pose. A chain that a platform of fixed orientation
//! hangs on by axes that meet is solved up to that point, and then about it.
//!
//! **Forward kinematics.** With its actuated joints set, a single loop is one
//! serial chain of the passive joints around it, whose two ends the actuated
//! ones place: inverse kinematics of that chain, by the same search, gives all
//! assembly modes. Three chains that hold a translating platform at constant
//! distances from points that the actuators place (a Delta) are three spheres;
//! that tells all assembly modes of the mode in which it translates, and leaves out
//! those, if there are any, in which its joints were forced into another one.
//! All others are left to Newton's method, from a seed.
//!
//! Data flows one way; the runtime half is [`kin_runtime::ParallelKinematics`],
//! and [`kin_runtime::Mechanism`] is the generic mechanism that checks it.

mod chains;
mod compiled;
mod forward;
mod freedom;
mod inverse;
mod model;
mod rounding;
mod summary;

pub(crate) use compiled::compile;
pub use compiled::{CompiledMechanism, Placed};
pub use forward::{ForwardMethod, Loop, Rod};
pub use freedom::Freedom;
pub use inverse::{Aim, ChainRefusal, Inverse, LegForm, Split, UnsolvedChain};
pub use model::{Leg, Mechanism};
