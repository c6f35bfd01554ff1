//! A trigonometric polynomial from its values at equal distances.

use super::turn::{cosine_of_turn, sine_of_turn};
use crate::math;

/// The highest degree that is solved.
pub(super) const DEGREE: usize = 12;

/// Samples of a polynomial of the highest degree.
pub(super) const MOST_SAMPLES: usize = 32;

/// f(θ) = Σ aₖ cos kθ + bₖ sin kθ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Harmonics {
    pub degree: usize,
    pub cosines: [f64; DEGREE + 1],
    pub sines: [f64; DEGREE + 1],
    /// What all are shares of: the largest, or half of it, times the number of samples.
    pub size: f64,
    /// How far values are off by rounding: as large as the harmonics are that
    /// have to vanish, or more.
    pub noise: f64,
    /// How far rounding of the target moves values, where that may be more.
    pub shift: f64,
}

/// A turn in `MOST_SAMPLES · 3` parts: 24 and 32 samples are on it.
const PARTS: usize = 96;
/// How many samples a polynomial takes: enough that some harmonics have to
/// vanish.
pub(super) const fn samples(degree: usize) -> usize {
    if degree <= 8 { 24 } else { MOST_SAMPLES }
}

/// Harmonics that are looked at, and some zeros that make whole vectors.
const ORDERS: usize = 24;

/// Sines and cosines of k times the angle of a sample, by sample and k.
struct Transform<const HALF: usize> {
    cosines: [[f64; ORDERS]; HALF],
    sines: [[f64; ORDERS]; HALF],
}

static FEW: Transform<13> = Transform::new();
static MANY: Transform<17> = Transform::new();

impl<const HALF: usize> Transform<HALF> {
    const fn new() -> Self {
        let mut out = Self {
            cosines: [[0.0; ORDERS]; HALF],
            sines: [[0.0; ORDERS]; HALF],
        };
        let samples = 2 * (HALF - 1);
        let mut j = 0;
        while j < HALF {
            let mut k = 0;
            while k < HALF {
                out.cosines[j][k] = cosine_of_turn(j * k, samples);
                out.sines[j][k] = sine_of_turn(j * k, samples);
                k += 1;
            }
            j += 1;
        }
        out
    }

    /// Sums of the values times cosines and sines, by k.
    #[inline(always)]
    fn sums(&self, values: &[f64]) -> [[f64; ORDERS]; 2] {
        let mut sums = [[0.0; ORDERS]; 2];
        let n = values.len();
        for j in 0..HALF {
            // Values mirrored at 0 and half a turn: even and odd parts.
            let (value, mirrored) = match j == 0 || 2 * j == n {
                true => (values[j], 0.0),
                false => (values[j], values[n - j]),
            };
            let (even, odd) = (value + mirrored, value - mirrored);
            for k in 0..ORDERS {
                sums[0][k] += even * self.cosines[j][k];
                sums[1][k] += odd * self.sines[j][k];
            }
        }
        sums
    }
}

impl Harmonics {
    /// From values at 2πj/n; the largest harmonic becomes one or two, the mean being one at most.
    #[inline(always)]
    pub fn new(degree: usize, values: &[f64]) -> Self {
        let mut out = Self {
            degree,
            cosines: [0.0; DEGREE + 1],
            sines: [0.0; DEGREE + 1],
            size: 0.0,
            noise: 0.0,
            shift: 0.0,
        };
        let [cosines, sines] = match values.len() < MOST_SAMPLES {
            true => FEW.sums(values),
            false => MANY.sums(values),
        };
        let mut largest: f64 = 0.0;
        let mut vanishing = 0.0;
        for (k, (a, b)) in cosines.into_iter().zip(sines).enumerate() {
            if k <= degree {
                let share = if k == 0 { 1.0 } else { 2.0 };
                (out.cosines[k], out.sines[k]) = (share * a, share * b);
                largest = largest.max(a.abs()).max(b.abs());
            } else {
                vanishing += a * a + b * b;
            }
        }
        let scale = 1.0 / largest;
        out.size = largest;
        for k in 0..=DEGREE {
            out.cosines[k] *= scale;
            out.sines[k] *= scale;
        }
        out.noise = math::sqrt(vanishing) * scale + f64::EPSILON;
        out
    }
}

impl Harmonics {
    /// f by 1 − cos(θ − angle), which divides it: from the highest harmonic down, each is told by
    /// the two above it; by how much the last ones miss is noise.
    pub fn without_double_root(&self, angle: f64) -> Self {
        let (s, c) = math::sin_cos(angle);
        let turned = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
        // Of e^{ikθ}: half of what is of cos kθ − i sin kθ.
        let (mut above, mut here) = ([0.0; 2], [0.0; 2]);
        let mut out = Self {
            degree: self.degree.saturating_sub(1),
            cosines: [0.0; DEGREE + 1],
            sines: [0.0; DEGREE + 1],
            ..*self
        };
        let mut largest: f64 = 0.0;
        for k in (1..=self.degree).rev() {
            let given = [0.5 * self.cosines[k], -0.5 * self.sines[k]];
            let once = turned([here[0] - given[0], here[1] - given[1]]);
            let twice = turned(turned(above));
            let below = [2.0 * once[0] - twice[0], 2.0 * once[1] - twice[1]];
            (above, here) = (here, below);
            let share = if k == 1 { 1.0 } else { 2.0 };
            (out.cosines[k - 1], out.sines[k - 1]) = (share * below[0], -share * below[1]);
            largest = math::max(largest, math::max(below[0].abs(), below[1].abs()));
        }
        let missed = (here[0] - turned(above)[0] - self.cosines[0]).abs() + here[1].abs();
        out.sines[0] = 0.0;
        let scale = 1.0 / largest;
        for k in 0..=DEGREE {
            out.cosines[k] *= scale;
            out.sines[k] *= scale;
        }
        out.size = self.size * largest;
        out.noise = (self.noise + missed) * scale;
        out
    }
}

/// Sines and cosines of half the angles of the samples.
pub(super) const HALF_ANGLES: [[f64; 2]; PARTS] = {
    let mut table = [[0.0; 2]; PARTS];
    let mut i = 0;
    while i < PARTS {
        table[i] = [cosine_of_turn(i, 2 * PARTS), sine_of_turn(i, 2 * PARTS)];
        i += 1;
    }
    table
};

impl Harmonics {
    /// f and f′ at some angles, radians: Horner's rule in e^{iθ}.
    #[inline(always)]
    pub fn value_and_slope<const L: usize>(&self, angles: &[f64; L]) -> ([f64; L], [f64; L]) {
        let (sine, cosine) = crate::generated::lanes::sin_cos(*angles);
        let (mut f, mut g) = ([[0.0; L]; 2], [[0.0; L]; 2]);
        for k in (1..=self.degree).rev() {
            let (a, b) = (self.cosines[k], -self.sines[k]);
            let order = k as f64;
            for lane in 0..L {
                let (c, s) = (cosine[lane], sine[lane]);
                let (x, y) = (f[0][lane] + a, f[1][lane] + b);
                f[0][lane] = x * c - y * s;
                f[1][lane] = x * s + y * c;
                let (x, y) = (g[0][lane] - order * b, g[1][lane] + order * a);
                g[0][lane] = x * c - y * s;
                g[1][lane] = x * s + y * c;
            }
        }
        let mut value = f[0];
        value.iter_mut().for_each(|x| *x += self.cosines[0]);
        (value, g[0])
    }

    /// f, f′ and f″ at the angle of a cosine and sine.
    pub fn derivatives(&self, [cosine, sine]: [f64; 2]) -> [f64; 3] {
        let (mut c, mut s) = (1.0, 0.0);
        let mut out = [self.cosines[0], 0.0, 0.0];
        for k in 1..=self.degree {
            (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
            let order = k as f64;
            let (a, b) = (self.cosines[k], self.sines[k]);
            out[0] += a * c + b * s;
            out[1] += order * (b * c - a * s);
            out[2] -= order * order * (a * c + b * s);
        }
        out
    }

    /// f′, with the noise of f.
    pub fn derivative(&self) -> Self {
        let mut out = *self;
        for k in 0..=DEGREE {
            let order = k as f64;
            out.cosines[k] = order * self.sines[k];
            out.sines[k] = -order * self.cosines[k];
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_double_root_is_divided_out() {
        let g = |x: f64| 0.3 - 1.1 * (3.0 * x).cos() + 0.7 * (5.0 * x).sin() + 0.2 * x.sin();
        let sampled = |f: &dyn Fn(f64) -> f64, degree: usize| {
            let at = |j: usize| f(core::f64::consts::TAU * j as f64 / 24.0);
            let values: [f64; 24] = core::array::from_fn(at);
            Harmonics::new(degree, &values)
        };
        let without = sampled(&g, 5);
        for angle in [0.0, 1.3, core::f64::consts::PI, -2.2] {
            let f = sampled(&|x| g(x) * (1.0 - (x - angle).cos()), 6);
            let divided = f.without_double_root(angle);
            assert_eq!(divided.degree, 5);
            assert!(divided.noise < 1e-13, "{:e}", divided.noise);
            for k in 0..=DEGREE {
                let given = without.size * without.cosines[k];
                let found = divided.size * divided.cosines[k];
                assert!((given - found).abs() < 1e-12 * without.size, "{k}");
                let given = without.size * without.sines[k];
                let found = divided.size * divided.sines[k];
                assert!((given - found).abs() < 1e-12 * without.size, "{k}");
            }
            // It tells where there is none.
            assert!(f.without_double_root(angle + 0.1).noise > 1e-3);
        }
    }
}
