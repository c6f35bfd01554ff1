//! Along a path: the sequence of solutions that moves the joints least in total.
//!
//! Choosing the nearest solution target by target can lead into a branch that
//! ends, or to a stop a full turn later. Here all targets are known, and the
//! sequence is found by dynamic programming (R. Bellman, *Dynamic Programming*,
//! 1957) over all branches and all full turns inside the limits.

use crate::{JointLimit, Kinematics, Nearest, NoSolution, Pose, Solution, math};
use alloc::vec::Vec;

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

/// The sequence of solutions for `targets` that moves the joints least in total
/// from the seed of `nearest`, by its weights, inside its limits, no joint
/// moving further than its step from one target to the next. From the seed to
/// the first target it may: a path can have to begin a full turn away.
///
/// Angles that singular targets leave free have the values of the seed. The time
/// grows with the square of the number of solutions with full turns: one to two
/// milliseconds for a target of an arm of six joints that have two turns each,
/// some ten microseconds where they have one.
///
/// # Errors
/// Where the path cannot go on, and why.
pub fn ik_path<K: Kinematics<N>, const N: usize>(
    robot: &K,
    targets: &[Pose],
    nearest: &Nearest<N>,
) -> Result<Path<N>, NoPath<N>> {
    let limits = nearest.limits();
    let mut layers: Vec<Vec<Solution<N>>> = Vec::with_capacity(targets.len());
    let mut ends = Vec::new();
    for (target, pose) in targets.iter().enumerate() {
        let all = robot.ik_seeded(pose, &nearest.seed);
        let inside: Vec<Solution<N>> = all.with_full_turns(&limits).collect();
        if let Some(before) = layers.last() {
            let ended = branches(before).filter(|&branch| !has(&inside, branch));
            ends.extend(ended.map(|branch| BranchEnd {
                target: target - 1,
                branch,
                at_limits: has(&all, branch),
            }));
        }
        layers.push(inside);
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

/// One of the solutions of each target, which come with all full turns that are
/// allowed, so that their sequence moves least from the seed of `nearest`, by its
/// weights and, from one target to the next, its steps; and the sum of the norms of its motions. For arms with a
/// free parameter, `layers` may have the solutions for many values of it.
///
/// # Errors
/// The first target that none of the steps leads to, and the values of the joints
/// at the target before that took the least motion.
pub fn least_motion<const N: usize>(
    layers: &[Vec<Solution<N>>],
    nearest: &Nearest<N>,
) -> Result<(Vec<Solution<N>>, f64), (usize, [f64; N])> {
    // By target the way to every solution: what it took, and from where.
    let mut ways: Vec<Vec<Way>> = Vec::with_capacity(layers.len());
    for (target, layer) in layers.iter().enumerate() {
        let before = match target {
            0 => alloc::vec![(0.0, 0, nearest.seed)],
            _ => reached(&ways[target - 1], &layers[target - 1]),
        };
        let mut nearest = *nearest;
        if target == 0 {
            nearest.step = [f64::INFINITY; N];
        }
        let way = |solution: &Solution<N>| shortest(&before, &solution.q, &nearest);
        let here: Vec<Way> = layer.iter().map(way).collect();
        if here.iter().all(|way| way.motion == f64::INFINITY) {
            return Err((target, before[0].2));
        }
        ways.push(here);
    }
    let Some(last) = ways.last() else {
        return Ok((Vec::new(), 0.0));
    };
    let ends = last.iter().enumerate();
    let end = ends.min_by(|a, b| a.1.motion.total_cmp(&b.1.motion));
    let (mut place, motion) = end.map_or((0, 0.0), |(i, way)| (i, way.motion));
    let mut solutions: Vec<Solution<N>> = Vec::with_capacity(layers.len());
    for (layer, ways) in layers.iter().zip(&ways).rev() {
        solutions.push(layer[place]);
        place = ways[place].from;
    }
    solutions.reverse();
    let mut from = nearest.seed;
    for solution in &mut solutions {
        for i in 0..N {
            solution.q[i] = nearest.endless(i, solution.q[i], from[i]);
        }
        from = solution.q;
    }
    Ok((solutions, motion))
}

/// The best way to a solution.
#[derive(Clone, Copy)]
struct Way {
    /// Infinite if there is none.
    motion: f64,
    /// The solution of the target before.
    from: usize,
}

/// What a target is reached by: motion so far, place and joint values, the least
/// motion first.
fn reached<const N: usize>(ways: &[Way], layer: &[Solution<N>]) -> Vec<(f64, usize, [f64; N])> {
    let all = ways.iter().zip(layer).enumerate();
    let mut reached: Vec<_> = all
        .filter(|(_, (way, _))| way.motion < f64::INFINITY)
        .map(|(place, (way, solution))| (way.motion, place, solution.q))
        .collect();
    reached.sort_by(|a, b| a.0.total_cmp(&b.0));
    reached
}

fn shortest<const N: usize>(
    before: &[(f64, usize, [f64; N])],
    q: &[f64; N],
    nearest: &Nearest<N>,
) -> Way {
    let mut best = Way {
        motion: f64::INFINITY,
        from: 0,
    };
    for (motion, place, from) in before {
        // Those behind have taken more already.
        if *motion >= best.motion {
            break;
        }
        let total = motion + distance(from, q, nearest);
        if total < best.motion {
            best = Way {
                motion: total,
                from: *place,
            };
        }
    }
    best
}

/// The weighted norm of a motion; infinite where a step is too long.
fn distance<const N: usize>(from: &[f64; N], q: &[f64; N], nearest: &Nearest<N>) -> f64 {
    let mut square = 0.0;
    for i in 0..N {
        let by = nearest.endless(i, q[i], from[i]) - from[i];
        if by.abs() > nearest.step[i] + JointLimit::TOLERANCE {
            return f64::INFINITY;
        }
        square += (nearest.weights[i] * by) * (nearest.weights[i] * by);
    }
    math::sqrt(square)
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
