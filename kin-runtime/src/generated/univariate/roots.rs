//! All real roots of a trigonometric polynomial.
//!
//! Descartes' rule of signs in Bernstein's basis bounds the number of roots on
//! an interval and has its parity (G. E. Collins and A. G. Akritas, SYMSAC
//! 1976; J. M. Lane and R. F. Riesenfeld, BIT 21, 1981): no change of sign means
//! none, one means one. Halving does the rest, with a bound on its steps;
//! intervals on which the signs are those of rounding end at a width at which
//! two terms of Taylor's series tell all.

use super::LANES;
use super::bernstein::{ARCS, Arcs, COEFFICIENTS, REACH, middle, on_arcs};
use super::harmonics::Harmonics;
use crate::generated::dispatch::{Dispatched, dispatch};
use crate::math;

/// Candidates at most: more than a polynomial of the highest degree has roots.
pub(super) const MOST: usize = 32;

/// Halvings at most, in all: roots that are near each other take ten for each
/// pair, and no polynomial has more than twelve.
const HALVINGS: usize = 192;

/// Intervals that wait at a time: one of each halving on the way.
const WAITING: usize = 16;

/// In multiples of the noise, what a coefficient may be without having a sign.
const UNSIGNED: f64 = 256.0;

/// Below this an interval, in radians, is told by Taylor's series.
const NARROW: f64 = 4e-4;

/// Clusters that are nearer to each other are one, radians.
pub(super) const CLUSTER: f64 = 5e-3;

/// Two roots that are nearer to each other than twice the root of this are one
/// candidate, radians².
const CLOSE: f64 = 1e-12;

/// Where f″ is above this, relative to the largest harmonic, two roots are no more than
/// two: of three or more, it would be what rounding leaves.
const CURVED: f64 = 1e-4;

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

    /// Whether another candidate is near one.
    pub fn has_neighbour(&self, i: usize) -> bool {
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
    fn run((search, found): (&Search, &mut Roots)) {
        search.newton(found);
    }
}

/// An interval with one root, radians, and where it may be.
#[derive(Clone, Copy)]
struct Bracket {
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

fn signs(coefficients: &[f64], noise: f64) -> Signs {
    let last = coefficients.len() - 1;
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
    coefficients: [f64; COEFFICIENTS],
    /// From middle + 2 atan t.
    t: [f64; 2],
}

impl Interval {
    /// Leaves the upper part, and gives the lower, by de Casteljau's algorithm; not quite
    /// halves, since roots like to be in the middle.
    fn halve(&mut self, n: usize, low: &mut Self) {
        const SHARE: f64 = 0.4871;
        let cut = self.t[0] + SHARE * (self.t[1] - self.t[0]);
        low.t = [self.t[0], cut];
        self.t[0] = cut;
        for i in 0..n {
            low.coefficients[i] = self.coefficients[0];
            for j in 0..n - 1 - i {
                let (a, b) = (self.coefficients[j], self.coefficients[j + 1]);
                self.coefficients[j] = a + SHARE * (b - a);
            }
        }
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
        incomplete: false,
    };
    let mut search = Search {
        f,
        noise: UNSIGNED * f.noise,
        brackets: [Bracket {
            ends: [0.0; 2],
            guess: 0.0,
            rises: true,
        }; MOST],
        count: 0,
        halvings: 0,
        waiting: [Interval {
            coefficients: [0.0; COEFFICIENTS],
            t: [0.0; 2],
        }; WAITING],
    };
    for (first, arcs) in (0..ARCS).step_by(LANES).zip(on_arcs(f)) {
        for lane in 0..LANES {
            search.on_arc(middle(first + lane), &arcs, lane, &mut found);
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
    fn on_arc(&mut self, middle: f64, arcs: &Arcs, lane: usize, found: &mut Roots) {
        let signed = arcs.least[lane] > self.noise;
        if signed && arcs.changes[lane] == 0.0 {
            return;
        }
        let n = arcs.count;
        let whole = Interval {
            coefficients: arcs.of(lane),
            t: [-REACH, REACH],
        };
        if signed && arcs.changes[lane] == 1.0 {
            self.bracket(middle, &whole, arcs.share[lane], found);
            return;
        }
        let angle = |t: f64| middle + 2.0 * math::atan2(t, 1.0);
        self.waiting[0] = whole;
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let interval = &self.waiting[count];
            let [low, high] = interval.t;
            match signs(&interval.coefficients[..n], self.noise) {
                Signs::None => {}
                Signs::One(share) => {
                    let interval = *interval;
                    self.bracket(middle, &interval, share, found);
                }
                Signs::Two if 2.0 * (high - low) < NARROW => {
                    self.narrow([angle(low), angle(high)], found);
                }
                Signs::Many if 2.0 * (high - low) < NARROW => {
                    found.push_cluster(angle(0.5 * (low + high)));
                }
                Signs::Two | Signs::Many if self.halvings == HALVINGS || count + 2 > WAITING => {
                    found.push_cluster(angle(0.5 * (low + high)));
                }
                Signs::Two | Signs::Many => {
                    self.halvings += 1;
                    let (first, second) = self.waiting[count..].split_at_mut(1);
                    first[0].halve(n, &mut second[0]);
                    count += 2;
                }
            }
        }
    }

    /// An interval with one root, at about a share of it.
    fn bracket(&mut self, middle: f64, interval: &Interval, share: f64, found: &mut Roots) {
        let Some(place) = self.brackets.get_mut(self.count) else {
            found.incomplete = true;
            return;
        };
        let [low, high] = interval.t;
        let angle = |t: f64| middle + 2.0 * math::atan2(t, 1.0);
        *place = Bracket {
            ends: [angle(low), angle(high)],
            guess: angle(low + share * (high - low)),
            rises: interval.coefficients[0] < 0.0,
        };
        self.count += 1;
    }

    /// The roots on an interval on which f is a parabola.
    fn narrow(&mut self, [low, high]: [f64; 2], found: &mut Roots) {
        let width = high - low;
        let mut at = 0.5 * (low + high);
        let mut values = [0.0; 3];
        for _ in 0..6 {
            values = self.f.derivatives(at);
            let step = values[1] / values[2];
            if step.is_nan() || (at - step - 0.5 * (low + high)).abs() > 1.5 * width {
                break;
            }
            at -= step;
            if step.abs() < 1e-12 {
                break;
            }
        }
        values = if (at - 0.5 * (low + high)).abs() <= 1.5 * width {
            self.f.derivatives(at)
        } else {
            values
        };
        let square = -2.0 * values[0] / values[2];
        let blur = CLOSE + 4.0 * self.noise / values[2].abs();
        let flat = (values[1] / values[2]).abs() < width;
        if flat && square > blur {
            let apart = math::sqrt(square);
            found.push(at - apart);
            found.push(at + apart);
        } else if flat && square > -blur || square.is_nan() {
            match values[2].abs() > CURVED {
                true => found.push_double(at),
                false => found.push_cluster(at),
            }
        } else {
            let [a, b] = [low, high].map(|at| self.f.derivatives(at)[0]);
            if a * b <= 0.0 || a.abs().min(b.abs()) <= self.noise {
                let guess = if a == b {
                    low
                } else {
                    low + width * (a / (a - b)).clamp(0.0, 1.0)
                };
                found.push(guess);
            }
        }
    }

    /// Newton's method on all brackets at once, halving where it leaves them.
    fn simple(&self, found: &mut Roots) {
        dispatch::<Simple, _>((self, found));
    }

    #[inline(always)]
    fn newton(&self, found: &mut Roots) {
        for chunk in self.brackets[..self.count].chunks(LANES) {
            let at = |k: usize| chunk[k.min(chunk.len() - 1)];
            let mut x: [f64; LANES] = core::array::from_fn(|k| at(k).guess);
            let mut low: [f64; LANES] = core::array::from_fn(|k| at(k).ends[0]);
            let mut high: [f64; LANES] = core::array::from_fn(|k| at(k).ends[1]);
            let rises: [f64; LANES] =
                core::array::from_fn(|k| if at(k).rises { 1.0 } else { -1.0 });
            for _ in 0..STEPS {
                let (value, slope) = self.f.value_and_slope(&x);
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
            for &x in &x[..chunk.len()] {
                found.push(x);
            }
        }
    }
}
