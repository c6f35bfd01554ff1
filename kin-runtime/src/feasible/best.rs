//! The best configuration for a target.

use super::curve::{Curve, Part};
use super::limits::is_within;
use super::task::Task;
use crate::scalar::golden_section::GoldenSection;
use crate::{JointLimit, Nearest, RedundantKinematics};
use alloc::vec::Vec;

/// Configurations of a part that are looked at before the least is refined, for each
/// radian or metre of the parameter, and at least so many.
const DENSITY: f64 = 24.0;
const FEWEST: usize = 24;
/// Golden-section steps: the variable to the square root of rounding.
const STEPS: usize = 40;
/// Costs that differ by less, relative to the largest, are the same.
const SAME: f64 = 1e-12;

/// What makes a configuration better than another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Criterion<const N: usize> {
    /// The nearest to joint values: least Euclidean norm of the ways within the limits,
    /// radians and metres.
    Nearest([f64; N]),
    /// The farthest from limits: the joint that is nearest to a stop, as a share of half
    /// of its travel, is as far from it as can be.
    FarthestFromLimits,
    /// The largest manipulability: the volume of the ellipsoid of velocities.
    Manipulability,
}

impl<const N: usize> Criterion<N> {
    /// What is to be small; `q` is wound to lie within the limits.
    pub(crate) fn cost<K: RedundantKinematics<N> + ?Sized>(
        &self,
        robot: &K,
        q: &[f64; N],
        stops: &[JointLimit; N],
    ) -> f64 {
        match self {
            Criterion::Nearest(seed) => (0..N).map(|i| (q[i] - seed[i]) * (q[i] - seed[i])).sum(),
            Criterion::FarthestFromLimits => (0..N).fold(0.0, |most: f64, i| {
                let (lower, upper) = (stops[i].lower(), stops[i].upper());
                let half = 0.5 * (upper - lower);
                let off = (q[i] - 0.5 * (lower + upper)).abs() / half;
                if half.is_finite() {
                    most.max(off)
                } else {
                    most
                }
            }),
            Criterion::Manipulability => -robot.manipulability(q).volume,
        }
    }

    /// The configuration wound inside the limits, as the criterion likes it; none if it
    /// is outside.
    pub(crate) fn wound(&self, q: &[f64; N], stops: &[JointLimit; N]) -> Option<[f64; N]> {
        let mut wound = *q;
        for i in 0..N {
            let (lower, upper) = (stops[i].lower(), stops[i].upper());
            let near = match self {
                Criterion::Nearest(seed) => seed[i],
                _ if (upper - lower).is_finite() => 0.5 * (lower + upper),
                _ => q[i],
            };
            wound[i] = stops[i].nearest(q[i], near)?;
        }
        Some(wound)
    }
}

/// The best configuration on parts of curves.
pub(super) fn best<'a, K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    parts: impl Iterator<Item = (&'a Curve, Part)>,
    stops: &[JointLimit; N],
    criterion: &Criterion<N>,
) -> Option<[f64; N]> {
    let mut best: Option<(f64, [f64; N])> = None;
    for (curve, part) in parts {
        for (cost, q) in candidates(task, curve, part, stops, criterion) {
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, q));
            }
        }
    }
    let seeded = seeded(task, stops, criterion);
    best.into_iter()
        .chain(seeded)
        .min_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, q)| q)
}

/// What is nearest with the parameter of a seed, with its angle where a singular target leaves one
/// free.
fn seeded<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    stops: &[JointLimit; N],
    criterion: &Criterion<N>,
) -> Option<(f64, [f64; N])> {
    let Criterion::Nearest(seed) = criterion else {
        return None;
    };
    let parameter = task.robot.parameter_of(task.target, seed);
    let solutions = task.robot.ik_seeded_at(task.target, parameter, seed);
    let q = solutions.nearest_by(&Nearest::new(*seed, stops))?.q;
    Some((criterion.cost(task.robot, &q, stops), q))
}

/// The minima of a part.
fn candidates<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    curve: &Curve,
    part: Part,
    stops: &[JointLimit; N],
    criterion: &Criterion<N>,
) -> Vec<(f64, [f64; N])> {
    let at = |variable: f64| {
        let q = task.q(&task.on(curve, curve.parameter(variable))?);
        let q = criterion.wound(&q, stops).filter(|q| is_within(q, stops))?;
        Some((criterion.cost(task.robot, &q, stops), q))
    };
    let cost = |variable: f64| at(variable).map_or(f64::INFINITY, |(cost, _)| cost);
    let count = FEWEST.max((curve.length(&part) * DENSITY) as usize);
    let variable = |i: usize| part.from + (part.to - part.from) * i as f64 / count as f64;
    let costs: Vec<f64> = (0..=count).map(|i| cost(variable(i))).collect();
    let finite = costs.iter().filter(|cost| cost.is_finite());
    let same = SAME * finite.fold(0.0, |most: f64, cost| most.max(cost.abs()));
    // Where all that is seen is the same, the first.
    let is_least = |&i: &usize| {
        let before = i == 0 || costs[i] < costs[i - 1] - same;
        before && (i == count || costs[i] <= costs[i + 1] + same) && costs[i].is_finite()
    };
    let refined = |i: usize| {
        let beside = [i.saturating_sub(1), (i + 1).min(count)];
        let [low, high] = beside.map(variable);
        // Where the cost jumps, at a stop, what is between the last two may be on either side.
        let mut best = at(variable(i));
        let mut gain = |variable: f64| {
            let found = at(variable);
            let cost = found.map_or(f64::INFINITY, |(cost, _)| cost);
            if best.is_none_or(|(least, _)| cost < least) {
                best = found.or(best);
            }
            -cost
        };
        let mut section = GoldenSection::new(low, high, &mut gain);
        (0..STEPS).for_each(|_| section.step(&mut gain));
        best
    };
    let least = (0..=count).filter(is_least);
    least.filter_map(refined).collect()
}
