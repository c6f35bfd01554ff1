//! Along the curve, in one direction.

use super::fixed_tip::FixedTip;
use super::options::Stop;
use crate::Kinematics;
use crate::continuation::{Cut, along};
use crate::linear::vector::{dot, norm};
use alloc::vec::Vec;

/// The sharpest bend in one step: the cosine between tangents, and how far the
/// correction may lead from the prediction, relative to the step. A curve that
/// bends so stays within a tenth of the step from its chord.
const BEND: f64 = 0.98;
const CORRECTION: f64 = 0.1;
/// Steps lead no further than this part of the way to where the curve may meet
/// another, so that the trace does not change over to one that passes close by.
const CAUTION: f64 = 0.5;
/// Steps shorter than this part of the longest are not taken: there is a
/// crossing.
const SHORTEST: f64 = 1e-6;

/// Why a trace ended.
pub(super) enum Ending {
    /// Back at the start.
    Closed,
    Stopped(Stop),
}

/// Follows the curve from `start`; the path begins behind it.
pub(super) fn trace<K: Kinematics<N>, const N: usize>(
    arm: &FixedTip<K, N>,
    start: &[f64; N],
    direction: &[f64; N],
) -> (Vec<[f64; N]>, Ending) {
    let mut path = Vec::new();
    let mut here = Place {
        q: *start,
        tangent: *direction,
        reach: arm.internal(start).reach,
    };
    let mut step = arm.options.step;
    while path.len() < arm.options.most_steps {
        let Some(next) = advance(arm, &here, &mut step) else {
            return (path, Ending::Stopped(Stop::Singular));
        };
        if let Some(joint) = arm.beyond(&next.q) {
            let (stop, at) = stop(arm, &here.q, &next.q, joint);
            path.extend(at);
            return (path, Ending::Stopped(stop));
        }
        let arrives = dot(next.tangent, *direction) > 0.0 && !path.is_empty();
        if let Some(end) = arrives
            .then(|| passes(arm, &here.q, &next.q, start))
            .flatten()
        {
            path.push(end);
            return (path, Ending::Closed);
        }
        path.push(next.q);
        here = next;
    }
    (path, Ending::Stopped(Stop::Unfinished))
}

/// A point of the curve.
struct Place<const N: usize> {
    q: [f64; N],
    /// Where the trace goes.
    tangent: [f64; N],
    /// As [`Internal::reach`](super::fixed_tip::Internal::reach).
    reach: f64,
}

/// One step; `step` is shortened until the curve bends little, and lengthened
/// again where it hardly does. None at a crossing.
fn advance<K: Kinematics<N>, const N: usize>(
    arm: &FixedTip<K, N>,
    here: &Place<N>,
    step: &mut f64,
) -> Option<Place<N>> {
    *step = step.min(CAUTION * here.reach);
    while *step > SHORTEST * arm.options.step {
        let point = along(&here.q, &here.tangent, *step);
        let cut = Cut {
            normal: here.tangent,
            point,
        };
        if let Some(q) = arm.meet(&cut, point) {
            let correction = norm(along(&q, &point, -1.0)) / *step;
            let internal = arm.internal(&q);
            let cosine = dot(internal.tangent, here.tangent);
            let bends_little = cosine.abs() > BEND && correction < CORRECTION;
            if internal.dimension == 1 && bends_little {
                *step = (1.5 * *step).min(arm.options.step);
                return Some(Place {
                    q,
                    tangent: internal.tangent.map(|x| if cosine < 0.0 { -x } else { x }),
                    reach: internal.reach,
                });
            }
        }
        *step *= 0.5;
    }
    None
}

/// Whether the curve goes through a posture between two of its points; if so,
/// that posture with the turns that its angles have there.
pub(super) fn passes<K: Kinematics<N>, const N: usize>(
    arm: &FixedTip<K, N>,
    from: &[f64; N],
    to: &[f64; N],
    posture: &[f64; N],
) -> Option<[f64; N]> {
    /// How exactly, radians and metres.
    const SAME: f64 = 1e-7;
    let chord = along(to, from, -1.0);
    let way = arm.way(from, posture);
    let chord_length = norm(chord);
    // Of what stops where it begins.
    if chord_length == 0.0 {
        return (norm(way) <= SAME).then(|| along(from, &way, 1.0));
    }
    let share = dot(way, chord) / (chord_length * chord_length);
    let aside = norm(along(&way, &chord, -share)) / chord_length;
    let ends = SAME / chord_length;
    if !(-ends..=1.0 + ends).contains(&share) || aside > CORRECTION {
        return None;
    }
    let here = along(from, &way, 1.0);
    let cut = Cut {
        normal: chord.map(|x| x / chord_length),
        point: here,
    };
    let met = arm.meet(&cut, along(from, &chord, share))?;
    (norm(along(&met, &here, -1.0)) <= SAME).then_some(here)
}

/// Where the first joint comes to a limit on the way from `from` to `to`.
fn stop<K: Kinematics<N>, const N: usize>(
    arm: &FixedTip<K, N>,
    from: &[f64; N],
    to: &[f64; N],
    joint: usize,
) -> (Stop, Option<[f64; N]>) {
    let Some(limits) = arm.options.limits else {
        return (Stop::Limit { joint }, None);
    };
    let (mut end, mut joint) = (*to, joint);
    // Another joint may have come to its limit before.
    for _ in 0..N {
        let bound = end[joint]
            .max(limits[joint].lower())
            .min(limits[joint].upper());
        let share = (bound - from[joint]) / (end[joint] - from[joint]);
        let guess = along(from, &along(&end, from, -1.0), share);
        let Some(met) = arm.meet(&Cut::at(joint, bound), guess) else {
            break;
        };
        end = met;
        match arm.beyond(&end) {
            Some(other) => joint = other,
            None => return (Stop::Limit { joint }, Some(end)),
        }
    }
    (Stop::Limit { joint }, None)
}
