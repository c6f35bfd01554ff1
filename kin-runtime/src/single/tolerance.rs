//! What depends on how many digits a scalar has: those of `f32`, seven.
//!
//! A target that was rounded is off by 6e-8, relative, and a closed form of some hundred
//! operations adds ten times as much. Two roots that meet tell their angle to the square root
//! of that, 1e-3.

use super::Real;

/// Solutions may miss their target by this, relative to the arm's size.
pub const SOLVED: Real = 2e-5;
/// How far beyond a stop a value still counts as resting on it, radians or metres: the accuracy
/// of inverse kinematics.
pub const STOP: Real = 1e-5;
/// Configurations whose joints are all as near are one, radians or metres.
pub const SAME: Real = 2e-3;
/// A target's rotation is none if it is off one by more.
pub const ROTATION: Real = 2e-5;
/// What is smaller than this, relative to the largest, adds no rank.
pub const RANK: Real = 1e-5;

/// A vector whose square is below this, relative to its scale, tells no angle: rounding, 5e-7, turns
/// it by a twentieth of a radian, and the tip moves by half of what a solution may miss, whatever
/// the angle.
pub const FREE_BELOW: Real = 1e-10;
/// The same where the angle that it tells would be given up for any other.
pub const NEARLY_FREE: Real = 1e-10;
/// How far the level of a free joint is at most, where it is the sum that three places tell, from that
/// sum, relative to its terms.
pub const AS_TOLD: Real = 1e-4;
/// A vector whose square is below this, relative to its scale, tells an angle to a hundredth of
/// what a solution may miss.
pub const BADLY_TOLD: Real = 1e-4;
/// Roots of a difference: where cancellation leaves noise, relative to the square of the
/// amplitude. Branches nearer than its square root are one.
pub const NOISE: Real = 2e-6;
/// A root this small, squared as [`NOISE`] (angle 1.4e-3), is reported singular.
pub const DOUBLE_ROOT: Real = 2e-6;

/// Branches that miss their target by more than this, relative to the arm's size, do so not by
/// rounding.
pub const NEARLY: Real = 5e-3;
/// The same of a plan with quartics.
pub const NEARLY_BY_QUARTIC: Real = 5e-3;
/// The same where joints depend on others.
pub const NEARLY_COUPLED: Real = 5e-2;
/// Relative to the arm's size, a residual below this is rounding.
pub const ROUNDING: Real = 5e-7;
/// Below this a pivot of the Jacobian, relative to the largest, is that of a singular
/// configuration.
pub const SINGULAR: Real = 3e-3;
/// Rounding may leave the square of a singular pivot below zero.
pub const PIVOT: Real = 1e-12;
