//! Arcs as far as all joints are within their limits.

use super::arcs::Arc;
use super::task::{Point, Task, along};
use crate::{JointLimit, RedundantKinematics, math};
use alloc::vec::Vec;

/// A joint that comes nearer to a bound than this by less than a quarter turn crosses it.
const NEAR: f64 = 1.6;
/// Ends nearer than this are one.
const SAME: f64 = 1e-12;

/// The parts of an arc on which every joint is within its limits, or can be by full turns.
pub(super) fn within<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    arc: &Arc,
    stops: &[JointLimit; N],
) -> Vec<Arc> {
    let parameter = task.parameter;
    let points = monotone(task, arc);
    let mut crossings: Vec<Point> = Vec::new();
    for (joint, stop) in stops.iter().enumerate() {
        for bound in [stop.lower(), stop.upper()] {
            if bound.is_finite() {
                crossings.extend(cross(task, &points, joint, bound));
            }
        }
    }
    crossings.sort_by(|a, b| a[parameter].total_cmp(&b[parameter]));
    let mut ends: Vec<Point> = Vec::new();
    ends.extend(points.first());
    ends.extend(crossings);
    ends.extend(points.last());
    ends.dedup_by(|a, b| a[parameter] - b[parameter] < SAME);
    let inside = |from: &Point, to: &Point| {
        let middle = 0.5 * (from[parameter] + to[parameter]);
        let middle = task.on(arc, middle);
        middle.is_some_and(|x| is_within(&task.q(&x), stops))
    };
    let mut parts: Vec<Arc> = Vec::new();
    let mut goes_on = false;
    for pair in ends.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if !inside(&from, &to) {
            goes_on = false;
            continue;
        }
        let between = points.iter().filter(|x| {
            let value = x[parameter];
            from[parameter] < value && value < to[parameter]
        });
        let piece = between.copied().chain([to]);
        match parts.last_mut().filter(|_| goes_on) {
            Some(part) => part.points.extend(piece),
            None => parts.push(Arc {
                points: core::iter::once(from).chain(piece).collect(),
                is_closed: false,
            }),
        }
        goes_on = true;
    }
    let whole = parts.len() == 1 && ends.len() >= 2 && {
        let all = &parts[0].points;
        all.first() == ends.first() && all.last() == ends.last()
    };
    if whole {
        parts[0].is_closed = arc.is_closed;
    } else if arc.is_closed && parts.len() > 1 {
        join_round(&mut parts, &ends, parameter);
    }
    parts
}

/// Of a closed arc, the last part goes on as the first if both reach where it was cut.
fn join_round(parts: &mut Vec<Arc>, ends: &[Point], parameter: usize) {
    let reaches_start = parts[0].points.first() == ends.first();
    let reaches_end = parts.last().and_then(|part| part.points.last()) == ends.last();
    if !(reaches_start && reaches_end) {
        return;
    }
    let Some([first, last]) = ends.first().zip(ends.last()).map(|(a, b)| [a, b]) else {
        return;
    };
    let round = last[parameter] - first[parameter];
    let head = parts.remove(0);
    if let Some(tail) = parts.last_mut() {
        tail.points
            .extend(head.points.into_iter().skip(1).map(|mut x| {
                x[parameter] += round;
                x
            }));
    }
}

/// Whether joint values are within limits, angles by full turns.
pub(super) fn is_within<const N: usize>(q: &[f64; N], stops: &[JointLimit; N]) -> bool {
    (0..N).all(|i| stops[i].nearest(q[i], q[i]).is_some())
}

/// The points of an arc, and between them those where a joint turns back.
fn monotone<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    arc: &Arc,
) -> Vec<Point> {
    let parameter = task.parameter;
    let mut points: Vec<Point> = Vec::new();
    for pair in arc.points.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        points.push(from);
        let (Some(a), Some(b)) = (task.place(from), task.place(to)) else {
            continue;
        };
        // In a fold the parameter's sense is not told by the tangent: by the way it is.
        let way = task.way(&from, &to);
        let sense = |tangent: &Point| {
            let along: f64 = way.iter().zip(tangent).map(|(x, y)| x * y).sum();
            tangent.map(|t| t * 1.0_f64.copysign(along))
        };
        let (u, v) = (sense(&a.tangent), sense(&b.tangent));
        let mut turning: Vec<Point> = (0..N)
            .filter(|&joint| joint != parameter && u[joint] * v[joint] < 0.0)
            .filter_map(|joint| {
                let start = super::task::Place {
                    x: from,
                    tangent: u,
                };
                let point = task.extremum(joint, &start, 1.0)?;
                let inside = from[parameter] < point[parameter] && point[parameter] < to[parameter];
                inside.then_some(point)
            })
            .collect();
        turning.sort_by(|a, b| a[parameter].total_cmp(&b[parameter]));
        points.extend(turning);
    }
    points.extend(arc.points.last());
    points
}

/// Where a joint crosses a bound, between points that no joint turns back between.
fn cross<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    points: &[Point],
    joint: usize,
    bound: f64,
) -> Vec<Point> {
    let off = |x: &Point| match task.turns(joint) {
        true => math::wrap(x[joint] - bound),
        false => x[joint] - bound,
    };
    let mut found = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (off(&pair[0]), off(&pair[1]));
        let crosses = a * b <= 0.0 && (!task.turns(joint) || (a - b).abs() < NEAR);
        if !crosses || a == b {
            continue;
        }
        let way = task.way(&pair[0], &pair[1]);
        let guess = along(&pair[0], &way, a / (a - b));
        let value = pair[0][joint] - a;
        found.extend(task.meet_at(joint, value, guess));
    }
    found
}
