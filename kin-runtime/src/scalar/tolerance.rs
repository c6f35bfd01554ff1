//! What depends on how many digits a scalar has.

use super::Real;

/// Solutions may miss their target by this, relative to the arm's size.
pub const SOLVED: Real = 1e-9;
/// How far beyond a stop a value still counts as resting on it, radians or metres: the accuracy
/// of inverse kinematics.
pub const STOP: Real = 1e-9;
/// Configurations whose joints are all as near are one, radians or metres.
pub const SAME: Real = 1e-6;
/// A target's rotation is none if it is off one by more.
pub const ROTATION: Real = 1e-9;
/// What is smaller than this, relative to the largest, adds no rank.
pub const RANK: Real = 1e-9;

/// A vector whose square is below this, relative to its scale, tells no angle: steps before it that are
/// nearly singular leave it 1e-12 and more of rounding, and the tip moves by a hundredth of what a solution
/// may miss, whatever the angle.
pub const FREE_BELOW: Real = 1e-22;
/// A vector whose square is below this moves the tip by no more than Newton's method mends: the angle
/// that it tells may be given up for any other, since the target may be nearer than what a solution
/// may miss to one that leaves it free, the more so the nearer the vector's point is to the axis.
pub const NEARLY_FREE: Real = 1e-16;
/// How far the level of a free joint is at most, where it is the sum that three places tell, from that
/// sum, relative to its terms.
pub const AS_TOLD: Real = 1e-9;
/// A vector whose square is below this, relative to its scale, tells an angle to a hundredth of
/// what a solution may miss.
pub const BADLY_TOLD: Real = 1e-10;
/// Roots of a difference: where cancellation leaves noise, relative to the square of the
/// amplitude. Branches nearer than its square root are one.
pub const NOISE: Real = 1e-13;
/// A root this small, squared as [`NOISE`] (angle 3e-7), is reported singular.
pub const DOUBLE_ROOT: Real = 1e-13;

/// Branches that miss their target by more than this, relative to the arm's size, do so not by
/// rounding.
pub const NEARLY: Real = 1e-5;
/// The same of a plan with quartics: where all four roots meet, the fourth root of rounding.
pub const NEARLY_BY_QUARTIC: Real = 1e-3;
/// The same where joints depend on others: the arm is regular where these would be singular by
/// themselves, in two ways at once, and short links between them make an angle of what they are off.
pub const NEARLY_COUPLED: Real = 1e-2;
/// Relative to the arm's size, a residual below this is rounding.
pub const ROUNDING: Real = 1e-14;
/// Below this a pivot of the Jacobian, relative to the largest, is that of a singular
/// configuration.
pub const SINGULAR: Real = 1e-5;
/// Rounding may leave the square of a singular pivot below zero.
pub const PIVOT: Real = 1e-20;
