//! The determinant as a polynomial in the joint that is kept.

use super::determinant::{Factors, Triangle};
use super::elimination::{SIZE, none};
use super::harmonics::{HALF_ANGLES, Harmonics, MOST_SAMPLES, samples};
use super::lanes::{InLanes, LANES, Lanes, in_lanes};
use super::matrix::Vectors;
use super::recover::Recovery;

/// Above this noise, relative to the largest harmonic, no pivot can be trusted that was
/// not chosen for the target.
pub(super) const NOISY: f64 = 3e-13;

/// Not a number where the target is none.
#[inline(never)]
pub(super) fn polynomial(recovery: &Recovery) -> Harmonics {
    let f = in_lanes::<Sampled<false>, _>(recovery);
    match f.noise < NOISY {
        true => f,
        false => in_lanes::<Sampled<true>, _>(recovery),
    }
}

/// The determinants, by reflections or with the pivots that were chosen for the arm.
struct Sampled<const REFLECTED: bool>;

impl<const REFLECTED: bool> InLanes<&Recovery<'_>> for Sampled<REFLECTED> {
    type Output = Harmonics;

    #[inline(always)]
    fn run<L: Lanes>(recovery: &Recovery) -> Harmonics {
        let Recovery {
            elimination,
            places,
            equations,
            ..
        } = recovery;
        let degree = usize::from(elimination.degree);
        let mut factors = Factors::<L>::EMPTY;
        let mut at_values = none();
        let mut values = [0.0; MOST_SAMPLES];
        let values = &mut values[..samples(degree)];
        // How fast the determinants change with the entries.
        let mut slopes = L::ZERO;
        let mut largest: Vectors<L> = [L::ZERO; SIZE];
        let step = HALF_ANGLES.len() / values.len();
        for (chunk, values) in values.chunks_exact_mut(LANES).enumerate() {
            let (mut cosine, mut sine) = ([0.0; LANES], [0.0; LANES]);
            for k in 0..LANES {
                [cosine[k], sine[k]] = HALF_ANGLES[step * (LANES * chunk + k)];
            }
            equations.write(L::of(cosine), L::of(sine), &mut at_values);
            let (pivots, inverse_norm) = match REFLECTED {
                true => {
                    let triangle = Triangle::new(places, &at_values);
                    (triangle.pivots(), triangle.inverse_norm())
                }
                false => {
                    factors.factor(places, &at_values);
                    (factors.pivots(), L::ZERO)
                }
            };
            // Fifteen reflections have the determinant −1.
            let mut determinants = if REFLECTED { -L::ONE } else { L::ONE };
            for (largest, pivot) in largest.iter_mut().zip(pivots) {
                determinants *= pivot;
                *largest = largest.max(pivot.abs());
            }
            values.copy_from_slice(&determinants.numbers());
            slopes = slopes.plus(&determinants.abs(), &inverse_norm);
        }
        let mut f = Harmonics::new(degree, values);
        let slopes: f64 = slopes.numbers().into_iter().sum();
        f.shift = f64::EPSILON * slopes / f.size;
        // What rounding leaves of a pivot that is zero for all angles may be the same for
        // all, so that the harmonics that have to vanish do.
        for pivot in largest {
            let largest = pivot.numbers().into_iter().fold(0.0, f64::max);
            f.noise = larger(f.noise, f64::EPSILON / largest);
        }
        match elimination.fold {
            Some(angle) => f.without_double_root(angle),
            None => f,
        }
    }
}

/// The first where it is not a number.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a < b { b } else { a }
}
