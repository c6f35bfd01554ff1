//! What is left of the closed loop when one joint is kept.

use super::line::{ENTRIES, Lines, Z_AXIS, moved, turned_back};
use crate::Pose;

/// Rows and columns of the matrix whose determinant is the polynomial.
pub(super) const SIZE: usize = 16;

/// The equations of an arm that keep one joint; numbers of the arm.
///
/// From the kept joint on, the joints round the loop are kept, two of the
/// constant side, one that leaves its own axis in place, and the two that are
/// eliminated in half tangents. The line of the fourth, as the two before it
/// move it, lies in a space of nine dimensions out of fifteen: six linear
/// functionals vanish on it, and so along the other side of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elimination {
    /// The joints in the order of the loop, from 0, the kept one first.
    pub joints: [u8; 6],
    /// Whether the loop runs from the tip to the base.
    pub backwards: bool,
    /// The degree of the polynomial in the kept joint.
    pub degree: u8,
    /// The six functionals as coefficients of 1, the cosine and the sine of the
    /// kept joint; of the first ones, of the cosine and sine of its half, and 0.
    pub functionals: [[[f64; ENTRIES]; 3]; 6],
    /// How many of the functionals need only half the angle.
    pub half: u8,
    /// Functionals that give the cosine and sine of the second joint, and of the
    /// third.
    pub pair: [[f64; ENTRIES]; 4],
    /// Rows of the matrix: which functional, and by which half tangents it
    /// is multiplied: bit 0 of the last joint, bit 1 of
    /// the last but one.
    pub rows: [[u8; 2]; SIZE],
    /// In which column the monomial i + 4 j stands: the i-th power of the last
    /// joint's half tangent times the j-th of the last but one.
    pub columns: [u8; SIZE],
}

impl Elimination {
    /// The functionals at a value of the kept joint, radians, along the other
    /// side of the loop at a target: by functional, the coefficients of the
    /// monomials i + 4 j of the half tangents at 3 i + j. Lengths as in `frames`.
    pub fn coefficients(&self, frames: &[Pose; 7], target: &Pose, kept: f64) -> [[f64; 9]; 6] {
        let far_side = Loop::new(self, frames, target).far_side();
        let (sine, cosine) = crate::math::sin_cos(0.5 * kept);
        let equations = Equations::new(self, &far_side).at(&[cosine], &[sine]);
        equations.map(|row| row.map(|[x]| x))
    }
}

/// The loop as a sequence of constant motions, one behind each joint, in the
/// order of an elimination.
pub(super) struct Loop {
    /// Behind the kept joint and so on.
    pub behind: [Pose; 6],
}

impl Loop {
    /// Of an arm that is A₀ Rz(q₁) A₁ … Rz(q₆) A₆ at the target.
    pub fn new(elimination: &Elimination, frames: &[Pose; 7], target: &Pose) -> Self {
        let closing = frames[6] * (target.inverse() * frames[0]);
        let behind = |i: usize| if i == 5 { closing } else { frames[i + 1] };
        let joints = elimination.joints.map(usize::from);
        Self {
            behind: joints.map(|joint| match elimination.backwards {
                false => behind(joint),
                true => behind((joint + 5) % 6).inverse(),
            }),
        }
    }

    /// The other side of the loop: the line of the fourth joint in the frame of
    /// the kept one, as coefficients of (1, cos, sin) of the last joint times
    /// those of the last but one, which change fastest.
    pub fn far_side(&self) -> Lines<9> {
        let [third, fourth, fifth] = [3, 4, 5].map(|i| self.behind[i].inverse());
        let line = moved(&third, &Z_AXIS.map(|x| [x]));
        let lines = moved(&fourth, &turned_back::<1, 3>(&line));
        moved(&fifth, &turned_back::<3, 9>(&lines))
    }
}

/// The equations at one target: by functional, the coefficients of the half
/// tangents' monomials, as far as they depend on the kept joint.
pub(super) struct Equations {
    functionals: [[[f64; 9]; 3]; 6],
    half: usize,
}

impl Equations {
    pub fn new(elimination: &Elimination, far_side: &Lines<9>) -> Self {
        let on = |functional: &[f64; ENTRIES]| half_tangents(&apply(functional, far_side));
        let functionals = elimination.functionals.each_ref();
        Self {
            functionals: functionals.map(|row| row.each_ref().map(on)),
            half: usize::from(elimination.half),
        }
    }

    /// The six equations at values of the kept joint, as array lanes of the
    /// cosine and sine of its half.
    #[inline(always)]
    fn at<const L: usize>(&self, cosine: &[f64; L], sine: &[f64; L]) -> [[[f64; L]; 9]; 6] {
        let (mut whole, mut double) = ([0.0; L], [0.0; L]);
        for k in 0..L {
            whole[k] = (cosine[k] - sine[k]) * (cosine[k] + sine[k]);
            double[k] = 2.0 * cosine[k] * sine[k];
        }
        let mut out = [[[0.0; L]; 9]; 6];
        for (i, (out, [x, y, z])) in out.iter_mut().zip(&self.functionals).enumerate() {
            let basis = match i < self.half {
                true => [cosine, sine, &[0.0; L]],
                false => [&[1.0; L], &whole, &double],
            };
            for j in 0..9 {
                for k in 0..L {
                    out[j][k] = x[j] * basis[0][k] + y[j] * basis[1][k] + z[j] * basis[2][k];
                }
            }
        }
        out
    }

    /// The matrix at values of the kept joint.
    #[inline(always)]
    pub fn matrix<const L: usize>(
        &self,
        elimination: &Elimination,
        cosine: &[f64; L],
        sine: &[f64; L],
    ) -> [[[f64; L]; SIZE]; SIZE] {
        let equations = self.at(cosine, sine);
        let mut matrix = [[[0.0; L]; SIZE]; SIZE];
        for (row, &[equation, shift]) in matrix.iter_mut().zip(&elimination.rows) {
            let (i0, j0) = (usize::from(shift & 1), usize::from(shift >> 1));
            for i in 0..3 {
                for j in 0..3 {
                    let column = elimination.columns[(i + i0 + 4 * (j + j0)) & 15];
                    row[usize::from(column & 15)] = equations[usize::from(equation) % 6][3 * i + j];
                }
            }
        }
        matrix
    }
}

/// A functional on each lane.
#[inline(always)]
fn apply<const L: usize>(functional: &[f64; ENTRIES], lines: &Lines<L>) -> [f64; L] {
    let mut out = [0.0; L];
    for (f, line) in functional.iter().zip(lines) {
        for k in 0..L {
            out[k] += f * line[k];
        }
    }
    out
}

/// From (1, cos a, sin a) × (1, cos b, sin b) to the monomials of the half
/// tangents, times the two cos² of the half angles.
fn half_tangents(x: &[f64; 9]) -> [f64; 9] {
    let of = |[one, c, s]: [f64; 3]| [one + c, 2.0 * s, one - c];
    let rows = [0, 3, 6].map(|i| of([x[i], x[i + 1], x[i + 2]]));
    let columns = [0, 1, 2].map(|j| of([rows[0][j], rows[1][j], rows[2][j]]));
    core::array::from_fn(|k| columns[k % 3][k / 3])
}
