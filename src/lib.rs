//! A kinematics compiler: robot files become specialized, verified Rust while
//! your crate builds.
#![no_std]

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
pub use kin_runtime::*;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
