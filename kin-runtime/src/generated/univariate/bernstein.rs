//! A trigonometric polynomial on arcs of the circle, in Bernstein's basis.

use super::harmonics::{DEGREE, Harmonics};
use super::turn::cosine_of_turn;
use crate::generated::dispatch::{Dispatched, dispatch};
use core::f64::consts::TAU;

/// The circle in arcs.
pub(super) const ARCS: usize = 16;

/// Coefficients of a polynomial of the highest degree.
pub(super) const COEFFICIENTS: usize = 2 * DEGREE + 1;

/// Where the first arc has its middle, radians: no arc ends at an angle that
/// robots are sent to.
const FIRST: f64 = 0.0371;

/// The middle of an arc, radians.
pub(super) fn middle(arc: usize) -> f64 {
    FIRST + TAU / ARCS as f64 * arc as f64
}

/// tan of a quarter of an arc: an arc is θ = middle + 2 atan t, |t| up to this.
pub(super) const REACH: f64 = 0.098_491_403_357_164_25;

/// (1 + t²)ᵈ f is a polynomial of degree 2d in t, and its coefficients in
/// Bernstein's basis on an arc are linear in the harmonics, turned to the
/// middle of the arc: those of cosines the same from both ends, those of sines
/// the opposite.
struct Basis<const N: usize> {
    cosines: [[f64; N]; N],
    sines: [[f64; N]; N],
}

/// Degrees up to 8, and above.
static LOW: Basis<9> = Basis::new();
static HIGH: Basis<{ DEGREE + 1 }> = Basis::new();

impl<const N: usize> Basis<N> {
    /// cos kφ + i sin kφ is (1 + it)ᵈ⁺ᵏ (1 − it)ᵈ⁻ᵏ / (1 + t²)ᵈ, and products of
    /// polynomials are convolutions of their coefficients times binomials.
    const fn new() -> Self {
        let d = N - 1;
        let mut out = Self {
            cosines: [[0.0; N]; N],
            sines: [[0.0; N]; N],
        };
        let mut k = 0;
        while k < N {
            let mut product = [[0.0; 2]; COEFFICIENTS];
            product[0][0] = 1.0;
            let mut factor = 0;
            while factor < 2 * d {
                let reach = if factor < d + k { REACH } else { -REACH };
                let mut i = factor + 1;
                loop {
                    let [x, y] = product[i];
                    let mut next = [x + reach * y, y - reach * x];
                    if i > 0 {
                        let [x, y] = product[i - 1];
                        next = [next[0] + x - reach * y, next[1] + y + reach * x];
                    }
                    product[i] = next;
                    if i == 0 {
                        break;
                    }
                    i -= 1;
                }
                factor += 1;
            }
            let mut binomial = 1.0;
            let mut i = 0;
            while i <= d {
                out.cosines[i][k] = product[i][0] / binomial;
                out.sines[i][k] = product[i][1] / binomial;
                binomial = binomial * (2 * d - i) as f64 / (i + 1) as f64;
                i += 1;
            }
            k += 1;
        }
        out
    }

    #[inline(always)]
    fn coefficients(&self, turned: &[[[f64; ARCS]; 2]; DEGREE + 1]) -> [[f64; ARCS]; COEFFICIENTS] {
        let mut out = [[0.0; ARCS]; COEFFICIENTS];
        for i in 0..N {
            let (mut even, mut odd) = ([0.0; ARCS], [0.0; ARCS]);
            for k in 0..N {
                let (a, b) = (self.cosines[i][k], self.sines[i][k]);
                for arc in 0..ARCS {
                    even[arc] += a * turned[k][0][arc];
                    odd[arc] += b * turned[k][1][arc];
                }
            }
            for arc in 0..ARCS {
                out[i][arc] = even[arc] + odd[arc];
                out[2 * (N - 1) - i][arc] = even[arc] - odd[arc];
            }
        }
        out
    }
}

/// Coefficients on all arcs, and how many of each there are.
pub(super) fn on_arcs(f: &Harmonics) -> OnArcs {
    dispatch::<Turned, _>(f)
}

type OnArcs = ([[f64; ARCS]; COEFFICIENTS], usize);

struct Turned;

impl Dispatched<&Harmonics> for Turned {
    type Output = OnArcs;

    #[inline(always)]
    fn run(f: &Harmonics) -> OnArcs {
        turned(f)
    }
}

#[inline(always)]
fn turned(f: &Harmonics) -> OnArcs {
    const PARTS: [f64; ARCS] = {
        let mut table = [0.0; ARCS];
        let mut i = 0;
        while i < ARCS {
            table[i] = cosine_of_turn(i, ARCS);
            i += 1;
        }
        table
    };
    let mut turned = [[[0.0; ARCS]; 2]; DEGREE + 1];
    let (sine, cosine) = crate::math::sin_cos(FIRST);
    let mut first = [1.0, 0.0];
    for k in 0..=f.degree {
        let [c, s] = first;
        let (a, b) = (f.cosines[k], f.sines[k]);
        let (a, b) = (a * c + b * s, b * c - a * s);
        for arc in 0..ARCS {
            let (c, s) = (
                PARTS[k * arc % ARCS],
                PARTS[(k * arc + 3 * ARCS / 4) % ARCS],
            );
            turned[k][0][arc] = a * c + b * s;
            turned[k][1][arc] = b * c - a * s;
        }
        first = [c * cosine - s * sine, s * cosine + c * sine];
    }
    if f.degree <= 8 {
        (LOW.coefficients(&turned), 17)
    } else {
        (HIGH.coefficients(&turned), COEFFICIENTS)
    }
}
