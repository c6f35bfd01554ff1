//! Roots near which there may be several solutions.

use super::harmonics::Harmonics;
use super::polynomial::NOISY;
use super::roots::{MOST, Roots};
use super::sharing::SHARING;
use super::zeros::{Zeros, zeros_near};
use crate::math;

/// Where zeros have met is one place, radians, that others are farther from.
const SAME: f64 = 1e-6;

/// One of them.
#[derive(Clone, Copy, Default)]
pub(super) struct Candidate {
    /// The kept joint's value there, radians.
    pub angle: f64,
    /// Whether it is two.
    pub is_double: bool,
    /// Whether nobody knows how many it is.
    pub is_several: bool,
    /// The polynomial's zeros near it, if they could be counted.
    pub zeros: Option<Zeros>,
    /// Whether these have met there.
    pub is_met: bool,
}

/// Those whose solutions are not known yet.
#[derive(Default)]
pub(super) struct Candidates {
    all: [Candidate; MOST],
    count: usize,
}

impl Candidates {
    pub fn len(&self) -> usize {
        self.count
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub fn all(&self) -> impl Iterator<Item = &Candidate> {
        self.all[..self.count].iter()
    }

    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut Candidate> {
        self.all[..self.count].iter_mut()
    }

    /// Adds a root by its number.
    pub fn push(&mut self, roots: &Roots, number: usize) {
        self.all[self.count % MOST] = Candidate {
            angle: roots.angles[number % MOST],
            is_double: roots.is_double(number),
            is_several: roots.is_several(number),
            zeros: None,
            is_met: false,
        };
        self.count += 1;
    }

    /// Leaves those that are wanted.
    pub fn retain(&mut self, mut wanted: impl FnMut(&Candidate) -> bool) {
        let mut kept = 0;
        for i in 0..self.count {
            if wanted(&self.all[i]) {
                self.all[kept] = self.all[i];
                kept += 1;
            }
        }
        self.count = kept;
    }

    /// Counts the zeros of the polynomial near them, but for those near a fold: a root of all
    /// targets was taken from it there.
    pub fn count_zeros(&mut self, fold: Option<f64>, f: &Harmonics) {
        for i in 0..self.count {
            let (before, rest) = self.all.split_at_mut(i);
            let angle = rest[0].angle;
            let mut known = before.iter().filter_map(|it| it.zeros);
            let zeros = known.find(|zeros| zeros.cover(angle));
            let zeros = zeros.or_else(|| zeros_near(f, angle));
            let has_fold = |zeros: &Zeros| fold.is_some_and(|fold| zeros.are_near(fold));
            rest[0].zeros = zeros.filter(|zeros| !has_fold(zeros));
        }
        // Next to a target with a family of solutions what is nearly taken to zero is more than theirs.
        if f.noise < NOISY {
            self.gather(f);
        }
    }

    /// Leaves one candidate where a few zeros have met, at the angle where they have.
    fn gather(&mut self, f: &Harmonics) {
        for i in 0..self.count {
            let it = &mut self.all[i];
            let few = |zeros: &Zeros| (2..=SHARING).contains(&zeros.count);
            let zeros = it
                .zeros
                .filter(few)
                .filter(|_| it.is_double || it.is_several);
            if let Some(angle) = zeros.and_then(|zeros| zeros.meeting(f)) {
                (it.angle, it.is_met) = (angle, true);
            }
        }
        let mut kept = 0;
        for i in 0..self.count {
            let it = self.all[i];
            let same = |known: &Candidate| {
                known.is_met && it.is_met && math::wrap(known.angle - it.angle).abs() < SAME
            };
            if !self.all[..kept].iter().any(same) {
                self.all[kept] = it;
                kept += 1;
            }
        }
        self.count = kept;
    }
}

#[cfg(test)]
mod tests {
    use super::super::harmonics::samples;
    use super::super::roots::roots;
    use super::*;
    use std::vec::Vec;

    /// sin(θ/2) sin(θ/2 − 0.0005) (2 − cos θ): two roots next to each other, and two zeros that
    /// are far away.
    fn with_two_roots() -> Harmonics {
        let values: [f64; 24] = core::array::from_fn(|k| {
            let angle = core::f64::consts::TAU / samples(8) as f64 * k as f64;
            let pair = (0.5 * angle).sin() * (0.5 * angle - 0.0005).sin();
            pair * (2.0 - angle.cos())
        });
        Harmonics::new(8, &values[..samples(8)])
    }

    fn counted(fold: Option<f64>) -> Vec<Option<usize>> {
        let f = with_two_roots();
        let roots = roots(&f);
        let mut candidates = Candidates::default();
        (0..roots.count).for_each(|root| candidates.push(&roots, root));
        assert_eq!((candidates.len(), candidates.is_empty()), (2, false));
        candidates.count_zeros(fold, &f);
        let zeros = candidates.all().map(|it| it.zeros.map(|zeros| zeros.count));
        zeros.collect()
    }

    #[test]
    fn zeros_are_counted_but_for_those_near_a_fold() {
        for fold in [None, Some(1.0), Some(-2.0)] {
            assert_eq!(counted(fold), [Some(2); 2], "{fold:?}");
        }
        for fold in [0.0, 0.005, -0.002, core::f64::consts::TAU] {
            assert_eq!(counted(Some(fold)), [None; 2], "{fold}");
        }
    }

    /// The square of the square of sin((θ − 1) / 2), seen at three places about its zero.
    #[test]
    fn where_zeros_have_met_one_candidate_is_left() {
        let values: [f64; 24] = core::array::from_fn(|k| {
            let angle = core::f64::consts::TAU / samples(8) as f64 * k as f64;
            (1.0 - (angle - 1.0).cos()).powi(2) * (2.0 - angle.cos())
        });
        let f = Harmonics::new(8, &values[..samples(8)]);
        let mut candidates = Candidates::default();
        for (i, off) in [-1e-3, 0.0, 2e-3].into_iter().enumerate() {
            candidates.all[i] = Candidate {
                angle: 1.0 + off,
                is_several: true,
                ..Candidate::default()
            };
        }
        candidates.count = 3;
        candidates.count_zeros(None, &f);
        let left: Vec<_> = candidates.all().collect();
        assert_eq!(left.len(), 1);
        assert!(left[0].is_met && (left[0].angle - 1.0).abs() < 1e-9);
    }

    #[test]
    fn those_that_are_wanted_are_left() {
        let roots = roots(&with_two_roots());
        let mut candidates = Candidates::default();
        (0..2).for_each(|root| candidates.push(&roots, root));
        candidates.retain(|it| it.angle == roots.angles[1]);
        let left: Vec<f64> = candidates.all().map(|it| it.angle).collect();
        assert_eq!(left, [roots.angles[1]]);
        candidates.retain(|_| false);
        assert!(candidates.is_empty());
    }
}
