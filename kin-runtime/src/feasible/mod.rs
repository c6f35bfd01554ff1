//! Where the branches of an arm with a parameter exist: intervals of the parameter, and
//! the best configuration among them.
//!
//! The configurations that reach a target are curves. Over the parameter they fall into
//! arcs, which end where they turn back: where the other joints are singular. Where branches
//! come from square roots, those are the zeros of the roots' arguments, and all of them are found
//! (`unfold`, `zeros`). Where the parameter is a turn that the last joint makes alone, all go round
//! (`tool_axis`). Otherwise the arcs are followed from sample to sample of the parameter,
//! each sample with all of its solutions, and one between any two places where a polynomial has
//! double roots (`eliminant`, `patch` with `signs` and `halves`) or a plan nearly ceases to have
//! solutions (`suspects`); what is not carried over by tangents has to end in a fold with another
//! one that is not, and is sampled more finely until it does. Either way a branch over its interval
//! is a `curve`, which is cut where a joint crosses a limit (`limits`).

mod arcs;
mod best;
mod change;
mod chebyshev;
mod chord;
mod crossings;
mod curve;
mod eliminant;
mod false_position;
mod fold;
mod halves;
mod interpolant;
mod interval;
mod lanes;
mod limits;
mod memo;
mod patch;
mod sample;
mod signs;
mod suspects;
mod task;
mod tool_axis;
mod unfold;
mod zeros;

pub use best::Criterion;
pub use interval::FeasibleInterval;

use crate::{JointLimit, Pose, RedundantKinematics};
use alloc::vec::Vec;
use curve::{Curve, Part};
use task::Task;

/// The intervals of the parameter in which a branch of solutions exists, of all branches.
pub(crate) fn feasible<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    robot: &K,
    target: &Pose,
) -> Vec<FeasibleInterval<N>> {
    let task = Task::new(robot, target);
    match task.branches() {
        Branches::OfLanes { intervals, .. } => intervals.into_iter().map(|(_, it)| it).collect(),
        Branches::Followed(curves) => {
            let whole = |curve: &Curve| task.interval(curve, &curve.whole());
            curves.iter().filter_map(whole).collect()
        }
    }
}

/// The same as far as all joints are within their limits.
pub(crate) fn feasible_within<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    robot: &K,
    target: &Pose,
    stops: &[JointLimit; N],
) -> Vec<FeasibleInterval<N>> {
    let task = Task::new(robot, target);
    let curves = task.curves();
    let parts = parts(&task, &curves, stops);
    let wound = |(curve, part)| {
        let mut interval: FeasibleInterval<N> = task.interval(curve, &part)?;
        for (q, stop) in interval.middle.iter_mut().zip(stops) {
            *q = stop.nearest(*q, *q).unwrap_or(*q);
        }
        Some(interval)
    };
    parts.filter_map(wound).collect()
}

/// The best configuration within limits.
pub(crate) fn best<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    robot: &K,
    target: &Pose,
    stops: &[JointLimit; N],
    criterion: &Criterion<N>,
) -> Option<[f64; N]> {
    let task = Task::new(robot, target);
    let curves = task.curves();
    best::best(&task, parts(&task, &curves, stops), stops, criterion)
}

/// What of the curves is within limits.
fn parts<'a, K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    curves: &'a [Curve],
    stops: &[JointLimit; N],
) -> impl Iterator<Item = (&'a Curve, Part)> {
    let within = move |curve| {
        limits::within(task, curve, stops)
            .into_iter()
            .map(move |part| (curve, part))
    };
    curves.iter().flat_map(within)
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// All branches, of what is a target.
    fn branches(&self) -> Branches<N> {
        if !self.is_target() {
            return Branches::Followed(Vec::new());
        }
        if let Some(intervals) = self.intervals_of_lanes() {
            return Branches::OfLanes {
                intervals,
                is_free: false,
            };
        }
        let arcs = self.turned_arcs().unwrap_or_else(|| arcs::arcs(self));
        let arcs = arcs.into_iter();
        let curves = arcs.map(|arc| Curve::of_arc(self.parameter, arc));
        let curves: Vec<Curve> = curves.collect();
        match curves.is_empty() {
            // Nothing is followed where an angle is free, whatever the parameter.
            true => Branches::OfLanes {
                intervals: self.intervals_between(&self.changes()),
                is_free: true,
            },
            false => Branches::Followed(curves),
        }
    }

    fn curves(&self) -> Vec<Curve> {
        match self.branches() {
            Branches::OfLanes { intervals, is_free } => {
                let each = intervals.iter();
                each.map(|(lane, interval)| self.curve(*lane, interval, is_free))
                    .collect()
            }
            Branches::Followed(curves) => curves,
        }
    }
}

/// What is known of branches.
enum Branches<const N: usize> {
    /// Their numbers and intervals.
    OfLanes {
        intervals: Vec<(usize, FeasibleInterval<N>)>,
        /// Whether an angle is free throughout.
        is_free: bool,
    },
    /// Their curves.
    Followed(Vec<Curve>),
}
