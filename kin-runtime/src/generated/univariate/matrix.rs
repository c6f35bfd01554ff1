//! The matrix whose determinant is the polynomial, as the equations make it.

use super::elimination::{AtValues, EQUATIONS, Elimination, SIZE};
use super::lanes::Lanes;

/// Vectors by entry.
pub(super) type Vectors<L> = [L; SIZE];

/// Columns in which a row may have entries: the first four of the matrix or the next four,
/// and the last eight.
pub(super) const WIDTH: usize = 12;

/// The matrix without the columns in which a row has none.
///
/// The first four columns are of monomials that no shifted row has, the next four of
/// those that no other row has.
pub(super) type Compact<L> = [[L; WIDTH]; SIZE];

/// Where the equations stand in the matrix of an elimination.
pub(super) struct Places {
    /// By row and column of the compact matrix, and some places that make whole vectors: which
    /// coefficient, counted through all equations.
    sources: [[u8; SIZE]; SIZE],
    /// Bit i is set where row i is multiplied by the last joint's half tangent.
    pub shifted: u16,
}

/// The equation that is 1 = 0 has its 1 here, and zeros behind.
const ONE: u8 = 9 * (EQUATIONS as u8 - 1);
const ZERO: u8 = ONE + 1;
const LAST: usize = 9 * EQUATIONS - 1;

impl Places {
    pub fn new(elimination: &Elimination) -> Self {
        let mut sources = [[ZERO; SIZE]; SIZE];
        let mut shifted = 0;
        // By monomial, without the columns in which a row has no entries.
        let mut columns = elimination.columns;
        for column in &mut columns {
            *column = if *column < 4 { *column } else { *column - 4 };
        }
        for (k, (row, &[equation, shift])) in sources.iter_mut().zip(&elimination.rows).enumerate()
        {
            let mut put = |monomial: u8, source: u8| {
                row[usize::from(columns[usize::from(monomial & 15)] & 15)] = source;
            };
            if usize::from(equation) == EQUATIONS - 1 {
                put(shift, ONE);
                let column = elimination.columns[usize::from(shift & 15)];
                shifted |= u16::from(is_shifted(column)) << k;
                continue;
            }
            shifted |= u16::from(shift & 1) << k;
            let first = (shift & 1) + 4 * (shift >> 1 & 1);
            for i in 0..3 {
                for j in 0..3 {
                    put(first + i + 4 * j, 9 * equation + 3 * i + j);
                }
            }
        }
        Self { sources, shifted }
    }

    /// The entry of a row in a column of the compact matrix.
    #[inline(always)]
    fn entry<L: Lanes>(&self, equations: &AtValues<L>, row: usize, column: usize) -> L {
        equations.as_flattened()[usize::from(self.sources[row][column]).min(LAST)]
    }

    /// The column of the matrix that a row has in this one of the compact matrix.
    #[inline(always)]
    fn column(&self, row: usize, column: usize) -> usize {
        match column < 4 {
            true => column + 4 * usize::from(self.shifted >> row & 1),
            false => column + 4,
        }
    }

    /// Writes the matrices without the columns in which a row has no entries.
    #[inline(always)]
    pub fn write<L: Lanes>(&self, equations: &AtValues<L>, out: &mut Compact<L>) {
        for row in 0..SIZE {
            for column in 0..WIDTH {
                out[row][column] = self.entry(equations, row, column);
            }
        }
    }

    /// The matrices times vectors.
    #[inline(always)]
    pub fn times<L: Lanes>(&self, equations: &AtValues<L>, x: &Vectors<L>) -> Vectors<L> {
        let mut out = [L::ZERO; SIZE];
        for row in 0..SIZE {
            for column in 0..WIDTH {
                let entry = self.entry(equations, row, column);
                out[row] = out[row].plus(&entry, &x[self.column(row, column)]);
            }
        }
        out
    }
}

/// Whether only rows that are multiplied by the last joint's half tangent have a column.
fn is_shifted(column: u8) -> bool {
    (4..8).contains(&column)
}
