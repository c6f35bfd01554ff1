//! Closed configurations of a mechanism next to home.

use super::Mechanism;
use alloc::{vec, vec::Vec};

/// How many ways to leave home are tried.
const WAYS: u8 = 8;
/// Steps along them, radians or multiples of the length; the first that closes counts. Next to where a
/// leg is stretched only small ones do.
const STEPS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];
/// What has gone further, radians or multiples of the length, has left home. Where loops close but for
/// higher orders of a step, up to the third, Newton's method goes back to what closes them to rounding;
/// the fourth of a step that legs allow next to where they are stretched is rounding itself.
const LEFT: f64 = 2e-3;
/// Rows of the Jacobian that others leave less of, relative to its length, depend on these; directions
/// that they leave less of are no motions.
const ROUNDING: f64 = 1e-10;

impl Mechanism {
    /// Up to eight closed configurations near home, always the same: none if
    /// the mechanism is stuck there.
    pub fn neighbours(&self) -> Vec<Vec<f64>> {
        let closing = self.closing();
        let nearest = |way| {
            let motion = self.motion(way, &closing)?;
            STEPS.iter().find_map(|step| self.along(&motion, *step))
        };
        (0..WAYS).filter_map(nearest).collect()
    }

    /// What loops keep joints from at home: the rows of their Jacobian, made orthonormal, the longest
    /// first.
    fn closing(&self) -> Vec<Vec<f64>> {
        let mut rows = self.constraint_jacobian(&vec![0.0; self.joints()]);
        let mut known: Vec<Vec<f64>> = Vec::new();
        let longer = |a: &Vec<f64>, b: &Vec<f64>| norm(a).total_cmp(&norm(b));
        while let Some(longest) = rows.iter().max_by(|a, b| longer(a, b)) {
            let length = norm(longest);
            if length < ROUNDING * self.length() {
                break;
            }
            known.push(longest.iter().map(|x| x / length).collect());
            rows.iter_mut().for_each(|row| reject(&known, row));
        }
        known
    }

    /// A way to leave home on which loops stay closed to first order: by how much each joint moves,
    /// one of them by a radian or its share of [`Mechanism::length`].
    fn motion(&self, way: u8, closing: &[Vec<f64>]) -> Option<Vec<f64>> {
        let anywhere = |i: usize| libm::sin(1.0 + 2.4 * i as f64 + 3.7 * f64::from(way));
        let direction = (0..self.joints()).map(|i| anywhere(i) * self.unit(i));
        let mut motion: Vec<f64> = direction.collect();
        reject(closing, &mut motion);
        let most = self.size(&motion);
        (most > ROUNDING).then(|| motion.iter().map(|x| x / most).collect())
    }

    /// The closed configuration next to a step along a motion, no joint held.
    fn along(&self, motion: &[f64], step: f64) -> Option<Vec<f64>> {
        let mut q: Vec<f64> = motion.iter().map(|rate| step * rate).collect();
        let gap = self.close_with(&[], &mut q);
        let moved = self.size(&q) > LEFT;
        (gap <= 1e-12 * self.length() && moved).then_some(q)
    }

    /// How far joints have moved at most, radians or multiples of the length.
    fn size(&self, q: &[f64]) -> f64 {
        let shares = q.iter().enumerate().map(|(i, x)| x.abs() / self.unit(i));
        shares.fold(0.0, f64::max)
    }

    /// What a joint's values are measured by.
    fn unit(&self, joint: usize) -> f64 {
        match self.is_prismatic(joint) {
            true => self.length(),
            false => 1.0,
        }
    }
}

/// Takes what is along orthonormal vectors out of one.
fn reject(known: &[Vec<f64>], vector: &mut [f64]) {
    // Twice is enough (Kahan, in Parlett, *The Symmetric Eigenvalue Problem*, §6.9).
    for unit in known.iter().chain(known) {
        let part: f64 = unit.iter().zip(&*vector).map(|(a, b)| a * b).sum();
        vector
            .iter_mut()
            .zip(unit)
            .for_each(|(x, u)| *x -= part * u);
    }
}

fn norm(vector: &[f64]) -> f64 {
    libm::sqrt(vector.iter().map(|x| x * x).sum())
}
