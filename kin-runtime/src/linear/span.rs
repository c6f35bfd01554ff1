//! What the joints of a chain can do together, and what they cannot.

use crate::math;

/// A twist or a wrench with its angular part in metres; see
/// [`Posture`](crate::parallel::posture::Posture).
pub(crate) type Vector6 = [f64; 6];

/// A column that the others leave no more than this of, relative to the
/// longest, is one of their combinations: the rounding of a long chain.
const DEPENDENT: f64 = 1e-10;

pub(crate) fn dot(a: &Vector6, b: &Vector6) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// An orthonormal basis of the columns' span, and how the columns come of it:
/// QR with the longest remainder first, which reveals the rank.
pub(crate) struct Span {
    basis: [Vector6; 6],
    /// Entry (i, j), i ≤ j: basis vector i in the j-th column chosen.
    triangle: [[f64; 6]; 6],
    columns: [usize; 6],
    rank: usize,
}

impl Span {
    pub(crate) fn of(count: usize, column: impl Fn(usize) -> Vector6) -> Self {
        let mut span = Span {
            basis: [[0.0; 6]; 6],
            triangle: [[0.0; 6]; 6],
            columns: [0; 6],
            rank: 0,
        };
        let mut longest = 0.0;
        while span.rank < 6.min(count) {
            let rest = |j: usize| {
                let rest = span.reject(column(j));
                (j, dot(&rest, &rest))
            };
            let next = (0..count).map(rest).max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((j, square)) = next else { break };
            let length = math::sqrt(square);
            if span.rank == 0 {
                longest = length;
            }
            if length.is_nan() || length <= DEPENDENT * longest {
                break;
            }
            span.take(j, column(j));
        }
        span
    }

    fn take(&mut self, j: usize, column: Vector6) {
        let rest = self.reject(column);
        let length = math::sqrt(dot(&rest, &rest));
        let n = self.rank;
        self.basis[n] = rest.map(|x| x / length);
        self.columns[n] = j;
        self.rank += 1;
        for i in 0..self.rank {
            self.triangle[i][n] = dot(&self.basis[i], &column);
        }
    }

    #[cfg(test)]
    pub(crate) fn rank(&self) -> usize {
        self.rank
    }

    pub(crate) fn basis(&self) -> &[Vector6] {
        &self.basis[..self.rank]
    }

    /// What the span leaves of a vector. Twice, since the first remainder of a
    /// vector near the span is mostly rounding.
    pub(crate) fn reject(&self, vector: Vector6) -> Vector6 {
        let mut rest = vector;
        for _ in 0..2 {
            for b in self.basis() {
                let along = dot(b, &rest);
                rest.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
            }
        }
        rest
    }

    /// The vectors at right angles to the span: the reciprocal wrenches, if
    /// its columns are twists.
    pub(crate) fn complement(&self) -> Span {
        // Unit vectors leave remainders of at least 1/6 of their length, or
        // rounding.
        let unit = |j: usize| core::array::from_fn(|i| f64::from(i == j));
        let mut rest = Span::of(6, |j| self.reject(unit(j)));
        rest.rank = rest.rank.min(6 - self.rank);
        rest
    }

    /// The combination of the columns that comes nearest to a vector: tells
    /// the coefficient of each column that is not one of the others'
    /// combinations; theirs is 0.
    pub(crate) fn coordinates(&self, vector: &Vector6, mut tell: impl FnMut(usize, f64)) {
        let mut x = [0.0; 6];
        for i in (0..self.rank).rev() {
            let known: f64 = (i + 1..self.rank).map(|j| self.triangle[i][j] * x[j]).sum();
            x[i] = (dot(&self.basis[i], vector) - known) / self.triangle[i][i];
            tell(self.columns[i], x[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: [Vector6; 4] = [
        [1.0, 2.0, 0.0, 0.0, 0.0, 1.0],
        [0.0, 1.0, 1.0, 0.0, 3.0, 0.0],
        [1.0, 3.0, 1.0, 0.0, 3.0, 1.0], // the sum of the first two
        [0.0, 0.0, 0.0, 2.0, 0.0, 0.5],
    ];

    #[test]
    fn the_rank_is_revealed_and_coordinates_come_back() {
        let span = Span::of(4, |j| COLUMNS[j]);
        assert_eq!((span.rank(), span.complement().rank()), (3, 3));
        let vector: Vector6 = core::array::from_fn(|i| 2.0 * COLUMNS[1][i] - COLUMNS[3][i]);
        let mut found = [0.0; 6];
        span.coordinates(&vector, |j, x| {
            (0..6).for_each(|i| found[i] += x * COLUMNS[j][i]);
        });
        assert!((0..6).all(|i| (found[i] - vector[i]).abs() < 1e-14));
    }

    #[test]
    fn the_complement_is_at_right_angles_to_every_column() {
        let span = Span::of(4, |j| COLUMNS[j]);
        for wrench in span.complement().basis() {
            assert!(COLUMNS.iter().all(|c| dot(c, wrench).abs() < 1e-14));
        }
    }
}
