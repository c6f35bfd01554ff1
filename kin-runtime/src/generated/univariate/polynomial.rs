//! The determinant as a polynomial in the joint that is kept.

use super::determinant::{Factors, Triangle};
use super::elimination::{Elimination, Equations};
use super::harmonics::{HALF_ANGLES, Harmonics, MOST_SAMPLES, samples};
use super::lanes::{InLanes, LANES, Lanes, in_lanes};
use super::matrix::Places;

/// Above this noise, relative to the largest harmonic, no pivot can be trusted that was
/// not chosen for the target.
pub(super) const NOISY: f64 = 3e-13;

/// Not a number where the target is none.
#[inline(never)]
pub(super) fn polynomial(elimination: &Elimination, equations: &Equations) -> Harmonics {
    let f = in_lanes::<Sampled<false>, _>((elimination, equations));
    match f.noise < NOISY {
        true => f,
        false => in_lanes::<Sampled<true>, _>((elimination, equations)),
    }
}

/// The determinants, by reflections or with the pivots that were chosen for the arm.
struct Sampled<const REFLECTED: bool>;

impl<const REFLECTED: bool> InLanes<(&Elimination, &Equations)> for Sampled<REFLECTED> {
    type Output = Harmonics;

    #[inline(always)]
    fn run<L: Lanes>((elimination, equations): (&Elimination, &Equations)) -> Harmonics {
        let degree = usize::from(elimination.degree);
        let places = Places::new(elimination);
        let mut factors = Factors::<L>::EMPTY;
        let mut values = [0.0; MOST_SAMPLES];
        let values = &mut values[..samples(degree)];
        let step = HALF_ANGLES.len() / values.len();
        for (chunk, values) in values.chunks_exact_mut(LANES).enumerate() {
            let (mut cosine, mut sine) = ([0.0; LANES], [0.0; LANES]);
            for k in 0..LANES {
                [cosine[k], sine[k]] = HALF_ANGLES[step * (LANES * chunk + k)];
            }
            let equations = equations.at(L::of(cosine), L::of(sine));
            let determinants = match REFLECTED {
                true => Triangle::new(places.matrices(&equations)).determinants(),
                false => {
                    factors.factor(&places, &equations);
                    factors.determinants()
                }
            };
            values.copy_from_slice(&determinants.numbers());
        }
        Harmonics::new(degree, values)
    }
}
