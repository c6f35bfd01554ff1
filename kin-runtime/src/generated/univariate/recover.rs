//! The other joints from a value of the kept one.

use super::determinant::{Factors, Triangle};
use super::elimination::{AtValues, Elimination, Equations, Loop, SIZE, Vanishing, none};
use super::frames::Frames;
use super::lanes::{InLanes, LANES, Lanes, in_lanes};
use super::line::{ENTRIES, Lines};
use super::matrix::{Places, Vectors};
use super::sharing::{Eigenvalues, Ratio, monomial_vectors};
use crate::Pose;
use crate::generated::dispatch::{Dispatched, dispatch};

/// A null vector that misses zero by more than this was spoilt by a small pivot.
const SPOILT: f64 = 1e-9;

/// What is taken to less may be of solutions next to a value of the kept joint.
const NULL: f64 = 1e-2;

/// Configurations in lanes, by joint of the arm.
#[derive(Clone, Copy)]
pub(super) struct Starts {
    pub q: [[f64; LANES]; 6],
    /// How far two cosines and sines are from being of an angle, or powers of a slide: what an
    /// extraneous root shows itself by.
    pub inconsistency: [f64; LANES],
}

/// Where an eigenvalue and what is taken to zero are known to this share of how far the eigenvalues are
/// apart, so is a vector of monomials.
const KNOWN: f64 = 1e-4;

/// What is nearly taken to zero at values of the kept joint, in lanes: the first vectors are those
/// of a space of fewer.
pub(super) struct NullSpace<const N: usize> {
    pub vectors: [InAll; N],
    /// About how long what they are taken to is.
    lengths: [[f64; LANES]; N],
}

/// A vector in every lane.
pub(super) type InAll = [[f64; LANES]; SIZE];

impl<const N: usize> NullSpace<N> {
    /// How many vectors are taken to nearly nothing in a lane.
    pub fn dimension(&self, lane: usize) -> usize {
        let is_null = |length: &&[f64; LANES]| length[lane] < NULL;
        self.lengths.iter().filter(is_null).count()
    }
}

/// Starts from the vectors of monomials in a space.
pub(super) struct Shared<const N: usize> {
    pub starts: [Starts; N],
    eigenvalues: Eigenvalues<N>,
}

impl<const N: usize> Shared<N> {
    /// The starts in a lane, but for those of complex eigenvalues.
    pub fn real(&self, lane: usize) -> impl Iterator<Item = &Starts> {
        let is_real = move |&n: &usize| !self.eigenvalues.is_complex(n, lane);
        (0..N).filter(is_real).map(|n| &self.starts[n])
    }

    /// How many of the vectors in a lane are of no solution, complex or off by more than a solution
    /// may be: none where nobody knows.
    pub fn extraneous(&self, space: &NullSpace<N>, lane: usize, off: f64) -> usize {
        let error = space.lengths[N - 1][lane];
        // Not a number is not less.
        let is_known = error < KNOWN * self.eigenvalues.apart(lane);
        let is_none = |n: usize| {
            let inconsistency = self.starts[n].inconsistency[lane];
            self.eigenvalues.is_complex(n, lane) || inconsistency > off
        };
        match is_known {
            true => (0..N).filter(|&n| is_none(n)).count(),
            false => 0,
        }
    }
}

/// One elimination at one target.
pub(super) struct Recovery<'a> {
    pub elimination: &'a Elimination,
    pub places: Places,
    pub equations: Equations,
    round: Loop,
    vanishing: Vanishing<'a>,
    far_side: Lines<9>,
}

impl<'a> Recovery<'a> {
    pub fn new(elimination: &'a Elimination, frames: &Frames, target: &Pose) -> Self {
        let round = Loop::new(elimination, frames, target);
        let vanishing = elimination.vanishing(&round);
        let functionals = vanishing.functionals();
        let (far_side, equations) = dispatch::<Opened, _>((elimination.half, functionals, &round));
        Self {
            vanishing,
            elimination,
            places: Places::new(elimination),
            equations,
            round,
            far_side,
        }
    }

    /// The joints that go with values of the kept one.
    #[inline(never)]
    pub fn joints(&self, kept: &[f64; LANES]) -> Starts {
        in_lanes::<One, _>((self, kept))
    }

    /// N vectors at each of some values of the kept joint.
    pub fn null_space<const N: usize>(&self, kept: &[f64; LANES]) -> NullSpace<N> {
        in_lanes::<Nearly<N>, _>((self, kept))
    }

    /// The configurations that share a value of the kept joint or have nearly met there: those of
    /// the vectors in its null space that are monomials, told apart by a ratio.
    pub fn sharing<const N: usize>(
        &self,
        kept: &[f64; LANES],
        space: &[InAll; N],
        ratio: Ratio,
    ) -> Shared<N> {
        in_lanes::<Sharing<N>, _>((self, kept, space, ratio))
    }

    /// Where a monomial of the half tangents stands.
    #[inline(always)]
    fn column(&self, i: usize, j: usize) -> usize {
        usize::from(self.elimination.columns[(i + 4 * j) & 15] & 15)
    }

    #[inline(always)]
    fn of_null_vectors<L: Lanes>(&self, kept: L, null: &Vectors<L>) -> Starts {
        let [_, _, _, _, before, last] = self.round.slides;
        let last = match last {
            true => self.slide::<L, false>(null),
            false => self.angle::<L, false>(null),
        };
        let before = match before {
            true => self.slide::<L, true>(null),
            false => self.angle::<L, true>(null),
        };
        self.rest(kept, before, last)
    }

    /// The last joint, or the last but one: tan of its half is the share of two
    /// neighbouring powers, and sine and cosine are had without dividing.
    #[inline(always)]
    fn angle<L: Lanes, const BEFORE: bool>(&self, null: &Vectors<L>) -> L {
        let (mut y, mut x) = (L::ZERO, L::ZERO);
        for i in 0..3 {
            for j in 0..4 {
                let (low, high) = match BEFORE {
                    true => (self.column(j, i), self.column(j, i + 1)),
                    false => (self.column(i, j), self.column(i + 1, j)),
                };
                let (low, high) = (null[low], null[high]);
                y = y.plus(&(low + low), &high);
                x = x.plus(&(low - high), &(low + high));
            }
        }
        L::angle(y, x)
    }

    /// The same of a slide: its first power by the power before.
    #[inline(always)]
    fn slide<L: Lanes, const BEFORE: bool>(&self, null: &Vectors<L>) -> L {
        let (mut y, mut x) = (L::ZERO, L::ZERO);
        let [last, before] = self.elimination.powers;
        for j in 0..=usize::from(if BEFORE { last } else { before }.min(3)) {
            let (low, high) = match BEFORE {
                true => (self.column(j, 0), self.column(j, 1)),
                false => (self.column(0, j), self.column(1, j)),
            };
            let (low, high) = (null[low], null[high]);
            y = y.plus(&low, &high);
            x = x.plus(&low, &low);
        }
        y * x.inverse()
    }

    /// By what a joint, by its place in the loop, moves a line: its sine and cosine, or
    /// the square of its slide and the slide.
    #[inline(always)]
    fn functions<L: Lanes>(&self, place: usize, value: L) -> [L; 2] {
        match self.round.slides[place] {
            true => [value * value, value],
            false => value.sin_cos(),
        }
    }

    /// The joint's value by these, and how far they are from being of one.
    #[inline(always)]
    fn value<L: Lanes>(&self, place: usize, [s, c]: [L; 2]) -> [L; 2] {
        let square = c * c;
        match self.round.slides[place] {
            true => [c, (square - s) * (L::ONE + square).inverse()],
            false => [L::angle(s, c), square.plus(&s, &s) - L::ONE],
        }
    }

    #[inline(always)]
    fn null_vectors<L: Lanes>(&self, equations: &AtValues<L>) -> Vectors<L> {
        let places = &self.places;
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
        let ([null], _) = Triangle::new(places, equations).null_space();
        null
    }

    #[inline(always)]
    fn rest<L: Lanes>(&self, kept: L, before: L, last: L) -> Starts {
        let [sk, ck] = kept.sin_cos();
        let [sb, cb] = self.functions(4, before);
        let [sl, cl] = self.functions(5, last);
        let mut line = [L::ZERO; ENTRIES];
        for (line, far) in line.iter_mut().zip(&self.far_side) {
            let mut parts = [L::ZERO; 3];
            for (part, far) in parts.iter_mut().zip(far.chunks_exact(3)) {
                *part = L::splat(far[0])
                    .plus_scaled(&cb, far[1])
                    .plus_scaled(&sb, far[2]);
            }
            *line = parts[0].plus(&parts[1], &cl).plus(&parts[2], &sl);
        }
        for v in [0, 3, 6, 9] {
            let (x, y) = (line[v], line[v + 1]);
            line[v] = (x * ck).plus(&y, &sk);
            line[v + 1] = (y * ck).minus(&x, &sk);
        }
        let mut functions = [L::ZERO; 2];
        for (out, functional) in functions.iter_mut().zip(self.vanishing.third()) {
            for (f, line) in functional.iter().zip(&line) {
                *out = out.plus_scaled(line, *f);
            }
        }
        let [c3, s3] = functions;
        let [third, third_off] = self.value(2, [s3, c3]);
        let [second, second_off] = self.second(&line, self.functions(2, third));
        let fourth = self.fourth([
            [sk, ck],
            self.functions(1, second),
            self.functions(2, third),
            [sb, cb],
            [sl, cl],
        ]);
        let sign = if self.elimination.backwards {
            -1.0
        } else {
            1.0
        };
        let mut q = [[0.0; LANES]; 6];
        let values = [kept, second, third, fourth, before, last];
        for (joint, value) in self.elimination.joints.iter().zip(values) {
            q[usize::from(*joint) % 6] = value.scaled(sign).numbers();
        }
        Starts {
            q,
            inconsistency: second_off.max(third_off.abs()).numbers(),
        }
    }

    /// The second joint, which takes the fourth's axis and the point on it from where the third
    /// leaves them to where they are seen in the frame of the kept one; and how far it misses.
    #[inline(always)]
    fn second<L: Lanes>(&self, line: &[L; ENTRIES], third: [L; 2]) -> [L; 2] {
        let [kept, second, third_on, ..] = &self.round.behind;
        let (mut axis, mut point, mut far_point) = ([L::ZERO; 3], [L::ZERO; 3], [L::ZERO; 3]);
        for i in 0..3 {
            axis[i] = L::splat(third_on.rotation[i][2]);
            point[i] = L::splat(third_on.translation[i]);
            far_point[i] = line[3 + i] - L::splat(kept.translation[i]);
        }
        let (l, p) = self.moved(2, third, &axis, &point);
        let near = [
            rotated(&second.rotation, &l),
            shifted(second, &rotated(&second.rotation, &p)),
        ];
        let far = [
            rotated_back(&kept.rotation, &[line[0], line[1], line[2]]),
            rotated_back(&kept.rotation, &far_point),
        ];
        let value = match self.round.slides[1] {
            true => far[1][2] - near[1][2],
            false => {
                let (mut s, mut c) = (L::ZERO, L::ZERO);
                for i in 0..2 {
                    let (near, far) = (&near[i], &far[i]);
                    s = s.plus(&near[0], &far[1]).minus(&near[1], &far[0]);
                    c = c.plus(&near[0], &far[0]).plus(&near[1], &far[1]);
                }
                L::angle(s, c)
            }
        };
        let (l, p) = self.moved(1, self.functions(1, value), &near[0], &near[1]);
        let mut off = L::ZERO;
        for i in 0..3 {
            off = off.max((l[i] - far[0][i]).abs());
            off = off.max((p[i] - far[1][i]).abs());
        }
        [value, off]
    }

    /// A direction and a point as a joint moves them, by its place in the loop and what
    /// [`Self::functions`] says of it.
    #[inline(always)]
    fn moved<L: Lanes>(
        &self,
        place: usize,
        [s, c]: [L; 2],
        l: &[L; 3],
        p: &[L; 3],
    ) -> ([L; 3], [L; 3]) {
        let turned = |x: &[L; 3]| {
            [
                (c * x[0]).minus(&s, &x[1]),
                (s * x[0]).plus(&c, &x[1]),
                x[2],
            ]
        };
        match self.round.slides[place] {
            true => (*l, [p[0], p[1], p[2] + c]),
            false => (turned(l), turned(p)),
        }
    }

    /// The joint whose axis was followed: where its x axis goes the other way
    /// round. Of the others, sine and cosine; slides do not turn it.
    #[inline(always)]
    fn fourth<L: Lanes>(&self, [kept, second, third, before, last]: [[L; 2]; 5]) -> L {
        let mut x = [L::ONE, L::ZERO, L::ZERO];
        for (i, [s, c]) in [(3, before), (4, last), (5, kept), (0, second), (1, third)] {
            x = rotated_back(&self.round.behind[i].rotation, &x);
            if self.round.slides[(i + 1) % 6] {
                continue;
            }
            (x[0], x[1]) = ((c * x[0]).plus(&s, &x[1]), (c * x[1]).minus(&s, &x[0]));
        }
        x = rotated_back(&self.round.behind[2].rotation, &x);
        L::angle(x[1], x[0])
    }
}

/// The far side of the loop, and the equations.
struct Opened;
struct One;
struct Nearly<const N: usize>;
struct Sharing<const N: usize>;

impl Dispatched<(u8, &[[f64; ENTRIES]], &Loop)> for Opened {
    type Output = (Lines<9>, Equations);

    #[inline(always)]
    fn run<const FUSED: bool>(
        (half, functionals, round): (u8, &[[f64; ENTRIES]], &Loop),
    ) -> Self::Output {
        let far_side = round.far_side();
        let equations = Equations::new(half, functionals, round, &far_side);
        (far_side, equations)
    }
}

impl InLanes<(&Recovery<'_>, &[f64; LANES])> for One {
    type Output = Starts;

    #[inline(always)]
    fn run<L: Lanes>((recovery, kept): (&Recovery, &[f64; LANES])) -> Starts {
        let kept = L::of(*kept);
        let [sine, cosine] = kept.scaled(0.5).sin_cos();
        let mut equations = none();
        recovery.equations.write(cosine, sine, &mut equations);
        let null = recovery.null_vectors(&equations);
        recovery.of_null_vectors(kept, &null)
    }
}

impl<const N: usize> InLanes<(&Recovery<'_>, &[f64; LANES])> for Nearly<N> {
    type Output = NullSpace<N>;

    #[inline(always)]
    fn run<L: Lanes>((recovery, kept): (&Recovery, &[f64; LANES])) -> NullSpace<N> {
        let [sine, cosine] = L::of(*kept).scaled(0.5).sin_cos();
        let mut equations = none();
        recovery.equations.write(cosine, sine, &mut equations);
        let (space, lengths) = Triangle::new(&recovery.places, &equations).null_space::<N>();
        let mut out = NullSpace {
            vectors: [[[0.0; LANES]; SIZE]; N],
            lengths: [[0.0; LANES]; N],
        };
        for n in 0..N {
            out.lengths[n] = lengths[n].numbers();
            for (out, entry) in out.vectors[n].iter_mut().zip(&space[n]) {
                *out = entry.numbers();
            }
        }
        out
    }
}

impl<const N: usize> InLanes<(&Recovery<'_>, &[f64; LANES], &[InAll; N], Ratio)> for Sharing<N> {
    type Output = Shared<N>;

    #[inline(always)]
    fn run<L: Lanes>(
        (recovery, kept, space, ratio): (&Recovery, &[f64; LANES], &[InAll; N], Ratio),
    ) -> Shared<N> {
        let kept = L::of(*kept);
        let mut vectors = [[L::ZERO; SIZE]; N];
        for (out, x) in vectors
            .as_flattened_mut()
            .iter_mut()
            .zip(space.as_flattened())
        {
            *out = L::of(*x);
        }
        let [last, before] = recovery.elimination.powers;
        let powers = [usize::from(last.min(3)), usize::from(before.min(3))];
        let column = |i, j| recovery.column(i, j);
        let (vectors, eigenvalues) = monomial_vectors(&vectors, &column, powers, ratio);
        let mut starts = [recovery.of_null_vectors(kept, &vectors[0]); N];
        for n in 1..N {
            starts[n] = recovery.of_null_vectors(kept, &vectors[n]);
        }
        Shared {
            starts,
            eigenvalues,
        }
    }
}

#[inline(always)]
fn rotated<L: Lanes>(r: &[[f64; 3]; 3], x: &[L; 3]) -> [L; 3] {
    let mut out = [L::ZERO; 3];
    for (out, row) in out.iter_mut().zip(r) {
        *out = x[0]
            .scaled(row[0])
            .plus_scaled(&x[1], row[1])
            .plus_scaled(&x[2], row[2]);
    }
    out
}

#[inline(always)]
fn shifted<L: Lanes>(by: &Pose, x: &[L; 3]) -> [L; 3] {
    let mut out = *x;
    for (out, t) in out.iter_mut().zip(by.translation) {
        *out += L::splat(t);
    }
    out
}

#[inline(always)]
fn rotated_back<L: Lanes>(r: &[[f64; 3]; 3], x: &[L; 3]) -> [L; 3] {
    let mut out = [L::ZERO; 3];
    for (i, out) in out.iter_mut().enumerate() {
        *out = x[0]
            .scaled(r[0][i])
            .plus_scaled(&x[1], r[1][i])
            .plus_scaled(&x[2], r[2][i]);
    }
    out
}
