//! Two solutions that share the value of the kept joint.
//!
//! They span the plane that the matrix takes to zero; the vectors of monomials in it are
//! the eigenvectors of multiplication (W. Auzinger and H. J. Stetter, "An elimination
//! algorithm for the computation of all zeros of a system of multivariate polynomial
//! equations", ISNM 86, 1988).

use super::LANES;
use super::determinant::Vectors;
use crate::math;

type Lanes = [f64; LANES];

/// Two functions of the half tangents whose ratio tells solutions apart: the
/// coefficients of 1, each of the two, and their product.
const ABOVE: [f64; 4] = [0.31, 0.83, -0.57, 0.44];
const BELOW: [f64; 4] = [0.92, -0.38, 0.29, 0.71];

/// How much of each of the plane's vectors makes a vector of monomials, twice; where the
/// two are complex, their real part twice. `column` tells the place of a monomial by its
/// powers.
#[inline(always)]
pub(super) fn monomial_vectors(
    plane: &[Vectors<LANES>; 2],
    column: impl Fn(usize, usize) -> usize,
) -> [[Lanes; 2]; 2] {
    let mut gram = [[[0.0; LANES]; 2]; 2];
    let mut image = gram;
    for i in 0..3 {
        for j in 0..3 {
            let corners = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)];
            let corners = corners.map(|(i, j)| column(i, j));
            let of = |weights: &[f64; 4], vector: &Vectors<LANES>| -> Lanes {
                let mut out = [0.0; LANES];
                for (weight, &corner) in weights.iter().zip(&corners) {
                    for k in 0..LANES {
                        out[k] += weight * vector[corner][k];
                    }
                }
                out
            };
            let below = plane.each_ref().map(|x| of(&BELOW, x));
            let above = plane.each_ref().map(|x| of(&ABOVE, x));
            for a in 0..2 {
                for b in 0..2 {
                    for k in 0..LANES {
                        gram[a][b][k] += below[a][k] * below[b][k];
                        image[a][b][k] += below[a][k] * above[b][k];
                    }
                }
            }
        }
    }
    let mut out = [[[0.0; LANES]; 2]; 2];
    for k in 0..LANES {
        let at = |m: &[[Lanes; 2]; 2]| m.map(|row| row.map(|x| x[k]));
        let vectors = eigenvectors(adjugate_times(at(&gram), at(&image)));
        for (out, vector) in out.iter_mut().zip(vectors) {
            (out[0][k], out[1][k]) = (vector[0], vector[1]);
        }
    }
    out
}

type Square = [[f64; 2]; 2];

/// G⁻¹ H but for a factor, which eigenvectors do not see.
#[inline(always)]
fn adjugate_times([[a, b], [c, d]]: Square, h: Square) -> Square {
    let row = |x: f64, y: f64| [0, 1].map(|j| x * h[0][j] + y * h[1][j]);
    [row(d, -b), row(-c, a)]
}

#[inline(always)]
fn eigenvectors([[a, b], [c, d]]: Square) -> Square {
    let half = 0.5 * (a - d);
    let root = math::sqrt(math::max(half * half + b * c, 0.0));
    // The one without cancellation, of the two rows that tell it.
    let vector = |root: f64| {
        let (x, y) = ([b, root - half], [root + half, c]);
        let first = root * half < 0.0;
        [0, 1].map(|i| math::select(first, x[i], y[i]))
    };
    [vector(root), vector(-root)]
}
