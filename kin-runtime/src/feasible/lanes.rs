//! Intervals by the roots of a plan alone: branches exist where all of them are real.

use super::interval::FeasibleInterval;
use super::suspects::Margins;
use super::task::Task;
use crate::RedundantKinematics;
use alloc::vec::Vec;
use core::f64::consts::TAU;

/// Halvings and secants of a zero.
const STEPS: usize = 60;
/// Zeros are told to this, radians and metres.
const EXACT: f64 = 1e-13;
/// Samples are taken so far beside every zero: later roots depend on the square root of
/// the one that vanishes, which is steep there. All but the first on the side on which
/// more branches exist.
const BESIDE: [f64; 7] = [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 4e-2];
/// More zeros than any arm has.
const MOST: usize = 256;
/// Margins below this vanish at the zero of another branch.
const ZERO: f64 = 1e-11;

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The intervals of all branches; none where margins do not tell exactly.
    pub fn intervals_of_lanes(&self) -> Option<Vec<FeasibleInterval<N>>> {
        if !K::EXACT_MARGINS {
            return None;
        }
        let mut samples = self.margin_samples()?;
        let turns = self.turns(Self::PARAMETER);
        if turns {
            let mut round = samples[0];
            round.0 += TAU;
            samples.push(round);
        }
        let known = self.zeros(&mut samples)?;
        let mut found = Vec::new();
        for lane in 0..K::BRANCHES_AT {
            let crossing = |pair: &[Margins]| {
                let zero = self.zero(lane, pair[0], pair[1], &known)?;
                Some((zero.0, exists(&pair[1], lane)))
            };
            let crossings: Option<Vec<(f64, bool)>> =
                changes(&samples, lane).map(crossing).collect();
            self.between(lane, &crossings?, &samples, turns, &mut found);
        }
        Some(found)
    }

    /// Where branches begin and end. Two do so together: one of which a sample tells
    /// nothing is told by samples on both sides of the end of the other.
    fn zeros(&self, samples: &mut Vec<Margins>) -> Option<Vec<Margins>> {
        let mut known: Vec<Margins> = Vec::new();
        loop {
            let before = known.len();
            for lane in 0..K::BRANCHES_AT {
                for pair in changes(samples, lane) {
                    let zero = self.zero(lane, pair[0], pair[1], &known)?;
                    if !known.contains(&zero) {
                        known.push(zero);
                    }
                }
            }
            if known.len() == before || known.len() > MOST {
                return Some(known);
            }
            for zero in &known[before..] {
                let [low, high] = [-BESIDE[0], BESIDE[0]].map(|by| zero.0 + by);
                let beside = [(low, self.margins(low)?), (high, self.margins(high)?)];
                let count =
                    |sample: &Margins| (0..K::BRANCHES_AT).filter(|&k| exists(sample, k)).count();
                let sense = if count(&beside[0]) > count(&beside[1]) {
                    -1.0
                } else {
                    1.0
                };
                samples.extend(beside);
                for by in &BESIDE[1..] {
                    let side = zero.0 + sense * by;
                    samples.push((side, self.margins(side)?));
                }
            }
            samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
    }

    /// The intervals of a branch between the values at which it begins (`true`) and ends.
    fn between(
        &self,
        lane: usize,
        crossings: &[(f64, bool)],
        samples: &[Margins],
        turns: bool,
        found: &mut Vec<FeasibleInterval<N>>,
    ) {
        let ends = samples.first().zip(samples.last());
        let Some([first, last]) = ends.map(|(a, b)| [a.0, b.0]) else {
            return;
        };
        let goes_on = exists(&samples[0], lane);
        if crossings.is_empty() {
            if goes_on {
                found.extend(self.of_lane(lane, first, last, turns));
            }
            return;
        }
        let mut from = match (goes_on, turns) {
            (false, _) => None,
            (true, false) => Some(first),
            // It began behind the samples, a turn earlier.
            (true, true) => crossings.last().map(|(value, _)| value - TAU),
        };
        for &(value, begins) in crossings {
            match (begins, from) {
                (true, _) => from = Some(value),
                (false, Some(from)) => found.extend(self.of_lane(lane, from, value, false)),
                (false, None) => {}
            }
        }
        if let (Some((from, true)), false) = (crossings.last(), turns) {
            found.extend(self.of_lane(lane, *from, last, false));
        }
    }

    /// The interval of a branch; none if rounding is all of it.
    fn of_lane(
        &self,
        lane: usize,
        from: f64,
        to: f64,
        is_closed: bool,
    ) -> Option<FeasibleInterval<N>> {
        let middle = self.robot.ik_at(self.target, 0.5 * (from + to));
        let middle = middle.iter().find(|found| found.branch as usize == lane)?;
        Some(self.wound(FeasibleInterval {
            from,
            to,
            is_closed,
            middle: middle.q,
        }))
    }

    /// Where the margin of a branch vanishes between two samples, by the method of false
    /// position in the version of Illinois (M. Dowell and P. Jarratt, "A modified regula
    /// falsi method", BIT 11, 1971). Branches that meet share it.
    fn zero(&self, lane: usize, from: Margins, to: Margins, known: &[Margins]) -> Option<Margins> {
        let shared =
            |zero: &&Margins| (from.0..=to.0).contains(&zero.0) && zero.1[lane].abs() < ZERO;
        if let Some(zero) = known.iter().find(shared) {
            return Some(*zero);
        }
        let ([mut a, mut b], [mut u, mut v]) = ([from.0, to.0], [from.1[lane], to.1[lane]]);
        let mut last = from;
        for _ in 0..STEPS {
            let c = (a * v - b * u) / (v - u);
            let moved = (c - last.0).abs();
            last = (c, self.margins(c)?);
            let w = last.1[lane];
            // The end behind which the zero is moves up; the other one counts half if it
            // has stayed.
            match (w < 0.0) == (v < 0.0) {
                true => u *= 0.5,
                false => (a, u) = (b, v),
            }
            (b, v) = (c, w);
            if w == 0.0 || moved < EXACT || (b - a).abs() < EXACT {
                break;
            }
        }
        Some(last)
    }
}

/// Neighbouring samples between which a branch begins or ends.
fn changes(samples: &[Margins], lane: usize) -> impl Iterator<Item = &[Margins]> {
    let pairs = samples.windows(2);
    pairs.filter(move |pair| exists(&pair[0], lane) != exists(&pair[1], lane))
}

fn exists(sample: &Margins, lane: usize) -> bool {
    sample.1[lane] >= 0.0
}
