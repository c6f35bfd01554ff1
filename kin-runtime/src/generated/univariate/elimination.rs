//! What is left of the closed loop when one joint is kept.

use super::frames::Frames;
use super::lanes::{Lanes, Portable};
use super::line::{ENTRIES, Lines, Z_AXIS, gone_back, moved};
use super::vanishing::{Moved, SIX};
use crate::Pose;

/// So many functionals at most vanish on one side of the loop.
pub const FUNCTIONALS: usize = 8;

/// One for each, and one that is 1 = 0.
pub const EQUATIONS: usize = FUNCTIONALS + 1;

/// Rows and columns of the matrix whose determinant is the polynomial.
pub(super) const SIZE: usize = 16;

/// The equations of an arm that keep one joint; numbers of the arm.
///
/// From the kept joint on, the joints round the loop are kept, two of the
/// constant side, one that leaves its own axis in place, and the two that are
/// eliminated in half tangents. The line of the fourth, as the two before it
/// move it, lies in a space of nine dimensions out of fifteen, or fewer: six linear
/// functionals or more vanish on it, and so along the other side of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elimination {
    /// The joints in the order of the loop, from 0, the kept one first.
    pub joints: [u8; 6],
    /// Whether the loop runs from the tip to the base.
    pub backwards: bool,
    /// The degree of the polynomial in the kept joint.
    pub degree: u8,
    /// Whether a joint that is given stands between the kept one and the next.
    pub moved: bool,
    /// The functionals in the frame of the kept joint, whose axis is z, and zeros. The first
    /// ones are the real and imaginary parts, in turn, of those that do not see what
    /// turns with e^{−iθ}. Where a joint is given behind the kept one, all six, in the frame of
    /// the next: which of their combinations these are depends on its value.
    pub functionals: [[f64; ENTRIES]; FUNCTIONALS],
    /// How many these are.
    pub half: u8,
    /// Functionals in the same frame that give the cosine and sine of the third joint, or its slide
    /// and the square of that.
    pub third: [[f64; ENTRIES]; 2],
    /// The value of the kept joint, in the sense of the loop and radians, at which the axes of
    /// the joints beside it coincide: a double root whatever the target.
    pub fold: Option<f64>,
    /// Up to these powers of the last joint's half tangent, or slide, and the last but one's
    /// all monomials are there.
    pub powers: [u8; 2],
    /// Rows of the matrix: which functional, and by which half tangents, or slides, it
    /// is multiplied: bit 0 of the last joint, bit 1 of
    /// the last but one. Of the first eight, four are not multiplied by the last joint's,
    /// and then four are. A seventh functional stands for a monomial, i + 4 j, that no other
    /// row has.
    pub rows: [[u8; 2]; SIZE],
    /// In which column the monomial i + 4 j stands: the i-th power of the last
    /// joint's half tangent times the j-th of the last but one. First those with i = 0,
    /// then those with i = 3.
    pub columns: [u8; SIZE],
}

impl Elimination {
    /// The functionals at a value of the kept joint, radians, along the other
    /// side of the loop at a target: by functional, the coefficients of the
    /// monomials i + 4 j of the half tangents at 3 i + j. Lengths as in `frames`.
    pub fn coefficients(&self, frames: &Frames, target: &Pose, kept: f64) -> [[f64; 9]; EQUATIONS] {
        let round = Loop::new(self, frames, target);
        let (sine, cosine) = crate::math::sin_cos(0.5 * kept);

        let [cosine, sine] = [cosine, sine].map(Portable::splat);
        let mut out = none();
        let vanishing = self.vanishing(&round);
        let functionals = vanishing.functionals();
        Equations::new(self.half, functionals, &round, &round.far_side())
            .write(cosine, sine, &mut out);
        out.map(|row| row.map(|x| x.numbers()[0]))
    }
}

impl Elimination {
    /// What vanishes along a loop.
    pub(super) fn vanishing(&self, round: &Loop) -> Vanishing<'_> {
        let of_value = || {
            let six: [[f64; ENTRIES]; SIX] = core::array::from_fn(|i| self.functionals[i]);
            Moved::new(&six, &self.third, &round.behind[0])
        };
        Vanishing {
            elimination: self,
            moved: self.moved.then(of_value),
        }
    }
}

/// The functionals in the frame of the kept joint.
pub(super) struct Vanishing<'a> {
    elimination: &'a Elimination,
    /// Where a joint that is given stands behind it.
    moved: Option<Moved>,
}

impl Vanishing<'_> {
    /// See [`Elimination::functionals`].
    pub fn functionals(&self) -> &[[f64; ENTRIES]] {
        match &self.moved {
            Some(moved) => &moved.functionals,
            None => &self.elimination.functionals,
        }
    }

    /// See [`Elimination::third`].
    pub fn third(&self) -> &[[f64; ENTRIES]; 2] {
        match &self.moved {
            Some(moved) => &moved.third,
            None => &self.elimination.third,
        }
    }
}

/// The loop as a sequence of constant motions, one behind each joint, in the
/// order of an elimination.
pub(super) struct Loop {
    /// Behind the kept joint and so on.
    pub behind: [Pose; 6],
    /// Which of the joints slide.
    pub slides: [bool; 6],
}

impl Loop {
    /// Of an arm at the target.
    pub fn new(elimination: &Elimination, frames: &Frames, target: &Pose) -> Self {
        let fixed = &frames.fixed;
        let closing = fixed[6] * (target.inverse() * fixed[0]);
        let behind = |i: usize| if i == 5 { closing } else { fixed[i + 1] };
        let joints = elimination.joints.map(usize::from);
        Self {
            behind: joints.map(|joint| match elimination.backwards {
                false => behind(joint),
                true => behind((joint + 5) % 6).inverse(),
            }),
            slides: joints.map(|joint| frames.slides(joint)),
        }
    }

    /// The other side of the loop: the line of the fourth joint in the frame of
    /// the kept one, as coefficients of (1, cos, sin) of the last joint, or (1, d, d²) where
    /// it slides, times those of the last but one, which change fastest.
    #[inline(always)]
    pub fn far_side(&self) -> Lines<9> {
        let [.., third, fourth, fifth] = &self.behind;
        let (third, fourth, fifth) = (third.inverse(), fourth.inverse(), fifth.inverse());
        let mut axis = [[0.0; 1]; ENTRIES];
        for (axis, z_axis) in axis.iter_mut().zip(Z_AXIS) {
            axis[0] = z_axis;
        }
        let line = moved(&third, &axis);
        let lines = moved(&fourth, &gone_back::<1, 3>(self.slides[4], &line));
        moved(&fifth, &gone_back::<3, 9>(self.slides[5], &lines))
    }
}

/// The equations at one target: by functional, the coefficients of the half
/// tangents' monomials, times 1, the cosine and the sine of the kept joint; of the
/// first ones, multiplied by e^{−iθ/2}, times the cosine and sine of its half.
pub(super) struct Equations {
    functionals: [[[f64; 9]; 3]; FUNCTIONALS],
    /// How many there are.
    count: usize,
    half: usize,
}

impl Equations {
    /// Of functionals, so many of which half the angle is enough for.
    #[inline(always)]
    pub fn new(
        half: u8,
        functionals: &[[f64; ENTRIES]],
        round: &Loop,
        far_side: &Lines<9>,
    ) -> Self {
        let mut lines = *far_side;
        for line in &mut lines {
            *line = monomials(line, round.slides);
        }
        let all = functionals;
        let last = all.iter().rposition(|row| *row != [0.0; ENTRIES]);
        let count = last.map_or(0, |last| last + 1);
        let half = usize::from(half).min(FUNCTIONALS);
        let mut functionals = [[[0.0; 9]; 3]; FUNCTIONALS];
        for i in (0..half).step_by(2) {
            let [re, im] = [Parts::of(&all[i], &lines), Parts::of(&all[i + 1], &lines)];
            for k in 0..9 {
                functionals[i][0][k] = re.fixed[k] + re.turning[k];
                functionals[i][1][k] = im.fixed[k] - im.turning[k];
                functionals[i + 1][0][k] = im.fixed[k] + im.turning[k];
                functionals[i + 1][1][k] = re.turning[k] - re.fixed[k];
            }
        }
        for i in half..count {
            let parts = Parts::of(&all[i], &lines);
            functionals[i] = [parts.fixed, parts.turning, parts.ahead];
        }
        Self {
            functionals,
            count,
            half,
        }
    }

    /// Writes the equations at values of the kept joint, by the cosine and sine of its half, over
    /// those at others or none.
    #[inline(always)]
    pub fn write<L: Lanes>(&self, cosine: L, sine: L, out: &mut AtValues<L>) {
        let whole = (cosine * cosine).minus(&sine, &sine);
        let double = (cosine + cosine) * sine;
        for i in 0..self.count.min(FUNCTIONALS) {
            let [x, y, z] = &self.functionals[i];
            if i < self.half {
                for j in 0..9 {
                    out[i][j] = cosine.scaled(x[j]).plus_scaled(&sine, y[j]);
                }
            } else {
                for j in 0..9 {
                    out[i][j] = L::splat(x[j])
                        .plus_scaled(&whole, y[j])
                        .plus_scaled(&double, z[j]);
                }
            }
        }
    }
}

/// By functional, the coefficients of the half tangents' monomials, and of the equation 1 = 0.
pub(super) type AtValues<L> = [[L; 9]; EQUATIONS];

/// Of no functional yet.
#[inline(always)]
pub(super) fn none<L: Lanes>() -> AtValues<L> {
    let mut out = [[L::ZERO; 9]; EQUATIONS];
    out[FUNCTIONALS][0] = L::ONE;
    out
}

/// A functional on lines that turn back with the kept joint.
struct Parts {
    /// What does not turn.
    fixed: [f64; 9],
    /// The coefficient of the cosine, and that of the sine: a quarter turn ahead.
    turning: [f64; 9],
    ahead: [f64; 9],
}

impl Parts {
    #[inline(always)]
    fn of(functional: &[f64; ENTRIES], lines: &Lines<9>) -> Self {
        let mut parts = Self {
            fixed: [0.0; 9],
            turning: [0.0; 9],
            ahead: [0.0; 9],
        };
        for v in [0, 3, 6, 9] {
            let (a, b) = (functional[v], functional[v + 1]);
            for k in 0..9 {
                let (x, y) = (lines[v][k], lines[v + 1][k]);
                parts.turning[k] += a * x + b * y;
                parts.ahead[k] += a * y - b * x;
            }
        }
        for i in [2, 5, 8, 11, 12, 13, 14] {
            for k in 0..9 {
                parts.fixed[k] += functional[i] * lines[i][k];
            }
        }
        parts
    }
}

/// From (1, cos a, sin a) × (1, cos b, sin b) to the monomials of the half
/// tangents, times the two cos² of the half angles. A slide's powers are monomials already.
#[inline(always)]
fn monomials(x: &[f64; 9], slides: [bool; 6]) -> [f64; 9] {
    let [.., b_slides, a_slides] = slides;
    let mut x = *x;
    for i in [0, 3, 6] {
        if !b_slides {
            (x[i], x[i + 1], x[i + 2]) = (x[i] + x[i + 1], 2.0 * x[i + 2], x[i] - x[i + 1]);
        }
    }
    for i in 0..3 {
        if !a_slides {
            (x[i], x[i + 3], x[i + 6]) = (x[i] + x[i + 3], 2.0 * x[i + 6], x[i] - x[i + 3]);
        }
    }
    x
}
