//! Poses from one precision to the other, and to and from other crates.

#[cfg(feature = "mint")]
#[path = "../convert/mint.rs"]
mod mint;
#[cfg(feature = "nalgebra")]
#[path = "../convert/nalgebra.rs"]
mod nalgebra;

#[cfg(feature = "serde")]
#[path = "../convert/serde.rs"]
mod serde;

use super::Pose;

impl From<crate::Pose> for Pose {
    /// Every entry rounded.
    fn from(pose: crate::Pose) -> Self {
        Pose {
            rotation: pose.rotation.map(|row| row.map(|x| x as f32)),
            translation: pose.translation.map(|x| x as f32),
        }
    }
}

impl From<Pose> for crate::Pose {
    /// The same numbers. The matrix is a rotation to seven digits; see
    /// [`orthonormalized`](crate::Pose::orthonormalized).
    fn from(pose: Pose) -> Self {
        crate::Pose {
            rotation: pose.rotation.map(|row| row.map(f64::from)),
            translation: pose.translation.map(f64::from),
        }
    }
}
