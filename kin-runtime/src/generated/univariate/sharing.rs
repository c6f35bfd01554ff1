//! Solutions that share the value of the kept joint.
//!
//! They span what the matrix takes to zero; the vectors of monomials in that space are
//! the eigenvectors of multiplication in it (W. Auzinger and H. J. Stetter, "An
//! elimination algorithm for the computation of all zeros of a system of multivariate
//! polynomial equations", ISNM 86, 1988).

use super::elimination::SIZE;
use super::lanes::Lanes;
use super::matrix::Vectors;

/// How many solutions may share it.
pub(super) const SHARING: usize = 4;

type Square<L, const N: usize> = [[L; N]; N];

/// Rounds of the QR algorithm on the fourth power. Those eigenvalues that are real and apart
/// part by then as far as a start of Newton's method needs it.
const ROUNDS: usize = 10;

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

/// The vectors of monomials in a space; where two are complex, one of a pair their real
/// part, of more something else. `column` tells the place of a monomial by its powers; all up to
/// `powers` are there.
#[inline(always)]
pub(super) fn monomial_vectors<L: Lanes, const N: usize>(
    space: &[Vectors<L>; N],
    column: &impl Fn(usize, usize) -> usize,
    powers: [usize; 2],
    ratio: Ratio,
) -> [Vectors<L>; N] {
    let by_ratio = multiplication(space, column, powers, ratio);
    let weights = match N {
        2 => of_pair(by_ratio),
        _ => eigenvectors(by_ratio),
    };
    let mut out = [[L::ZERO; SIZE]; N];
    for (out, weights) in out.iter_mut().zip(&weights) {
        for (x, weight) in space.iter().zip(weights) {
            for (out, x) in out.iter_mut().zip(x) {
                *out = out.plus(x, weight);
            }
        }
    }
    out
}

/// What multiplication by the ratio does to the space's vectors, in the sense of least
/// squares.
#[inline(always)]
fn multiplication<L: Lanes, const N: usize>(
    space: &[Vectors<L>; N],
    column: &impl Fn(usize, usize) -> usize,
    powers: [usize; 2],
    Ratio(numerator, denominator): Ratio,
) -> Square<L, N> {
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

/// G⁻¹ H for a positive definite G.
#[inline(always)]
fn solved<L: Lanes, const N: usize>(mut g: Square<L, N>, mut h: Square<L, N>) -> Square<L, N> {
    for k in 0..N {
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
    h
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

/// Eigenvalues by the QR algorithm without shifts, on the fourth power, which has the same vectors
/// and needs a quarter of the rounds; where two are complex, two of the vectors are none.
#[inline(always)]
fn eigenvectors<L: Lanes, const N: usize>(given: Square<L, N>) -> Square<L, N> {
    let square = product(&given, &given);
    let mut t = product(&square, &square);
    let mut basis = [[L::ZERO; N]; N];
    for (k, row) in basis.iter_mut().enumerate() {
        row[k] = L::ONE;
    }
    for _ in 0..ROUNDS {
        let (q, r) = orthogonal_and_triangular(&t);
        t = product(&r, &q);
        basis = product(&basis, &q);
    }
    let image = product(&given, &basis);
    let mut out = [[L::ZERO; N]; N];
    for (k, out) in out.iter_mut().enumerate() {
        let mut value = L::ZERO;
        for i in 0..N {
            value = value.plus(&basis[i][k], &image[i][k]);
        }
        *out = eigenvector(&given, value);
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
    let (_, r) = orthogonal_and_triangular(&shifted);
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

/// By Gram and Schmidt.
#[inline(always)]
fn orthogonal_and_triangular<L: Lanes, const N: usize>(
    t: &Square<L, N>,
) -> (Square<L, N>, Square<L, N>) {
    let (mut q, mut r) = (*t, [[L::ZERO; N]; N]);
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
    (q, r)
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
