//! The scalar that a robot is computed in, and what depends on its digits.

use kin_runtime::__private::free_joint::{FreeJoint, Levels};
use kin_runtime::__private::tolerance as double;
use kin_runtime::Pose;
use kin_runtime::single::__private::free_joint as free_joint_in_single;
use kin_runtime::single::__private::tolerance as single;
use std::fmt;

/// The type of numbers in generated code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    #[default]
    F64,
    /// Single precision, for processors without a unit for more; see [`kin_runtime::single`].
    F32,
}

/// What the digits of a scalar allow. Lengths are relative to the arm's size.
#[derive(Clone, Copy, Debug)]
pub struct Tolerances {
    /// Solutions reach the target to this.
    pub solved: f64,
    /// Branches are solutions that reach it to this, as far as the scalar tells: no more than
    /// [`Tolerances::solved`] with the rounding of that distance.
    pub accepted: f64,
    /// See [`kin_runtime::__private::tolerance`], also for the next ones.
    pub free_below: f64,
    pub nearly_free: f64,
    pub nearly: f64,
    pub nearly_by_quartic: f64,
    pub nearly_coupled: f64,
    pub badly_told: f64,
    pub noise: f64,
    pub double_root: f64,
    /// Between 1 and the next number.
    pub epsilon: f64,
    /// An idealized arm whose tip moved less than this, of its size, is the given one to rounding.
    pub unmoved: f64,
    /// The same of fewer joints than targets have coordinates: at a double root, where half of the
    /// digits are lost, these need not be singular, so that the tip misses the target by as much.
    pub unmoved_if_short: f64,
    /// What has led to configurations as near as this has led to one, radians and metres.
    pub one: f64,
    /// Below this conditioning of the Jacobian branches of an exact arm may be lost to rounding;
    /// 0 if none may.
    pub near_singular: f64,
    /// A configuration comes back to this by the square of its conditioning, and not better than
    /// the next; radians and metres.
    pub recovered: f64,
    pub same: f64,
    /// No worse than this, either.
    pub different: f64,
}

impl Scalar {
    /// The words that stand for it.
    pub const WORDS: [&'static str; 2] = ["f64", "f32"];

    /// What it allows.
    pub fn tolerances(self) -> Tolerances {
        match self {
            Scalar::F64 => Tolerances {
                solved: double::SOLVED,
                accepted: double::SOLVED,
                free_below: double::FREE_BELOW,
                nearly_free: double::NEARLY_FREE,
                nearly: double::NEARLY,
                nearly_by_quartic: double::NEARLY_BY_QUARTIC,
                nearly_coupled: double::NEARLY_COUPLED,
                badly_told: double::BADLY_TOLD,
                noise: double::NOISE,
                double_root: double::DOUBLE_ROOT,
                epsilon: f64::EPSILON,
                unmoved: 1e-10,
                unmoved_if_short: 1e-12,
                one: double::SAME,
                near_singular: 0.0,
                recovered: 1e-11,
                same: 1e-7,
                different: 1e-2,
            },
            Scalar::F32 => Tolerances {
                solved: single::SOLVED.into(),
                accepted: f64::from(single::SOLVED) - 16.0 * f64::from(f32::EPSILON),
                free_below: single::FREE_BELOW.into(),
                nearly_free: single::NEARLY_FREE.into(),
                nearly: single::NEARLY.into(),
                nearly_by_quartic: single::NEARLY_BY_QUARTIC.into(),
                nearly_coupled: single::NEARLY_COUPLED.into(),
                badly_told: single::BADLY_TOLD.into(),
                noise: single::NOISE.into(),
                double_root: single::DOUBLE_ROOT.into(),
                epsilon: f32::EPSILON.into(),
                unmoved: 2e-6,
                unmoved_if_short: 2e-6,
                one: single::SAME.into(),
                near_singular: single::SINGULAR.into(),
                recovered: 2e-6,
                same: 1e-4,
                different: 5e-2,
            },
        }
    }

    /// A target as it can be given.
    pub fn target(self, pose: Pose) -> Pose {
        match self {
            Scalar::F64 => pose,
            Scalar::F32 => kin_runtime::single::Pose::from(pose).into(),
        }
    }

    /// [`Levels::next_root`] in this arithmetic.
    pub fn next_root(self, levels: [f64; 4], joint: FreeJoint) -> Option<f64> {
        match self {
            Scalar::F64 => Levels::new(levels, joint).next_root(),
            Scalar::F32 => in_single(levels, joint).next_root().map(f64::from),
        }
    }

    /// The turn of a free joint that leaves a later root the most room, radians, by its levels; see
    /// [`kin_runtime::__private::free_joint::Levels`].
    pub fn roomiest_turn(self, levels: [f64; 4], joint: FreeJoint) -> f64 {
        match self {
            Scalar::F64 => Levels::new(levels, joint).roomiest(),
            Scalar::F32 => in_single(levels, joint).roomiest().into(),
        }
    }

    /// Whether these tell the level at a turn too, as there.
    pub fn levels_tell(self, levels: [f64; 4], joint: FreeJoint, turn: f64, level: f64) -> bool {
        match self {
            Scalar::F64 => Levels::new(levels, joint).tell(turn, level),
            Scalar::F32 => in_single(levels, joint).tell(turn as f32, level as f32),
        }
    }

    /// The nearest number of this type.
    pub fn rounded(self, x: f64) -> f64 {
        match self {
            Scalar::F64 => x,
            Scalar::F32 => f64::from(x as f32),
        }
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Scalar::F64 => "f64",
            Scalar::F32 => "f32",
        })
    }
}

fn in_single(levels: [f64; 4], joint: FreeJoint) -> free_joint_in_single::Levels {
    let joint = free_joint_in_single::FreeJoint {
        coordinate: joint.coordinate,
        slide: joint.slide.map(|slide| slide as f32),
    };
    free_joint_in_single::Levels::new(levels.map(|x| x as f32), joint)
}
