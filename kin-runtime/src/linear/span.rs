//! The space that some vectors span, what of a vector is in it, and what is
//! beside it: a Householder factorization that takes the longest remainder
//! first, which reveals the rank.

use super::super::math::sqrt;
use super::super::scalar::Real;
use super::vector::dot;

/// V Π = Q R: the vectors, in another order, are upper triangular in an
/// orthonormal basis, whose further vectors span what is at right angles to all
/// of them.
pub struct Span<const D: usize> {
    /// How many of the vectors are independent.
    pub rank: usize,
    /// Which these are, in the order in which they were taken.
    taken: [usize; D],
    /// Rᵀ: row k is the k-th vector taken in the basis, zero behind entry k.
    lower: [[Real; D]; D],
    /// The reflections 1 − 2 w wᵀ whose product is Q, as unit vectors.
    reflections: [[Real; D]; D],
}

/// So many vectors are kept in the basis as it grows, those behind them are brought there anew.
const AT_HAND: usize = 16;

/// The number of a vector, the vector in the basis, and how long it is beside those taken.
type Rest<const D: usize> = (usize, [Real; D], Real);

impl<const D: usize> Span<D> {
    /// Of no vectors.
    pub const EMPTY: Self = Span {
        rank: 0,
        taken: [0; D],
        lower: [[0.0; D]; D],
        reflections: [[0.0; D]; D],
    };

    /// Of so many vectors. They count as dependent when what the others leave
    /// of them is below `tolerance` times the longest.
    #[inline]
    pub fn of(count: usize, vector: impl Fn(usize) -> [Real; D], tolerance: Real) -> Self {
        let mut span = Self::EMPTY;
        let mut longest = 0.0;
        let mut first: [[Real; D]; AT_HAND] =
            core::array::from_fn(|j| if j < count { vector(j) } else { [0.0; D] });
        while span.rank < D.min(count) {
            let rest = |j: usize| {
                let inside = match first.get(j) {
                    Some(inside) => *inside,
                    None => span.inside(vector(j)),
                };
                let square: Real = inside[span.rank..].iter().map(|x| x * x).sum();
                (j, inside, sqrt(square))
            };
            let longer = |a: Rest<D>, b: Rest<D>| if b.2 > a.2 { b } else { a };
            let (j, inside, length) = (1..count).map(rest).fold(rest(0), longer);
            if span.rank == 0 {
                longest = length;
            }
            // Not a number is no pivot either.
            if length.is_nan() || length <= tolerance * longest {
                break;
            }
            span.take(j, inside, length);
            let normal = &span.reflections[span.rank - 1];
            first.iter_mut().take(count).for_each(|x| mirror(normal, x));
        }
        span
    }

    /// Turns the rest of a vector, given in the basis, into one entry.
    fn take(&mut self, j: usize, mut inside: [Real; D], length: Real) {
        let k = self.rank;
        let target = -length.copysign(inside[k]);
        // |x − t e|² = 2 t (t − x), without cancellation by the choice of sign.
        let size = sqrt(2.0 * target * (target - inside[k]));
        let mut normal = [0.0; D];
        normal[k..].copy_from_slice(&inside[k..]);
        normal[k] -= target;
        self.reflections[k] = normal.map(|x| x / size);
        inside[k] = target;
        inside[k + 1..].fill(0.0);
        self.lower[k] = inside;
        self.taken[k] = j;
        self.rank += 1;
    }

    /// Qᵀ x: a vector in the basis.
    fn inside(&self, mut x: [Real; D]) -> [Real; D] {
        for normal in &self.reflections[..self.rank] {
            mirror(normal, &mut x);
        }
        x
    }

    /// Q x: a vector given in the basis.
    fn outside(&self, mut x: [Real; D]) -> [Real; D] {
        for normal in self.reflections[..self.rank].iter().rev() {
            mirror(normal, &mut x);
        }
        x
    }

    /// Orthonormal vectors at right angles to all of the vectors: D − rank.
    pub fn complement(&self) -> impl Iterator<Item = [Real; D]> {
        (self.rank..D).map(|i| self.outside(core::array::from_fn(|j| Real::from(u8::from(i == j)))))
    }

    /// What the span leaves of a vector.
    pub fn reject(&self, vector: [Real; D]) -> [Real; D] {
        let mut inside = self.inside(vector);
        inside[..self.rank].fill(0.0);
        self.outside(inside)
    }

    /// The combination of the vectors that comes nearest to another: tells the
    /// coefficient of each vector taken; those of the others are 0.
    pub fn coordinates(&self, vector: [Real; D], mut tell: impl FnMut(usize, Real)) {
        let mut x = self.inside(vector);
        for k in (0..self.rank).rev() {
            let known: Real = (k + 1..self.rank).map(|j| self.lower[j][k] * x[j]).sum();
            x[k] = (x[k] - known) / self.lower[k][k];
            tell(self.taken[k], x[k]);
        }
    }

    /// The shortest x whose inner product with each vector taken is the given
    /// one.
    #[cfg(any(feature = "alloc", test))]
    pub fn least_norm(&self, products: impl Fn(usize) -> Real) -> [Real; D] {
        let mut x = [0.0; D];
        for k in 0..self.rank {
            let row = &self.lower[k];
            let known: Real = (0..k).map(|i| row[i] * x[i]).sum();
            x[k] = (products(self.taken[k]) - known) / row[k];
        }
        self.outside(x)
    }

    /// The sign of the determinant of D − 1 independent vectors as rows, with
    /// the vector of their complement as a last row.
    pub fn orientation(&self) -> Real {
        let taken = &self.taken[..self.rank];
        let behind = |k: usize| taken[k + 1..].iter().filter(|&&j| j < taken[k]).count();
        let exchanges: usize = (0..self.rank).map(behind).sum();
        let negative = (0..self.rank).filter(|&k| self.lower[k][k] < 0.0).count();
        // Every reflection changes the sign as well.
        if (exchanges + negative + self.rank).is_multiple_of(2) {
            1.0
        } else {
            -1.0
        }
    }

    /// How far the independent vectors are from being dependent: their least
    /// singular value but for a small factor.
    #[cfg(feature = "alloc")]
    pub fn least_pivot(&self) -> Real {
        let last = self.rank.checked_sub(1);
        last.map_or(0.0, |k| self.lower[k][k].abs())
    }
}

/// x − 2 w (w · x).
#[inline(always)]
fn mirror<const D: usize>(normal: &[Real; D], x: &mut [Real; D]) {
    let twice = 2.0 * dot(*normal, *x);
    for (x, w) in x.iter_mut().zip(normal) {
        *x -= twice * w;
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::scalar::tolerance;
    use super::super::vector::norm;
    use super::*;

    const ROWS: [[Real; 4]; 3] = [
        [1.0, 2.0, 0.0, -1.0],
        [0.5, 0.0, 3.0, 1.0],
        [0.0, -1.0, 1.0, 2.0],
    ];

    fn span<const R: usize, const D: usize>(rows: [[Real; D]; R]) -> Span<D> {
        Span::of(R, |i| rows[i], tolerance::RANK)
    }

    #[test]
    fn the_complement_is_at_right_angles_to_every_vector() {
        let found = span(ROWS);
        assert_eq!((found.rank, found.complement().count()), (3, 1));
        for vector in found.complement() {
            assert!(
                ROWS.iter()
                    .all(|row| dot(*row, vector).abs() < 8.0 * Real::EPSILON)
            );
            assert!((norm(vector) - 1.0).abs() < 8.0 * Real::EPSILON);
        }
    }

    /// The signed minors, by hand: the vector is orthogonal to all rows and
    /// completes them to a matrix of positive determinant.
    #[test]
    fn the_orientation_is_that_of_the_signed_minors() {
        for order in [[0, 1, 2], [1, 0, 2], [2, 0, 1], [2, 1, 0]] {
            let rows = order.map(|i| ROWS[i]);
            let minor = |skip: usize| {
                let c: [usize; 3] = core::array::from_fn(|i| if i < skip { i } else { i + 1 });
                let m = |i: usize, j: usize| rows[i][c[j]];
                m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1))
                    - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0))
                    + m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0))
            };
            let minors = [-minor(0), minor(1), -minor(2), minor(3)];
            let found = span(rows);
            let vector = found.complement().next().unwrap();
            for i in 0..4 {
                let expected = minors[i] / norm(minors);
                assert!((found.orientation() * vector[i] - expected).abs() < 8.0 * Real::EPSILON);
            }
        }
    }

    #[test]
    fn dependent_vectors_are_left_out() {
        let rows = [ROWS[0], ROWS[0].map(|x| -2.0 * x), [0.0; 4], ROWS[1]];
        let found = span(rows);
        assert_eq!(found.rank, 2);
        let products = [3.0, -6.0, 0.0, 1.0];
        let x = found.least_norm(|i| products[i]);
        for (row, product) in rows.iter().zip(products) {
            assert!((dot(*row, x) - product).abs() < 90.0 * Real::EPSILON);
        }
        for vector in found.complement() {
            assert!(
                rows.iter()
                    .all(|row| dot(*row, vector).abs() < 8.0 * Real::EPSILON)
            );
        }
    }

    #[test]
    fn coordinates_come_back_and_what_is_beside_is_rejected() {
        let found = span(ROWS);
        let beside = found.complement().next().unwrap();
        let inside: [Real; 4] = core::array::from_fn(|i| 2.0 * ROWS[1][i] - ROWS[2][i]);
        let vector: [Real; 4] = core::array::from_fn(|i| inside[i] + 0.3 * beside[i]);
        let mut back = [0.0; 4];
        found.coordinates(vector, |j, x| {
            (0..4).for_each(|i| back[i] += x * ROWS[j][i])
        });
        let rest = found.reject(vector);
        for i in 0..4 {
            assert!((back[i] - inside[i]).abs() < 90.0 * Real::EPSILON);
            assert!((rest[i] - 0.3 * beside[i]).abs() < 90.0 * Real::EPSILON);
        }
    }

    #[test]
    fn zeros_and_what_is_no_number_have_no_rank() {
        assert_eq!(span([[0.0; 3]; 6]).rank, 0);
        assert_eq!(span([[Real::NAN; 3]; 6]).rank, 0);
        assert_eq!(Span::<6>::of(0, |_| [1.0; 6], tolerance::RANK).rank, 0);
    }
}
