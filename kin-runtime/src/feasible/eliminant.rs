//! Where two solutions of an arm without closed form may meet.
//!
//! What an elimination leaves of a target is a polynomial in sine and cosine of one joint, θ, and
//! of the parameter s, or in its travel. Two solutions meet where f = ∂f/∂θ = 0. On pieces of the
//! parameter f is replaced by the polynomial through its values at Chebyshev points, as in
//! `zeros`, and divided by factors of s alone; on rectangles of (s, θ) the coefficients of that in Bernstein's basis tell which of
//! them have no such place or one, and the others are halved. So no branch is missed that
//! begins and ends between two samples. What comes out beside are places where solutions
//! with the same θ cross.

use super::chebyshev::{Table, bernstein, chebyshev, point, without_factors};
use super::patch::{COEFFICIENTS, Folds, POINTS, Patch};
use super::task::Task;
use crate::__private::Eliminant;
use crate::RedundantKinematics;
use alloc::vec::Vec;

/// Pieces of the parameter's range to begin with.
const PIECES: usize = 16;
/// Halvings of a piece at most.
const HALVINGS: u32 = 4;
/// The last three coefficients of a polynomial that is the function, relative to its largest.
const RESOLVED: f64 = 1e-9;
/// Eliminations that are asked at most for one that rounding leaves alone.
const ASKED: usize = 3;
/// Rounding that leaves it alone, relative to its largest coefficient.
const QUIET: f64 = 1e-11;
/// How much of the noise of values coefficients in Bernstein's basis have.
const AMPLIFIED: f64 = 1e3;
/// Parts of a rectangle that are looked at, at most.
const PATCHES: usize = 400;
/// And so many of all, of which what is left is shared by the pieces that are left: of targets that
/// are singular throughout, what rounding leaves has double roots everywhere.
const MOST: usize = 20_000;
/// Rectangles are not halved below these sides: shares of the parameter's range, and of t.
const SHORTEST: [f64; 2] = [1e-4, 5e-4];
/// Places that are nearer to each other are one.
const SAME: f64 = 1e-9;
/// Of places where solutions may touch, those that are nearer to each other are one: a share of
/// the parameter's range.
const NEAR: f64 = 5e-4;

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// Values of the parameter of which there is one between any two at which branches
    /// begin or end, ascending; none of an arm that is solved otherwise.
    pub fn values_between_meetings(&self) -> Option<Vec<f64>> {
        let [from, to] = self.range();
        self.robot.eliminant_at(self.target, from, 0)?;
        let mut search = Search {
            task: self,
            bernstein: bernstein(),
            ends: Vec::new(),
            touching: Vec::new(),
            looked_at: 0,
            most: 0,
            shortest: [SHORTEST[0] * (to - from), SHORTEST[1]],
        };
        let end = |i: usize| from + (to - from) * i as f64 / PIECES as f64;
        for i in 0..PIECES {
            search.most = search.looked_at + (MOST - search.looked_at) / (PIECES - i);
            search.piece(end(i), end(i + 1), HALVINGS)?;
        }
        let mut ends = search.ends;
        ends.sort_by(f64::total_cmp);
        if let (true, Some(&first)) = (self.turns(self.parameter), ends.first()) {
            ends.push(first + to - from);
        }
        let between = ends.windows(2).filter(|pair| pair[1] - pair[0] > SAME);
        let between = between.map(|pair| 0.5 * (pair[0] + pair[1]));
        let mut touching = search.touching;
        touching.sort_by(f64::total_cmp);
        touching.dedup_by(|a, b| *a - *b < NEAR * (to - from));
        let mut values: Vec<f64> = between.chain(touching).collect();
        for value in &mut values {
            // Beyond the last end and before the first.
            *value -= if *value > to { to - from } else { 0.0 };
        }
        Some(values)
    }
}

struct Search<'a, K: ?Sized, const N: usize> {
    task: &'a Task<'a, K, N>,
    bernstein: [[f64; POINTS]; POINTS],
    /// Where two solutions meet.
    ends: Vec<f64>,
    /// Where they cross, or may meet and part.
    touching: Vec<f64>,
    /// How many rectangles were looked at.
    looked_at: usize,
    /// And how many may be, the present piece included.
    most: usize,
    shortest: [f64; 2],
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Search<'_, K, N> {
    /// Looks at a piece of the parameter's range; none if the target is no number.
    fn piece(&mut self, from: f64, to: f64, halvings: u32) -> Option<()> {
        let (table, degree, noise) = self.sampled(from, to)?;
        let coefficients = chebyshev(&table);
        let size = |rows: &[[f64; COEFFICIENTS]]| {
            let all = rows.iter().flatten();
            all.fold(0.0, |largest: f64, x| largest.max(x.abs()))
        };
        let tail = size(&coefficients[POINTS - 3..]);
        let largest = size(&coefficients);
        if tail > RESOLVED * largest + noise && halvings > 0 {
            let (middle, most) = (0.5 * (from + to), self.most);
            self.most = self.looked_at.midpoint(most);
            self.piece(from, middle, halvings - 1)?;
            self.most = most;
            return self.piece(middle, to, halvings - 1);
        }
        let noise = AMPLIFIED * noise + tail;
        let (coefficients, noise) = without_factors(coefficients, noise.max(RESOLVED * largest));
        self.rectangles(from, to, &coefficients, degree, noise);
        Some(())
    }

    /// Looks at all values of θ.
    fn rectangles(&mut self, from: f64, to: f64, coefficients: &Table, degree: usize, noise: f64) {
        let mut all: Vec<[[f64; COEFFICIENTS]; Eliminant::ARCS]> = Vec::new();
        let mut count = 0;
        for own in &self.bernstein {
            let mut harmonics = [0.0; COEFFICIENTS];
            for (share, row) in own.iter().zip(coefficients) {
                for (to, from) in harmonics.iter_mut().zip(row) {
                    *to += share * from;
                }
            }
            let (arcs, n) = Eliminant::new(degree, harmonics, noise).on_arcs();
            all.push(arcs);
            count = n;
        }
        for arc in 0..Eliminant::ARCS {
            self.explore(Patch {
                rows: core::array::from_fn(|i| all[i][arc]),
                count,
                s: [from, to],
                t: [-Eliminant::REACH, Eliminant::REACH],
                shares: [1.0; 2],
                noise,
            });
        }
    }

    /// The harmonics at the Chebyshev points of a piece, their degree, and their noise.
    fn sampled(&self, from: f64, to: f64) -> Option<(Table, usize, f64)> {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut best: Option<(f64, (Table, usize, f64))> = None;
        for which in 0..ASKED {
            let mut table = [[0.0; COEFFICIENTS]; POINTS];
            let (mut noise, mut largest, mut degree) = (0.0_f64, 0.0_f64, 0);
            for (j, row) in table.iter_mut().enumerate() {
                let value = middle + half * point(j);
                let Some(f) = self.task.robot.eliminant_at(self.task.target, value, which) else {
                    return best.map(|best| best.1);
                };
                *row = f.harmonics;
                degree = f.degree;
                noise = noise.max(f.noise);
                largest = row.iter().fold(largest, |a, x| a.max(x.abs()));
            }
            let share = noise / largest;
            if best.as_ref().is_none_or(|best| share < best.0) {
                best = Some((share, (table, degree, noise)));
            }
            if share < QUIET {
                break;
            }
        }
        best.map(|best| best.1)
    }

    fn explore(&mut self, whole: Patch) {
        let mut waiting = alloc::vec![whole];
        let mut looked_at = 0;
        while let Some(patch) = waiting.pop().filter(|_| self.looked_at < self.most) {
            looked_at += 1;
            self.looked_at += 1;
            match patch.folds() {
                Folds::None => {}
                Folds::One(s) => self.ends.push(s),
                Folds::Touching(s) => self.touching.push(s),
                Folds::Unknown => match patch.halves(self.shortest) {
                    Some(halves) if looked_at < PATCHES => waiting.extend(halves),
                    _ => self.touching.push(0.5 * (patch.s[0] + patch.s[1])),
                },
            }
        }
    }
}
