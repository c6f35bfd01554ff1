//! How many zeros a trigonometric polynomial has near an angle, complex ones included.
//!
//! The argument principle: along a circle the argument of f makes as many turns as there are zeros
//! within (L. V. Ahlfors, Complex Analysis, 1979, section 5.2), and so does that of a function that
//! differs from f by less than |f| there. In t = tan((θ − angle) / 2) a circle about zero is its own
//! mirror image, as f is: half of it tells all.

use super::complex::product_of;
use super::harmonics::{DEGREE, Harmonics};
use super::lanes::{InLanes, LANES, Lanes, in_lanes};
use super::roots::{STANDS_FOR, UNSIGNED};
use super::turn::{cosine_of_turn, sine_of_turn};
use crate::math;
use core::f64::consts::TAU;

/// Points on half a circle.
const POINTS: usize = 2 * LANES;

/// Their cosines and sines.
const ON_CIRCLE: [[f64; 2]; POINTS] = {
    let mut points = [[0.0; 2]; POINTS];
    let mut i = 0;
    while i < POINTS {
        points[i] = [
            cosine_of_turn(2 * i + 1, 4 * POINTS),
            sine_of_turn(2 * i + 1, 4 * POINTS),
        ];
        i += 1;
    }
    points
};

/// Radii of circles about an angle, tangents of its half.
const RADII: [f64; 6] = [1.5e-3, 3e-3, 6e-3, 1.2e-2, 2.4e-2, 4.8e-2];

const _: () = assert!(1.99 * RADII[1] > STANDS_FOR);

/// Between two points the argument is followed where it turns by less, radians.
const FOLLOWED: f64 = 2.0;

/// In multiples of its noise, the least of |f| on a circle that tells: more than f may be at an
/// extremum that is taken for roots, so that beyond the circle, where it is farther from it, there are
/// none of these.
const TELLING: f64 = 2.5 * UNSIGNED;

/// Steps of Newton's method towards where zeros have met.
const STEPS: usize = 6;

/// The derivative before the last one that is zero there, as a multiple of the next: where it is less, the
/// zeros' angles are 3e-5 apart at most, radians.
const MET: f64 = 1e-10;

/// So near to it, radians, that is known.
const SETTLED: f64 = 1e-9;

/// The zeros near an angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Zeros {
    /// With their multiplicities.
    pub count: usize,
    /// Where, radians.
    angle: f64,
    /// No others are as near to that as this, radians.
    within: f64,
}

impl Zeros {
    /// Whether an angle, radians, is one of them if it is a zero.
    pub fn are_near(&self, angle: f64) -> bool {
        math::wrap(angle - self.angle).abs() < self.within
    }

    /// Where they have met, or all but met: f and its derivatives but for the last are nearly zero there,
    /// and of the last but one it is a zero that is found to all digits.
    pub fn meeting(&self, f: &Harmonics) -> Option<f64> {
        let mut before = *f;
        for _ in 2..self.count {
            before = before.derivative();
        }
        let mut angle = self.angle;
        for _ in 0..STEPS {
            let (sine, cosine) = math::sin_cos(angle);
            let [height, slope, curvature] = before.derivatives([cosine, sine]);
            if height.abs() <= MET * curvature.abs() && slope.abs() <= SETTLED * curvature.abs() {
                return self.are_near(angle).then_some(angle);
            }
            angle -= slope / curvature;
        }
        None
    }

    /// Whether all that a candidate at an angle, radians, stands for are among them.
    pub fn cover(&self, angle: f64) -> bool {
        math::wrap(angle - self.angle).abs() + STANDS_FOR < self.within
    }
}

/// The zeros near an angle, radians, if there are two circles about it with none between them.
pub(super) fn zeros_near(f: &Harmonics, angle: f64) -> Option<Zeros> {
    let about = About::new(f, angle);
    let mut before = None;
    for radius in RADII {
        let count = about.zeros_within(radius);
        let within = 2.0 * math::atan2(radius, 1.0);
        if let Some(count) = count.filter(|_| count == before) {
            return Some(Zeros {
                count,
                angle,
                within,
            });
        }
        before = count;
    }
    None
}

/// f as a function of θ − angle: a sum of e^{ikθ} times these numbers and of their mirror images.
struct About {
    degree: usize,
    harmonics: [[f64; 2]; DEGREE + 1],
    /// No smaller value tells.
    least: f64,
}

impl About {
    fn new(f: &Harmonics, angle: f64) -> Self {
        let (sine, cosine) = math::sin_cos(angle);
        let mut harmonics = [[0.0; 2]; DEGREE + 1];
        let (mut c, mut s) = (1.0, 0.0);
        for k in 0..=f.degree {
            let (a, b) = (0.5 * f.cosines[k], -0.5 * f.sines[k]);
            harmonics[k] = [a * c - b * s, a * s + b * c];
            (c, s) = (c * cosine - s * sine, c * sine + s * cosine);
        }
        Self {
            degree: f.degree,
            harmonics,
            least: TELLING * f.noise,
        }
    }

    /// The zeros within a circle, where it passes next to none.
    fn zeros_within(&self, radius: f64) -> Option<usize> {
        let Values { arguments, squares } = in_lanes::<OnCircle, _>((self, radius));
        // From the mirror image of the first point, and to that of the last one.
        let ends = [2.0 * arguments[0], -2.0 * arguments[POINTS - 1]].map(math::wrap);
        let mut turned = ends[0] + ends[1];
        let mut followed = ends.iter().all(|end| end.abs() < FOLLOWED);
        for pair in arguments.windows(2) {
            let step = math::wrap(pair[1] - pair[0]);
            turned += 2.0 * step;
            followed &= step.abs() < FOLLOWED;
        }
        // Not a number is not above.
        let above = |square: &f64| *square > self.least * self.least;
        let tells = followed && squares.iter().all(above) && turned > -FOLLOWED;
        tells.then_some((turned / TAU + 0.5) as usize)
    }
}

/// Of f at the points of half a circle.
struct Values {
    arguments: [f64; POINTS],
    /// Of its absolute values.
    squares: [f64; POINTS],
}

struct OnCircle;

impl InLanes<(&About, f64)> for OnCircle {
    type Output = Values;

    #[inline(always)]
    fn run<L: Lanes>((f, radius): (&About, f64)) -> Values {
        let mut values = Values {
            arguments: [0.0; POINTS],
            squares: [0.0; POINTS],
        };
        for first in (0..POINTS).step_by(LANES) {
            let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
            for k in 0..LANES {
                let [cosine, sine] = ON_CIRCLE[first + k];
                (x[k], y[k]) = (radius * cosine, radius * sine);
            }
            let (x, y) = (L::of(x), L::of(y));
            // e^{iθ} = (1 + i t) / (1 − i t), and its inverse.
            let (above, below) = (L::ONE - y, L::ONE + y);
            let across = (above * below).minus(&x, &x);
            let outer = (below * below).plus(&x, &x).inverse();
            let inner = (above * above).plus(&x, &x).inverse();
            let ahead = [across * outer, (x + x) * outer];
            let back = [across * inner, -(x + x) * inner];
            let (mut p, mut q) = ([L::ZERO; 2], [L::ZERO; 2]);
            for k in (1..=f.degree.min(DEGREE)).rev() {
                let [a, b] = f.harmonics[k];
                p = product_of([p[0] + L::splat(a), p[1] + L::splat(b)], ahead);
                q = product_of([q[0] + L::splat(a), q[1] - L::splat(b)], back);
            }
            let constant = f.harmonics[0][0];
            let re = p[0] + q[0] + L::splat(constant + constant);
            let im = p[1] + q[1];
            let square = (re * re).plus(&im, &im);
            values.arguments[first..first + LANES].copy_from_slice(&L::angle(im, re).numbers());
            values.squares[first..first + LANES].copy_from_slice(&square.numbers());
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::super::harmonics::samples;
    use super::super::roots::roots;
    use super::*;
    use std::vec::Vec;

    /// Of degree 8, with zeros at real angles, at complex ones, each with its mirror image, and
    /// others that are far from the real axis.
    fn with_zeros(real: &[f64], complex: &[[f64; 2]]) -> Harmonics {
        let mut values = [0.0; 24];
        let pairs = (16 - real.len()) / 2;
        for (i, value) in values.iter_mut().enumerate() {
            let at = TAU * i as f64 / samples(8) as f64;
            let product: f64 = real.iter().map(|r| (0.5 * (at - r)).sin()).product();
            let near = complex.iter().map(|[re, im]| im.cosh() - (at - re).cos());
            let far = (0..pairs).map(|k| 1.4 + (at - k as f64).cos());
            *value = product * near.chain(far).take(pairs).product::<f64>();
        }
        Harmonics::new(8, &values)
    }

    /// How many of these, relative to the angle, are within the circle.
    fn inside(zeros: &Zeros, real: &[f64], complex: &[[f64; 2]]) -> usize {
        let radius = (0.5 * zeros.within).tan();
        // |tan(z / 2)|
        let is_inside = |re: f64, im: f64| {
            let (cosine, hyperbolic) = (re.cos(), im.cosh());
            ((hyperbolic - cosine) / (hyperbolic + cosine)).sqrt() < radius
        };
        let reals = real.iter().filter(|re| is_inside(**re, 0.0)).count();
        reals + 2 * complex.iter().filter(|z| is_inside(z[0], z[1])).count()
    }

    /// Parts of one, in no order.
    fn part(k: usize) -> f64 {
        let mut bits = (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        for _ in 0..2 {
            bits = (bits ^ bits >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        }
        (bits >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Another polynomial that is as far from this one as its noise.
    fn off(f: &Harmonics, noise: f64, k: usize) -> Harmonics {
        let mut f = *f;
        f.noise = noise;
        for i in 0..=f.degree {
            f.cosines[i] += noise * (part(20 * k + i) - 0.5);
            f.sines[i] += noise * (part(20 * k + 9 + i) - 0.5);
        }
        f
    }

    /// Seen from beside; a few that are apart have not met.
    #[test]
    fn where_zeros_have_met_is_known_to_all_digits() {
        for count in 2..=4 {
            for spread in [0.0, 1e-6, 1e-3] {
                let mut real = [1.3, 1.3 + spread, 1.3, 1.3 - spread];
                let far = [-2.0, 0.0];
                real[count..].copy_from_slice(&far[..4 - count]);
                let zeros = zeros_near(&with_zeros(&real, &[]), 1.302).unwrap();
                assert_eq!(zeros.count, count);
                let met = zeros.meeting(&with_zeros(&real, &[]));
                let mean = real[..count].iter().sum::<f64>() / count as f64;
                match met {
                    None => assert_eq!(spread, 1e-3),
                    Some(angle) => {
                        assert!((angle - mean).abs() < 1e-9 + spread * spread, "{angle}")
                    }
                }
                assert_eq!(met.is_some(), spread < 1e-3);
            }
        }
    }

    #[test]
    fn of_a_polynomial_that_is_known_but_for_noise_those_are_counted_that_it_must_have() {
        let mut told = 0;
        for k in 0..2000 {
            let spread = 10f64.powf(-3.0 + 2.0 * part(k));
            let real = [0.0, -0.3 * spread];
            let complex = [[0.2 * spread, spread]];
            let f = off(&with_zeros(&real, &complex), 1e-10, k);
            if let Some(zeros) = zeros_near(&f, 0.0) {
                told += 1;
                assert_eq!(zeros.count, inside(&zeros, &real, &complex), "{spread}");
            }
        }
        assert!(told > 1000, "{told}");
    }

    #[test]
    fn every_root_is_one_by_itself_or_among_the_zeros_near_a_candidate() {
        let mut told = 0;
        for k in 0..20_000 {
            let spread = 10f64.powf(-4.0 + 4.5 * part(k));
            let angle = TAU * part(7 * k) - 3.0;
            let at = |i: usize| spread * (part(13 * k + i) - 0.5);
            let real: Vec<f64> = (0..2 + 2 * (k % 3)).map(at).collect();
            let turned: Vec<f64> = real.iter().map(|r| r + angle).collect();
            let noise = 10f64.powf(-15.0 + 6.0 * part(3 * k));
            let f = off(&with_zeros(&turned, &[]), noise, k);
            let roots = roots(&f);
            let candidates =
                (0..roots.count).filter(|&i| roots.is_double(i) || roots.is_several(i));
            let near = |i| zeros_near(&f, roots.angles[i]);
            let zeros: Vec<_> = candidates.map(near).collect();
            if roots.incomplete || zeros.iter().any(Option::is_none) {
                continue;
            }
            told += usize::from(!zeros.is_empty());
            let among = |r: f64| zeros.iter().flatten().any(|zeros| zeros.are_near(r));
            let by_themselves = real.iter().filter(|r| !among(*r + angle)).count();
            let single = (0..roots.count).filter(|&i| {
                let near = math::wrap(roots.angles[i] - angle).abs() < 2.0;
                let is_one = !roots.is_double(i) && !roots.is_several(i);
                near && is_one && !among(roots.angles[i])
            });
            assert_eq!(
                single.count(),
                by_themselves,
                "{k} {real:?} {noise:e} {roots:?}"
            );
        }
        assert!(told > 2000, "{told}");
    }

    #[test]
    fn what_is_counted_are_the_zeros_within_double_and_complex_ones_included() {
        let (mut told, mut all) = (0, 0);
        for k in 0..20_000 {
            let number = |i: usize| part(11 * k + i);
            // From far closer than the smallest circle to far beyond the largest, and next to one.
            let far = |i: usize| match k % 3 {
                0 => 10f64.powf(-6.0 + 5.5 * number(i)),
                1 => 2.0 * RADII[k % RADII.len()] * (1.0 + 10f64.powf(-4.0 * number(i))),
                _ => 2.0 * RADII[k % RADII.len()] * (1.0 - 10f64.powf(-4.0 * number(i))),
            };
            let sign = |i: usize| if number(i) < 0.5 { -1.0 } else { 1.0 };
            let mut real = [far(0) * sign(1), far(2) * sign(3), 0.0, 2.3, -1.7, 0.9];
            if k % 2 == 0 {
                real[1] = real[0];
            }
            let bearing = TAU * number(4);
            let complex = [[far(5) * bearing.cos(), far(5) * bearing.sin()]];
            let angle = TAU * number(6) - 3.0;
            let turned = real.map(|r| r + angle);
            let f = with_zeros(&turned, &complex.map(|[re, im]| [re + angle, im]));
            all += 1;
            let Some(zeros) = zeros_near(&f, angle) else {
                continue;
            };
            told += 1;
            let count = inside(&zeros, &real, &complex);
            assert_eq!(zeros.count, count, "{real:?} {complex:?} {zeros:?}");
        }
        assert!(4 * told > 3 * all, "{told} of {all}");
    }
}
