//! Newton's method on the structure equation, from a seed.

use super::posture::{Posture, Vector6, Wrenches, back_substitute, wrenches};
use crate::linear::givens;
use crate::linear::span::Span;
use crate::linear::vector::dot;
use crate::{Pose, Twist};

/// Near the solution every step doubles the digits; far from it, or towards a
/// singular one, more are needed.
const STEPS: usize = 60;

/// Loops closed to this, relative to the mechanism's length, leave nothing to
/// improve but rounding.
const CLOSED: f64 = 1e-14;

/// Below this, relative to the mechanism's length, a step that does not halve
/// the gap is the last.
const SETTLED: f64 = 1e-12;

/// The longest step: radians, or metres by the mechanism's length.
const LONGEST: f64 = 0.6;

/// A mechanism whose loops are to be closed.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub chains: &'a [[usize; 2]],
    /// These joints keep the values that they have.
    pub actuated: &'a [usize],
    pub length: f64,
}

/// A limb of the mechanism, a chain, at one step.
pub(crate) struct Limb {
    /// The motions that its passive joints can give the platform.
    passive: Span<6>,
    /// What takes its end to the platform.
    missing: Vector6,
}

impl Limb {
    pub(crate) const NONE: Self = Self {
        passive: Span::EMPTY,
        missing: [0.0; 6],
    };
}

/// Moves the passive joints of `q` until the loops are closed, at most so many
/// steps, and tells the gap that is left, metres. `evaluate` gives the chains'
/// poses and displaced twists. The best configuration seen stays in `q`; `best`
/// has room for as many numbers, `limbs` for the chains.
pub(crate) fn close(
    task: Task,
    mut evaluate: impl FnMut(&[f64], &mut [Pose], &mut [Twist]),
    q: &mut [f64],
    best: &mut [f64],
    poses: &mut [Pose],
    twists: &mut [Twist],
    limbs: &mut [Limb],
) -> f64 {
    let mut least = f64::INFINITY;
    let mut platform = None;
    let mut idle = 0;
    for _ in 0..STEPS {
        evaluate(q, poses, twists);
        let posture = Posture {
            poses,
            twists,
            chains: task.chains,
            actuated: task.actuated,
            length: task.length,
        };
        let gap = posture.gap();
        idle = if gap < 0.5 * least { 0 } else { idle + 1 };
        if gap < least {
            least = gap;
            best.copy_from_slice(q);
        }
        if gap <= CLOSED * task.length
            || gap.is_nan()
            || (idle > 0 && least < SETTLED * task.length)
        {
            break;
        }
        let at = platform.unwrap_or(poses[0]);
        platform = Some(step(&posture, at, gap, limbs, q));
    }
    q.copy_from_slice(best);
    least
}

/// One step: of the platform, such that no chain needs an impossible motion to
/// follow, and then of every chain. The nearer the loops are to being closed,
/// the less is the platform's motion damped (Levenberg and Marquardt).
fn step(posture: &Posture, platform: Pose, gap: f64, limbs: &mut [Limb], q: &mut [f64]) -> Pose {
    for (chain, (limb, pose)) in limbs.iter_mut().zip(posture.poses).enumerate() {
        *limb = Limb {
            passive: posture.passive(chain),
            missing: posture.scaled(&(platform * pose.inverse()).log()),
        };
    }
    let passive = limbs.iter().map(|limb| &limb.passive);
    let Wrenches {
        mut r, mut tails, ..
    } = wrenches(passive, |chain, wrench| {
        [-dot(*wrench, limbs[chain].missing)]
    });
    let damping = (gap / posture.length).min(0.1);
    for i in 0..6 {
        let mut row: Vector6 = core::array::from_fn(|j| if i == j { damping } else { 0.0 });
        let (r, tails) = (r.as_flattened_mut(), tails.as_flattened_mut());
        givens::absorb(r, tails, &mut row, &mut [0.0]);
    }
    let motion = back_substitute(&r, |i| tails[i][0]);
    // Most steps are short enough; those that are not are drawn back.
    let longest = follow(posture, &motion, limbs, 1.0, q);
    let limit = if longest > LONGEST {
        LONGEST / longest
    } else {
        1.0
    };
    if limit < 1.0 {
        follow(posture, &motion, limbs, limit - 1.0, q);
    }
    Pose::exp(&posture.spatial(&motion), limit) * platform
}

/// Moves every chain's passive joints by a part of what takes its end along
/// with the platform, and tells the longest of the whole motions: radians, or
/// metres by the mechanism's length.
fn follow(posture: &Posture, motion: &Vector6, limbs: &[Limb], part: f64, q: &mut [f64]) -> f64 {
    let mut longest = motion.iter().fold(0.0, |most: f64, x| most.max(x.abs())) / posture.length;
    for (limb, [first, _]) in limbs.iter().zip(posture.chains) {
        let wanted = core::array::from_fn(|i| motion[i] + limb.missing[i]);
        limb.passive.coordinates(wanted, |j, change| {
            let turns = posture.twists[first + j].angular != [0.0; 3];
            let unit = if turns { 1.0 } else { posture.length };
            longest = longest.max(change.abs() / unit);
            q[first + j] += part * change;
        });
    }
    longest
}
