//! Along a path of targets with a joint to spare.

use crate::generated::refinement::{Problem, levenberg};
use crate::{JointLimit, Nearest, Parameter, Pose, RedundantKinematics, Solution, Target, math};

/// How to go on along a path; see [`RedundantKinematics::ik_follow`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Follow<const N: usize> {
    /// Which solutions count, radians and metres.
    pub limits: [JointLimit; N],
    /// By how much every joint may move in one step, radians and metres; what moves more
    /// is a jump.
    pub step: [f64; N],
    /// By how much the parameter may move in one step, radians or metres, beyond what the
    /// target itself takes.
    pub rate: f64,
}

/// The next configuration of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathStep<const N: usize> {
    /// The solution for the target that was asked for, wound to lie within the limits.
    pub solution: Solution<N>,
    /// Its parameter, radians or metres.
    pub parameter: f64,
    /// Whether a joint moves by more than a step: the branch that was followed ends here, or
    /// leaves the limits, and this is the nearest of another one.
    pub jumps: bool,
}

/// Half the width of the central difference by which the slope of the cost is found, as a share of
/// the rate; the second is its lower bound, radians or metres.
const PROBE: f64 = 0.5;
const SHORTEST_PROBE: f64 = 1e-5;
/// The slope at which the parameter moves by half the rate.
const GENTLE: f64 = 0.2;
/// Evaluations of Levenberg's method at most, and metres that count as a radian.
const STEPS: usize = 12;
const SIZE: f64 = 1.0;
/// How often the method runs at most, and how far inside of the end of what it may move a joint is held, radians
/// and metres: others are known to less.
const RUNS: usize = 3;
const INSIDE: f64 = 1e-8;
/// Keeps the cost of a joint at its limit finite.
const ROOM: f64 = 1.02;

impl<const N: usize> Follow<N> {
    /// Within limits, with steps of every length, and so much of the parameter in one step.
    pub fn new(limits: &[JointLimit; N], rate: f64) -> Self {
        Follow {
            limits: *limits,
            step: [f64::INFINITY; N],
            rate,
        }
    }

    /// How near joint values are to their limits: Σ u² / (1.02 − u²), where u is ±1 at the
    /// stops, or beyond them, and 0 midway. A joint without two stops adds nothing.
    pub fn crowding(&self, q: &[f64; N]) -> f64 {
        let mut sum = 0.0;
        for (value, limit) in q.iter().zip(&self.limits) {
            let (lower, upper) = (limit.lower(), limit.upper());
            let travel = upper - lower;
            if travel.is_finite() && travel > 0.0 {
                let u = ((2.0 * value - lower - upper) / travel).clamp(-1.0, 1.0);
                sum += u * u / (ROOM - u * u);
            }
        }
        sum
    }
}

/// See [`RedundantKinematics::ik_follow`].
pub(super) fn follow<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    robot: &K,
    target: &Pose,
    from: &[f64; N],
    follow: &Follow<N>,
) -> Option<PathStep<N>> {
    let nearest = Nearest::new(*from, &follow.limits);
    // One by steps, if there is one.
    let mut by_steps = nearest;
    by_steps.step = follow.step;
    let at = |parameter: f64| {
        let all = robot.ik_seeded_at(target, parameter, from);
        let solution = all.nearest_by(&by_steps);
        let solution = solution.or_else(|| all.nearest_by(&nearest))?;
        let moves = |i: usize| (solution.q[i] - from[i]).abs() > follow.step[i];
        Some(PathStep {
            parameter: robot.parameter_of(target, &solution.q),
            jumps: (0..N).any(moves),
            solution,
        })
    };
    let smooth = |parameter: f64| at(parameter).filter(|step| !step.jumps);
    let own = robot.parameter_of(target, from);
    // Downhill, by the slope between two probes; away from the end of a branch, where one
    // of them finds nothing.
    let probe = (PROBE * follow.rate).max(SHORTEST_PROBE);
    let [below, above] = [own - probe, own + probe].map(smooth);
    let cost = |step: &PathStep<N>| follow.crowding(&step.solution.q);
    let wanted = match (&below, &above) {
        (Some(below), Some(above)) => {
            let slope = (cost(above) - cost(below)) / (2.0 * probe);
            -follow.rate * slope / (slope.abs() + GENTLE)
        }
        (Some(_), None) => -follow.rate,
        (None, Some(_)) => follow.rate,
        (None, None) => 0.0,
    };
    let tries = [own + wanted, own, own - follow.rate, own + follow.rate];
    // What a probe found counts if the parameter may move so far.
    let [below, above] = [below, above].map(|it| it.filter(|_| probe <= follow.rate));
    let goes_on = tries.into_iter().find_map(smooth).or(below).or(above);
    // Next to a stop or to a singularity few values leave the other joints where they may be.
    let goes_on = goes_on.or_else(|| {
        let parameter = robot.parameter_of(target, &led(robot, target, from, follow));
        let by = match robot.parameter() {
            Parameter::Joint(joint) if !follow.limits[joint].is_revolute() => parameter - own,
            _ => math::wrap(parameter - own),
        };
        let is_near = by.abs() <= follow.rate;
        is_near.then(|| smooth(parameter)).flatten()
    });
    goes_on.or_else(|| at(own))
}

/// Where Levenberg's method leads within limits and steps, whatever becomes of the parameter: a joint that
/// it takes farther is held at the end, and the others go on from there.
#[cold]
fn led<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    robot: &K,
    target: &Pose,
    from: &[f64; N],
    follow: &Follow<N>,
) -> [f64; N] {
    let mut held = robot.held();
    let turn = robot.held_turn();
    let ends: [[f64; 2]; N] = core::array::from_fn(|i| {
        let step = match robot.parameter() {
            Parameter::Joint(joint) if joint == i => follow.step[i].min(follow.rate),
            _ => follow.step[i],
        };
        let limit = follow.limits[i];
        [
            limit.lower().max(from[i] - step),
            limit.upper().min(from[i] + step),
        ]
    });
    let beyond = |q: &[f64; N], i: usize| (ends[i][0] - q[i]).max(q[i] - ends[i][1]);
    let mut q = *from;
    for _ in 0..RUNS {
        q = core::array::from_fn(|i| held[i].unwrap_or(q[i]));
        let fk_jacobian = |q: &[f64; N]| {
            let (pose, mut jacobian) = robot.fk_jacobian(q);
            for row in &mut jacobian.rows {
                *row = core::array::from_fn(|i| held[i].map_or(row[i], |_| 0.0));
            }
            (pose, jacobian)
        };
        let problem = Problem {
            fk_jacobian,
            target: &turn.map_or(*target, |turn| target.turned(turn)),
            size: SIZE,
            counts: turn.map_or(robot.own_target(), |_| Target::Pose),
        };
        q = levenberg(&problem, q, STEPS).q;
        let free = (0..N).filter(|&i| held[i].is_none());
        let farthest = free.reduce(|a, b| if beyond(&q, b) > beyond(&q, a) { b } else { a });
        match farthest {
            Some(i) if beyond(&q, i) > 0.0 => {
                let [lower, upper] = [ends[i][0] + INSIDE, ends[i][1] - INSIDE];
                held = robot.held();
                held[i] = Some(q[i].max(lower).min(upper));
            }
            _ => break,
        }
    }
    q
}
