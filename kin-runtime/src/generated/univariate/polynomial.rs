//! The determinant as a polynomial in the joint that is kept.

use super::LANES;
use super::determinant::{Matrices, eliminate, product, reflect};
use super::elimination::{Elimination, Equations, SIZE};
use super::harmonics::{HALF_ANGLES, Harmonics, MOST_SAMPLES, samples};

/// Above this noise, relative to the largest harmonic, no pivot can be trusted that was
/// not chosen for the target.
pub(super) const NOISY: f64 = 3e-13;

/// Not a number where the target is none.
#[inline(never)]
pub(super) fn polynomial(elimination: &Elimination, equations: &Equations) -> Harmonics {
    let degree = usize::from(elimination.degree);
    let mut values = [0.0; MOST_SAMPLES];
    let values = &mut values[..samples(degree)];
    sample(elimination, equations, values, |m| {
        eliminate(m, |row| elimination.is_shifted(row))
    });
    let f = Harmonics::new(degree, values);
    if f.noise < NOISY {
        return f;
    }
    sample(elimination, equations, values, reflect);
    Harmonics::new(degree, values)
}

#[inline(always)]
fn sample(
    elimination: &Elimination,
    equations: &Equations,
    values: &mut [f64],
    factor: impl Fn(&mut Matrices<LANES>),
) {
    let step = HALF_ANGLES.len() / values.len();
    for (chunk, values) in values.chunks_mut(LANES).enumerate() {
        let angle = |k: usize| HALF_ANGLES[step * (LANES * chunk + k)];
        let cosine: [f64; LANES] = core::array::from_fn(|k| angle(k)[0]);
        let sine: [f64; LANES] = core::array::from_fn(|k| angle(k)[1]);
        let mut matrix = [[[0.0; LANES]; SIZE]; SIZE];
        equations.write(elimination, &cosine, &sine, &mut matrix);
        factor(&mut matrix);
        values.copy_from_slice(&product(&matrix)[..values.len()]);
    }
}
