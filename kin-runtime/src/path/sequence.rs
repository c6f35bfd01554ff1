//! The sequence of configurations that moves the joints least.
//!
//! Dynamic programming (R. Bellman, *Dynamic Programming*, 1957) over branches
//! and full turns. An arm of six joints with two turns each has 64 ways to stand
//! in every branch, and one whose stops are thousands of radians away has more
//! than can be listed; nearly all of them are of no use. What is left to move
//! from a solution on, whatever turns are taken, is known to be at least what the
//! shorter ways take, without any full turn (a lower bound, as P. Hart, N. Nilsson
//! and B. Raphael's, *A Formal Basis for the Heuristic Determination of Minimum
//! Cost Paths*, 1968). Ways that exceed a bound together with what is left are
//! dropped; if none remains, the bound was too low.

use crate::{JointLimit, math};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::f64::consts::TAU;

/// More than rounding and [`JointLimit::TOLERANCE`] take from a sum of motions, relative and
/// absolute.
const ROUNDING: f64 = 1e-6;
/// How far a bound is raised beyond the least that it dropped, at first; radians and metres.
const RAISED: f64 = 0.5;

/// Stops that are farther apart, radians, are not met on the way: files have numbers like 1e4 for
/// joints that turn without end.
const ENDLESS: f64 = 1e3;

/// What moves, and at what cost.
#[derive(Clone, Copy)]
pub struct Joints<'a> {
    /// Stops of each joint.
    pub limits: &'a [JointLimit],
    /// By which each joint's motion is multiplied.
    pub weights: &'a [f64],
    /// How far each joint moves at most from one configuration to the next, the first excepted.
    pub steps: &'a [f64],
}

/// A sequence of configurations.
pub struct Sequence {
    /// Of each layer, which solution is taken, and the values of the joints.
    pub taken: Vec<(usize, Vec<f64>)>,
    /// The sum of the weighted Euclidean norms of all motions.
    pub motion: f64,
}

impl Joints<'_> {
    /// One solution of each layer, by full turns inside the limits, so that their sequence moves
    /// least from a seed. Joints whose seed is not finite begin anywhere. A joint that lacks a stop,
    /// or has stops a thousand radians apart, takes the turn that is nearest.
    pub fn least_motion<Q: AsRef<[f64]>>(
        self,
        layers: &[Vec<Q>],
        seed: &[f64],
    ) -> Option<Sequence> {
        let layers: Vec<Vec<Solution>> = (layers.iter())
            .map(|layer| self.inside(layer).collect())
            .collect();
        let left = self.left(&layers);
        let mut bound = match layers.first() {
            Some(first) => self.least_from(seed, first, &left[0]),
            None => 0.0,
        };
        let mut raised = RAISED;
        let mut starts = starts(seed).into_iter();
        let mut anywhere = starts.next().unwrap_or_default();
        bound += ROUNDING * (1.0 + bound);
        while bound.is_finite() {
            match (
                self.within(bound, &layers, &left, (seed, &anywhere)),
                starts.next(),
            ) {
                (Ok(sequence), _) => return Some(sequence),
                (Err(_), Some(next)) => anywhere = next,
                (Err(dropped), None) => {
                    bound = dropped + raised;
                    bound += ROUNDING * (1.0 + bound);
                    raised *= 2.0;
                }
            }
        }
        None
    }

    /// The solutions that some full turns lead inside the limits.
    fn inside<'q, Q: AsRef<[f64]>>(self, layer: &'q [Q]) -> impl Iterator<Item = Solution<'q>> {
        let turns = move |(place, q): (usize, &'q Q)| {
            let q = q.as_ref();
            let turns = q.iter().zip(self.limits);
            let turns: Vec<_> = turns.map(|(&q, limit)| limit.turns(q)).collect();
            let is_inside = turns.iter().all(|(least, most)| least <= most);
            is_inside.then_some(Solution { place, q, turns })
        };
        layer.iter().enumerate().filter_map(turns)
    }

    /// Of every solution, the least that may be left to move behind it.
    fn left(self, layers: &[Vec<Solution>]) -> Vec<Vec<f64>> {
        let mut left: Vec<Vec<f64>> = Vec::with_capacity(layers.len());
        for (k, layer) in layers.iter().enumerate().rev() {
            let here = match (layers.get(k + 1), left.last()) {
                (Some(next), Some(behind)) => layer
                    .iter()
                    .map(|from| self.least(from, next, behind))
                    .collect(),
                _ => alloc::vec![0.0; layer.len()],
            };
            left.push(here);
        }
        left.reverse();
        left
    }

    fn least(self, from: &Solution, layer: &[Solution], left: &[f64]) -> f64 {
        let motion = |to: &Solution| {
            self.norm(|i| {
                let (least, most) = to.turns[i];
                let (first, last) = from.turns[i];
                let by = to.q[i] - from.q[i];
                let by = by + TAU * nearest_turn(-by, least - last, most - first);
                // Both may be moved onto a stop. No number is no bound.
                let is_beyond = by.abs() > self.steps[i] + 3.0 * JointLimit::TOLERANCE;
                (!is_beyond).then_some(by)
            })
        };
        least_sum(layer.iter().map(motion), left)
    }

    fn least_from(self, seed: &[f64], layer: &[Solution], left: &[f64]) -> f64 {
        let motion = |to: &Solution| self.norm(|i| Some(self.nearest(i, to, seed[i]).1));
        least_sum(layer.iter().map(motion), left)
    }

    /// By which turn a joint moves least to a solution, and how far that is.
    fn nearest(self, i: usize, to: &Solution, from: f64) -> (f64, f64) {
        let ((least, most), q) = (to.turns[i], to.q[i]);
        if !from.is_finite() {
            return (nearest_turn(0.0, least, most), 0.0);
        }
        let turn = nearest_turn(from - q, least, most);
        (turn, self.limits[i].turned(q, turn) - from)
    }

    /// Whether it can pay to be in another turn than the nearest: not where the stops are no ends of
    /// a way, nor where any turn is reached from any other at no cost.
    fn may_need_another_turn(self, i: usize) -> bool {
        let travel = self.limits[i].upper() - self.limits[i].lower();
        let is_free = self.weights[i] == 0.0 && self.steps[i].is_infinite();
        travel < ENDLESS && !is_free
    }

    /// The weighted norm of motions of all joints; infinite where one cannot be.
    fn norm(self, motion: impl Fn(usize) -> Option<f64>) -> f64 {
        let mut square = 0.0;
        for i in 0..self.limits.len() {
            let Some(by) = motion(i) else {
                return f64::INFINITY;
            };
            square += (self.weights[i] * by) * (self.weights[i] * by);
        }
        math::sqrt(square)
    }

    /// The sequence that moves least, if it moves less than a bound; from a seed, and with the joints
    /// without one that begin in all turns.
    ///
    /// # Errors
    /// The least that a way would have taken that was dropped; infinite if none was.
    fn within(
        self,
        bound: f64,
        layers: &[Vec<Solution>],
        left: &[Vec<f64>],
        (seed, anywhere): (&[f64], &[usize]),
    ) -> Result<Sequence, f64> {
        let mut dropped = f64::INFINITY;
        let mut ways: Vec<Vec<Way>> = Vec::with_capacity(layers.len());
        for (k, (layer, left)) in layers.iter().zip(left).enumerate() {
            let mut here = Here {
                joints: self,
                is_first: k == 0,
                anywhere,
                bound,
                ways: Vec::new(),
                places: BTreeMap::new(),
                dropped: &mut dropped,
            };
            match ways.last() {
                None => here.extend(layer, left, 0, 0.0, seed),
                Some(before) => {
                    for (place, way) in before.iter().enumerate() {
                        here.extend(layer, left, place, way.motion, &way.q);
                    }
                }
            }
            let here = here.ways;
            ways.push(here);
        }
        let Some(last) = ways.last() else {
            return Ok(Sequence {
                taken: Vec::new(),
                motion: 0.0,
            });
        };
        let all = last.iter().enumerate();
        let end = all.min_by(|a, b| a.1.motion.total_cmp(&b.1.motion));
        let (mut place, motion) = end.map(|(i, way)| (i, way.motion)).ok_or(dropped)?;
        let mut taken = Vec::with_capacity(layers.len());
        for (layer, ways) in layers.iter().zip(&ways).rev() {
            let way = &ways[place];
            taken.push((layer[way.solution].place, way.q.clone()));
            place = way.from;
        }
        taken.reverse();
        Ok(Sequence { taken, motion })
    }
}

/// Which joints without a seed begin in all turns: none, so that they begin in the one about zero, if
/// that is as good as any other; otherwise one of them, two, or all. Ways are as many as all turns of
/// those together.
fn starts(seed: &[f64]) -> Vec<Vec<usize>> {
    let free: Vec<usize> = (0..seed.len()).filter(|&i| !seed[i].is_finite()).collect();
    let mut starts = alloc::vec![Vec::new()];
    starts.extend(free.iter().map(|&i| alloc::vec![i]));
    for (k, &i) in free.iter().enumerate() {
        starts.extend(free[..k].iter().map(|&j| alloc::vec![j, i]));
    }
    if free.len() > 2 {
        starts.push(free);
    }
    starts
}

/// A solution inside the limits.
struct Solution<'q> {
    /// In its layer.
    place: usize,
    q: &'q [f64],
    /// The least and the greatest full turn of each joint that lead inside.
    turns: Vec<(f64, f64)>,
}

/// The shortest way to a solution by certain turns.
struct Way {
    solution: usize,
    q: Vec<f64>,
    motion: f64,
    /// The way to the layer before.
    from: usize,
}

/// The ways to one layer.
struct Here<'a> {
    joints: Joints<'a>,
    is_first: bool,
    /// The joints without a seed that begin in all turns.
    anywhere: &'a [usize],
    bound: f64,
    ways: Vec<Way>,
    /// Of a solution and its turns the place in `ways`.
    places: BTreeMap<(usize, Vec<i64>), usize>,
    dropped: &'a mut f64,
}

/// A way that grows joint by joint.
struct Growing<'a> {
    /// The weighted motion up to the layer before, and a lower bound for what follows this one.
    others: [f64; 2],
    from: usize,
    start: &'a [f64],
    solution: usize,
    turns: Vec<i64>,
}

impl Here<'_> {
    /// Goes on from a way to the layer before.
    fn extend(
        &mut self,
        layer: &[Solution],
        left: &[f64],
        from: usize,
        motion: f64,
        start: &[f64],
    ) {
        for (solution, (to, &left)) in layer.iter().zip(left).enumerate() {
            let mut growing = Growing {
                others: [motion, left],
                from,
                start,
                solution,
                turns: Vec::with_capacity(start.len()),
            };
            if left.is_finite() {
                self.grow(&mut growing, to, 0.0);
            }
        }
    }

    /// Takes all turns of the next joint that the bound allows, the nearest first.
    fn grow(&mut self, growing: &mut Growing, to: &Solution, square: f64) {
        let joints = self.joints;
        let i = growing.turns.len();
        if i == to.q.len() {
            return self.arrive(growing, to, math::sqrt(square));
        }
        let (nearest, _) = joints.nearest(i, to, growing.start[i]);
        if !self.turn(growing, to, square, nearest) {
            return;
        }
        let begins = !growing.start[i].is_finite() && !self.anywhere.contains(&i);
        if begins || !joints.may_need_another_turn(i) {
            return;
        }
        let (least, most) = to.turns[i];
        for side in [-1.0, 1.0] {
            let mut turn = nearest + side;
            while (least..=most).contains(&turn) && self.turn(growing, to, square, turn) {
                turn += side;
            }
        }
    }

    /// Takes a turn of the next joint; tells whether that is allowed.
    fn turn(&mut self, growing: &mut Growing, to: &Solution, square: f64, turn: f64) -> bool {
        let joints = self.joints;
        let i = growing.turns.len();
        let by = match growing.start[i].is_finite() {
            true => joints.limits[i].turned(to.q[i], turn) - growing.start[i],
            false => 0.0,
        };
        if !self.is_first && by.abs() > joints.steps[i] + JointLimit::TOLERANCE {
            return false;
        }
        let square = square + (joints.weights[i] * by) * (joints.weights[i] * by);
        let total = growing.others[0] + math::sqrt(square) + growing.others[1];
        if total > self.bound {
            *self.dropped = self.dropped.min(total);
            return false;
        }
        growing.turns.push(turn as i64);
        self.grow(growing, to, square);
        growing.turns.pop();
        true
    }

    /// Keeps a way, if it is the shortest to where it leads.
    fn arrive(&mut self, growing: &Growing, to: &Solution, by: f64) {
        let joints = self.joints;
        let motion = growing.others[0] + by;
        let key = (growing.solution, growing.turns.clone());
        let place = *self.places.entry(key).or_insert(self.ways.len());
        match self.ways.get_mut(place) {
            Some(way) if motion < way.motion => {
                way.motion = motion;
                way.from = growing.from;
            }
            Some(_) => {}
            None => {
                let turned = growing.turns.iter().enumerate();
                let q = turned.map(|(i, &turn)| joints.limits[i].turned(to.q[i], turn as f64));
                self.ways.push(Way {
                    solution: growing.solution,
                    q: q.collect(),
                    motion,
                    from: growing.from,
                });
            }
        }
    }
}

/// The full turns that are nearest to an angle, of those from `least` to `most`.
fn nearest_turn(angle: f64, least: f64, most: f64) -> f64 {
    math::round(angle / TAU).max(least).min(most)
}

fn least_sum(motions: impl Iterator<Item = f64>, left: &[f64]) -> f64 {
    let sums = motions.zip(left).map(|(motion, left)| motion + left);
    sums.fold(f64::INFINITY, f64::min)
}
