//! What vanishes on the near side of the loop, as a joint that is given moves it.

use super::complex::{Complex, conjugate, minus, plus, product, square};
use super::line::{ENTRIES, moved};
use crate::{Pose, math};

/// So many functionals vanish on nine dimensions of fifteen.
pub(super) const SIX: usize = 6;

/// So many vectors of a line turn about an axis, and so many combinations of six functionals do not
/// see what turns with e^{−iθ} of them.
const TURNING: [usize; 4] = [0, 3, 6, 9];
const UNSEEN: usize = SIX - TURNING.len();

/// No square of a pivot is divided by less.
const LEAST_SQUARE: f64 = 1e-60;

type Functional = [f64; ENTRIES];
type Vector = [Complex; SIX];

/// Functionals in the frame in front of the motion between the kept joint and the next.
pub(super) struct Moved {
    /// Those that do not see what turns with e^{−iθ}: real and imaginary parts in turn.
    pub functionals: [Functional; 2 * UNSEEN],
    /// What gives the third joint.
    pub third: [Functional; 2],
}

impl Moved {
    /// Of those behind it.
    pub fn new(functionals: &[Functional; SIX], third: &[Functional; 2], motion: &Pose) -> Self {
        let six = in_front(motion, functionals);
        let mut unseen_parts = [[0.0; ENTRIES]; 2 * UNSEEN];
        for (pair, weights) in unseen_parts.chunks_exact_mut(2).zip(unseen(&six)) {
            for (functional, [re, im]) in six.iter().zip(weights) {
                for (k, x) in functional.iter().enumerate() {
                    pair[0][k] += re * x;
                    pair[1][k] += im * x;
                }
            }
        }
        Self {
            functionals: unseen_parts,
            third: in_front(motion, third),
        }
    }
}

/// Functionals on lines as seen behind a motion, on those in front of it.
fn in_front<const N: usize>(motion: &Pose, behind: &[Functional; N]) -> [Functional; N] {
    let mut units = [[0.0; ENTRIES]; ENTRIES];
    for (i, unit) in units.iter_mut().enumerate() {
        unit[i] = 1.0;
    }
    let entries = moved(&motion.inverse(), &units);
    let mut out = [[0.0; ENTRIES]; N];
    for (out, functional) in out.iter_mut().zip(behind) {
        for (weight, entry) in functional.iter().zip(&entries) {
            for (out, x) in out.iter_mut().zip(entry) {
                *out += weight * x;
            }
        }
    }
    out
}

/// The weights of the combinations that do not see what turns with e^{−iθ}, at right angles to each
/// other and of length 1: by elimination with the largest pivots.
fn unseen(functionals: &[Functional; SIX]) -> [Vector; UNSEEN] {
    let mut seen = TURNING.map(|v| functionals.map(|it| [it[v], -it[v + 1]]));
    let mut pivots = [SIX; TURNING.len()];
    for k in 0..TURNING.len() {
        let (mut row, mut column, mut largest) = (k, 0, -1.0);
        for (i, entries) in seen.iter().enumerate().skip(k) {
            for (j, entry) in entries.iter().enumerate() {
                if square(*entry) > largest && !pivots.contains(&j) {
                    (row, column, largest) = (i, j, square(*entry));
                }
            }
        }
        seen.swap(k, row);
        pivots[k] = column;
        let share = 1.0 / math::max(largest, LEAST_SQUARE);
        let inverse = conjugate(seen[k][column]).map(|x| share * x);
        let pivot = seen[k].map(|x| product(inverse, x));
        for (i, entries) in seen.iter_mut().enumerate() {
            let by = entries[column];
            for (entry, x) in entries.iter_mut().zip(pivot) {
                *entry = if i == k { x } else { minus(*entry, by, x) };
            }
        }
    }
    let mut vectors = [[[0.0; 2]; SIX]; UNSEEN];
    let free = (0..SIX).filter(|j| !pivots.contains(j));
    for (n, free) in free.take(UNSEEN).enumerate() {
        let (before, rest) = vectors.split_at_mut(n);
        let vector = &mut rest[0];
        vector[free] = [1.0, 0.0];
        for (entries, &column) in seen.iter().zip(&pivots) {
            vector[column] = entries[free].map(|x| -x);
        }
        for other in before {
            let along = other.iter().zip(&*vector);
            let along = along.fold([0.0; 2], |sum, (x, y)| plus(sum, conjugate(*x), *y));
            for (y, x) in vector.iter_mut().zip(other) {
                *y = minus(*y, along, *x);
            }
        }
        *vector = unit(vector);
    }
    vectors
}

fn unit(vector: &Vector) -> Vector {
    let length = math::sqrt(vector.iter().copied().map(square).sum());
    vector.map(|x| x.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::super::line::{Lines, Z_AXIS};
    use super::*;
    use crate::linear::span::Span;

    /// Parts of one, in no order.
    fn part(k: usize) -> f64 {
        (k as f64 * 0.618_033_988_749_895 + 0.3 * ((k % 7) as f64)).fract()
    }

    fn motion(k: usize) -> Pose {
        let of = |i: usize| 2.0 * part(9 * k + i) - 1.0;
        let twist = crate::Twist {
            linear: [of(0), of(1), of(2)],
            angular: [of(3), of(4), of(5)],
        };
        Pose::exp(&twist, 2.0)
    }

    fn turn(angle: f64) -> Pose {
        Pose::from_axis_angle([0.0, 0.0, 1.0], angle, [0.0; 3])
    }

    fn at(functional: &Functional, line: &Lines<1>) -> f64 {
        functional.iter().zip(line).map(|(f, [x])| f * x).sum()
    }

    /// The line of the fourth joint in the frame behind the motion, at angles of the two before it.
    fn near_side(k: usize, angles: [f64; 2]) -> Lines<1> {
        let [second, third] = [motion(3 * k + 1), motion(3 * k + 2)];
        let pose = turn(angles[0]) * second * turn(angles[1]) * third;
        moved(&pose, &Z_AXIS.map(|x| [x]))
    }

    /// Functionals that vanish behind the motion, and two that do not.
    fn behind(k: usize) -> ([Functional; SIX], [Functional; 2]) {
        let vector = |j: usize| near_side(k, [part(2 * j), part(2 * j + 1)].map(|x| 6.0 * x));
        let span = Span::of(30, |j| vector(j).map(|[x]| x), 1e-9);
        assert_eq!(span.rank, 9);
        let mut functionals = [[0.0; ENTRIES]; SIX];
        for (out, functional) in functionals.iter_mut().zip(span.complement()) {
            *out = functional;
        }
        let mut third = [[0.0; ENTRIES]; 2];
        third[0][k % ENTRIES] = 1.0;
        (functionals, third)
    }

    #[test]
    fn functionals_vanish_in_front_of_the_motion_on_what_they_did_behind_it() {
        for k in 0..200 {
            let ((functionals, third), motion) = (behind(k), motion(3 * k));
            let front = Moved::new(&functionals, &third, &motion);
            let behind_it = near_side(k, [0.7 + k as f64, 1.9 * k as f64]);
            let line = moved(&motion, &behind_it);
            for functional in &front.functionals {
                assert!(at(functional, &line).abs() < 1e-12, "{k}");
                let length: f64 = functional.iter().map(|x| x * x).sum();
                assert!(length > 1e-6, "{k}: {length}");
            }
            let apart = at(&front.third[0], &line) - at(&third[0], &behind_it);
            assert!(apart.abs() < 1e-12, "{k}: {apart}");
        }
    }

    /// On a line that turns back by θ they are u + v e^{iθ}: at three angles of a third of a turn
    /// what is left of e^{−iθ} is none.
    #[test]
    fn half_the_angle_is_enough_for_them() {
        for k in 0..200 {
            let (functionals, third) = behind(k);
            let front = Moved::new(&functionals, &third, &motion(3 * k));
            let line = moved(&motion(k + 1000), &Z_AXIS.map(|x| [x]));
            let third = core::f64::consts::TAU / 3.0;
            for pair in front.functionals.chunks(2) {
                let (mut seen, mut size) = ([0.0; 2], 0.0_f64);
                for angle in [0.0, third, -third] {
                    let turned = moved(&turn(-angle), &line);
                    let value = [at(&pair[0], &turned), at(&pair[1], &turned)];
                    let (s, c) = angle.sin_cos();
                    seen = plus(seen, value, [c, s]);
                    size = size.max(square(value));
                }
                assert!(square(seen) < 1e-24 * size.max(1.0), "{k}: {seen:?}");
                assert!(size > 1e-6, "{k}: {size}");
            }
        }
    }
}
