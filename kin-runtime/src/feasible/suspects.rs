//! Branches that exist between two samples alone, or are gone there alone.
//!
//! Of arms whose plan tells no ends: margins are continuous functions of the parameter, whose
//! sign tells whether branches exist. They cost less than solutions and are looked at more densely:
//! where one has changed its sign, or has an extremum of the other sign in between, one more sample
//! is taken.

use super::task::Task;
use crate::RedundantKinematics;
use crate::scalar::golden_section::GoldenSection;
use alloc::vec::Vec;

/// Margins of a turn, or of a slide's travel.
const MARGINS: usize = 256;
/// Golden-section steps.
const STEPS: usize = 24;

/// So many steps in a row that gain less than a share of what is missing end a search.
const STALLS: usize = 5;
const GAIN: f64 = 0.02;

/// A value of the parameter, and the margins there.
type Margins = (f64, [f64; 16]);

/// By how much steeper than between samples a margin may be next to them.
const STEEPER: f64 = 2.0;

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The values of the parameter to sample, ascending; none of an arm without margins.
    pub fn margin_samples(&self) -> Option<Vec<f64>> {
        let at = |value: f64| Some((value, self.margins(value)?));
        let samples = self.spread(MARGINS).into_iter().map(at);
        let samples: Vec<Margins> = samples.collect::<Option<_>>()?;
        let mut values = self.values();
        values.extend(self.suspects(&samples));
        let changes = |pair: &&[Margins]| {
            let [before, here] = [0, 1].map(|i| pair[i].1.map(|margin| margin < 0.0));
            before != here
        };
        values.extend(samples.windows(2).filter(changes).map(|pair| pair[1].0));
        values.sort_by(f64::total_cmp);
        values.dedup();
        Some(values)
    }

    /// More values of the parameter to sample.
    fn suspects(&self, samples: &[Margins]) -> Vec<f64> {
        let mut found = Vec::new();
        let n = samples.len();
        let turns = self.turns(self.parameter);
        let round = self.range()[1] - self.range()[0];
        // Around the circle, or between the ends.
        let at = |i: usize| match i {
            0 => (samples[n - 1].0 - round, samples[n - 1].1),
            i if i <= n => samples[i - 1],
            i => (samples[i - 1 - n].0 + round, samples[i - 1 - n].1),
        };
        let cells = if turns { 1..n + 1 } else { 2..n - 1 };
        for i in cells {
            let four = [i - 1, i, i + 1, i + 2].map(at);
            let mut seen: Vec<[f64; 4]> = Vec::new();
            for lane in 0..self.branches {
                let own = four.map(|sample| sample.1[lane]);
                let same_sign = (own[1] < 0.0) == (own[2] < 0.0);
                let sign = if own[1] < 0.0 { 1.0 } else { -1.0 };
                let towards = own.map(|x| sign * x);
                // Branches that meet have one margin.
                if same_sign && !seen.contains(&own) && may_cross(four.map(|s| s.0), towards) {
                    found.extend(self.crossing(lane, sign, four[1].0, four[2].0));
                }
                seen.push(own);
            }
        }
        found
    }

    /// Where the largest margin of a lane, times the sign, is positive.
    fn crossing(&self, lane: usize, sign: f64, low: f64, high: f64) -> Option<f64> {
        let none = f64::NEG_INFINITY;
        let at = |value: f64| self.margins(value).map_or(none, |all| sign * all[lane]);
        let mut section = GoldenSection::new(low, high, at);
        let (mut best, mut stalls) = (none, 0);
        for _ in 0..STEPS {
            let (place, larger) = section.best();
            if larger > 0.0 {
                return Some(place);
            }
            // An extremum is quadratic: steps that gain less lead nowhere near zero.
            stalls = if larger - best < -GAIN * larger {
                stalls + 1
            } else {
                0
            };
            if stalls == STALLS {
                return None;
            }
            best = best.max(larger);
            section.step(at);
        }
        None
    }

    fn margins(&self, value: f64) -> Option<[f64; 16]> {
        self.robot.margins_at(self.target, value)
    }
}

/// Whether a function that is negative at the two inner places may be positive between
/// them: it is below the lines through the two samples on either side where it bends down,
/// and these are taken steeper than they are. Where it has a kink, because two functions change
/// places, it is as steep inside.
fn may_cross(at: [f64; 4], [a, b, c, d]: [f64; 4]) -> bool {
    let width = at[2] - at[1];
    let inside = (c - b) / width;
    let slope = |rise: f64, run: f64, inside: f64| STEEPER * (rise / run).max(inside).max(0.0);
    let up = slope(b - a, at[1] - at[0], inside);
    let down = slope(c - d, at[3] - at[2], -inside);
    if up == 0.0 || down == 0.0 {
        return false;
    }
    // Where the two lines meet, or the lower of them at the ends of the cell.
    let meet = ((c - b + down * width) / (up + down)).clamp(0.0, width);
    (b + up * meet).min(c + down * (width - meet)) > 0.0
}
