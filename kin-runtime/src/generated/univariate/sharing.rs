//! Solutions that share the value of the kept joint.
//!
//! They span what the matrix takes to zero; the vectors of monomials in that space are
//! the eigenvectors of multiplication in it (W. Auzinger and H. J. Stetter, "An
//! elimination algorithm for the computation of all zeros of a system of multivariate
//! polynomial equations", ISNM 86, 1988).

use crate::math;

/// How many solutions may share it.
pub(super) const SHARING: usize = 4;

type Square = [[f64; SHARING]; SHARING];

/// Rounds of the QR algorithm. Those eigenvalues that are real and apart part by then
/// as far as a start of Newton's method needs it.
const ROUNDS: usize = 40;

/// Two functions of the half tangents whose ratio tells solutions apart: the
/// coefficients of 1, each of the two, and their product.
const ABOVE: [f64; 4] = [0.31, 0.83, -0.57, 0.44];
const BELOW: [f64; 4] = [0.92, -0.38, 0.29, 0.71];

/// The weights of the space's vectors that make up vectors of monomials, by vector; of
/// `entry(i, j)` the powers are i and j.
pub(super) fn monomial_vectors<'a>(
    entry: &impl Fn(usize, usize) -> &'a [f64; SHARING],
) -> [[f64; SHARING]; SHARING] {
    let (mut gram, mut image) = (Square::default(), Square::default());
    for i in 0..3 {
        for j in 0..3 {
            let corners = [
                entry(i, j),
                entry(i + 1, j),
                entry(i, j + 1),
                entry(i + 1, j + 1),
            ];
            let of = |weights: &[f64; 4], k: usize| -> f64 {
                (0..4).map(|c| weights[c] * corners[c][k]).sum()
            };
            for k in 0..SHARING {
                let below = of(&BELOW, k);
                for l in 0..SHARING {
                    gram[k][l] += below * of(&BELOW, l);
                    image[k][l] += below * of(&ABOVE, l);
                }
            }
        }
    }
    eigenvectors(solved(gram, image))
}

/// G⁻¹ H for a positive definite G.
fn solved(mut g: Square, mut h: Square) -> Square {
    for k in 0..SHARING {
        let pivot = 1.0 / math::max(g[k][k], 1e-30);
        for i in (0..SHARING).filter(|&i| i != k) {
            let share = g[i][k] * pivot;
            for j in 0..SHARING {
                g[i][j] -= share * g[k][j];
                h[i][j] -= share * h[k][j];
            }
        }
        for j in 0..SHARING {
            g[k][j] *= pivot;
            h[k][j] *= pivot;
        }
    }
    h
}

/// By the QR algorithm without shifts; where two eigenvalues are complex, two of the
/// vectors are none.
fn eigenvectors(mut t: Square) -> [[f64; SHARING]; SHARING] {
    let mut basis: Square =
        core::array::from_fn(|i| core::array::from_fn(|j| f64::from(u8::from(i == j))));
    for _ in 0..ROUNDS {
        let (q, r) = orthogonal_and_triangular(&t);
        t = product(&r, &q);
        basis = product(&basis, &q);
    }
    core::array::from_fn(|k| {
        let mut weights = [0.0; SHARING];
        weights[k] = 1.0;
        for i in (0..k).rev() {
            let above: f64 = (i + 1..=k).map(|j| t[i][j] * weights[j]).sum();
            let apart = t[i][i] - t[k][k];
            weights[i] = -above / math::max(apart.abs(), 1e-12).copysign(apart);
        }
        core::array::from_fn(|i| (0..SHARING).map(|j| basis[i][j] * weights[j]).sum())
    })
}

/// By Gram and Schmidt.
fn orthogonal_and_triangular(t: &Square) -> (Square, Square) {
    let (mut q, mut r) = (*t, Square::default());
    for j in 0..SHARING {
        for k in 0..j {
            r[k][j] = (0..SHARING).map(|i| q[i][k] * q[i][j]).sum();
            (0..SHARING).for_each(|i| q[i][j] -= r[k][j] * q[i][k]);
        }
        let square: f64 = (0..SHARING).map(|i| q[i][j] * q[i][j]).sum();
        r[j][j] = math::max(math::sqrt(square), 1e-150);
        (0..SHARING).for_each(|i| q[i][j] /= r[j][j]);
    }
    (q, r)
}

fn product(a: &Square, b: &Square) -> Square {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| (0..SHARING).map(|k| a[i][k] * b[k][j]).sum())
    })
}
