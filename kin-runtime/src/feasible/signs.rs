//! Bounds of a function by its coefficients in Bernstein's basis, and of what is made of them.

use crate::math;

/// What coefficients tell of a function.
#[derive(Clone, Copy)]
pub(super) struct Signs {
    pub least: f64,
    largest: f64,
}

impl Signs {
    pub const NONE: Self = Self {
        least: f64::INFINITY,
        largest: f64::NEG_INFINITY,
    };

    pub fn add(&mut self, x: f64) {
        self.least = -math::max(-self.least, -x);
        self.largest = math::max(self.largest, x);
    }

    pub fn of(row: &[f64]) -> Self {
        let mut signs = Self::NONE;
        row.iter().for_each(|&x| signs.add(x));
        signs
    }

    /// Of differences.
    pub fn of_slope(row: &[f64]) -> Self {
        let mut signs = Self::NONE;
        row.windows(2).for_each(|x| signs.add(x[1] - x[0]));
        signs
    }

    /// Of second differences.
    pub fn of_bend(row: &[f64]) -> Self {
        let mut signs = Self::NONE;
        let second = row.windows(3).map(|x| (x[2] - x[1]) - (x[1] - x[0]));
        second.for_each(|x| signs.add(x));
        signs
    }

    pub fn with(mut self, other: Self) -> Self {
        self.add(other.least);
        self.add(other.largest);
        self
    }

    /// Whether all have one sign, however they are off by so much.
    pub fn is_one(self, noise: f64) -> bool {
        self.least > noise || self.largest < -noise
    }

    /// The sign that all have.
    pub fn sign(self) -> Option<f64> {
        self.is_one(0.0).then(|| self.least.signum())
    }

    pub fn scaled(self, by: f64) -> Self {
        Self {
            least: by * self.least,
            largest: by * self.largest,
        }
    }

    pub fn times(self, other: Self) -> Self {
        let mut out = Self::NONE;
        for a in [self.least, self.largest] {
            for b in [other.least, other.largest] {
                out.add(a * b);
            }
        }
        out
    }

    pub fn square(self) -> Self {
        let [a, b] = [self.least.abs(), self.largest.abs()];
        Self {
            least: match self.is_one(0.0) {
                true => a.min(b) * a.min(b),
                false => 0.0,
            },
            largest: a.max(b) * a.max(b),
        }
    }

    pub fn minus(self, other: Self) -> Self {
        Self {
            least: self.least - other.largest,
            largest: self.largest - other.least,
        }
    }
}
