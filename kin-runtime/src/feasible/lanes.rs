//! Intervals by the roots of a plan alone: branches exist where all of them are real.

use super::interval::FeasibleInterval;
use super::task::Task;
use crate::{RedundantKinematics, Solutions};
use alloc::vec::Vec;
use core::f64::consts::TAU;

/// Arguments that are negative by less than this are zero.
const ZERO: f64 = 1e-12;
/// Ends that are nearer to each other are one.
const SAME: f64 = 1e-12;
/// Where between two ends it is asked whether a branch exists: not in the middle, where targets
/// with a symmetry have roots that meet.
const AMID: f64 = 0.381_966;
/// Where in an interval the configuration is that stands for it: in the middle, or near it where
/// that is singular and the branch is not told from another.
const MIDDLES: [f64; 3] = [0.5, 0.49, 0.53];

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The intervals of all branches; none where no plan tells them.
    pub fn intervals_of_lanes(&self) -> Option<Vec<FeasibleInterval<N>>> {
        if self.roots == 0 {
            return None;
        }
        let turns = self.turns(self.parameter);
        let ends = self.ends();
        let mut found = Vec::new();
        let mut middle = None;
        // The sign of the last root changes nothing.
        let lanes = 1 << (self.roots - 1);
        for signs in 0..lanes {
            let own = ends.iter().filter(|end| end.is_of(signs));
            let own = own.map(|end| self.round(end.value));
            let parts = self.parts(own.collect(), turns, signs);
            for lane in (signs..self.branches).step_by(lanes) {
                for &[from, to] in &parts {
                    let is_closed = turns && to - from == TAU;
                    found.extend(self.of_lane(lane, from, to, is_closed, &mut middle));
                }
            }
        }
        Some(found)
    }

    /// Values of the parameter between which no branch begins or ends, one of each interval
    /// between neighbouring ends.
    pub fn values_between_ends(&self) -> Option<Vec<f64>> {
        if self.roots == 0 {
            return None;
        }
        let ends = self.ends().into_iter().map(|end| self.round(end.value));
        let mut ends: Vec<f64> = ends.collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|a, b| (*a - *b).abs() < SAME);
        Some(
            ends.windows(2)
                .map(|pair| 0.5 * (pair[0] + pair[1]))
                .collect(),
        )
    }

    /// Within the first turn, if the parameter turns.
    fn round(&self, value: f64) -> f64 {
        match self.turns(self.parameter) {
            true => crate::math::wrap(value),
            false => value,
        }
    }

    /// Where the roots of these signs are all real, by the values at which they may begin or
    /// cease to be.
    fn parts(&self, mut ends: Vec<f64>, turns: bool, signs: usize) -> Vec<[f64; 2]> {
        let exists = |value: f64| {
            let arguments = self.robot.root_arguments(self.target, value);
            arguments[..self.roots]
                .iter()
                .all(|root| root[signs] >= -ZERO)
        };
        let [first, last] = self.range();
        if !turns {
            ends.extend([first, last]);
        }
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|a, b| (*a - *b).abs() < SAME);
        if turns {
            let Some(&begin) = ends.first() else {
                let whole = exists(first).then_some([first, last]);
                return whole.into_iter().collect();
            };
            ends.push(begin + TAU);
        }
        let mut parts: Vec<[f64; 2]> = Vec::new();
        for pair in ends.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            if !exists(from + AMID * (to - from)) {
                continue;
            }
            match parts.last_mut() {
                Some(part) if part[1] == from => part[1] = to,
                _ => parts.push([from, to]),
            }
        }
        // The last one goes on as the first.
        let meets = |parts: &[[f64; 2]]| parts[parts.len() - 1][1] == parts[0][0] + TAU;
        if turns && parts.len() > 1 && meets(&parts) {
            let head = parts.remove(0);
            let tail = parts.len() - 1;
            parts[tail][1] = head[1] + TAU;
        }
        parts
    }

    /// The interval of a branch; none if rounding is all of it. `middle` has what was solved
    /// last, which other branches may share.
    fn of_lane(
        &self,
        lane: usize,
        from: f64,
        to: f64,
        is_closed: bool,
        middle: &mut Option<(f64, Solutions<N>)>,
    ) -> Option<FeasibleInterval<N>> {
        let q = MIDDLES.iter().find_map(|share| {
            let value = from + share * (to - from);
            let known = middle.take().filter(|known| known.0 == value);
            let known = known.unwrap_or_else(|| (value, self.robot.ik_at(self.target, value)));
            let (_, solutions) = middle.insert(known);
            let solution = solutions.iter().find(|found| found.branch as usize == lane);
            solution.map(|solution| solution.q)
        });
        Some(self.wound(FeasibleInterval {
            from,
            to,
            is_closed,
            middle: q?,
        }))
    }
}
