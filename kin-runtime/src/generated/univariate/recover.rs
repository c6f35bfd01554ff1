//! The other joints from a value of the kept one.

use super::determinant::{Factors, Triangle};
use super::elimination::{Elimination, Equations, Loop};
use super::lanes::{InLanes, LANES, Lanes, in_lanes};
use super::line::{ENTRIES, Lines};
use super::matrix::{Places, Vectors};
use super::sharing::{SHARING, monomial_vectors};

/// A null vector that misses zero by more than this was spoilt by a small pivot.
const SPOILT: f64 = 1e-9;

/// Configurations in lanes, radians, by joint of the arm.
#[derive(Clone, Copy)]
pub(super) struct Starts {
    pub q: [[f64; LANES]; 6],
    /// How far two cosines and sines are from being of an angle: what an
    /// extraneous root shows itself by.
    pub inconsistency: [f64; LANES],
}

/// One elimination at one target.
pub(super) struct Recovery<'a> {
    pub elimination: &'a Elimination,
    pub round: &'a Loop,
    pub far_side: &'a Lines<9>,
    pub equations: &'a Equations,
}

impl Recovery<'_> {
    /// The joints that go with values of the kept one.
    #[inline(never)]
    pub fn joints(&self, kept: &[f64; LANES]) -> Starts {
        in_lanes::<One, _>((self, kept))
    }

    /// Two configurations at each of some values of the kept joint, which share it or
    /// have nearly met there: of what is nearly taken to zero, the vectors that are monomials.
    pub fn pairs(&self, kept: &[f64; LANES]) -> [Starts; 2] {
        in_lanes::<Several<2>, _>((self, kept))
    }

    /// The same of up to [`SHARING`].
    pub fn sharing(&self, kept: &[f64; LANES]) -> [Starts; SHARING] {
        in_lanes::<Several<SHARING>, _>((self, kept))
    }

    /// Where a monomial of the half tangents stands.
    #[inline(always)]
    fn column(&self, i: usize, j: usize) -> usize {
        usize::from(self.elimination.columns[(i + 4 * j) & 15] & 15)
    }

    #[inline(always)]
    fn of_null_vectors<L: Lanes>(&self, kept: L, null: &Vectors<L>) -> Starts {
        let last = self.eliminated::<L, false>(null);
        let before = self.eliminated::<L, true>(null);
        self.rest(kept, before, last)
    }

    /// The last joint, or the last but one: tan of its half is the share of two
    /// neighbouring powers, and sine and cosine are had without dividing.
    #[inline(always)]
    fn eliminated<L: Lanes, const BEFORE: bool>(&self, null: &Vectors<L>) -> L {
        let (mut y, mut x) = (L::ZERO, L::ZERO);
        for i in 0..3 {
            for j in 0..4 {
                let (low, high) = match BEFORE {
                    true => (self.column(j, i), self.column(j, i + 1)),
                    false => (self.column(i, j), self.column(i + 1, j)),
                };
                let (low, high) = (null[low], null[high]);
                y = y.plus(low + low, high);
                x = x.plus(low - high, low + high);
            }
        }
        L::angle(y, x)
    }

    #[inline(always)]
    fn null_vectors<L: Lanes>(&self, places: &Places, equations: &[[L; 9]; 6]) -> Vectors<L> {
        let mut factors = Factors::EMPTY;
        factors.factor(places, equations);
        let null = factors.null_vectors();
        let mut miss = L::ZERO;
        for entry in places.times(equations, &null) {
            miss = miss.max(entry.abs());
        }
        // Not a number is not less.
        if miss.numbers().iter().all(|&x| x < SPOILT) {
            return null;
        }
        let [null] = Triangle::new(places.matrices(equations)).null_space();
        null
    }

    #[inline(always)]
    fn rest<L: Lanes>(&self, kept: L, before: L, last: L) -> Starts {
        let [sk, ck] = kept.sin_cos();
        let [sb, cb] = before.sin_cos();
        let [sl, cl] = last.sin_cos();
        let mut line = [L::ZERO; ENTRIES];
        for (line, far) in line.iter_mut().zip(self.far_side) {
            let mut parts = [L::ZERO; 3];
            for (part, far) in parts.iter_mut().zip(far.chunks_exact(3)) {
                *part = L::splat(far[0])
                    .plus_scaled(cb, far[1])
                    .plus_scaled(sb, far[2]);
            }
            *line = parts[0].plus(parts[1], cl).plus(parts[2], sl);
        }
        for v in [0, 3, 6, 9] {
            let (x, y) = (line[v], line[v + 1]);
            line[v] = (x * ck).plus(y, sk);
            line[v + 1] = (y * ck).minus(x, sk);
        }
        let mut pair = [L::ZERO; 4];
        for (out, functional) in pair.iter_mut().zip(&self.elimination.pair) {
            for (f, line) in functional.iter().zip(&line) {
                *out = out.plus_scaled(*line, *f);
            }
        }
        let [c2, s2, c3, s3] = pair;
        let second_off = (c2 * c2).plus(s2, s2) - L::ONE;
        let third_off = (c3 * c3).plus(s3, s3) - L::ONE;
        let (second, third) = (L::angle(s2, c2), L::angle(s3, c3));
        let fourth = self.fourth([
            [sk, ck],
            second.sin_cos(),
            third.sin_cos(),
            [sb, cb],
            [sl, cl],
        ]);
        let sign = if self.elimination.backwards {
            -1.0
        } else {
            1.0
        };
        let mut q = [[0.0; LANES]; 6];
        let angles = [kept, second, third, fourth, before, last];
        for (joint, angle) in self.elimination.joints.iter().zip(angles) {
            q[usize::from(*joint) % 6] = angle.scaled(sign).numbers();
        }
        Starts {
            q,
            inconsistency: second_off.abs().max(third_off.abs()).numbers(),
        }
    }

    /// The joint whose axis was followed: where its x axis goes the other way
    /// round. Of the others, sine and cosine.
    #[inline(always)]
    fn fourth<L: Lanes>(&self, [kept, second, third, before, last]: [[L; 2]; 5]) -> L {
        let mut x = [L::ONE, L::ZERO, L::ZERO];
        for (i, [s, c]) in [(3, before), (4, last), (5, kept), (0, second), (1, third)] {
            x = rotated_back(&self.round.behind[i].rotation, &x);
            (x[0], x[1]) = ((c * x[0]).plus(s, x[1]), (c * x[1]).minus(s, x[0]));
        }
        x = rotated_back(&self.round.behind[2].rotation, &x);
        L::angle(x[1], x[0])
    }
}

struct One;
struct Several<const N: usize>;

impl InLanes<(&Recovery<'_>, &[f64; LANES])> for One {
    type Output = Starts;

    #[inline(always)]
    fn run<L: Lanes>((recovery, kept): (&Recovery, &[f64; LANES])) -> Starts {
        let kept = L::of(*kept);
        let [sine, cosine] = kept.scaled(0.5).sin_cos();
        let equations = recovery.equations.at(cosine, sine);
        let places = Places::new(recovery.elimination);
        let null = recovery.null_vectors(&places, &equations);
        recovery.of_null_vectors(kept, &null)
    }
}

impl<const N: usize> InLanes<(&Recovery<'_>, &[f64; LANES])> for Several<N> {
    type Output = [Starts; N];

    #[inline(always)]
    fn run<L: Lanes>((recovery, kept): (&Recovery, &[f64; LANES])) -> [Starts; N] {
        let kept = L::of(*kept);
        let [sine, cosine] = kept.scaled(0.5).sin_cos();
        let equations = recovery.equations.at(cosine, sine);
        let matrices = Places::new(recovery.elimination).matrices(&equations);
        let space = Triangle::new(matrices).null_space::<N>();
        let vectors = monomial_vectors(&space, &|i, j| recovery.column(i, j));
        let mut out = [recovery.of_null_vectors(kept, &vectors[0]); N];
        for (out, null) in out.iter_mut().zip(&vectors).skip(1) {
            *out = recovery.of_null_vectors(kept, null);
        }
        out
    }
}

#[inline(always)]
fn rotated_back<L: Lanes>(r: &[[f64; 3]; 3], x: &[L; 3]) -> [L; 3] {
    let mut out = [L::ZERO; 3];
    for (i, out) in out.iter_mut().enumerate() {
        *out = x[0]
            .scaled(r[0][i])
            .plus_scaled(x[1], r[1][i])
            .plus_scaled(x[2], r[2][i]);
    }
    out
}
