//! What a matrix of few rows sees of a space, and what it does not: a
//! Householder factorization of its rows with pivoting.

use crate::math::sqrt;

/// A Π = L Qᵀ: the rows of A, in another order, are lower triangular in an
/// orthonormal basis, whose further vectors span the null space.
pub(crate) struct RowSpace<const R: usize, const N: usize> {
    /// How many rows are independent.
    pub rank: usize,
    /// L; row k is that of row `order[k]` of the matrix.
    lower: [[f64; N]; R],
    order: [usize; R],
    /// The reflections 1 − 2 w wᵀ whose product is Q, as unit vectors.
    reflections: [[f64; N]; R],
    /// The sign of the determinant of Π and Q together.
    orientation: f64,
}

impl<const R: usize, const N: usize> RowSpace<R, N> {
    /// Rows count as dependent when what the others leave of them is below
    /// `tolerance` times the longest row.
    pub fn new(rows: &[[f64; N]; R], tolerance: f64) -> Self {
        let mut found = RowSpace {
            rank: 0,
            lower: *rows,
            order: core::array::from_fn(|i| i),
            reflections: [[0.0; N]; R],
            orientation: 1.0,
        };
        let mut longest = 0.0;
        for k in 0..R.min(N) {
            let rest = |i: usize| sqrt(found.lower[i][k..].iter().map(|x| x * x).sum());
            let longer = |i: usize, j: usize| if rest(j) > rest(i) { j } else { i };
            let pivot = (k..R).fold(k, longer);
            let length = rest(pivot);
            if k == 0 {
                longest = length;
            }
            // Not a number is no pivot either.
            if length.is_nan() || length <= tolerance * longest {
                break;
            }
            if pivot != k {
                found.lower.swap(k, pivot);
                found.order.swap(k, pivot);
                found.orientation = -found.orientation;
            }
            found.reflect(k, length);
            found.rank += 1;
        }
        found
    }

    /// Turns the rest of row k into one entry, and the rows behind with it.
    fn reflect(&mut self, k: usize, length: f64) {
        let target = -length.copysign(self.lower[k][k]);
        let mut normal = [0.0; N];
        normal[k..].copy_from_slice(&self.lower[k][k..]);
        normal[k] -= target;
        // |x − t e|² = 2 t (t − x), without cancellation by the choice of sign.
        let size = sqrt(2.0 * target * (target - self.lower[k][k]));
        self.reflections[k] = normal.map(|x| x / size);
        self.orientation = -self.orientation;
        for row in &mut self.lower[k..] {
            mirror(&self.reflections[k], row);
        }
        self.lower[k][k] = target;
        self.lower[k][k + 1..].fill(0.0);
    }

    /// Q x: a vector given in the basis.
    fn expand(&self, mut x: [f64; N]) -> [f64; N] {
        for normal in self.reflections[..self.rank].iter().rev() {
            mirror(normal, &mut x);
        }
        x
    }

    /// Orthonormal vectors that no row sees; zero beyond the first N − rank.
    pub fn null_space(&self) -> [[f64; N]; N] {
        core::array::from_fn(|i| {
            let mut unit = [0.0; N];
            match unit.get_mut(self.rank + i) {
                Some(entry) => *entry = 1.0,
                None => return unit,
            }
            self.expand(unit)
        })
    }

    /// The sign of the determinant of the matrix with the one vector of its
    /// null space as a last row, where that is square.
    pub fn orientation(&self) -> f64 {
        let negative = (0..self.rank).filter(|&k| self.lower[k][k] < 0.0);
        if negative.count() % 2 == 0 {
            self.orientation
        } else {
            -self.orientation
        }
    }

    /// How far the independent rows are from being dependent: the least singular
    /// value but for a small factor.
    #[cfg(feature = "alloc")]
    pub fn least_pivot(&self) -> f64 {
        let last = self.rank.checked_sub(1);
        last.map_or(0.0, |k| self.lower[k][k].abs())
    }

    /// The shortest x with A x = b for as many rows as are independent.
    #[cfg(any(feature = "alloc", test))]
    pub fn least_norm(&self, b: &[f64; R]) -> [f64; N] {
        let mut x = [0.0; N];
        for k in 0..self.rank {
            let row = &self.lower[k];
            let known: f64 = (0..k).map(|i| row[i] * x[i]).sum();
            x[k] = (b[self.order[k]] - known) / row[k];
        }
        self.expand(x)
    }
}

/// x − 2 w (w · x).
fn mirror<const N: usize>(normal: &[f64; N], x: &mut [f64; N]) {
    let twice: f64 = 2.0 * normal.iter().zip(&*x).map(|(a, b)| a * b).sum::<f64>();
    for (x, w) in x.iter_mut().zip(normal) {
        *x -= twice * w;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: [[f64; 4]; 3] = [
        [1.0, 2.0, 0.0, -1.0],
        [0.5, 0.0, 3.0, 1.0],
        [0.0, -1.0, 1.0, 2.0],
    ];

    fn times<const R: usize>(rows: &[[f64; 4]; R], x: &[f64; 4]) -> [f64; R] {
        rows.map(|row| (0..4).map(|j| row[j] * x[j]).sum())
    }

    #[test]
    fn the_null_space_is_what_no_row_sees() {
        let found = RowSpace::new(&ROWS, 1e-9);
        assert_eq!(found.rank, 3);
        let [vector, rest @ ..] = found.null_space();
        assert!(times(&ROWS, &vector).iter().all(|x| x.abs() < 1e-15));
        assert!((vector.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-15);
        assert_eq!(rest, [[0.0; 4]; 3]);
    }

    /// The signed minors, by hand: the vector is orthogonal to all rows and
    /// completes them to a matrix of positive determinant.
    #[test]
    fn the_orientation_is_that_of_the_signed_minors() {
        let minor = |skip: usize| {
            let c: [usize; 3] = core::array::from_fn(|i| if i < skip { i } else { i + 1 });
            let m = |i: usize, j: usize| ROWS[i][c[j]];
            m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1))
                - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0))
                + m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0))
        };
        let minors = [-minor(0), minor(1), -minor(2), minor(3)];
        let found = RowSpace::new(&ROWS, 1e-9);
        let vector = found.null_space()[0].map(|x| x * found.orientation());
        let length = minors.iter().map(|x| x * x).sum::<f64>().sqrt();
        for i in 0..4 {
            assert!((vector[i] - minors[i] / length).abs() < 1e-15);
        }
    }

    #[test]
    fn dependent_rows_are_left_out() {
        let rows = [ROWS[0], ROWS[0].map(|x| -2.0 * x), [0.0; 4], ROWS[1]];
        let found = RowSpace::new(&rows, 1e-9);
        assert_eq!(found.rank, 2);
        let x = found.least_norm(&[3.0, -6.0, 0.0, 1.0]);
        let reached = times(&rows, &x);
        for (a, b) in reached.iter().zip([3.0, -6.0, 0.0, 1.0]) {
            assert!((a - b).abs() < 1e-14);
        }
        assert!(
            found.null_space()[..2]
                .iter()
                .all(|v| times(&rows, v).iter().all(|x| x.abs() < 1e-15))
        );
    }

    #[test]
    fn zeros_and_what_is_no_number_have_no_rank() {
        assert_eq!(RowSpace::new(&[[0.0; 3]; 6], 1e-9).rank, 0);
        assert_eq!(RowSpace::new(&[[f64::NAN; 3]; 6], 1e-9).rank, 0);
    }
}
