//! The matrix whose determinant is the polynomial, as the equations make it.

use super::elimination::{EQUATIONS, Elimination, SIZE};
use super::lanes::Lanes;

/// Square matrices by row and column.
pub(super) type Matrices<L> = [[L; SIZE]; SIZE];

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
    rows: [Row; SIZE],
    /// Bit i is set where row i is multiplied by the last joint's half tangent.
    pub shifted: u16,
}

#[derive(Clone, Copy, Default)]
struct Row {
    equation: u8,
    /// The columns of its entries.
    entries: [u8; 9],
    /// The columns among its twelve in which it has none.
    empty: [u8; 3],
}

impl Places {
    pub fn new(elimination: &Elimination) -> Self {
        let mut rows = [Row::default(); SIZE];
        let mut shifted = 0;
        for (k, (row, &[equation, shift])) in rows.iter_mut().zip(&elimination.rows).enumerate() {
            if usize::from(equation) == EQUATIONS - 1 {
                let column = elimination.columns[usize::from(shift & 15)];
                *row = Row::alone(column);
                shifted |= u16::from(is_shifted(column)) << k;
                continue;
            }
            row.equation = equation;
            shifted |= u16::from(shift & 1) << k;
            let (i0, j0) = (usize::from(shift & 1), usize::from(shift >> 1 & 1));
            let column = |i: usize, j: usize| elimination.columns[i + i0 + 4 * j];
            for i in 0..3 {
                for j in 0..3 {
                    row.entries[3 * i + j] = column(i, j + j0);
                }
                row.empty[i] = column(i, 3 * (1 - j0));
            }
        }
        Self { rows, shifted }
    }

    /// The matrices.
    #[inline(always)]
    pub fn matrices<L: Lanes>(&self, equations: &[[L; 9]; EQUATIONS]) -> Matrices<L> {
        let mut out = [[L::ZERO; SIZE]; SIZE];
        for (out, row) in out.iter_mut().zip(&self.rows) {
            for (column, entry) in row.entries.iter().zip(row.of(equations)) {
                out[usize::from(*column) % SIZE] = *entry;
            }
        }
        out
    }

    /// Writes them without the columns in which a row has no entries.
    #[inline(always)]
    pub fn write<L: Lanes>(&self, equations: &[[L; 9]; EQUATIONS], out: &mut Compact<L>) {
        let place = |column: u8| usize::from(column - 4 * u8::from(column > 3)) % WIDTH;
        for (out, row) in out.iter_mut().zip(&self.rows) {
            for (column, entry) in row.entries.iter().zip(row.of(equations)) {
                out[place(*column)] = *entry;
            }
            for column in row.empty {
                out[place(column)] = L::ZERO;
            }
        }
    }

    /// The matrices times vectors.
    #[inline(always)]
    pub fn times<L: Lanes>(&self, equations: &[[L; 9]; EQUATIONS], x: &Vectors<L>) -> Vectors<L> {
        let mut out = [L::ZERO; SIZE];
        for (out, row) in out.iter_mut().zip(&self.rows) {
            for (column, entry) in row.entries.iter().zip(row.of(equations)) {
                *out = out.plus(*entry, x[usize::from(*column) % SIZE]);
            }
        }
        out
    }
}

/// Whether only rows that are multiplied by the last joint's half tangent have a column.
fn is_shifted(column: u8) -> bool {
    (4..8).contains(&column)
}

impl Row {
    /// With a single entry.
    fn alone(column: u8) -> Self {
        let first = if is_shifted(column) { 4 } else { 0 };
        let mut row = Self {
            equation: EQUATIONS as u8 - 1,
            ..Self::default()
        };
        row.entries[0] = column;
        let others = (first..first + 4).chain(8..16).filter(|&c| c != column);
        let places = row.entries[1..].iter_mut().chain(&mut row.empty);
        places.zip(others).for_each(|(place, other)| *place = other);
        row
    }

    #[inline(always)]
    fn of<'e, L>(&self, equations: &'e [[L; 9]; EQUATIONS]) -> &'e [L; 9] {
        &equations[usize::from(self.equation) % EQUATIONS]
    }
}
