//! The polynomial in the kept joint itself, for those that follow it along a parameter.

use super::Univariate;
use super::bernstein::{ARCS, Arcs, COEFFICIENTS, REACH, on_arcs};
use super::harmonics::{DEGREE, Harmonics};
use super::lanes::LANES;
use super::polynomial::polynomial;
use super::recover::Recovery;
use super::search::Search;
use crate::Pose;

/// What an elimination leaves of a target: a trigonometric polynomial that vanishes at the
/// values of the kept joint of all solutions, and perhaps elsewhere. Over the sines and cosines of
/// a joint that carries the target, or its travel, it is a polynomial as well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eliminant {
    /// Its degree.
    pub degree: usize,
    /// The coefficients of 1, cos θ, cos 2θ ... and, behind them, of sin θ, sin 2θ ...
    pub harmonics: [f64; Self::HARMONICS],
    /// How far these are off by rounding.
    pub noise: f64,
}

impl Eliminant {
    /// How many harmonics there are of the highest degree.
    pub const HARMONICS: usize = 2 * DEGREE + 1;
    /// How many arcs make the circle.
    pub const ARCS: usize = ARCS;
    /// From −`REACH` to this t goes on an arc, of which θ = middle + 2 atan t.
    pub const REACH: f64 = REACH;

    /// Of harmonics, in the same order.
    pub fn new(degree: usize, harmonics: [f64; Self::HARMONICS], noise: f64) -> Self {
        Self {
            degree,
            harmonics,
            noise,
        }
    }

    /// (1 + t²)ᵈ f on every arc, by its coefficients in Bernstein's basis, of which so many count.
    pub fn on_arcs(&self) -> ([[f64; COEFFICIENTS]; ARCS], usize) {
        let mut f = Harmonics {
            degree: self.degree,
            cosines: [0.0; DEGREE + 1],
            sines: [0.0; DEGREE + 1],
            size: 1.0,
            noise: self.noise,
            shift: 0.0,
        };
        f.cosines.copy_from_slice(&self.harmonics[..=DEGREE]);
        f.sines[1..].copy_from_slice(&self.harmonics[DEGREE + 1..]);
        let arcs: [Arcs; ARCS / LANES] = on_arcs(&f);
        let arc = |i: usize| {
            let all = arcs[i / LANES].of(i % LANES);
            core::array::from_fn(|j| all[j])
        };
        (core::array::from_fn(arc), arcs[0].count)
    }
}

impl Univariate<'_> {
    /// The polynomial of a target by an elimination, counted from 0; none if there are fewer, or
    /// the target is no number.
    pub fn eliminant(&self, target: &Pose, which: usize) -> Option<Eliminant> {
        let elimination = self.eliminations.get(which)?;
        let search = Search::new(self, target);
        let recovery = Recovery::new(elimination, &self.frames, search.target());
        let f = polynomial(&recovery);
        let mut harmonics = [0.0; Eliminant::HARMONICS];
        for (k, harmonic) in harmonics.iter_mut().enumerate() {
            *harmonic = f.size
                * match k {
                    0..=DEGREE => f.cosines[k],
                    _ => f.sines[k - DEGREE],
                };
        }
        f.noise
            .is_finite()
            .then(|| Eliminant::new(f.degree, harmonics, f.size * f.noise))
    }
}
