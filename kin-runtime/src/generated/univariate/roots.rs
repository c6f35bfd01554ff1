//! All real roots of a trigonometric polynomial.
//!
//! Descartes' rule of signs in Bernstein's basis bounds the number of roots on
//! an interval and has its parity (G. E. Collins and A. G. Akritas, SYMSAC
//! 1976; J. M. Lane and R. F. Riesenfeld, BIT 21, 1981): no change of sign means
//! none, one means one. Halving does the rest, with a bound on its steps;
//! where there may be two on an interval with one extremum, the sign at that
//! tells; intervals on which the signs are those of rounding end at a width.

use super::LANES;
use super::bernstein::{
    ARCS, Arcs, COEFFICIENTS, CUT, PLACES, REACH, cut, middle, on_arcs, turn_of_middle,
};
use super::harmonics::Harmonics;
use crate::generated::dispatch::{Dispatched, dispatch};
use crate::generated::lanes;
use crate::math;

/// Candidates at most: more than a polynomial of the highest degree has roots.
pub(super) const MOST: usize = 32;

/// Halvings at most, in all: roots that are near each other take ten for each
/// pair, and no polynomial has more than twelve.
const HALVINGS: usize = 192;

/// Intervals that wait at a time: one of each halving on the way.
const WAITING: usize = 16;

/// In multiples of the noise, what a coefficient may be without having a sign.
pub(super) const UNSIGNED: f64 = 256.0;

/// Below this an interval, radians, on which there may be several roots is one candidate.
const NARROW: f64 = 4e-4;

/// Where all is noise, candidates are this far apart at most, radians.
const BLIND: f64 = 0.05;

/// Clusters that are nearer to each other are one, radians.
pub(super) const CLUSTER: f64 = 5e-3;

/// So far from the roots that it stands for a candidate may be, radians.
pub(super) const STANDS_FOR: f64 = CLUSTER + NARROW;

/// Two roots that are nearer to each other than twice the root of this are one
/// candidate, radians².
const CLOSE: f64 = 1e-12;

/// Where f″ is above this, relative to the largest harmonic, two roots are no more than
/// two: of three or more, it would be what rounding leaves.
const CURVED: f64 = 1e-4;

/// Where f′ is below this, relative to the largest harmonic, roots that are complex may be so
/// near that their solutions mix with that of a real one.
const FLAT: f64 = 1e-3;

/// Extrema are found to this, as a share of a radian: values there to its square.
const EXTREMUM: f64 = 1e-7;

/// Roots are found to this, radians: Newton's method on the arm does the rest.
const ROOT: f64 = 1e-9;

/// Steps towards a root: a bracket of an arc is halved thirty times at most, and
/// between two halvings there may be a step of Newton's.
const STEPS: usize = 60;

/// Where an arm may have a solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Roots {
    pub angles: [f64; MOST],
    pub count: usize,
    /// Bit i is set where candidate i is two.
    double: u32,
    /// Bit i is set where candidate i may be none, or any number.
    several: u32,
    /// Bit i is set where f hardly changes at candidate i.
    flat: u32,
    /// Whether there was no place for all of them.
    pub incomplete: bool,
}

impl Roots {
    /// Whether a candidate is two.
    pub fn is_double(&self, i: usize) -> bool {
        self.double >> i & 1 == 1
    }

    /// Whether a candidate may be none, or any number.
    pub fn is_several(&self, i: usize) -> bool {
        self.several >> i & 1 == 1
    }

    /// Whether another root is near a candidate, complex ones included.
    pub fn has_neighbour(&self, i: usize) -> bool {
        if self.flat >> i & 1 == 1 {
            return true;
        }
        let near = |j: usize| math::wrap(self.angles[j] - self.angles[i]).abs() < CLUSTER;
        (0..self.count).any(|j| j != i && near(j))
    }

    fn push(&mut self, angle: f64) {
        if self.count == MOST {
            self.incomplete = true;
            return;
        }
        self.angles[self.count] = angle;
        self.count += 1;
    }

    /// Where there are several, nobody knows how many, unless a neighbour tells of them.
    fn push_cluster(&mut self, angle: f64) {
        let near = |i: usize| self.is_several(i) && (self.angles[i] - angle).abs() < CLUSTER;
        if !(0..self.count).any(near) {
            self.several |= 1 << (self.count % MOST);
            self.push(angle);
        }
    }

    fn push_double(&mut self, angle: f64) {
        self.double |= 1 << (self.count % MOST);
        self.push(angle);
    }
}

struct Simple;

impl Dispatched<(&Search<'_>, &mut Roots)> for Simple {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>((search, found): (&Search, &mut Roots)) {
        search.newton(found);
    }
}

/// An interval of an arc with one root, and where it may be, from middle + 2 atan t.
#[derive(Clone, Copy)]
struct Bracket {
    middle: f64,
    ends: [f64; 2],
    guess: f64,
    rises: bool,
}

/// What the coefficients say.
enum Signs {
    None,
    /// One root, at about this share of the interval.
    One(f64),
    /// Two or none.
    Two,
    Many,
}

/// Of so many coefficients.
fn signs(coefficients: &[f64; PLACES], n: usize, noise: f64) -> Signs {
    let last = n - 1;
    let (mut least, mut changes) = ([coefficients[0].abs(); LANES], [0.0; LANES]);
    for vector in 0..(COEFFICIENTS - 1) / LANES {
        for k in 0..LANES {
            let i = LANES * vector + k;
            let (a, b) = (coefficients[i], coefficients[i + 1]);
            least[k] = math::select(b.abs() < least[k], b.abs(), least[k]);
            changes[k] += math::select(a * b < 0.0, 1.0, 0.0);
        }
    }
    let changes: f64 = changes.iter().sum();
    if least.iter().all(|&least| least > noise) {
        return match changes {
            0.0 => Signs::None,
            1.0 => {
                let change = |i: &usize| coefficients[*i] * coefficients[i + 1] < 0.0;
                let i = (0..last).find(change).unwrap_or(0);
                let (a, b) = (coefficients[i], coefficients[i + 1]);
                Signs::One((i as f64 + a / (a - b)) / last as f64)
            }
            2.0 => Signs::Two,
            _ => Signs::Many,
        };
    }
    let unsigned = |x: f64| x.is_nan() || x.abs() <= noise;
    if unsigned(coefficients[0]) || unsigned(coefficients[last]) {
        return Signs::Many;
    }
    let (mut before, mut changes, mut share) = (0, 0, 0.0);
    for i in 1..=last {
        let (a, b) = (coefficients[before], coefficients[i]);
        if unsigned(b) {
            continue;
        }
        // One without a sign between two of different signs changes nothing; more may
        // hide two roots.
        if a * b < 0.0 && i <= before + 2 {
            changes += 1;
            share = (before as f64 + a / (a - b) * (i - before) as f64) / last as f64;
        } else if i > before + 1 {
            return Signs::Many;
        }
        before = i;
    }
    match changes {
        0 => Signs::None,
        1 => Signs::One(share),
        2 => Signs::Two,
        _ => Signs::Many,
    }
}

/// Part of an arc.
#[derive(Clone, Copy)]
struct Interval {
    coefficients: [f64; PLACES],
    /// From middle + 2 atan t.
    t: [f64; 2],
}

impl Interval {
    /// At a share of it.
    fn at(&self, share: f64) -> f64 {
        self.t[0] + share * (self.t[1] - self.t[0])
    }

    /// Whether all that is known of the polynomial here is noise.
    fn is_unsigned(&self, n: usize, noise: f64) -> bool {
        self.coefficients[..n].iter().all(|x| x.abs() <= noise)
    }

    fn rises(&self) -> bool {
        self.coefficients[0] < 0.0
    }

    /// Becomes its upper part, and another one its lower.
    fn halve(&mut self, n: usize, lower: &mut Self) {
        let at = self.at(CUT);
        cut(&mut self.coefficients, n, &mut lower.coefficients);
        lower.t = [self.t[0], at];
        self.t[0] = at;
    }
}

/// The roots, in no order, in (−π, 2π] radians; a few that are none may be with
/// them.
pub(super) fn roots(f: &Harmonics) -> Roots {
    let mut found = Roots {
        angles: [0.0; MOST],
        count: 0,
        double: 0,
        several: 0,
        flat: 0,
        incomplete: false,
    };
    let mut search = Search {
        f,
        noise: UNSIGNED * f.noise,
        brackets: [Bracket {
            middle: 0.0,
            ends: [0.0; 2],
            guess: 0.0,
            rises: true,
        }; MOST],
        count: 0,
        halvings: 0,
        waiting: [Interval {
            coefficients: [0.0; PLACES],
            t: [0.0; 2],
        }; WAITING],
    };
    for (first, arcs) in (0..ARCS).step_by(LANES).zip(&on_arcs(f)) {
        for lane in 0..LANES {
            search.on_arc(first + lane, arcs, lane, &mut found);
        }
    }
    search.simple(&mut found);
    found
}

struct Search<'a> {
    f: &'a Harmonics,
    noise: f64,
    brackets: [Bracket; MOST],
    count: usize,
    halvings: usize,
    /// Intervals that are looked at later.
    waiting: [Interval; WAITING],
}

impl Search<'_> {
    fn on_arc(&mut self, arc: usize, arcs: &Arcs, lane: usize, found: &mut Roots) {
        let signed = arcs.least[lane] > self.noise;
        if signed && arcs.changes[lane] == 0.0 {
            return;
        }
        let t = [-REACH, REACH];
        if signed && arcs.changes[lane] == 1.0 {
            let guess = t[0] + arcs.share[lane] * (t[1] - t[0]);
            self.bracket(arc, t, guess, arcs.rises(lane), found);
            return;
        }
        let angle = |t: f64| middle(arc) + 2.0 * math::atan2(t, 1.0);
        let coefficients = arcs.of(lane);
        self.waiting[0] = Interval { coefficients, t };
        let (n, mut count) = (arcs.count, 1);
        while count > 0 {
            count -= 1;
            let interval = &self.waiting[count];
            let [low, high] = interval.t;
            match signs(&interval.coefficients, n, self.noise) {
                Signs::None => {}
                Signs::One(share) => {
                    let (guess, rises) = (interval.at(share), interval.rises());
                    self.bracket(arc, [low, high], guess, rises, found);
                }
                Signs::Two if self.extremum(arc, count, n, found) => {}
                Signs::Two | Signs::Many if 2.0 * (high - low) < NARROW => {
                    found.push_cluster(angle(0.5 * (low + high)));
                }
                Signs::Many if self.waiting[count].is_unsigned(n, self.noise) => {
                    let parts = math::ceil(2.0 * (high - low) / BLIND);
                    for part in 0..parts as usize {
                        let share = (part as f64 + 0.5) / parts;
                        found.push_cluster(angle(low + share * (high - low)));
                    }
                }
                Signs::Two | Signs::Many if self.halvings == HALVINGS || count + 2 > WAITING => {
                    found.push_cluster(angle(0.5 * (low + high)));
                    found.incomplete = true;
                }
                Signs::Two | Signs::Many => {
                    self.halvings += 1;
                    let (upper, lower) = self.waiting.split_at_mut(count + 1);
                    upper[count].halve(n, &mut lower[0]);
                    count += 2;
                }
            }
        }
    }

    /// An interval with one root, and where it may be.
    fn bracket(&mut self, arc: usize, ends: [f64; 2], guess: f64, rises: bool, found: &mut Roots) {
        let Some(place) = self.brackets.get_mut(self.count) else {
            found.incomplete = true;
            return;
        };
        *place = Bracket {
            middle: middle(arc),
            ends,
            guess,
            rises,
        };
        self.count += 1;
    }

    /// The roots on an interval that waits, with two or none, if g = (1 + t²)ᵈ f has one
    /// extremum there: the sign at that tells which. False if it may have more.
    fn extremum(&mut self, arc: usize, waiting: usize, n: usize, found: &mut Roots) -> bool {
        let interval = &self.waiting[waiting];
        let mut rise = [0.0; PLACES];
        for i in 0..n - 1 {
            rise[i] = interval.coefficients[i + 1] - interval.coefficients[i];
        }
        let last = rise[n - 2];
        rise[n - 1..].fill(last);
        let Signs::One(share) = signs(&rise, n - 1, self.noise) else {
            return false;
        };
        let [low, high] = interval.t;
        let (opens, at_ends) = (rise[0] < 0.0, interval.coefficients[0]);
        let (t, [f, curvature]) = self.steady(arc, interval.t, interval.at(share), n, opens);
        let blur = 2.0 * self.noise + 0.5 * CLOSE * curvature.abs();
        if f.abs() <= blur || f.is_nan() {
            let at = middle(arc) + 2.0 * math::atan2(t, 1.0);
            match curvature.abs() > CURVED {
                true => found.push_double(at),
                false => found.push_cluster(at),
            }
        } else if f * at_ends < 0.0 {
            // Where a parabola has them.
            let apart = 0.5 * math::sqrt((2.0 * f / curvature).abs());
            self.bracket(arc, [low, t], math::max(t - apart, low), !opens, found);
            let guess = -math::max(-(t + apart), -high);
            self.bracket(arc, [t, high], guess, opens, found);
        } else if f.abs() <= 2.0 * UNSIGNED * self.f.shift {
            // Next to a family of solutions what the target is rounded by parts two that meet.
            found.push_double(middle(arc) + 2.0 * math::atan2(t, 1.0));
        }
        true
    }

    /// Where g has its only extremum between two ends, with f and f″ there: Newton's method
    /// on g′, halving where it leaves the bracket. `opens` tells the sign of g″.
    fn steady(
        &self,
        arc: usize,
        [mut from, mut to]: [f64; 2],
        mut t: f64,
        n: usize,
        opens: bool,
    ) -> (f64, [f64; 2]) {
        let degree = (n / 2) as f64;
        let [x, y] = turn_of_middle(arc);
        let mut at = [0.0; 2];
        for _ in 0..STEPS {
            let share = 1.0 / (1.0 + t * t);
            let (c, s) = ((1.0 - t * t) * share, 2.0 * t * share);
            let [f, slope, curvature] = self.f.derivatives([x * c - y * s, y * c + x * s]);
            at = [f, curvature];
            // But for powers of 1 + t².
            let g = slope + degree * t * f;
            let change = 2.0 * share * (curvature + degree * t * slope) + degree * f;
            match (g < 0.0) == opens {
                true => from = t,
                false => to = t,
            }
            let newton = t - g / change;
            let next = match newton > from && newton < to {
                true => newton,
                false => 0.5 * (from + to),
            };
            let moved = (next - t).abs();
            t = next;
            if moved < EXTREMUM {
                break;
            }
        }
        (t, at)
    }

    /// Newton's method on all brackets at once, halving where it leaves them.
    fn simple(&self, found: &mut Roots) {
        dispatch::<Simple, _>((self, found));
    }

    #[inline(always)]
    fn newton(&self, found: &mut Roots) {
        for chunk in self.brackets[..self.count].chunks(LANES) {
            let at = |k: usize| chunk[k.min(chunk.len() - 1)];
            let (mut x, mut low, mut high) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            let (mut middle, mut rises) = ([0.0; LANES], [0.0; LANES]);
            for k in 0..LANES {
                let bracket = at(k);
                middle[k] = bracket.middle;
                (x[k], [low[k], high[k]]) = (bracket.guess, bracket.ends);
                rises[k] = if bracket.rises { 1.0 } else { -1.0 };
            }
            for k in 0..LANES {
                x[k] = middle[k] + 2.0 * lanes::angle(x[k], 1.0);
                low[k] = middle[k] + 2.0 * lanes::angle(low[k], 1.0);
                high[k] = middle[k] + 2.0 * lanes::angle(high[k], 1.0);
            }
            let mut slope = [0.0; LANES];
            for _ in 0..STEPS {
                let value;
                (value, slope) = self.f.value_and_slope(&x);
                let mut largest: f64 = 0.0;
                for k in 0..LANES {
                    let above = value[k] * rises[k] > 0.0;
                    low[k] = math::select(above, low[k], x[k]);
                    high[k] = math::select(above, x[k], high[k]);
                    let newton = x[k] - value[k] / slope[k];
                    let inside = (newton >= low[k]) & (newton <= high[k]);
                    let next = math::select(inside, newton, 0.5 * (low[k] + high[k]));
                    largest = math::max(largest, (next - x[k]).abs());
                    x[k] = next;
                }
                if largest < ROOT {
                    break;
                }
            }
            for (&x, slope) in x[..chunk.len()].iter().zip(slope) {
                found.flat |= u32::from(slope.abs() < FLAT) << (found.count % MOST);
                found.push(x);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generated::univariate::harmonics::samples;
    use core::f64::consts::TAU;

    /// Of degree 8, with these roots and none elsewhere.
    fn with_roots<const N: usize>(roots: [f64; N]) -> Harmonics {
        let count = samples(8);
        let mut values = [0.0; 24];
        for (i, value) in values.iter_mut().enumerate() {
            let at = TAU * i as f64 / count as f64;
            let product: f64 = roots.iter().map(|r| (0.5 * (at - r)).sin()).product();
            let others = (0..(16 - N) / 2).map(|k| 1.4 + (at - k as f64).cos());
            *value = product * others.product::<f64>();
        }
        Harmonics::new(8, &values)
    }

    /// How often candidates stand for a root.
    fn found(all: &Roots, root: f64) -> usize {
        let within = |i: usize| if all.is_several(i) { NARROW } else { 1e-5 };
        let near = (0..all.count).filter(|&i| math::wrap(all.angles[i] - root).abs() < within(i));
        near.map(|i| 1 + usize::from(all.is_double(i))).sum()
    }

    #[test]
    fn of_three_roots_next_to_each_other_none_is_lost() {
        // The middle of the interval that has the first two is where f bends the other way.
        for apart in [1e-5, 1.5e-5, 1e-4, 1e-3] {
            for shift in 0..200 {
                let first = 1.604_168 + 1e-5 * f64::from(shift);
                let all = [first, first + apart, first + 4e-4 + apart, 2.149, 4.3, 5.29];
                let told = roots(&with_roots(all));
                for root in all {
                    assert!(found(&told, root) > 0, "{root} of {all:?}: {told:?}");
                }
            }
        }
    }

    #[test]
    fn two_roots_that_have_met_are_one_candidate_and_two_that_missed_are_none() {
        let mut both = with_roots([1.1, 1.1, 2.0, 4.0]);
        let told = roots(&both);
        assert_eq!((told.count, found(&told, 1.1)), (3, 2), "{told:?}");
        let [_, _, curvature] = both.derivatives([1.1_f64.cos(), 1.1_f64.sin()]);
        both.cosines[0] += 1e-9 * curvature.signum();
        let told = roots(&both);
        assert_eq!((told.count, found(&told, 1.1)), (2, 0), "{told:?}");
    }
}
