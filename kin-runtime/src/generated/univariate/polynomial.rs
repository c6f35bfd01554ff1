//! The determinant as a polynomial in the joint that is kept.

use super::LANES;
use super::determinant::{eliminate, product, reflect};
use super::elimination::{Elimination, Equations, SIZE};
use super::harmonics::{HALF_ANGLES, Harmonics, MOST_SAMPLES, samples};
use crate::generated::dispatch::{Dispatched, dispatch};

/// Above this noise, relative to the largest harmonic, no pivot can be trusted that was
/// not chosen for the target.
pub(super) const NOISY: f64 = 3e-13;

/// Not a number where the target is none.
#[inline(never)]
pub(super) fn polynomial(elimination: &Elimination, equations: &Equations) -> Harmonics {
    dispatch::<Sampled, _>((elimination, equations))
}

struct Sampled;

impl Dispatched<(&Elimination, &Equations)> for Sampled {
    type Output = Harmonics;

    #[inline(always)]
    fn run((elimination, equations): (&Elimination, &Equations)) -> Harmonics {
        sampled(elimination, equations)
    }
}

#[inline(always)]
fn sampled(elimination: &Elimination, equations: &Equations) -> Harmonics {
    let degree = usize::from(elimination.degree);
    let mut values = [0.0; MOST_SAMPLES];
    let values = &mut values[..samples(degree)];
    sample::<false>(elimination, equations, values);
    let f = Harmonics::new(degree, values);
    if f.noise < NOISY {
        return f;
    }
    sample::<true>(elimination, equations, values);
    Harmonics::new(degree, values)
}

/// The determinants, by reflections or with the pivots that were chosen for the arm.
#[inline(always)]
fn sample<const REFLECTED: bool>(
    elimination: &Elimination,
    equations: &Equations,
    values: &mut [f64],
) {
    let step = HALF_ANGLES.len() / values.len();
    for (chunk, values) in values.chunks_mut(LANES).enumerate() {
        let angle = |k: usize| HALF_ANGLES[step * (LANES * chunk + k)];
        let cosine: [f64; LANES] = core::array::from_fn(|k| angle(k)[0]);
        let sine: [f64; LANES] = core::array::from_fn(|k| angle(k)[1]);
        let mut matrix = [[[0.0; LANES]; SIZE]; SIZE];
        equations.write(elimination, &cosine, &sine, &mut matrix);
        match REFLECTED {
            true => reflect(&mut matrix),
            false => eliminate(&mut matrix, elimination.shifted()),
        }
        values.copy_from_slice(&product(&matrix)[..values.len()]);
    }
}
