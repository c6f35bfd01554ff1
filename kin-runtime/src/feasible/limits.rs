//! Parts of a curve on which all joints are within their limits.

use super::change::change;
use super::crossings::Bound;
use super::curve::{By, Curve, Part};
use super::interpolant::Cosines;
use super::lanes::AMID;
use super::memo::Memo;
use super::task::Task;
use super::zeros::zeros;
use crate::{JointLimit, RedundantKinematics, math};
use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

/// Pieces of a curve to begin with.
const PIECES: usize = 4;
/// Samples of a curve on which an angle is free throughout, and halvings between two of them.
const SAMPLES: usize = 48;
const HALVINGS: usize = 32;
/// How far beyond a bound a joint crosses it, less than what still counts as resting on it: one
/// that rests there crosses nothing.
const BEYOND: f64 = 0.1 * JointLimit::TOLERANCE;
/// How near two stops are that leave a single value between them, radians or metres.
const NARROW: f64 = 1e-8;
/// A range of turns below this has two ends that are looked for one by one, to both sides of its middle.
const APART: f64 = 0.1;
/// Parts that are nearer to each other are one: at a single value, an angle that is free may be
/// told beyond a limit.
const SAME: f64 = 1e-9;

/// The parts on which every joint is within its limits, or can be by full turns.
pub(super) fn within<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    curve: &Curve,
    stops: &[JointLimit; N],
) -> Vec<Part> {
    let inside = |variable: f64| {
        let point = task.on(curve, variable);
        point.is_some_and(|x| is_within(&task.q(&x), stops))
    };
    let whole = curve.whole();
    let mut ends = alloc::vec![whole.from];
    ends.extend(match &curve.by {
        By::Plan { .. } if curve.is_free => changes(&inside, &whole),
        By::Plan { .. } => crossings(task, curve, stops),
        By::Points(arc) => task.crossings(arc, &bounds(task, stops)),
    });
    ends.push(whole.to);
    ends.sort_by(f64::total_cmp);
    let mut parts: Vec<Part> = Vec::new();
    let mut add = |from: f64, to: f64| match parts.last_mut() {
        Some(part) if from - part.to < SAME => part.to = to,
        _ => parts.push(Part {
            from,
            to,
            is_closed: false,
        }),
    };
    let is_narrow = stops.iter().any(|&stop| is_narrow(stop));
    for pair in ends.windows(2).filter(|pair| pair[0] < pair[1]) {
        if inside(pair[0] + AMID * (pair[1] - pair[0])) {
            add(pair[0], pair[1]);
        } else if is_narrow && inside(pair[1]) {
            add(pair[1], pair[1]);
        }
    }
    if curve.is_closed {
        join_round(&mut parts, &whole);
    }
    parts
}

/// Where samples and halving between them find the other side of a limit: joint values that may be
/// anything are no functions.
fn changes(inside: &dyn Fn(f64) -> bool, whole: &Part) -> Vec<f64> {
    let at = |i: usize| whole.from + (whole.to - whole.from) * i as f64 / SAMPLES as f64;
    let samples: Vec<(f64, bool)> = (0..=SAMPLES).map(|i| (at(i), inside(at(i)))).collect();
    let changed = samples.windows(2).filter(|pair| pair[0].1 != pair[1].1);
    let halved = |pair: &[(f64, bool)]| {
        let [(low, before), (high, _)] = [pair[0], pair[1]];
        change([low, high], HALVINGS, |value| inside(value) == before)
    };
    changed.map(halved).collect()
}

/// Of a closed curve, the last part goes on as the first if both reach where it was cut.
fn join_round(parts: &mut Vec<Part>, whole: &Part) {
    let reaches = |part: Option<&Part>, end: fn(&Part) -> f64| {
        part.is_some_and(|part| end(part) == end(whole))
    };
    if !(reaches(parts.first(), |part| part.from) && reaches(parts.last(), |part| part.to)) {
        return;
    }
    if let [all] = &mut parts[..] {
        all.is_closed = true;
        return;
    }
    let head = parts.remove(0);
    if let Some(tail) = parts.last_mut() {
        tail.to += head.to - head.from;
    }
}

/// Whether joint values are within limits, angles by full turns.
pub(super) fn is_within<const N: usize>(q: &[f64; N], stops: &[JointLimit; N]) -> bool {
    (0..N).all(|i| stops[i].nearest(q[i], q[i]).is_some())
}

/// Whether limits leave a joint a single value, to what can be told apart.
fn is_narrow(stop: JointLimit) -> bool {
    stop.upper() - stop.lower() < NARROW
}

/// Values at which joints enter their limits or leave them, or the one that is all they may have.
fn bounds<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    stops: &[JointLimit; N],
) -> Vec<Bound> {
    let of_coordinate = |(coordinate, &joint): (usize, &usize)| {
        let stop = stops[joint];
        let (lower, upper) = (stop.lower() - BEYOND, stop.upper() + BEYOND);
        let is_all = task.turns(coordinate) && upper - lower >= TAU;
        let values = match is_narrow(stop) {
            true => [0.5 * (lower + upper), f64::NAN],
            false => [lower, upper],
        };
        let bounded = values
            .into_iter()
            .filter(move |value| value.is_finite() && !is_all);
        bounded.map(move |value| Bound { coordinate, value })
    };
    let moving = task.moving().iter().enumerate();
    moving.flat_map(of_coordinate).collect()
}

/// Where a branch of the plan crosses them.
fn crossings<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    curve: &Curve,
    stops: &[JointLimit; N],
) -> Vec<f64> {
    let known = Memo::new();
    let at = |variable: f64| known.at(variable, || task.on(curve, variable));
    let cosines = Cosines::new();
    let whole = curve.whole();
    let mut found = Vec::new();
    for (joint, stop) in stops.iter().enumerate() {
        let (lower, upper) = (stop.lower() - BEYOND, stop.upper() + BEYOND);
        let (middle, half) = (0.5 * (lower + upper), 0.5 * (upper - lower));
        let turns = task.limits[joint].is_revolute();
        // By full turns it is always within.
        if turns && half >= PI || lower == f64::NEG_INFINITY && upper == f64::INFINITY {
            continue;
        }
        let mut cross = |side: &dyn Fn(f64) -> f64| {
            // Where there is no solution it crosses nothing.
            let f = |variable: f64| at(variable).map_or(1.0, |x| side(task.q(&x)[joint]));
            found.extend(zeros(&cosines, &f, whole.from, whole.to, PIECES).crossing);
        };
        if turns && half > APART {
            // Steady where the angle wraps.
            let least = math::sin_cos(half).1;
            cross(&|q| math::sin_cos(q - middle).1 - least);
            continue;
        }
        // Between two bounds that are near each other a joint is so shortly that no sample sees it.
        let bounds = match is_narrow(*stop) {
            true => [middle, f64::NAN],
            false => [lower, upper],
        };
        for bound in bounds.into_iter().filter(|bound| bound.is_finite()) {
            match turns {
                // Also half a turn away, where it crosses nothing that counts.
                true => cross(&|q| math::sin_cos(q - bound).0),
                // A slide may run to infinity along the parameter.
                false => cross(&|q| bounded(q - bound)),
            }
        }
    }
    found
}

/// A number between −1 and 1 that is zero where `x` is.
fn bounded(x: f64) -> f64 {
    x / math::sqrt(1.0 + x * x)
}
