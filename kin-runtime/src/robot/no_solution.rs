//! Why inverse kinematics has no solution that is wanted.

use super::super::scalar::{Real, tolerance};
use super::super::{JointLimit, Kinematics, Nearest, Pose, Solution, Solutions, Target};
use core::fmt;

/// Why [`Kinematics::try_ik_nearest`], or
/// [`RedundantKinematics::try_ik_nearest_at`](crate::RedundantKinematics::try_ik_nearest_at), has
/// no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoSolution<const N: usize> {
    /// An entry of the target that counts, the parameter, or of a path a weight, is not a finite
    /// number.
    NotFinite,
    /// The target's rotation is none.
    NotRotation {
        /// How far it is from one; see [`Pose::rotation_error`].
        error: Real,
    },
    /// No configuration reaches the target, of an arm with a parameter none with its value.
    OutOfReach {
        /// What reaches towards it, with its distance, metres, as the residual; see
        /// [`Kinematics::ik_approximate`]. None of an arm with a parameter.
        approximate: Option<Solution<N>>,
    },
    /// The robot is redundant, so that a target alone has infinitely many solutions: use the
    /// method that takes the parameters. Of robots that are loaded when the program runs.
    NeedsParameters {
        /// How many.
        count: usize,
    },
    /// The robot was loaded without inverse kinematics, by `ik = none`.
    WithoutInverse,
    /// The target is reached outside the limits alone; a singular one with what it leaves free as the
    /// seed has it, of which other values may be inside.
    OutsideLimits {
        /// The solution that is least outside.
        solution: Solution<N>,
        /// The joint that is furthest beyond a limit there, from 0.
        joint: usize,
        /// How far, radians or metres.
        by: Real,
    },
    /// The target is reached inside the limits, by longer steps than allowed.
    BeyondStep {
        /// The solution that takes the least too much.
        solution: Solution<N>,
        /// The joint that would have to move the most too far, from 0.
        joint: usize,
        /// How much further than allowed, radians or metres.
        by: Real,
    },
}

impl<const N: usize> NoSolution<N> {
    /// Why a robot has none for a target.
    #[cold]
    pub(crate) fn of<K: Kinematics<N> + ?Sized>(
        robot: &K,
        target: &Pose,
        nearest: &Nearest<N>,
    ) -> Self {
        let solutions = robot.ik_seeded(target, &nearest.seed);
        Self::among(&solutions, nearest).unwrap_or_else(|| {
            Self::of_target(robot.own_target(), target, || robot.ik_approximate(target))
        })
    }

    /// Why none of some solutions is wanted; none if there are none.
    #[cold]
    pub(crate) fn among(solutions: &Solutions<N>, nearest: &Nearest<N>) -> Option<Self> {
        let joints = nearest.motion(&nearest.seed, solutions.prismatic());
        let outside = |solution: &Solution<N>| {
            furthest::<N>(core::array::from_fn(|i| {
                joints.beyond_limits(i, solution.q[i])
            }))
        };
        let too_far = |solution: &Solution<N>| {
            furthest::<N>(core::array::from_fn(|i| joints.beyond(i, solution.q[i])))
        };
        let inside = || {
            solutions
                .iter()
                .filter(|solution| outside(solution).1 <= JointLimit::TOLERANCE)
        };
        if let Some((solution, (joint, by))) = least(inside(), too_far) {
            return Some(Self::BeyondStep {
                solution,
                joint,
                by,
            });
        }
        let (solution, (joint, by)) = least(solutions.iter(), outside)?;
        Some(Self::OutsideLimits {
            solution,
            joint,
            by,
        })
    }

    /// Why a target of which so much counts has no solutions.
    #[cold]
    pub(crate) fn of_target(
        counts: Target,
        target: &Pose,
        approximate: impl FnOnce() -> Option<Solution<N>>,
    ) -> Self {
        match counts.rotation_error(target) {
            _ if !counts.is_finite(target) => Self::NotFinite,
            error if error > tolerance::ROTATION => Self::NotRotation { error },
            _ => Self::OutOfReach {
                approximate: approximate(),
            },
        }
    }
}

/// The joint that is furthest beyond something, and how far.
fn furthest<const N: usize>(beyond: [Real; N]) -> (usize, Real) {
    let all = beyond.into_iter().enumerate();
    all.fold((0, Real::NEG_INFINITY), |most, next| {
        if next.1 > most.1 { next } else { most }
    })
}

/// The solution that is least beyond something.
fn least<'a, const N: usize>(
    solutions: impl Iterator<Item = &'a Solution<N>>,
    beyond: impl Fn(&Solution<N>) -> (usize, Real),
) -> Option<(Solution<N>, (usize, Real))> {
    solutions
        .map(|solution| (*solution, beyond(solution)))
        .min_by(|(_, a), (_, b)| a.1.total_cmp(&b.1))
}

impl<const N: usize> fmt::Display for NoSolution<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str(
                "an entry of the target, the parameter, or a weight is not a finite number",
            ),
            Self::NotRotation { error } => write!(
                f,
                "the target's matrix is off a rotation by {error:.1e}: if that is rounding, \
                 `Pose::orthonormalized` mends it"
            ),
            Self::OutOfReach {
                approximate: Some(near),
            } => write!(
                f,
                "the target is out of reach by about {:.1e} m: `ik_approximate` has what comes near",
                near.residual
            ),
            Self::OutOfReach { approximate: None } => f.write_str(
                "no configuration reaches the target, or none with the parameter's value",
            ),
            Self::NeedsParameters { count } => write!(
                f,
                "a target leaves so many parameters of the robot open: {count}; `ik_nearest_at` takes \
                 them"
            ),
            Self::WithoutInverse => f.write_str(
                "the robot was loaded without inverse kinematics: leave out `ik = none`",
            ),
            Self::OutsideLimits { joint, by, .. } => write!(
                f,
                "the target is reached outside the limits alone: joint {} would be {by:.1e} rad or m \
                 beyond them",
                joint + 1
            ),
            Self::BeyondStep { joint, by, .. } => write!(
                f,
                "the target takes longer steps than allowed: joint {} would move {by:.1e} rad or m \
                 too far",
                joint + 1
            ),
        }
    }
}

impl<const N: usize> core::error::Error for NoSolution<N> {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn every_reason_has_its_words() {
        let solution = Solution {
            q: [0.0],
            residual: 0.5,
            branch: 0,
            singular: false,
        };
        let (joint, by) = (0, 0.25);
        let approximate = Some(solution);
        let texts = [
            (
                NoSolution::NotFinite,
                "an entry of the target, the parameter, or a weight is not a finite number",
            ),
            (
                NoSolution::NotRotation { error: 0.25 },
                "the target's matrix is off a rotation by 2.5e-1: if that is rounding, \
                 `Pose::orthonormalized` mends it",
            ),
            (
                NoSolution::OutOfReach { approximate },
                "the target is out of reach by about 5.0e-1 m: `ik_approximate` has what comes near",
            ),
            (
                NoSolution::OutOfReach { approximate: None },
                "no configuration reaches the target, or none with the parameter's value",
            ),
            (
                NoSolution::NeedsParameters { count: 2 },
                "a target leaves so many parameters of the robot open: 2; `ik_nearest_at` takes them",
            ),
            (
                NoSolution::WithoutInverse,
                "the robot was loaded without inverse kinematics: leave out `ik = none`",
            ),
            (
                NoSolution::OutsideLimits {
                    solution,
                    joint,
                    by,
                },
                "the target is reached outside the limits alone: joint 1 would be 2.5e-1 rad or m \
                 beyond them",
            ),
            (
                NoSolution::BeyondStep {
                    solution,
                    joint,
                    by,
                },
                "the target takes longer steps than allowed: joint 1 would move 2.5e-1 rad or m too \
                 far",
            ),
        ];
        for (reason, text) in texts {
            assert_eq!(reason.to_string(), text);
        }
    }
}
