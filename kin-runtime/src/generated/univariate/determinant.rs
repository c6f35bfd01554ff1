//! Many matrices at once, as array lanes: their determinants, and what they
//! nearly take to zero.

use super::elimination::SIZE;
use crate::math;
use core::ops::Range;

/// Square matrices by row and column.
pub(super) type Matrices<const L: usize> = [[[f64; L]; SIZE]; SIZE];

/// Vectors by entry.
pub(super) type Vectors<const L: usize> = [[f64; L]; SIZE];

/// What is divided by instead of 0.
const LEAST_PIVOT: f64 = 1e-150;

/// M = L U, in the order in which rows and columns stand: that was chosen for
/// the arm, and how far it can be trusted at a target is seen in what comes out.
/// L has ones on its diagonal and takes the place below that of U.
///
/// The first four columns are of monomials that no shifted row has, the next four of
/// those that no other row has: half of the work is on zeros, and left out. `shifted`
/// tells the rows.
#[inline(always)]
pub(super) fn eliminate<const L: usize>(m: &mut Matrices<L>, shifted: u16) {
    const LOW: u16 = 0xff;
    for k in (0..4).step_by(2) {
        pivots(m, k, k + 2..4, 0xf | !shifted & !LOW);
    }
    for k in (4..8).step_by(2) {
        pivots(m, k, k + 2..8, LOW | shifted & !LOW);
    }
    for k in (8..SIZE).step_by(2) {
        pivots(m, k, k + 2..8, u16::MAX);
    }
}

/// Two pivots at a time, so that the matrices are read and written half as often.
/// They have entries in the columns given, and from the eighth on; bit i of `rows` is set
/// where row i has some there too.
#[inline(always)]
fn pivots<const L: usize>(m: &mut Matrices<L>, k: usize, near: Range<usize>, rows: u16) {
    let from = 8.max(k + 2);
    let first = m[k];
    let mut second = m[k + 1];
    let mut inverses = [[0.0; L]; 2];
    for lane in 0..L {
        inverses[0][lane] = 1.0 / pivot(first[k][lane]);
        second[k][lane] *= inverses[0][lane];
        second[k + 1][lane] -= second[k][lane] * first[k + 1][lane];
        inverses[1][lane] = 1.0 / pivot(second[k + 1][lane]);
    }
    for j in near.clone().chain(from..SIZE) {
        for lane in 0..L {
            second[j][lane] -= second[k][lane] * first[j][lane];
        }
    }
    m[k + 1] = second;
    for (i, row) in m.iter_mut().enumerate().skip(k + 2) {
        if rows >> i & 1 == 0 {
            continue;
        }
        let (mut a, mut b) = ([0.0; L], [0.0; L]);
        for lane in 0..L {
            a[lane] = row[k][lane] * inverses[0][lane];
            b[lane] = (row[k + 1][lane] - a[lane] * first[k + 1][lane]) * inverses[1][lane];
        }
        (row[k], row[k + 1]) = (a, b);
        for j in near.clone() {
            for lane in 0..L {
                row[j][lane] -= a[lane] * first[j][lane] + b[lane] * second[j][lane];
            }
        }
        for j in from..SIZE {
            for lane in 0..L {
                row[j][lane] -= a[lane] * first[j][lane] + b[lane] * second[j][lane];
            }
        }
    }
}

/// M = Q R by Householder's reflections, without Q: at twice the cost, and never
/// worse than rounding. The determinant of Q is −1.
#[inline(always)]
pub(super) fn reflect<const L: usize>(m: &mut Matrices<L>) {
    for k in 0..SIZE - 1 {
        let mut square = [0.0; L];
        for row in &m[k..] {
            for lane in 0..L {
                square[lane] += row[k][lane] * row[k][lane];
            }
        }
        let mut image = [0.0; L];
        let mut weight = [0.0; L];
        for lane in 0..L {
            let x = m[k][k][lane];
            image[lane] = -math::sqrt(square[lane]).copysign(x);
            // Without cancellation by the choice of sign.
            weight[lane] = 1.0 / math::max(square[lane] - image[lane] * x, LEAST_PIVOT);
            m[k][k][lane] = x - image[lane];
        }
        for j in k + 1..SIZE {
            let mut along = [0.0; L];
            for row in &m[k..] {
                for lane in 0..L {
                    along[lane] += row[k][lane] * row[j][lane];
                }
            }
            for lane in 0..L {
                along[lane] *= weight[lane];
            }
            for row in &mut m[k..] {
                for lane in 0..L {
                    row[j][lane] -= along[lane] * row[k][lane];
                }
            }
        }
        m[k][k] = image;
        m[k + 1..].iter_mut().for_each(|row| row[k] = [0.0; L]);
    }
}

/// The product of the diagonal.
#[inline(always)]
pub(super) fn product<const L: usize>(m: &Matrices<L>) -> [f64; L] {
    let mut product = [1.0; L];
    for (k, row) in m.iter().enumerate() {
        for lane in 0..L {
            product[lane] *= row[k][lane];
        }
    }
    product
}

/// The vector that L U nearly takes to zero, of length 1: inverse iteration
/// (J. H. Wilkinson, The Algebraic Eigenvalue Problem, 1965, chapter 5).
#[inline(always)]
pub(super) fn null_vector_of_factors<const L: usize>(m: &Matrices<L>) -> Vectors<L> {
    // L times a vector of ones is as good a start as any.
    let mut x = unit(&back_substituted(m, [[1.0; L]; SIZE]));
    for i in 1..SIZE {
        for j in 0..i {
            for lane in 0..L {
                x[i][lane] -= m[i][j][lane] * x[j][lane];
            }
        }
    }
    unit(&back_substituted(m, x))
}

/// The vector that Q R nearly takes to zero, of length 1: the least right
/// singular vector, by inverse iteration on Rᵀ R.
#[inline(always)]
pub(super) fn null_vector_of_triangle<const L: usize>(m: &Matrices<L>) -> Vectors<L> {
    let mut x = unit(&back_substituted(m, [[1.0; L]; SIZE]));
    for _ in 0..2 {
        x = improved(m, x);
    }
    x
}

/// An orthonormal basis of the plane that Q R nearly takes to zero: the two least right
/// singular vectors, by subspace iteration.
#[inline(always)]
pub(super) fn null_plane_of_triangle<const L: usize>(m: &Matrices<L>) -> [Vectors<L>; 2] {
    // Starts that no arm is square to.
    let start = |of: usize| core::array::from_fn(|i| [math::sin_cos((1 + i * of) as f64).0; L]);
    let mut plane = [start(1), start(2)];
    for _ in 0..3 {
        // No closure: it would be compiled for the narrowest instructions.
        let [first, second] = [improved(m, plane[0]), improved(m, plane[1])];
        let mut along = [0.0; L];
        for (x, y) in first.iter().zip(&second) {
            for lane in 0..L {
                along[lane] += x[lane] * y[lane];
            }
        }
        let mut across = second;
        for (x, y) in first.iter().zip(&mut across) {
            for lane in 0..L {
                y[lane] -= along[lane] * x[lane];
            }
        }
        plane = [first, unit(&across)];
    }
    plane
}

/// An orthonormal basis, by lane, of what Q R nearly takes to zero, if all lanes are
/// one matrix: the least right singular vectors, by subspace iteration.
pub(super) fn null_space_of_triangle<const L: usize>(m: &Matrices<L>) -> Vectors<L> {
    let mut x = [[0.0; L]; SIZE];
    for i in 0..SIZE {
        for lane in 0..L {
            // Starts that no arm is square to.
            x[i][lane] = math::sin_cos((1 + i * (lane + 1)) as f64).0;
        }
    }
    for _ in 0..3 {
        x = improved(m, x);
        for lane in 0..L {
            for before in 0..lane {
                let along: f64 = x.iter().map(|x| x[before] * x[lane]).sum();
                x.iter_mut().for_each(|x| x[lane] -= along * x[before]);
            }
            let square: f64 = x.iter().map(|x| x[lane] * x[lane]).sum();
            let share = 1.0 / math::max(math::sqrt(square), LEAST_PIVOT);
            x.iter_mut().for_each(|x| x[lane] *= share);
        }
    }
    x
}

/// One step of inverse iteration on Rᵀ R.
#[inline(always)]
fn improved<const L: usize>(m: &Matrices<L>, mut x: Vectors<L>) -> Vectors<L> {
    for i in 0..SIZE {
        for j in 0..i {
            for lane in 0..L {
                x[i][lane] -= m[j][i][lane] * x[j][lane];
            }
        }
        for lane in 0..L {
            x[i][lane] /= pivot(m[i][i][lane]);
        }
    }
    unit(&back_substituted(m, unit(&x)))
}

/// U⁻¹ x.
#[inline(always)]
fn back_substituted<const L: usize>(m: &Matrices<L>, mut x: Vectors<L>) -> Vectors<L> {
    for i in (0..SIZE).rev() {
        for j in i + 1..SIZE {
            for lane in 0..L {
                x[i][lane] -= m[i][j][lane] * x[j][lane];
            }
        }
        for lane in 0..L {
            x[i][lane] /= pivot(m[i][i][lane]);
        }
    }
    x
}

/// A pivot that can be divided by.
#[inline(always)]
fn pivot(x: f64) -> f64 {
    math::max(x.abs(), LEAST_PIVOT).copysign(x)
}

/// The vectors by their lengths.
#[inline(always)]
fn unit<const L: usize>(x: &Vectors<L>) -> Vectors<L> {
    let mut largest = [LEAST_PIVOT; L];
    for entry in x {
        for lane in 0..L {
            largest[lane] = math::max(largest[lane], entry[lane].abs());
        }
    }
    let mut square = [0.0; L];
    for entry in x {
        for lane in 0..L {
            let share = entry[lane] / largest[lane];
            square[lane] += share * share;
        }
    }
    let mut out = *x;
    for lane in 0..L {
        largest[lane] = 1.0 / (largest[lane] * math::sqrt(square[lane]));
    }
    for entry in &mut out {
        for lane in 0..L {
            entry[lane] *= largest[lane];
        }
    }
    out
}

/// M x.
#[inline(always)]
pub(super) fn times<const L: usize>(m: &Matrices<L>, x: &Vectors<L>) -> Vectors<L> {
    let mut out = [[0.0; L]; SIZE];
    for (out, row) in out.iter_mut().zip(m) {
        for (entry, x) in row.iter().zip(x) {
            for lane in 0..L {
                out[lane] += entry[lane] * x[lane];
            }
        }
    }
    out
}
