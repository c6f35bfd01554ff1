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
const FEWEST: f64 = 24.0;
/// Between configurations with a joint farther apart, radians or metres, another is looked at,
/// halving ends after so many in a row, and after so many in all.
const FARTHEST: f64 = 0.2;
const DEEPEST: usize = 48;
const MOST: usize = 1024;
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

/// A configuration of a part.
struct Sample<const N: usize> {
    variable: f64,
    found: Option<(f64, [f64; N])>,
}

impl<const N: usize> Sample<N> {
    fn cost(&self) -> f64 {
        self.found.map_or(f64::INFINITY, |(cost, _)| cost)
    }
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
        let found = task.on(curve, variable).and_then(|x| {
            let q = criterion.wound(&task.q(&x), stops)?;
            is_within(&q, stops).then(|| (criterion.cost(task.robot, &q, stops), q))
        });
        Sample { variable, found }
    };
    let variables = task.spread_over(curve, &part, DENSITY, FEWEST);
    let mut samples = alloc::vec![at(part.from)];
    let mut between = 0;
    for &variable in &variables[1..] {
        // Those that are still to come, the next last.
        let mut ahead = alloc::vec![at(variable)];
        while let (Some(here), Some(next)) = (samples.last(), ahead.last()) {
            let middle = 0.5 * (here.variable + next.variable);
            let is_between = middle != here.variable && middle != next.variable;
            let is_function = is_between && !curve.is_free;
            let may_halve = is_function && ahead.len() < DEEPEST && between < MOST;
            if may_halve && are_apart(task, here, next) {
                between += 1;
                ahead.push(at(middle));
            } else {
                samples.extend(ahead.pop());
            }
        }
    }
    let costs = samples.iter().map(Sample::cost);
    let finite = costs.filter(|cost| cost.is_finite());
    let same = SAME * finite.fold(0.0, |most: f64, cost| most.max(cost.abs()));
    let last = samples.len() - 1;
    // Where all that is seen is the same, the first.
    let is_least = |&i: &usize| {
        let cost = samples[i].cost();
        let before = i == 0 || cost < samples[i - 1].cost() - same;
        before && (i == last || cost <= samples[i + 1].cost() + same) && cost.is_finite()
    };
    let refined = |i: usize| {
        let beside = [i.saturating_sub(1), (i + 1).min(last)];
        let [low, high] = beside.map(|i| samples[i].variable);
        // Where the cost jumps, at a stop, what is between the last two may be on either side.
        let mut best = at(samples[i].variable);
        let mut gain = |variable: f64| {
            let sample = at(variable);
            let cost = sample.cost();
            if cost < best.cost() {
                best = sample;
            }
            -cost
        };
        let mut section = GoldenSection::new(low, high, &mut gain);
        (0..STEPS).for_each(|_| section.step(&mut gain));
        best.found
    };
    let least = (0..=last).filter(is_least);
    least.filter_map(refined).collect()
}

/// Whether a joint goes so far from one to the other that a minimum may be between them. Full
/// turns that the limits take are no way.
fn are_apart<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
    from: &Sample<N>,
    to: &Sample<N>,
) -> bool {
    let Some(((_, from), (_, to))) = from.found.zip(to.found) else {
        return false;
    };
    let way = task.way(&task.point(&from, 0.0), &task.point(&to, 0.0));
    way.iter().any(|way| way.abs() > FARTHEST)
}
