//! The other joints from a value of the kept one.

use super::LANES;
use super::determinant::{
    Matrices, Vectors, eliminate, null_plane_of_triangle, null_space_of_triangle,
    null_vector_of_factors, null_vector_of_triangle, reflect, times,
};
use super::elimination::{Elimination, Equations, Loop, SIZE};
use super::line::{ENTRIES, Lines};
use super::pair;
use super::sharing::{self, SHARING};
use crate::generated::dispatch::{Dispatched, dispatch};
use crate::generated::lanes::{angle, sin_cos};
use crate::math;

type Lanes = [f64; LANES];

/// A null vector that misses zero by more than this was spoilt by a small pivot.
const SPOILT: f64 = 1e-9;

/// Configurations as array lanes, radians, by joint of the arm.
pub(super) struct Starts {
    pub q: [Lanes; 6],
    /// How far two cosines and sines are from being of an angle: what an
    /// extraneous root shows itself by.
    pub inconsistency: Lanes,
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
    pub fn joints(&self, kept: &Lanes) -> Starts {
        dispatch::<One, _>((self, kept))
    }

    #[inline(always)]
    fn one(&self, kept: &Lanes) -> Starts {
        let (sine, cosine) = sin_cos(kept.map(|x| 0.5 * x));
        let null = self.null_vectors(&cosine, &sine);
        self.of_null_vectors(kept, &null)
    }

    /// What several configurations each have in common that share a value of the kept
    /// joint, or have nearly met there.
    pub fn several<'r>(&'r self, kept: &'r Lanes) -> Several<'r> {
        Several {
            recovery: self,
            kept,
            triangle: dispatch::<Triangle, _>((self, kept)),
        }
    }

    #[inline(always)]
    fn triangle(&self, kept: &Lanes) -> Matrices<LANES> {
        let (sine, cosine) = sin_cos(kept.map(|x| 0.5 * x));
        let mut triangle = [[[0.0; LANES]; SIZE]; SIZE];
        self.equations
            .write(self.elimination, &cosine, &sine, &mut triangle);
        reflect(&mut triangle);
        triangle
    }

    /// Where a monomial of the half tangents stands.
    #[inline(always)]
    fn column(&self, i: usize, j: usize) -> usize {
        usize::from(self.elimination.columns[(i + 4 * j) & 15] & 15)
    }

    #[inline(always)]
    fn of_null_vectors(&self, kept: &Lanes, null: &Vectors<LANES>) -> Starts {
        let last = self.eliminated::<false>(null);
        let before = self.eliminated::<true>(null);
        self.rest(kept, &before, &last)
    }

    /// The last joint, or the last but one: tan of its half is the share of two
    /// neighbouring powers, and sine and cosine are had without dividing.
    #[inline(always)]
    fn eliminated<const BEFORE: bool>(&self, null: &Vectors<LANES>) -> Lanes {
        let (mut y, mut x) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..3 {
            for j in 0..4 {
                let [low, high] = [i, i + 1].map(|i| match BEFORE {
                    true => &null[self.column(j, i)],
                    false => &null[self.column(i, j)],
                });
                for k in 0..LANES {
                    y[k] += 2.0 * low[k] * high[k];
                    x[k] += (low[k] - high[k]) * (low[k] + high[k]);
                }
            }
        }
        let mut angles = [0.0; LANES];
        for k in 0..LANES {
            angles[k] = angle(y[k], x[k]);
        }
        angles
    }

    #[inline(always)]
    fn null_vectors(&self, cosine: &Lanes, sine: &Lanes) -> Vectors<LANES> {
        let mut matrix = [[[0.0; LANES]; SIZE]; SIZE];
        self.equations
            .write(self.elimination, cosine, sine, &mut matrix);
        let mut factors = matrix;
        eliminate(&mut factors, self.elimination.shifted());
        let null = null_vector_of_factors(&factors);
        let miss = times(&matrix, &null);
        let worst = miss
            .iter()
            .flatten()
            .fold(0.0, |a, &b: &f64| math::max(a, b.abs()));
        let is_number = null.iter().flatten().all(|x| x.is_finite());
        if is_number && worst < SPOILT {
            return null;
        }
        reflect(&mut matrix);
        null_vector_of_triangle(&matrix)
    }

    #[inline(always)]
    fn rest(&self, kept: &Lanes, before: &Lanes, last: &Lanes) -> Starts {
        let (sk, ck) = sin_cos(*kept);
        let (sb, cb) = sin_cos(*before);
        let (sl, cl) = sin_cos(*last);
        let mut line = [[0.0; LANES]; ENTRIES];
        for (line, far) in line.iter_mut().zip(self.far_side) {
            for k in 0..LANES {
                let of = |i: usize| far[i] + far[i + 1] * cb[k] + far[i + 2] * sb[k];
                line[k] = of(0) + of(3) * cl[k] + of(6) * sl[k];
            }
        }
        for v in [0, 3, 6, 9] {
            for k in 0..LANES {
                let (x, y) = (line[v][k], line[v + 1][k]);
                line[v][k] = x * ck[k] + y * sk[k];
                line[v + 1][k] = y * ck[k] - x * sk[k];
            }
        }
        let mut pair = [[0.0; LANES]; 4];
        for (out, functional) in pair.iter_mut().zip(&self.elimination.pair) {
            for (f, line) in functional.iter().zip(&line) {
                for k in 0..LANES {
                    out[k] += f * line[k];
                }
            }
        }
        let mut inconsistency = [0.0; LANES];
        let [mut second, mut third] = [[0.0; LANES]; 2];
        for k in 0..LANES {
            let [c2, s2, c3, s3] = pair.map(|x| x[k]);
            let off = |c: f64, s: f64| (c * c + s * s - 1.0).abs();
            inconsistency[k] = math::max(off(c2, s2), off(c3, s3));
            (second[k], third[k]) = (angle(s2, c2), angle(s3, c3));
        }
        let angles = [*kept, second, third, [0.0; LANES], *before, *last];
        let fourth = self.fourth(&angles);
        let mut q = [[0.0; LANES]; 6];
        let sign = if self.elimination.backwards {
            -1.0
        } else {
            1.0
        };
        for (i, joint) in self.elimination.joints.iter().enumerate() {
            let angles = if i == 3 { &fourth } else { &angles[i] };
            q[usize::from(*joint) % 6] = angles.map(|x| sign * x);
        }
        Starts { q, inconsistency }
    }

    /// The joint whose axis was followed: where its x axis goes the other way
    /// round.
    #[inline(always)]
    fn fourth(&self, angles: &[Lanes; 6]) -> Lanes {
        let mut x = [[1.0; LANES], [0.0; LANES], [0.0; LANES]];
        for i in [3, 4, 5, 0, 1, 2] {
            x = rotated_back(&self.round.behind[i].rotation, &x);
            if i != 2 {
                x = turned_back(&x, &angles[(i + 1) % 6]);
            }
        }
        let mut angles = [0.0; LANES];
        for k in 0..LANES {
            angles[k] = angle(x[1][k], x[0][k]);
        }
        angles
    }
}

struct One;
struct Two;
struct Triangle;

impl Dispatched<(&Recovery<'_>, &Lanes)> for One {
    type Output = Starts;

    #[inline(always)]
    fn run((recovery, kept): (&Recovery, &Lanes)) -> Starts {
        recovery.one(kept)
    }
}

impl Dispatched<(&Recovery<'_>, &Lanes)> for Triangle {
    type Output = Matrices<LANES>;

    #[inline(always)]
    fn run((recovery, kept): (&Recovery, &Lanes)) -> Matrices<LANES> {
        recovery.triangle(kept)
    }
}

impl Dispatched<&Several<'_>> for Two {
    type Output = [Starts; 2];

    #[inline(always)]
    fn run(several: &Several) -> [Starts; 2] {
        several.two()
    }
}

/// Several configurations at each of some values of the kept joint: of what is nearly taken
/// to zero, the vectors that are monomials.
pub(super) struct Several<'a> {
    recovery: &'a Recovery<'a>,
    kept: &'a Lanes,
    /// Q R without Q.
    triangle: Matrices<LANES>,
}

impl Several<'_> {
    /// Two at every value.
    pub fn pairs(&self) -> [Starts; 2] {
        dispatch::<Two, _>(self)
    }

    #[inline(always)]
    fn two(&self) -> [Starts; 2] {
        let plane = null_plane_of_triangle(&self.triangle);
        let weights = pair::monomial_vectors(&plane, |i, j| self.recovery.column(i, j));
        [
            self.in_plane(&plane, &weights[0]),
            self.in_plane(&plane, &weights[1]),
        ]
    }

    /// The configuration whose vector of monomials is so much of each of two vectors.
    #[inline(always)]
    fn in_plane(&self, plane: &[Vectors<LANES>; 2], [a, b]: &[Lanes; 2]) -> Starts {
        let mut null = [[0.0; LANES]; SIZE];
        for (out, (x, y)) in null.iter_mut().zip(plane[0].iter().zip(&plane[1])) {
            for k in 0..LANES {
                out[k] = a[k] * x[k] + b[k] * y[k];
            }
        }
        self.recovery.of_null_vectors(self.kept, &null)
    }

    /// Up to [`SHARING`] at the value in a lane, as the first lanes.
    pub fn sharing(&self, lane: usize) -> Starts {
        let mut triangle = [[[0.0; SHARING]; SIZE]; SIZE];
        for (row, all) in triangle.iter_mut().zip(&self.triangle) {
            for (entry, all) in row.iter_mut().zip(all) {
                *entry = [all[lane]; SHARING];
            }
        }
        let space = null_space_of_triangle(&triangle);
        let monomials = |i: usize, j: usize| &space[self.recovery.column(i, j)];
        let weights = sharing::monomial_vectors(&monomials);
        let mut null = [[0.0; LANES]; SIZE];
        for (out, space) in null.iter_mut().zip(&space) {
            for k in 0..LANES {
                let weights = &weights[k % SHARING];
                out[k] = (0..SHARING).map(|i| space[i] * weights[i]).sum();
            }
        }
        self.recovery
            .of_null_vectors(&[self.kept[lane]; LANES], &null)
    }
}

#[inline(always)]
fn rotated_back(r: &[[f64; 3]; 3], x: &[Lanes; 3]) -> [Lanes; 3] {
    let mut out = [[0.0; LANES]; 3];
    for (i, out) in out.iter_mut().enumerate() {
        for k in 0..LANES {
            out[k] = r[0][i] * x[0][k] + r[1][i] * x[1][k] + r[2][i] * x[2][k];
        }
    }
    out
}

#[inline(always)]
fn turned_back(x: &[Lanes; 3], angles: &Lanes) -> [Lanes; 3] {
    let (s, c) = sin_cos(*angles);
    let mut out = *x;
    for k in 0..LANES {
        out[0][k] = c[k] * x[0][k] + s[k] * x[1][k];
        out[1][k] = c[k] * x[1][k] - s[k] * x[0][k];
    }
    out
}
