//! Solutions that share the value of the kept joint.
//!
//! They span what the matrix takes to zero; the vectors of monomials in that space are
//! the eigenvectors of multiplication in it (W. Auzinger and H. J. Stetter, "An
//! elimination algorithm for the computation of all zeros of a system of multivariate
//! polynomial equations", ISNM 86, 1988).

use super::complex::product_of;
use super::elimination::SIZE;
use super::lanes::{LANES, Lanes};
use super::matrix::Vectors;

/// How many solutions may share it.
pub(super) const SHARING: usize = 4;

type Square<L, const N: usize> = [[L; N]; N];

/// Rounds of Weierstrass' iteration: those eigenvalues that are apart part by then as far as a start of
/// Newton's method needs it.
const ROUNDS: usize = 12;

/// It starts from points about the mean of the eigenvalues, none of which is another one's mirror image.
const ON_CIRCLE: [[f64; 2]; SHARING] = [
    [0.921, 0.389],
    [-0.416, 0.909],
    [-0.936, -0.351],
    [0.378, -0.926],
];

/// No squared distance of two eigenvalues is taken for less.
const LEAST_SQUARE: f64 = 1e-200;

/// By no larger share of how far two are apart the last round moves one, where they are known.
const SETTLED: f64 = 1e-4;

/// An eigenvalue that is farther from the real axis, as a share of the largest entry of the matrix, is
/// complex, and not one of two real ones that have nearly met.
const COMPLEX: f64 = 0.01;

/// Where a family of solutions has one value of the kept joint, the vectors of all its members are in the
/// space, and no matrix multiplies all of them by their ratios: a pivot is zero. The same next to it.
const OF_FAMILY: f64 = 1e-5;

/// Two functions of the half tangents whose ratio tells solutions apart, above and below: the
/// coefficients of 1, each of the two, and their product.
#[derive(Clone, Copy)]
pub(super) struct Ratio([f64; 4], [f64; 4]);

/// What one hardly tells apart, of values that are as large, others do.
pub(super) const RATIOS: [Ratio; 3] = [
    Ratio([0.31, 0.83, -0.57, 0.44], [0.92, -0.38, 0.29, 0.71]),
    Ratio([-0.74, 0.35, 0.61, 0.27], [0.42, 0.66, 0.53, -0.81]),
    Ratio([0.58, -0.47, 0.22, 0.89], [-0.33, 0.76, 0.85, 0.19]),
];

/// The eigenvalues that belong to vectors of a space, in lanes.
#[derive(Clone, Copy)]
pub(super) struct Eigenvalues<const N: usize> {
    /// How far each is from the real axis.
    imaginary: [[f64; LANES]; N],
    /// The least distance of two; zero where they are not known. As a share of the largest entry of the
    /// matrix.
    apart: [f64; LANES],
}

impl<const N: usize> Eigenvalues<N> {
    /// How far two are apart at least, if the largest entry of the matrix is one.
    pub fn apart(&self, lane: usize) -> f64 {
        self.apart[lane]
    }

    /// Whether one is complex, of those that are known.
    pub fn is_complex(&self, n: usize, lane: usize) -> bool {
        self.imaginary[n][lane] > COMPLEX
    }
}

/// The vectors of monomials in a space, and what they are multiplied by; where two are complex, one of a
/// pair their real part, of more something else. `column` tells the place of a monomial by its powers; all
/// up to `powers` are there.
#[inline(always)]
pub(super) fn monomial_vectors<L: Lanes, const N: usize>(
    space: &[Vectors<L>; N],
    column: &impl Fn(usize, usize) -> usize,
    powers: [usize; 2],
    ratio: Ratio,
) -> ([Vectors<L>; N], Eigenvalues<N>) {
    let (by_ratio, least) = multiplication(space, column, powers, ratio);
    let (values, error) = match N {
        2 => (values_of_pair(&by_ratio), L::ZERO),
        _ => values_of(&by_ratio),
    };
    let mut weights = of_pair(by_ratio);
    if N > 2 {
        for (weights, value) in weights.iter_mut().zip(&values) {
            *weights = eigenvector(&by_ratio, value[0]);
        }
    }
    let mut out = [[L::ZERO; SIZE]; N];
    for (out, weights) in out.iter_mut().zip(&weights) {
        for (x, weight) in space.iter().zip(weights) {
            for (out, x) in out.iter_mut().zip(x) {
                *out = out.plus(x, weight);
            }
        }
    }
    (out, told(&by_ratio, &values, error, least))
}

/// What is told of eigenvalues that are known but for an error, if the least pivot says that they are told.
#[inline(always)]
fn told<L: Lanes, const N: usize>(
    of: &Square<L, N>,
    values: &[[L; 2]; N],
    error: L,
    least: L,
) -> Eigenvalues<N> {
    let (mut largest, mut apart) = (L::ZERO, L::splat(f64::MAX));
    for x in of.as_flattened() {
        largest = largest.max(x.abs());
    }
    for i in 0..N {
        for j in 0..i {
            let (x, y) = (values[i][0] - values[j][0], values[i][1] - values[j][1]);
            apart = apart.min((x * x).plus(&y, &y).sqrt());
        }
    }
    let settled = apart.scaled(SETTLED);
    let share = error.where_less(settled, largest.inverse(), L::ZERO);
    let share = L::splat(OF_FAMILY).where_less(least, share, L::ZERO);
    let mut out = Eigenvalues {
        imaginary: [[0.0; LANES]; N],
        apart: (apart * share).numbers(),
    };
    for (out, value) in out.imaginary.iter_mut().zip(values) {
        *out = (value[1].abs() * share).numbers();
    }
    out
}

/// What multiplication by the ratio does to the space's vectors, in the sense of least
/// squares, and the least pivot.
#[inline(always)]
fn multiplication<L: Lanes, const N: usize>(
    space: &[Vectors<L>; N],
    column: &impl Fn(usize, usize) -> usize,
    powers: [usize; 2],
    Ratio(numerator, denominator): Ratio,
) -> (Square<L, N>, L) {
    let mut gram = [[L::ZERO; N]; N];
    let mut image = gram;
    for i in 0..powers[0] {
        for j in 0..powers[1] {
            let corners = [
                column(i, j),
                column(i + 1, j),
                column(i, j + 1),
                column(i + 1, j + 1),
            ];
            let (mut below, mut above) = ([L::ZERO; N], [L::ZERO; N]);
            for n in 0..N {
                for c in 0..4 {
                    let entry = space[n][corners[c]];
                    below[n] = below[n].plus_scaled(&entry, denominator[c]);
                    above[n] = above[n].plus_scaled(&entry, numerator[c]);
                }
            }
            for a in 0..N {
                for b in 0..N {
                    gram[a][b] = gram[a][b].plus(&below[a], &below[b]);
                    image[a][b] = image[a][b].plus(&below[a], &above[b]);
                }
            }
        }
    }
    solved(gram, image)
}

/// G⁻¹ H for a positive definite G, and its least pivot.
#[inline(always)]
fn solved<L: Lanes, const N: usize>(mut g: Square<L, N>, mut h: Square<L, N>) -> (Square<L, N>, L) {
    let mut least = L::splat(f64::MAX);
    for k in 0..N {
        least = least.min(g[k][k]);
        let pivot = g[k][k].max(L::splat(1e-30)).inverse();
        for i in 0..N {
            if i == k {
                continue;
            }
            let share = g[i][k] * pivot;
            for j in 0..N {
                g[i][j] = g[i][j].minus(&share, &g[k][j]);
                h[i][j] = h[i][j].minus(&share, &h[k][j]);
            }
        }
        for j in 0..N {
            g[k][j] *= pivot;
            h[k][j] *= pivot;
        }
    }
    (h, least)
}

/// Of two by two, from the quadratic.
#[inline(always)]
fn of_pair<L: Lanes, const N: usize>(t: Square<L, N>) -> Square<L, N> {
    let [a, b, c, d] = [t[0][0], t[0][1], t[1][0], t[1][1]];
    let half = (a - d).scaled(0.5);
    let root = (half * half).plus(&b, &c).max(L::ZERO).sqrt();
    let mut out = [[L::ZERO; N]; N];
    for (out, root) in out.iter_mut().zip([root, -root]) {
        // The one without cancellation, of the two rows that tell it.
        let sign = root * half;
        out[0] = sign.where_less(L::ZERO, b, root + half);
        out[1] = sign.where_less(L::ZERO, root - half, c);
    }
    out
}

/// The two of the first two rows and columns.
#[inline(always)]
fn values_of_pair<L: Lanes, const N: usize>(t: &Square<L, N>) -> [[L; 2]; N] {
    let mean = (t[0][0] + t[1][1]).scaled(0.5);
    let half = (t[0][0] - t[1][1]).scaled(0.5);
    let square = (half * half).plus(&t[0][1], &t[1][0]);
    let root = square.abs().sqrt();
    let real = square.where_less(L::ZERO, L::ZERO, root);
    let imaginary = root - real;
    let mut out = [[mean - real, -imaginary]; N];
    out[0] = [mean + real, imaginary];
    out
}

/// The eigenvalues as roots of the characteristic polynomial, all at once (K. Weierstrass, "Neuer Beweis
/// des Satzes, dass jede ganze rationale Function einer Veränderlichen dargestellt werden kann als ein
/// Product aus linearen Functionen derselben Veränderlichen", Sitzungsberichte der königlich preussischen
/// Akademie der Wissenschaften zu Berlin, 1891), and by how much the last round moved one at most.
#[inline(always)]
fn values_of<L: Lanes, const N: usize>(given: &Square<L, N>) -> ([[L; 2]; N], L) {
    let mut mean = L::ZERO;
    for i in 0..N {
        mean += given[i][i];
    }
    let mean = mean.scaled(1.0 / N as f64);
    let mut t = *given;
    let mut square = L::ZERO;
    for i in 0..N {
        t[i][i] = t[i][i] - mean;
        for x in &t[i] {
            square = square.plus(x, x);
        }
    }
    let polynomial = characteristic(&t);
    let radius = square.scaled(1.0 / N as f64).sqrt();
    let mut values = [[L::ZERO; 2]; N];
    for (value, [x, y]) in values.iter_mut().zip(ON_CIRCLE) {
        *value = [radius.scaled(x), radius.scaled(y)];
    }
    let mut moved = L::ZERO;
    for _ in 0..ROUNDS {
        moved = L::ZERO;
        for i in 0..N {
            let [x, y] = values[i];
            let mut above = [L::ONE, L::ZERO];
            for coefficient in polynomial {
                above = product_of(above, [x, y]);
                above[0] += coefficient;
            }
            let mut below = [L::ONE, L::ZERO];
            for (j, other) in values.iter().enumerate() {
                if j != i {
                    below = product_of(below, [x - other[0], y - other[1]]);
                }
            }
            let square = (below[0] * below[0]).plus(&below[1], &below[1]);
            let share = square.max(L::splat(LEAST_SQUARE)).inverse();
            let [u, v] = product_of(above, [below[0], -below[1]]);
            let [u, v] = [u * share, v * share];
            moved = moved.max(u.abs()).max(v.abs());
            values[i] = [x - u, y - v];
        }
    }
    for value in &mut values {
        value[0] += mean;
    }
    (values, moved)
}

/// The coefficients of the characteristic polynomial, from the second power's on down but for the first,
/// which is one (D. K. Faddeev and V. N. Faddeeva, Computational Methods of Linear Algebra, 1963).
#[inline(always)]
fn characteristic<L: Lanes, const N: usize>(t: &Square<L, N>) -> [L; N] {
    let mut out = [L::ZERO; N];
    let mut power = *t;
    for k in 0..N {
        let mut trace = L::ZERO;
        for i in 0..N {
            trace += power[i][i];
        }
        out[k] = trace.scaled(-1.0 / (k + 1) as f64);
        for i in 0..N {
            power[i][i] += out[k];
        }
        power = product(t, &power);
    }
    out
}

/// The vector that belongs to the eigenvalue nearest to a value, by inverse iteration, in which two
/// that are complex do no harm.
#[inline(always)]
fn eigenvector<L: Lanes, const N: usize>(given: &Square<L, N>, value: L) -> [L; N] {
    let mut shifted = *given;
    for (k, row) in shifted.iter_mut().enumerate() {
        row[k] = row[k] - value;
    }
    let r = triangular(shifted);
    // R⁻¹ takes the last column to where the shifted matrix has nearly nothing left.
    let mut x = [L::ZERO; N];
    x[N - 1] = L::ONE;
    for i in (0..N - 1).rev() {
        let mut above = L::ZERO;
        for j in i + 1..N {
            above = above.plus(&r[i][j], &x[j]);
        }
        x[i] = -above * r[i][i].inverse();
    }
    x
}

/// R of QR, by Gram and Schmidt.
#[inline(always)]
fn triangular<L: Lanes, const N: usize>(mut q: Square<L, N>) -> Square<L, N> {
    let mut r = [[L::ZERO; N]; N];
    for j in 0..N {
        for k in 0..j {
            for row in &q {
                r[k][j] = r[k][j].plus(&row[k], &row[j]);
            }
            for row in &mut q {
                row[j] = row[j].minus(&r[k][j], &row[k]);
            }
        }
        let mut square = L::ZERO;
        for row in &q {
            square = square.plus(&row[j], &row[j]);
        }
        r[j][j] = square.sqrt().max(L::splat(1e-150));
        let share = r[j][j].inverse();
        for row in &mut q {
            row[j] *= share;
        }
    }
    r
}

#[inline(always)]
fn product<L: Lanes, const N: usize>(a: &Square<L, N>, b: &Square<L, N>) -> Square<L, N> {
    let mut out = [[L::ZERO; N]; N];
    for (out, row) in out.iter_mut().zip(a) {
        for (entry, b) in row.iter().zip(b) {
            for j in 0..N {
                out[j] = out[j].plus(entry, &b[j]);
            }
        }
    }
    out
}
