//! Many matrices at once, in lanes: their determinants, and what they nearly take to
//! zero.

use super::elimination::{EQUATIONS, SIZE};
use super::lanes::{Lanes, dot};
use super::matrix::{Compact, Matrices, Places, Vectors, WIDTH};

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
    pub fn factor(&mut self, places: &Places, equations: &[[L; 9]; EQUATIONS]) {
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
                    other[j] = other[j].minus(share, row[j]);
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
                    share = share.minus(shares[l], pivots[l][COLUMN + k]);
                }
                shares[k] = share * self.inverses[first + k];
                row[COLUMN + k] = shares[k];
            }
            for j in COLUMN + BLOCK..WIDTH {
                let mut entry = row[j];
                for k in 0..BLOCK {
                    entry = entry.minus(shares[k], pivots[k][j]);
                }
                row[j] = entry;
            }
        }
    }

    /// The column of pivot k in its row.
    #[inline(always)]
    fn column(k: usize) -> usize {
        if k < 2 * BLOCK { k % BLOCK } else { k - BLOCK }
    }

    /// Their product is the determinant.
    #[inline(always)]
    pub fn pivots(&self) -> Vectors<L> {
        let mut pivots = [L::ZERO; SIZE];
        for (k, row) in self.rows.iter().enumerate() {
            pivots[k] = row[Self::column(k)];
        }
        pivots
    }

    /// The vector that L U nearly takes to zero, of length 1: inverse iteration
    /// (J. H. Wilkinson, The Algebraic Eigenvalue Problem, 1965, chapter 5).
    #[inline(always)]
    pub fn null_vectors(&self) -> Vectors<L> {
        // L times a vector of ones is as good a start as any.
        let x = unit(&self.back_substituted([L::ONE; SIZE]));
        unit(&self.back_substituted(self.forward_substituted(x)))
    }

    /// L⁻¹ x.
    #[inline(always)]
    fn forward_substituted(&self, mut x: Vectors<L>) -> Vectors<L> {
        for (i, row) in self.rows.iter().enumerate() {
            let own = if i < 2 * BLOCK { i % BLOCK } else { BLOCK };
            let first = match self.shifted >> i & 1 {
                0 => 0,
                _ => BLOCK,
            };
            let mut entry = x[i];
            for k in 0..own {
                entry = entry.minus(row[k], x[first + k]);
            }
            for k in 2 * BLOCK..i {
                entry = entry.minus(row[k - BLOCK], x[k]);
            }
            x[i] = entry;
        }
        x
    }

    /// U⁻¹ x.
    #[inline(always)]
    fn back_substituted(&self, mut x: Vectors<L>) -> Vectors<L> {
        for (i, row) in self.rows.iter().enumerate().rev() {
            let mut entry = x[i];
            for j in (i + 1).max(2 * BLOCK)..SIZE {
                entry = entry.minus(row[j - BLOCK], x[j]);
            }
            if i < 2 * BLOCK {
                for j in i % BLOCK + 1..BLOCK {
                    entry = entry.minus(row[j], x[i / BLOCK * BLOCK + j]);
                }
            }
            x[i] = entry * self.inverses[i];
        }
        x
    }
}

/// M = Q R by Householder's reflections, without Q: at twice the cost, and never
/// worse than rounding. The determinant of Q is −1.
pub(super) struct Triangle<L: Lanes> {
    rows: Matrices<L>,
    inverses: Vectors<L>,
}

impl<L: Lanes> Triangle<L> {
    #[inline(always)]
    pub fn new(mut m: Matrices<L>) -> Self {
        let mut inverses = [L::ZERO; SIZE];
        for k in 0..SIZE {
            let mut square = L::ZERO;
            for row in &m[k..] {
                square = square.plus(row[k], row[k]);
            }
            let x = m[k][k];
            let root = square.sqrt();
            let mut image = x.where_less(L::ZERO, root, -root);
            if k + 1 == SIZE {
                image = x;
            } else {
                // Without cancellation by the choice of sign.
                let weight = square.minus(image, x).max(L::splat(LEAST_PIVOT)).inverse();
                m[k][k] = x - image;
                for j in k + 1..SIZE {
                    let mut along = L::ZERO;
                    for row in &m[k..] {
                        along = along.plus(row[k], row[j]);
                    }
                    along *= weight;
                    for row in &mut m[k..] {
                        row[j] = row[j].minus(along, row[k]);
                    }
                }
            }
            m[k][k] = image;
            inverses[k] = image.away_from_zero(LEAST_PIVOT).inverse();
        }
        Self { rows: m, inverses }
    }

    /// The diagonal of R: their product is minus the determinant.
    #[inline(always)]
    pub fn pivots(&self) -> Vectors<L> {
        let mut pivots = [L::ZERO; SIZE];
        for (k, row) in self.rows.iter().enumerate() {
            pivots[k] = row[k];
        }
        pivots
    }

    /// An orthonormal basis of what Q R nearly takes to zero: the least right singular
    /// vectors, by subspace iteration on Rᵀ R.
    #[inline(always)]
    pub fn null_space<const N: usize>(&self) -> [Vectors<L>; N] {
        let mut space = [[L::ZERO; SIZE]; N];
        for (n, x) in space.iter_mut().enumerate() {
            for (i, x) in x.iter_mut().enumerate() {
                // Starts that no arm is square to.
                *x = L::splat(START[(n + 1) * i % START.len()]);
            }
        }
        for _ in 0..3 {
            for n in 0..N {
                let mut x = self.improved(&space[n]);
                for before in &space[..n] {
                    let along = dot(before, &x);
                    for i in 0..SIZE {
                        x[i] = x[i].minus(along, before[i]);
                    }
                }
                space[n] = unit(&x);
            }
        }
        space
    }

    /// One step of inverse iteration on Rᵀ R.
    #[inline(always)]
    fn improved(&self, x: &Vectors<L>) -> Vectors<L> {
        let mut x = *x;
        for i in 0..SIZE {
            let mut entry = x[i];
            for j in 0..i {
                entry = entry.minus(self.rows[j][i], x[j]);
            }
            x[i] = entry * self.inverses[i];
        }
        x = unit(&x);
        for i in (0..SIZE).rev() {
            let mut entry = x[i];
            for j in i + 1..SIZE {
                entry = entry.minus(self.rows[i][j], x[j]);
            }
            x[i] = entry * self.inverses[i];
        }
        x
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
