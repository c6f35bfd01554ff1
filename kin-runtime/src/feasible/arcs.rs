//! From samples to arcs.

use super::sample::Sample;
use super::task::{Place, Task};
use crate::linear::vector::norm;
use crate::{Parameter, RedundantKinematics};
use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

/// Samples of a turn, or of a slide's travel, to begin with.
const SAMPLES: usize = 64;
/// The first is no multiple of a quarter turn, and neither are the others: there arms are
/// aligned.
const OFFSET: f64 = 0.381_966;
/// Halvings of the distance between samples.
const HALVINGS: u32 = 24;
/// Samples that are taken between two of the first ones at most: where the arm is singular
/// throughout, nothing tells how curves go on.
const BETWEEN: usize = 256;
/// And so many between all of them.
const ALL_BETWEEN: usize = 1024;
/// Two places end in one fold if they find it this near to each other.
const SAME: f64 = 1e-5;
/// A slide without a stop is looked at so far beyond its target or its other stop, metres.
const FARTHEST: f64 = 10.0;
/// A stop that is farther away is none, metres: files have numbers like 1e9 for that.
const NO_STOP: f64 = 1e4;

/// A piece of a curve on which the parameter grows.
#[derive(Clone, Debug)]
pub(super) struct Arc {
    /// In the order of the parameter, from end to end; two at least.
    pub points: Vec<Place>,
    /// Whether its end goes on at its beginning, full turns of the parameter later.
    pub is_closed: bool,
}

impl Arc {
    /// How many chords there are between its points.
    pub fn chords(&self) -> usize {
        self.points.len() - 1
    }

    /// A coordinate at its first point and at its last.
    pub fn ends(&self, coordinate: usize) -> [f64; 2] {
        [0, self.chords()].map(|i| self.points[i].x[coordinate])
    }
}

/// An arc in the making.
struct Open {
    points: Vec<Place>,
    /// Whether it begins in a fold, or where a slide's travel does.
    begins: bool,
    /// Whether it ends so.
    ends: bool,
}

/// The arcs of all branches.
pub(super) fn arcs<K: RedundantKinematics<N> + ?Sized, const N: usize>(
    task: &Task<K, N>,
) -> Vec<Arc> {
    let values = task.samples();
    let Some((&first, rest)) = values.split_first() else {
        return Vec::new();
    };
    let turns = task.turns(task.parameter);
    let first = task.sample(first);
    let mut tracker = Tracker::new(task, &first, !turns);
    let mut before = first.clone();
    for &value in rest {
        let next = task.sample(value);
        tracker.go_on(&before, &next);
        before = next;
    }
    if turns {
        let parameter = first.parameter + TAU;
        let mut places = first.places.clone();
        for place in &mut places {
            place.x[task.parameter] = parameter;
        }
        let last = Sample::new(parameter, places);
        tracker.go_on(&before, &last);
    }
    tracker.finish(first.places.len(), turns)
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The values of the parameter to sample, ascending: evenly, and where a branch exists
    /// between two of them alone, or not there alone.
    fn samples(&self) -> Vec<f64> {
        let Some(between) = self.values_between_meetings() else {
            return self.margin_samples().unwrap_or_else(|| self.values());
        };
        let mut values = self.values();
        values.extend(between);
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    }

    /// The values of the parameter to begin with, ascending.
    pub fn values(&self) -> Vec<f64> {
        self.spread(SAMPLES)
    }

    /// So many values of the parameter, and those at its ends, ascending.
    pub fn spread(&self, count: usize) -> Vec<f64> {
        let [from, to] = self.range();
        let at = |i: usize| from + (to - from) * (i as f64 + OFFSET) / count as f64;
        let mut values: Vec<f64> = (0..count).map(at).collect();
        if !self.turns(self.parameter) {
            values.insert(0, from);
            values.push(to);
        }
        values
    }

    /// The range of the parameter: a turn, or a slide's travel.
    pub fn range(&self) -> [f64; 2] {
        match self.of {
            Parameter::Joint(joint) if !self.limits[joint].is_revolute() => {
                let limit = self.limits[joint];
                let distance = norm(self.target.translation);
                // Where the position counts it is a number.
                let far = FARTHEST + if distance.is_finite() { distance } else { 0.0 };
                let (lower, upper) = (limit.lower(), limit.upper());
                let is_stop = |end: f64| end.abs() <= NO_STOP;
                let end = |own: f64, other: f64, side: f64| match is_stop(other) {
                    _ if is_stop(own) => own,
                    true => other + 2.0 * side * far,
                    false => side * far,
                };
                [end(lower, upper, -1.0), end(upper, lower, 1.0)]
            }
            _ => [-PI, PI],
        }
    }
}

struct Tracker<'a, K: ?Sized, const N: usize> {
    task: &'a Task<'a, K, N>,
    arcs: Vec<Open>,
    /// By place of the sample last seen, its arc.
    open: Vec<usize>,
    /// How many samples have been taken between two of the first ones.
    between: usize,
    /// And how many between all of them so far.
    all_between: usize,
}

impl<'a, K: RedundantKinematics<N> + ?Sized, const N: usize> Tracker<'a, K, N> {
    fn new(task: &'a Task<K, N>, first: &Sample, begins: bool) -> Self {
        let arcs = first.places.iter().map(|place| Open {
            points: alloc::vec![*place],
            begins,
            ends: false,
        });
        Self {
            task,
            arcs: arcs.collect(),
            open: (0..first.places.len()).collect(),
            between: 0,
            all_between: 0,
        }
    }

    /// Carries the arcs from one of the first samples to the next.
    fn go_on(&mut self, from: &Sample, to: &Sample) {
        self.between = 0;
        self.cell(from, to, HALVINGS);
    }

    fn cell(&mut self, from: &Sample, to: &Sample, halvings: u32) {
        let mut matched = self.task.matched(from, to);
        let ends = [from.parameter, to.parameter];
        let ending = self.folds(from, &matched.ending, 1.0, ends);
        let beginning = self.folds(to, &matched.beginning, -1.0, ends);
        let (ending, beginning) = match (ending, beginning) {
            (Some(ending), Some(beginning)) => (ending, beginning),
            _ if halvings > 0 && self.between < BETWEEN && self.all_between < ALL_BETWEEN => {
                self.between += 1;
                self.all_between += 1;
                let middle = self.task.sample(0.5 * (from.parameter + to.parameter));
                self.cell(from, &middle, halvings - 1);
                self.cell(&middle, to, halvings - 1);
                return;
            }
            _ => {
                // Nothing tells how it goes on: to what is near, or the arcs end here.
                self.task.match_near(from, to, &mut matched);
                let at = |sample: &Sample, k: &usize| sample.places[*k];
                (
                    matched.ending.iter().map(|k| at(from, k)).collect(),
                    matched.beginning.iter().map(|k| at(to, k)).collect(),
                )
            }
        };
        for (&i, fold) in matched.ending.iter().zip(ending) {
            let arc = &mut self.arcs[self.open[i]];
            arc.points.push(fold);
            arc.ends = true;
        }
        let mut open = alloc::vec![0; to.places.len()];
        for &[i, j] in &matched.pairs {
            open[j] = self.open[i];
            self.arcs[open[j]].points.push(to.places[j]);
        }
        for (&j, fold) in matched.beginning.iter().zip(beginning) {
            open[j] = self.arcs.len();
            self.arcs.push(Open {
                points: alloc::vec![fold, to.places[j]],
                begins: true,
                ends: false,
            });
        }
        self.open = open;
    }

    /// The folds in which places end, between two values of the parameter; none if not
    /// all of them end so, two in each.
    fn folds(
        &self,
        sample: &Sample,
        which: &[usize],
        sense: f64,
        [from, to]: [f64; 2],
    ) -> Option<Vec<Place>> {
        let parameter = self.task.parameter;
        let slack = 1e-12;
        let find = |&k: &usize| {
            let fold = self.task.fold(sample, k, sense)?;
            let inside = (from - slack..=to + slack).contains(&fold.x[parameter]);
            inside.then_some(fold)
        };
        let folds: Vec<Place> = which.iter().map(find).collect::<Option<_>>()?;
        let same = |a: &Place, b: &Place| norm(self.task.way(&a.x, &b.x)) < SAME;
        let twice = |fold: &Place| folds.iter().filter(|other| same(fold, other)).count() == 2;
        folds.iter().all(twice).then_some(folds)
    }

    /// All arcs, joined where the parameter has come round.
    fn finish(mut self, first: usize, turns: bool) -> Vec<Arc> {
        if !turns {
            let arcs = self.arcs.into_iter().map(|arc| Arc {
                points: arc.points,
                is_closed: false,
            });
            return arcs.collect();
        }
        // The arc at place j of the last sample goes on as that of place j of the first.
        let mut next: Vec<Option<usize>> = alloc::vec![None; self.arcs.len()];
        for (j, &arc) in self.open.iter().enumerate().take(first) {
            next[arc] = Some(j);
        }
        let mut used = alloc::vec![false; self.arcs.len()];
        let begin = (0..self.arcs.len()).filter(|&i| self.arcs[i].begins);
        let order: Vec<usize> = begin.chain(0..self.arcs.len()).collect();
        let mut arcs = Vec::new();
        for start in order {
            if used[start] {
                continue;
            }
            let (mut points, mut here, mut turns) = (Vec::new(), start, 0.0);
            let is_closed = loop {
                used[here] = true;
                let own = core::mem::take(&mut self.arcs[here].points);
                let shifted = own.into_iter().map(|mut place| {
                    place.x[self.task.parameter] += turns;
                    place
                });
                // What joins two of them is in both.
                points.extend(shifted.skip(usize::from(turns > 0.0)));
                turns += TAU;
                match next[here] {
                    _ if self.arcs[here].ends => break false,
                    Some(on) if on == start => break true,
                    Some(on) if !used[on] => here = on,
                    _ => break false,
                }
            };
            arcs.push(Arc { points, is_closed });
        }
        arcs
    }
}
