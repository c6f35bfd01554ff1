//! The solutions of an arm, from those of six joints.
//!
//! Of an arm of fewer, joints behind the tip make six; the solutions with these at zero are those of
//! the arm itself. The turn about the tip's axis, where it is free, is one that need not be.

use super::Univariate;
use super::closest::Task;
use super::found::Answer;
use crate::generated::refinement::{Problem, levenberg};
use crate::scalar::tolerance::SOLVED;
use crate::{Jacobian, Pose, Solution, Solutions, Target, math};

/// Where six joints are nearly singular, a target that is off by rounding is reached with
/// the joints behind the tip this far from zero, radians.
const ZERO: f64 = 1e-2;

/// Evaluations at most; a regular solution takes two.
const STEPS: usize = 24;
/// The same from what comes nearest, where singularities lie within 1e-6 of each other.
const STEPS_FROM_NEAREST: usize = 96;

/// The solutions of the first N joints, among those of all six; where there are none, what comes
/// nearest, if Levenberg's method leads on from there.
pub(super) fn shortened<const N: usize>(
    arm: &Univariate,
    target: &Pose,
    found: &Answer,
) -> Solutions<N> {
    let moving = arm.moving(N);
    let at_zero = |solution: &&Solution<6>| solution.q[moving..].iter().all(|q| q.abs() < ZERO);
    Solutions::build_with_prismatic(arm.frames.prismatic, |out| {
        for solution in found.solutions.iter().filter(at_zero) {
            if moving == 6 {
                let q = arm.metres(&solution.q);
                out.push_if(true, with(solution, q, solution.residual));
            } else if let Some(arrived) = arrived(arm, target, solution, STEPS) {
                out.insert_distinct(arrived);
            }
        }
        if out.is_empty() {
            let nearest = found.nearest.iter().find(at_zero);
            if let Some(arrived) =
                nearest.and_then(|it| arrived(arm, target, it, STEPS_FROM_NEAREST))
            {
                out.push_if(true, arrived);
            }
        }
    })
}

/// Where Levenberg's method leads of the first N joints, if it reaches the target.
fn arrived<const N: usize>(
    arm: &Univariate,
    target: &Pose,
    from: &Solution<6>,
    steps: usize,
) -> Option<Solution<N>> {
    let task = Task::new(arm, target, N);
    let problem = Problem {
        fk_jacobian: |q: &[f64; N]| {
            let all = core::array::from_fn(|i| q.get(i).copied().unwrap_or(0.0));
            let (pose, jacobian) = task.frames.fk_jacobian(&all);
            let rows = jacobian.rows.map(|row| core::array::from_fn(|i| row[i]));
            (pose, Jacobian { rows })
        },
        target,
        size: arm.size,
        counts: arm.counts,
    };
    let arrived = levenberg(&problem, arm.metres(&from.q), steps);
    let q = core::array::from_fn(|i| match arm.frames.slides(i) {
        true => arrived.q[i],
        false => math::wrap(arrived.q[i]),
    });
    (arrived.residual <= SOLVED * arm.size).then(|| Solution {
        singular: arrived.singular,
        ..with(from, q, arrived.residual)
    })
}

impl Univariate<'_> {
    /// How many of the six need not be at zero where so many are solved for: a turn about the
    /// tip's axis, where it is free, is one more.
    pub(super) fn moving(&self, solved: usize) -> usize {
        solved + usize::from(self.counts == Target::PositionAxis)
    }

    /// All six in the units of the arm's frames, with the joints behind the tip at zero.
    pub(super) fn lengthened<const N: usize>(&self, q: &[f64; N]) -> [f64; 6] {
        let unit = 2.0 / self.size;
        core::array::from_fn(|i| {
            let q = q.get(i).copied().unwrap_or(0.0);
            if self.frames.slides(i) { unit * q } else { q }
        })
    }

    /// The first joints, with slides in metres.
    pub(super) fn metres<const N: usize>(&self, q: &[f64; 6]) -> [f64; N] {
        let unit = 0.5 * self.size;
        core::array::from_fn(|i| {
            if self.frames.slides(i) {
                unit * q[i]
            } else {
                q[i]
            }
        })
    }
}

/// The same solution in other joint values.
pub(super) fn with<const N: usize, const M: usize>(
    solution: &Solution<N>,
    q: [f64; M],
    residual: f64,
) -> Solution<M> {
    Solution {
        q,
        residual,
        branch: solution.branch,
        singular: solution.singular,
    }
}
