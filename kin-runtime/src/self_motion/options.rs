//! How to follow a self-motion, and what may end or prevent it.

use crate::{JointLimit, Target};

/// How to follow a self-motion.
///
/// ```
/// use kin_runtime::{SelfMotionOptions, Target};
/// let coarse = SelfMotionOptions::<7> { step: 0.2, ..Default::default() };
/// assert_eq!(coarse.target, Target::Pose);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SelfMotionOptions<const N: usize> {
    /// What of the tip rests; the whole pose by default.
    pub target: Target,
    /// Where the motion ends; by default nowhere, and angles that differ by
    /// full turns are one posture.
    pub limits: Option<[JointLimit; N]>,
    /// The longest step in joint space, radians and metres; 0.05 by default.
    /// Steps are shorter where the curve bends.
    pub step: f64,
    /// How many configurations to follow the motion for, in each direction, at
    /// most; 10 000 by default.
    pub most_steps: usize,
}

impl<const N: usize> Default for SelfMotionOptions<N> {
    fn default() -> Self {
        SelfMotionOptions {
            target: Target::Pose,
            limits: None,
            step: 0.05,
            most_steps: 10_000,
        }
    }
}

/// Why a self-motion cannot be followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SelfMotionError {
    /// There are this many independent internal motions, not one: the arm is
    /// not redundant, is so more than once, or stands in a singularity.
    Dimension(usize),
    /// This joint is beyond its limits to begin with.
    BeyondLimit {
        /// From 0.
        joint: usize,
    },
}

impl core::fmt::Display for SelfMotionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            SelfMotionError::Dimension(0) => write!(
                f,
                "no internal motion is possible here, so there is none to follow"
            ),
            SelfMotionError::Dimension(n) => write!(
                f,
                "{n} independent internal motions are possible here, and only one can be \
                 followed; is the arm singular, or more than once redundant?"
            ),
            SelfMotionError::BeyondLimit { joint } => {
                write!(f, "joint {joint}, counted from 0, is beyond its limits")
            }
        }
    }
}

impl core::error::Error for SelfMotionError {}

/// Why a self-motion goes no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// A joint has come to its limit.
    Limit {
        /// From 0.
        joint: usize,
    },
    /// The arm has come to a singularity, at which the curve crosses itself or
    /// another.
    Singular,
    /// [`SelfMotionOptions::most_steps`] were taken.
    Unfinished,
}
