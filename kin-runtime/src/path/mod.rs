//! Along a path: the sequence of solutions that moves the joints least in total.
//!
//! Choosing the nearest solution target by target can lead into a branch that
//! ends, or to a stop a full turn later. Here all targets are known.

mod sequence;

use crate::{Kinematics, Nearest, NoSolution, Pose, Solution};
use alloc::vec::Vec;
use core::fmt;
pub use sequence::Joints;

/// Joint values that differ by less are the same, radians and metres.
const SAME: f64 = 1e-9;

/// Solutions for all targets of a path; see [`ik_path`].
#[derive(Clone, Debug, PartialEq)]
pub struct Path<const N: usize> {
    /// One for each target. Joints without stops are not wrapped: each value is
    /// that nearest to the one before.
    pub solutions: Vec<Solution<N>>,
    /// The sum of the weighted Euclidean norms of all motions, that from the
    /// seed included.
    pub motion: f64,
    /// Where branches end on the way, in the order of the targets.
    pub ends: Vec<BranchEnd>,
}

/// A branch that reaches a target of a path, and not the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BranchEnd {
    /// The last target that the branch reaches, by its place in the path.
    pub target: usize,
    /// The branch's [number](Solution::branch).
    pub branch: u32,
    /// Whether the branch goes on outside the limits.
    pub at_limits: bool,
}

/// Where a path cannot go on; see [`ik_path`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoPath<const N: usize> {
    /// The first target that cannot be reached, by its place in the path.
    pub target: usize,
    /// Why: from the seed or, beyond a step, from the configuration at the
    /// target before that took the least motion.
    pub reason: NoSolution<N>,
}

impl<const N: usize> fmt::Display for NoPath<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "target {} of the path: {}", self.target, self.reason)
    }
}

impl<const N: usize> core::error::Error for NoPath<N> {}

/// The sequence of solutions for `targets` that moves the joints least in total
/// from the seed of `nearest`, by its weights, inside its limits, no joint
/// moving further than its step from one target to the next. From the seed to
/// the first target it may: a path can have to begin a full turn away.
///
/// Angles that singular targets leave free have the values of the seed, or those of a solution
/// for the target before or behind; a joint
/// whose seed is not finite begins anywhere, and one whose stops are a thousand
/// radians apart does not look ahead for them. The time grows with the square of the
/// number of solutions, and hardly with that of full turns.
///
/// # Errors
/// Where the path cannot go on, and why.
pub fn ik_path<K: Kinematics<N>, const N: usize>(
    robot: &K,
    targets: &[Pose],
    nearest: &Nearest<N>,
) -> Result<Path<N>, NoPath<N>> {
    if !nearest.weights.iter().all(|weight| weight.is_finite()) {
        let (target, reason) = (0, NoSolution::NotFinite);
        return Err(NoPath { target, reason });
    }
    let limits = nearest.limits();
    let mut layers: Vec<Vec<Solution<N>>> = Vec::with_capacity(targets.len());
    let mut singular = Vec::new();
    let mut ends = Vec::new();
    for (target, pose) in targets.iter().enumerate() {
        let all = robot.ik_seeded(pose, &nearest.seed);
        let inside = all.within_limits(&limits).to_vec();
        if let Some(before) = layers.last() {
            let ended = branches(before).filter(|&branch| !has(&inside, branch));
            ends.extend(ended.map(|branch| BranchEnd {
                target: target - 1,
                branch,
                at_limits: has(&all, branch),
            }));
        }
        layers.push(inside);
        // A joint that is free stays where the seed has it, or where it leaves a later root one:
        // there the rest may not reach.
        if all.is_empty() || all.iter().any(|solution| solution.singular) {
            singular.push(target);
        }
    }
    let before = singular.iter().map(|&at| (at, at.checked_sub(1)));
    let behind = singular.iter().rev().map(|&at| (at, Some(at + 1)));
    for (at, beside) in before.chain(behind) {
        let beside = beside.and_then(|beside| layers.get(beside)).cloned();
        for seed in beside.into_iter().flatten() {
            let inside = robot
                .ik_seeded(&targets[at], &seed.q)
                .within_limits(&limits);
            for solution in inside.iter().filter(|solution| solution.singular) {
                if !layers[at].iter().any(|known| is_same(known, solution)) {
                    layers[at].push(*solution);
                }
            }
        }
    }
    let path = least_motion(&layers, nearest);
    let (solutions, motion) = path.map_err(|(target, seed)| NoPath {
        target,
        reason: NoSolution::of(robot, &targets[target], &nearest.from_seed(seed)),
    })?;
    Ok(Path {
        solutions,
        motion,
        ends,
    })
}

/// One of the solutions of each target, by full turns inside the limits of `nearest`, so that
/// their sequence moves least from its seed, by its weights and, from one target to the next, its
/// steps; and the sum of the norms of its motions. For arms with a free parameter, `layers` may
/// have the solutions for many values of it.
///
/// # Errors
/// The first target that none of the steps leads to, and the values of the joints
/// at the target before that took the least motion.
pub fn least_motion<const N: usize>(
    layers: &[Vec<Solution<N>>],
    nearest: &Nearest<N>,
) -> Result<(Vec<Solution<N>>, f64), (usize, [f64; N])> {
    let joints = Joints {
        limits: &nearest.limits(),
        weights: &nearest.weights,
        steps: &nearest.step,
    };
    let configurations: Vec<Vec<&[f64]>> = (layers.iter())
        .map(|layer| layer.iter().map(|solution| &solution.q[..]).collect())
        .collect();
    let least = |count: usize| {
        let found = joints.least_motion(&configurations[..count], &nearest.seed)?;
        let taken = layers.iter().zip(found.taken);
        let taken = taken.map(|(layer, (place, q))| Solution {
            q: core::array::from_fn(|i| q[i]),
            ..layer[place]
        });
        Some((taken.collect::<Vec<_>>(), found.motion))
    };
    least(layers.len()).ok_or_else(|| {
        let (mut possible, mut impossible) = (0, layers.len());
        while impossible - possible > 1 {
            let middle = possible.midpoint(impossible);
            match least(middle) {
                Some(_) => possible = middle,
                None => impossible = middle,
            }
        }
        let before = least(possible).and_then(|(taken, _)| taken.last().map(|last| last.q));
        (possible, before.unwrap_or(nearest.seed))
    })
}

fn is_same<const N: usize>(a: &Solution<N>, b: &Solution<N>) -> bool {
    (0..N).all(|i| (a.q[i] - b.q[i]).abs() < SAME)
}

/// The branches of some solutions, each once.
fn branches<const N: usize>(solutions: &[Solution<N>]) -> impl Iterator<Item = u32> {
    let first = |i: &usize| !has(&solutions[..*i], solutions[*i].branch);
    (0..solutions.len())
        .filter(first)
        .map(|i| solutions[i].branch)
}

fn has<const N: usize>(solutions: &[Solution<N>], branch: u32) -> bool {
    solutions.iter().any(|solution| solution.branch == branch)
}
