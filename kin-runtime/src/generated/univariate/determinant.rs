//! Many matrices at once, in lanes: their determinants, and what they nearly take to
//! zero.

use super::elimination::{AtValues, SIZE};
use super::lanes::{Lanes, dot};
use super::matrix::{Compact, Places, Vectors, WIDTH};

/// What is divided by instead of 0.
const LEAST_PIVOT: f64 = 1e-30;

/// Pivots at a time, so that the matrices are seldom read and written.
const BLOCK: usize = 4;

/// M = L U, in the order in which rows and columns stand: that was chosen for
/// the arm, and how far it can be trusted at a target is seen in what comes out.
/// L has ones on its diagonal and takes the place below that of U.
pub(super) struct Factors<L: Lanes> {
    rows: Compact<L>,
    inverses: Vectors<L>,
    /// Bit i is set where row i is multiplied by the last joint's half tangent.
    shifted: u16,
}

impl<L: Lanes> Factors<L> {
    /// Of nothing yet.
    pub const EMPTY: Self = Self {
        rows: [[L::ZERO; WIDTH]; SIZE],
        inverses: [L::ZERO; SIZE],
        shifted: 0,
    };

    /// Of the matrices of an elimination.
    #[inline(always)]
    pub fn factor(&mut self, places: &Places, equations: &AtValues<L>) {
        places.write(equations, &mut self.rows);
        self.shifted = places.shifted;
        const LOW: u16 = 0xff;
        self.block::<0>(0, !self.shifted & !LOW);
        self.block::<0>(BLOCK, self.shifted & !LOW);
        self.block::<BLOCK>(2 * BLOCK, 0xf << (3 * BLOCK));
        self.block::<{ 2 * BLOCK }>(3 * BLOCK, 0);
    }

    /// Pivots of four rows from the `first` on, in the columns from `COLUMN` on of those
    /// that they have; bit i of `others` is set where row i has them too.
    #[inline(always)]
    fn block<const COLUMN: usize>(&mut self, first: usize, others: u16) {
        let (above, below) = self.rows.split_at_mut(first + BLOCK);
        let pivots = &mut above[first..];
        for k in 0..BLOCK {
            let (done, rest) = pivots.split_at_mut(k + 1);
            let (row, column) = (&done[k], COLUMN + k);
            let inverse = row[column].away_from_zero(LEAST_PIVOT).inverse();
            self.inverses[first + k] = inverse;
            for other in rest {
                let share = other[column] * inverse;
                other[column] = share;
                for j in column + 1..WIDTH {
                    other[j] = other[j].minus(&share, &row[j]);
                }
            }
        }
        for (i, row) in (first + BLOCK..).zip(below) {
            if others >> i & 1 == 0 {
                continue;
            }
            let mut shares = [L::ZERO; BLOCK];
            for k in 0..BLOCK {
                let mut share = row[COLUMN + k];
                for l in 0..k {
                    share = share.minus(&shares[l], &pivots[l][COLUMN + k]);
                }
                shares[k] = share * self.inverses[first + k];
                row[COLUMN + k] = shares[k];
            }
            for j in COLUMN + BLOCK..WIDTH {
                let mut entry = row[j];
                for k in 0..BLOCK {
                    entry = entry.minus(&shares[k], &pivots[k][j]);
                }
                row[j] = entry;
            }
        }
    }

    /// Their product is the determinant.
    #[inline(always)]
    pub fn pivots(&self) -> Vectors<L> {
        let mut pivots = [L::ZERO; SIZE];
        for (k, row) in self.rows.iter().enumerate() {
            pivots[k] = row[column_of(k)];
        }
        pivots
    }

    /// The vector that L U nearly takes to zero, of length 1: inverse iteration
    /// (J. H. Wilkinson, The Algebraic Eigenvalue Problem, 1965, chapter 5).
    #[inline(always)]
    pub fn null_vectors(&self) -> Vectors<L> {
        // L times a vector of ones is as good a start as any.
        let mut x = [L::ONE; SIZE];
        back_substitute(&self.rows, &self.inverses, &mut x);
        x = unit(&x);
        self.forward_substitute(&mut x);
        back_substitute(&self.rows, &self.inverses, &mut x);
        unit(&x)
    }

    /// x becomes L⁻¹ x.
    #[inline(always)]
    fn forward_substitute(&self, x: &mut Vectors<L>) {
        for k in 0..BLOCK {
            for i in k + 1..BLOCK {
                for first in [0, BLOCK] {
                    x[first + i] = x[first + i].minus(&self.rows[first + i][k], &x[first + k]);
                }
            }
        }
        let both = [part(x, 0), part(x, 1)];
        for i in 2 * BLOCK..SIZE {
            let known = &both[usize::from(self.shifted >> i & 1)];
            for k in 0..BLOCK {
                x[i] = x[i].minus(&self.rows[i][k], &known[k]);
            }
        }
        for k in 2 * BLOCK..SIZE {
            for i in k + 1..SIZE {
                x[i] = x[i].minus(&self.rows[i][column_of(k)], &x[k]);
            }
        }
    }
}

/// The column of pivot k, without the columns in which its row has no entry.
#[inline(always)]
fn column_of(k: usize) -> usize {
    if k < 2 * BLOCK { k % BLOCK } else { k - BLOCK }
}

/// x becomes U⁻¹ x. Of the first two blocks of four pivots neither has entries in the other's
/// columns.
#[inline(always)]
fn back_substitute<L: Lanes>(u: &Compact<L>, inverses: &Vectors<L>, x: &mut Vectors<L>) {
    for block in (0..SIZE / BLOCK).rev() {
        let first = BLOCK * block;
        let mut own = part(x, block);
        for behind in (block + 1).max(2)..SIZE / BLOCK {
            let known = part(x, behind);
            for j in 0..BLOCK {
                for i in 0..BLOCK {
                    let entry = u[first + i][column_of(BLOCK * behind) + j];
                    own[i] = own[i].minus(&entry, &known[j]);
                }
            }
        }
        for k in (0..BLOCK).rev() {
            own[k] *= inverses[first + k];
            for i in 0..k {
                own[i] = own[i].minus(&u[first + i][column_of(first) + k], &own[k]);
            }
        }
        x[first..first + BLOCK].copy_from_slice(&own);
    }
}

/// x becomes U⁻ᵀ x.
#[inline(always)]
fn back_substitute_transposed<L: Lanes>(u: &Compact<L>, inverses: &Vectors<L>, x: &mut Vectors<L>) {
    for block in 0..SIZE / BLOCK {
        let first = BLOCK * block;
        let mut own = part(x, block);
        for before in 0..if block < 2 { 0 } else { block } {
            let known = part(x, before);
            for i in 0..BLOCK {
                for j in 0..BLOCK {
                    let entry = u[BLOCK * before + i][column_of(first) + j];
                    own[j] = own[j].minus(&entry, &known[i]);
                }
            }
        }
        for k in 0..BLOCK {
            own[k] *= inverses[first + k];
            for j in k + 1..BLOCK {
                own[j] = own[j].minus(&u[first + k][column_of(first) + j], &own[k]);
            }
        }
        x[first..first + BLOCK].copy_from_slice(&own);
    }
}

/// A block's entries of a vector.
#[inline(always)]
fn part<L: Lanes>(x: &Vectors<L>, block: usize) -> [L; BLOCK] {
    let first = BLOCK * block;
    [x[first], x[first + 1], x[first + 2], x[first + 3]]
}

/// M = Q R by Householder's reflections, without Q: at twice the cost, and never
/// worse than rounding. The determinant of Q is −1.
pub(super) struct Triangle<L: Lanes> {
    rows: Compact<L>,
    inverses: Vectors<L>,
}

/// Rows that are reflected together.
#[derive(Clone, Copy, Default)]
struct Together {
    rows: [u8; SIZE],
    count: usize,
}

impl Together {
    fn push(&mut self, row: usize) {
        self.rows[self.count % SIZE] = row as u8;
        self.count += 1;
    }
}

impl<L: Lanes> Triangle<L> {
    /// Of the matrices of an elimination. Where a row has no entries nothing is reflected: first
    /// the rows that are multiplied by the last joint's half tangent and the others, each with
    /// four pivots of their own, then what is left of both.
    #[inline(always)]
    pub fn new(places: &Places, equations: &AtValues<L>) -> Self {
        let mut out = Self {
            rows: [[L::ZERO; WIDTH]; SIZE],
            inverses: [L::ZERO; SIZE],
        };
        places.write(equations, &mut out.rows);
        let mut together = [Together::default(); 3];
        for row in 0..SIZE {
            if row < 2 * BLOCK {
                together[row / BLOCK].push(row);
            } else {
                together[usize::from(places.shifted >> row & 1)].push(row);
                together[2].push(row);
            }
        }
        for k in 0..SIZE - 1 {
            let block = (k / BLOCK).min(2);
            let Together { rows, count } = &together[block];
            out.reflect(k, &rows[k - block * BLOCK..*count]);
        }
        let last = out.rows[SIZE - 1][WIDTH - 1];
        out.inverses[SIZE - 1] = last.away_from_zero(LEAST_PIVOT).inverse();
        out
    }

    /// The first of some rows becomes that of pivot k, and the others have nothing in its column
    /// but what nobody reads.
    #[inline(always)]
    fn reflect(&mut self, k: usize, rows: &[u8]) {
        let column = column_of(k);
        let at = |i: &u8| usize::from(*i) % SIZE;
        let mut square = L::ZERO;
        for i in rows {
            let x = self.rows[at(i)][column];
            square = square.plus(&x, &x);
        }
        let x = self.rows[k][column];
        let root = square.sqrt();
        // Without cancellation by the choice of sign.
        let image = x.where_less(L::ZERO, root, -root);
        let weight = square
            .minus(&image, &x)
            .max(L::splat(LEAST_PIVOT))
            .inverse();
        self.rows[k][column] = x - image;
        // From the last columns on, since those about the pivot's spoil it.
        for block in (column / BLOCK..WIDTH / BLOCK).rev() {
            let first = BLOCK * block;
            let mut along = [L::ZERO; BLOCK];
            for i in rows {
                let row = &self.rows[at(i)];
                for j in 0..BLOCK {
                    along[j] = along[j].plus(&row[column], &row[first + j]);
                }
            }
            for along in &mut along {
                *along *= weight;
            }
            for i in rows {
                let row = &mut self.rows[at(i)];
                let x = row[column];
                for j in 0..BLOCK {
                    row[first + j] = row[first + j].minus(&along[j], &x);
                }
            }
        }
        self.rows[k][column] = image;
        self.inverses[k] = image.away_from_zero(LEAST_PIVOT).inverse();
    }

    /// The diagonal of R: their product is minus the determinant.
    #[inline(always)]
    pub fn pivots(&self) -> Vectors<L> {
        let mut pivots = [L::ZERO; SIZE];
        for (k, row) in self.rows.iter().enumerate() {
            pivots[k] = row[column_of(k)];
        }
        pivots
    }

    /// About the norm of the inverse, and no more: by a step of inverse iteration on Rᵀ R.
    #[inline(always)]
    pub fn inverse_norm(&self) -> L {
        let mut x = [L::ZERO; SIZE];
        for (i, x) in x.iter_mut().enumerate() {
            *x = L::splat(START[i]);
        }
        back_substitute_transposed(&self.rows, &self.inverses, &mut x);
        x = unit(&x);
        back_substitute(&self.rows, &self.inverses, &mut x);
        dot(&x, &x).sqrt()
    }

    /// An orthonormal basis of what Q R nearly takes to zero: the least right singular
    /// vectors, by subspace iteration on Rᵀ R; and about how long what they are taken to is.
    #[inline(always)]
    pub fn null_space<const N: usize>(&self) -> ([Vectors<L>; N], [L; N]) {
        let mut lengths = [L::ZERO; N];
        let mut space = [[L::ZERO; SIZE]; N];
        for (n, x) in space.iter_mut().enumerate() {
            for (i, x) in x.iter_mut().enumerate() {
                // Starts that no arm is square to.
                *x = L::splat(START[(n + 1) * i % START.len()]);
            }
        }
        for _ in 0..3 {
            for x in &mut space {
                back_substitute_transposed(&self.rows, &self.inverses, x);
                *x = unit(x);
                back_substitute(&self.rows, &self.inverses, x);
            }
            for n in 0..N {
                for m in 0..n {
                    let along = dot(&space[m], &space[n]);
                    for i in 0..SIZE {
                        space[n][i] = space[n][i].minus(&along, &space[m][i]);
                    }
                }
                lengths[n] = dot(&space[n], &space[n]).sqrt().inverse();
                for entry in &mut space[n] {
                    *entry *= lengths[n];
                }
            }
        }
        (space, lengths)
    }
}

/// Numbers of no pattern, more than a vector has entries: the fractional parts of
/// multiples of the golden ratio, about 0.
const START: [f64; 61] = {
    let mut out = [0.0; 61];
    let mut i = 0;
    while i < out.len() {
        let x = (i + 1) as f64 * 0.618_033_988_749_894_8;
        out[i] = x - (x as u32) as f64 - 0.48;
        i += 1;
    }
    out
};

/// The vectors by their lengths.
#[inline(always)]
fn unit<L: Lanes>(x: &Vectors<L>) -> Vectors<L> {
    let share = dot(x, x).sqrt().inverse();
    let mut out = *x;
    for entry in &mut out {
        *entry *= share;
    }
    out
}
