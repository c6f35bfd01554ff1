//! Intervals by a plan alone: where its roots meet, branches may begin and end, and between such
//! places the solutions at one value tell which of them there are.

use super::change::change;
use super::interval::FeasibleInterval;
use super::task::Task;
use crate::{RedundantKinematics, Solutions};
use alloc::vec::Vec;
use core::f64::consts::TAU;

/// Places that are nearer to each other are one.
const SAME: f64 = 1e-9;
/// Of places where roots only touch zero, those are: rounding hides where they do.
const BLURRED: f64 = 1e-6;
/// Where between two places the solutions are asked for: not in the middle, where targets with
/// a symmetry have roots that meet.
pub(super) const AMID: f64 = 0.381_966;
/// Halvings between samples, where nothing else tells where branches begin and end.
const HALVINGS: usize = 40;
/// Where in an interval the configuration is that stands for it: in the middle, or near it where
/// that is singular and the branch is not told from another.
pub(super) const MIDDLES: [f64; 3] = [0.5, 0.49, 0.53];

/// A place at which branches may begin or end.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    value: f64,
    /// Whether roots meet there without ceasing to be real, or nearly: branches may exist there
    /// alone.
    touches: bool,
}

/// What is between two neighbouring places.
struct Cell {
    from: f64,
    to: f64,
    /// The value in between at which solutions were asked for.
    amid: f64,
    /// Their branches, as bits.
    branches: u32,
}

/// The branches of solutions, as bits.
fn branches<const N: usize>(solutions: &Solutions<N>) -> u32 {
    let each = solutions.iter().map(|solution| 1 << solution.branch);
    each.fold(0, |all, branch: u32| all | branch)
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The intervals of all branches, with their branches; none where no plan tells them.
    pub fn intervals_of_lanes(&self) -> Option<Vec<(usize, FeasibleInterval<N>)>> {
        (self.roots > 0).then(|| self.intervals_between(&self.cuts()))
    }

    /// The same where branches begin and end at these places alone.
    pub fn intervals_between(&self, cuts: &[Cut]) -> Vec<(usize, FeasibleInterval<N>)> {
        let turns = self.turns(self.parameter);
        let cells = self.cells(cuts, turns);
        let mut all: Vec<(Run, usize)> = Vec::new();
        for lane in 0..self.branches {
            let own = runs(&cells, lane, turns).into_iter();
            all.extend(own.map(|run| (run, lane)));
        }
        all.sort_by_key(|(run, _)| (run.first, run.last));
        let each = all.into_iter();
        let each = each.filter_map(|(run, lane)| Some((lane, self.of_run(&cells, lane, run)?)));
        let mut found: Vec<(usize, FeasibleInterval<N>)> = each.collect();
        self.isolated(cuts, &cells, turns, &mut found);
        found
    }

    /// The ends of a travel.
    fn stops(&self) -> Vec<Cut> {
        let ends = self.range().into_iter();
        let stop = |value| Cut {
            value,
            touches: false,
        };
        ends.filter(|_| !self.turns(self.parameter))
            .map(stop)
            .collect()
    }

    /// Where samples and halving between them find other branches, ascending; of a travel its ends
    /// too.
    pub fn changes(&self) -> Vec<Cut> {
        let mut values = self.values();
        if let (true, Some(&first)) = (self.turns(self.parameter), values.first()) {
            values.push(first + TAU);
        }
        let there = |value: f64| branches(&self.solutions(value));
        let changed = |pair: &[f64]| {
            let [low, high] = [pair[0], pair[1]];
            let before = there(low);
            if there(high) == before {
                return None;
            }
            let change = change([low, high], HALVINGS, |value| there(value) == before);
            Some(Cut {
                value: match self.turns(self.parameter) {
                    true => crate::math::wrap(change),
                    false => change,
                },
                touches: false,
            })
        };
        let mut cuts = self.stops();
        cuts.extend(values.windows(2).filter_map(changed));
        cuts.sort_by(|a, b| a.value.total_cmp(&b.value));
        cuts
    }

    /// All places at which branches may begin or end, ascending; of a travel its ends too.
    fn cuts(&self) -> Vec<Cut> {
        let meetings = self.meetings();
        let turns = self.turns(self.parameter);
        let cut = |value: &f64, touches| Cut {
            value: match turns {
                true => crate::math::wrap(*value),
                false => *value,
            },
            touches,
        };
        let crossing = meetings.crossing.iter().map(|value| cut(value, false));
        let touching = meetings.touching.iter().map(|value| cut(value, true));
        let mut cuts: Vec<Cut> = crossing.chain(touching).chain(self.stops()).collect();
        cuts.sort_by(|a, b| a.value.total_cmp(&b.value));
        cuts.dedup_by(|next, kept| {
            let apart = next.value - kept.value;
            let is_same = apart < SAME || apart < BLURRED && kept.touches && next.touches;
            // Of an oval that has shrunk to nothing both ends are here.
            kept.touches |= is_same;
            is_same
        });
        cuts
    }

    /// What is between the cuts, in their order: of a turn, the last one goes on to the first cut.
    fn cells(&self, cuts: &[Cut], turns: bool) -> Vec<Cell> {
        let mut ends: Vec<f64> = cuts.iter().map(|cut| cut.value).collect();
        if turns {
            let [first, last] = self.range();
            match ends.first() {
                Some(&begin) => ends.push(begin + TAU),
                None => ends.extend([first, last]),
            }
        }
        let cell = |pair: &[f64]| {
            let [from, to] = [pair[0], pair[1]];
            let amid = from + AMID * (to - from);
            let branches = branches(&self.robot.ik_at(self.target, amid));
            Cell {
                from,
                to,
                amid,
                branches,
            }
        };
        ends.windows(2).map(cell).collect()
    }

    /// The interval of a branch that exists in a run of cells.
    fn of_run(&self, cells: &[Cell], lane: usize, run: Run) -> Option<FeasibleInterval<N>> {
        let n = cells.len();
        let turned = (run.last / n - run.first / n) as f64;
        let from = cells[run.first % n].from;
        let to = cells[run.last % n].to + TAU * turned;
        let middles = MIDDLES.map(|share| from + share * (to - from));
        let mut values = middles.into_iter().chain([cells[run.first % n].amid]);
        let q = values.find_map(|value| {
            let solutions = self.solutions(value);
            let solution = solutions.iter().find(|found| found.branch as usize == lane);
            solution.map(|solution| solution.q)
        });
        Some(self.wound(FeasibleInterval {
            from,
            to,
            is_angle: self.turns(self.parameter),
            is_closed: run.is_closed,
            middle: q?,
        }))
    }

    /// Adds intervals without length: of branches that exist where roots touch zero and on neither
    /// side.
    fn isolated(
        &self,
        cuts: &[Cut],
        cells: &[Cell],
        turns: bool,
        found: &mut Vec<(usize, FeasibleInterval<N>)>,
    ) {
        for (i, cut) in cuts.iter().enumerate().filter(|(_, cut)| cut.touches) {
            let before = match turns {
                true => cells.get((i + cells.len() - 1) % cells.len()),
                false => i.checked_sub(1).and_then(|before| cells.get(before)),
            };
            let beside = [before, cells.get(i)];
            let beside = beside.map(|cell| cell.map_or(0, |cell| cell.branches));
            let solutions = self.robot.ik_at(self.target, cut.value);
            let going_on = beside.map(u32::count_ones).into_iter().max().unwrap_or(0);
            let own = solutions.iter().filter(|solution| {
                let branch = 1 << solution.branch;
                (beside[0] | beside[1]) & branch == 0
            });
            let count = solutions.len().saturating_sub(going_on as usize);
            found.extend(own.take(count).map(|solution| {
                let interval = self.wound(FeasibleInterval {
                    from: cut.value,
                    to: cut.value,
                    is_angle: turns,
                    is_closed: false,
                    middle: solution.q,
                });
                (solution.branch as usize, interval)
            }));
        }
    }
}

/// Neighbouring cells, of a turn by numbers that may go on beyond the last one.
#[derive(Clone, Copy)]
struct Run {
    first: usize,
    last: usize,
    is_closed: bool,
}

/// Where a branch exists.
fn runs(cells: &[Cell], lane: usize, turns: bool) -> Vec<Run> {
    let n = cells.len();
    let exists = |i: usize| cells[i % n].branches >> lane & 1 == 1;
    // Of a turn the first one to look at is one behind a cell without the branch.
    let begin = match turns {
        true => (0..n).find(|&i| !exists(i)).map(|i| i + 1),
        false => Some(0),
    };
    let Some(begin) = begin else {
        return alloc::vec![Run {
            first: 0,
            last: n - 1,
            is_closed: true,
        }];
    };
    let mut runs: Vec<Run> = Vec::new();
    for i in (begin..begin + n).filter(|&i| exists(i)) {
        match runs.last_mut().filter(|run| run.last + 1 == i) {
            Some(run) => run.last = i,
            None => runs.push(Run {
                first: i,
                last: i,
                is_closed: false,
            }),
        }
    }
    runs
}
