//! A trigonometric polynomial on arcs of the circle, in Bernstein's basis.

use super::harmonics::{DEGREE, Harmonics};
use super::lanes::{InLanes, LANES, Lanes, in_lanes};
use super::turn::{cosine_of_turn, sine_of_turn};
use core::f64::consts::TAU;

/// The circle in arcs.
pub(super) const ARCS: usize = 16;

/// Coefficients of a polynomial of the highest degree.
pub(super) const COEFFICIENTS: usize = 2 * DEGREE + 1;

/// Places for them, whole vectors of these. Behind the last one it is repeated, which adds no
/// change of sign.
pub(super) const PLACES: usize = COEFFICIENTS.next_multiple_of(LANES);

/// Where the first arc has its middle, radians: no arc ends at an angle that
/// robots are sent to.
const FIRST: f64 = 0.0371;

/// Its cosine and sine.
const FIRST_TURN: [f64; 2] = [0.999_311_873_934_065_4, 0.037_091_489_783_865_11];

/// The middle of an arc, radians.
pub(super) fn middle(arc: usize) -> f64 {
    FIRST + TAU / ARCS as f64 * arc as f64
}

/// The cosine and sine of it.
pub(super) fn turn_of_middle(arc: usize) -> [f64; 2] {
    MIDDLES[1][arc % ARCS]
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

    /// Of harmonics turned to the middle of each arc, the coefficients.
    #[inline(always)]
    fn coefficients<L: Lanes>(&self, turned: &[[L; 2]; DEGREE + 1]) -> [L; COEFFICIENTS] {
        let mut out = [L::ZERO; COEFFICIENTS];
        for i in 0..N {
            let (mut even, mut odd) = (L::ZERO, L::ZERO);
            for k in 0..N {
                even = even.plus_scaled(&turned[k][0], self.cosines[i][k]);
                odd = odd.plus_scaled(&turned[k][1], self.sines[i][k]);
            }
            out[i] = even + odd;
            out[2 * (N - 1) - i] = even - odd;
        }
        out
    }
}

/// Coefficient i, of the first half, of cos kφ and of sin kφ on an arc about φ = 0, for degrees up
/// to 8 or above: what tables of other languages are made of.
pub fn coefficients_on_arc(is_high: bool, i: usize, k: usize) -> [f64; 2] {
    match is_high {
        true => [HIGH.cosines[i][k], HIGH.sines[i][k]],
        false => [LOW.cosines[i][k], LOW.sines[i][k]],
    }
}

/// Some neighbouring arcs, as lanes.
#[derive(Clone, Copy)]
pub(super) struct Arcs {
    coefficients: [[f64; LANES]; PLACES],
    /// How many coefficients there are.
    pub count: usize,
    /// The least of them, without its sign.
    pub least: [f64; LANES],
    /// How often their sign changes.
    pub changes: [f64; LANES],
    /// Where it changes last, as a share of the arc.
    pub share: [f64; LANES],
}

impl Arcs {
    /// The coefficients on one of them.
    pub fn of(&self, lane: usize) -> [f64; PLACES] {
        core::array::from_fn(|i| self.coefficients[i][lane])
    }

    /// Whether the first one on one of them is negative.
    pub fn rises(&self, lane: usize) -> bool {
        self.coefficients[0][lane] < 0.0
    }
}

/// Where an interval is cut, as a share of it; not quite halves, since roots like to be in the
/// middle.
pub(super) const CUT: f64 = 0.4871;

/// De Casteljau's algorithm at [`CUT`] as two matrices, by vectors of rows and by column: the
/// coefficients of either part are means of the whole's.
struct Cut<const N: usize, const VECTORS: usize> {
    low: [[[f64; LANES]; N]; VECTORS],
    high: [[[f64; LANES]; N]; VECTORS],
}

static CUT_LOW: Cut<17, 3> = Cut::new();
static CUT_HIGH: Cut<COEFFICIENTS, { PLACES / LANES }> = Cut::new();

impl<const N: usize, const VECTORS: usize> Cut<N, VECTORS> {
    const fn new() -> Self {
        let mut out = Self {
            low: [[[0.0; LANES]; N]; VECTORS],
            high: [[[0.0; LANES]; N]; VECTORS],
        };
        // Row i of the lower part: the chances of so many of i throws.
        let mut row = [0.0; N];
        row[0] = 1.0;
        let mut other = row;
        let mut i = 0;
        while i < N {
            let mut j = i + 1;
            while j > 0 {
                j -= 1;
                let (low, high) = (i, N - 1 - i);
                out.low[low / LANES][j][low % LANES] = row[j];
                out.high[high / LANES][N - 1 - j][high % LANES] = other[j];
                if j + 1 < N {
                    row[j + 1] += CUT * row[j];
                    other[j + 1] += (1.0 - CUT) * other[j];
                }
                row[j] *= 1.0 - CUT;
                other[j] *= CUT;
            }
            i += 1;
        }
        // The last row is repeated.
        let mut i = N;
        while i < LANES * VECTORS {
            let mut j = 0;
            while j < N {
                out.low[i / LANES][j][i % LANES] = out.low[(N - 1) / LANES][j][(N - 1) % LANES];
                out.high[i / LANES][j][i % LANES] = out.high[(N - 1) / LANES][j][(N - 1) % LANES];
                j += 1;
            }
            i += 1;
        }
        out
    }

    #[inline(always)]
    fn cut<L: Lanes>(&self, whole: &mut [f64; PLACES], lower: &mut [f64; PLACES]) {
        let mut upper = [0.0; PLACES];
        for i in 0..VECTORS {
            let (mut low, mut high) = (L::ZERO, L::ZERO);
            for j in 0..N {
                low = low.plus_scaled(&L::of(self.low[i][j]), whole[j]);
                high = high.plus_scaled(&L::of(self.high[i][j]), whole[j]);
            }
            lower[LANES * i..][..LANES].copy_from_slice(&low.numbers());
            upper[LANES * i..][..LANES].copy_from_slice(&high.numbers());
        }
        *whole = upper;
        for part in [whole, lower] {
            let last = part[LANES * VECTORS - 1];
            part[LANES * VECTORS..].fill(last);
        }
    }
}

/// Of an interval that has so many coefficients those of its upper part, and those of its lower
/// part beside them.
pub(super) fn cut(whole: &mut [f64; PLACES], count: usize, lower: &mut [f64; PLACES]) {
    in_lanes::<InParts, _>((whole, count, lower));
}

struct InParts;

impl InLanes<(&mut [f64; PLACES], usize, &mut [f64; PLACES])> for InParts {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>((whole, count, lower): (&mut [f64; PLACES], usize, &mut [f64; PLACES])) {
        match count <= 17 {
            true => CUT_LOW.cut::<L>(whole, lower),
            false => CUT_HIGH.cut::<L>(whole, lower),
        }
    }
}

/// The polynomial on all arcs.
pub(super) fn on_arcs(f: &Harmonics) -> [Arcs; ARCS / LANES] {
    in_lanes::<OnArcs, _>(f)
}

struct OnArcs;

impl InLanes<&Harmonics> for OnArcs {
    type Output = [Arcs; ARCS / LANES];

    #[inline(always)]
    fn run<L: Lanes>(f: &Harmonics) -> Self::Output {
        [on_half::<L>(f, 0), on_half::<L>(f, LANES)]
    }
}

/// On arcs from the first one given on.
#[inline(always)]
fn on_half<L: Lanes>(f: &Harmonics, arc: usize) -> Arcs {
    let mut turned = [[L::ZERO; 2]; DEGREE + 1];
    for k in 0..=f.degree {
        let (mut c, mut s) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            [c[lane], s[lane]] = MIDDLES[k][arc + lane];
        }
        let (c, s, a, b) = (L::of(c), L::of(s), f.cosines[k], f.sines[k]);
        turned[k] = [
            c.scaled(a).plus_scaled(&s, b),
            c.scaled(b).plus_scaled(&s, -a),
        ];
    }
    let (coefficients, count) = match f.degree <= 8 {
        true => (LOW.coefficients(&turned), 17),
        false => (HIGH.coefficients(&turned), COEFFICIENTS),
    };
    let (mut least, mut changes) = (coefficients[0].abs(), L::ZERO);
    // At the last change: the coefficients before and behind, and the number of the first.
    let (mut before, mut behind, mut at) = (L::ONE, L::ZERO, L::ZERO);
    for i in 1..count {
        let [a, b] = [coefficients[i - 1], coefficients[i]];
        least = least.min(b.abs());
        let product = a * b;
        changes += product.where_less(L::ZERO, L::ONE, L::ZERO);
        before = product.where_less(L::ZERO, a, before);
        behind = product.where_less(L::ZERO, b, behind);
        at = product.where_less(L::ZERO, L::splat((i - 1) as f64), at);
    }
    let share = at.plus(&before, &((before - behind).inverse()));
    let mut numbers = [[0.0; LANES]; PLACES];
    for (i, numbers) in numbers.iter_mut().enumerate() {
        *numbers = coefficients[i.min(count - 1)].numbers();
    }
    Arcs {
        coefficients: numbers,
        count,
        least: least.numbers(),
        changes: changes.numbers(),
        share: share.scaled(1.0 / (count - 1) as f64).numbers(),
    }
}

/// Cosine and sine of k times the middle of each arc.
static MIDDLES: [[[f64; 2]; ARCS]; DEGREE + 1] = {
    // cos and sin of FIRST.
    let (mut first, mut k) = ([1.0, 0.0], 0);
    let mut out = [[[0.0; 2]; ARCS]; DEGREE + 1];
    while k <= DEGREE {
        let mut arc = 0;
        while arc < ARCS {
            let (c, s) = (cosine_of_turn(k * arc, ARCS), sine_of_turn(k * arc, ARCS));
            let [x, y] = first;
            out[k][arc] = [c * x - s * y, s * x + c * y];
            arc += 1;
        }
        let ([x, y], [c, s]) = (first, FIRST_TURN);
        first = [x * c - y * s, x * s + y * c];
        k += 1;
    }
    out
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_those_of_de_casteljau() {
        for count in [17, COEFFICIENTS] {
            let at = |i: usize| (1.7 * (i * i) as f64).sin();
            let mut rest: [f64; PLACES] = core::array::from_fn(|i| at(i.min(count - 1)));
            let (mut high, mut low) = (rest, [0.0; PLACES]);
            cut(&mut high, count, &mut low);
            for part in [&low, &high] {
                assert!(
                    part[count..].iter().all(|x| *x == part[count - 1]),
                    "{count}"
                );
            }
            for i in 0..count {
                assert!((low[i] - rest[0]).abs() < 1e-14, "{i} of {count}");
                let last = rest[count - 1 - i];
                assert!((high[count - 1 - i] - last).abs() < 1e-14, "{i} of {count}");
                for j in 0..count - 1 - i {
                    rest[j] += CUT * (rest[j + 1] - rest[j]);
                }
            }
        }
    }
}
