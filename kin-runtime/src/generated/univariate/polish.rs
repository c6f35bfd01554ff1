//! Newton's method on many configurations at once.

use super::frames::Frames;
use super::lanes::{InLanes, LANES, Lanes, dot, in_lanes};
use crate::Pose;
use crate::scalar::tolerance::ROUNDING;

pub(super) type Rows<L> = [L; 6];

/// From so many steps on, a configuration that does not come nearer by this factor in a
/// step is not waited for: at a double root Newton's method gains a factor of 4.
const PATIENCE: usize = 4;
const GAIN: f64 = 0.6;

/// No joint moves by more than this in one step, radians or half the arm's size.
const STRIDE: f64 = 0.3;

/// Where the residual is below this, and the pivots are no less than `REGULAR` by the largest,
/// the Jacobian of the step before is as good.
const STEADY: f64 = 1e-10;
const REGULAR: f64 = 1e-3;

/// Where the configurations arrived.
pub(super) struct Polished {
    pub q: [[f64; LANES]; 6],
    /// How far the tip is from the target, in units of the arm's size.
    pub residual: [f64; LANES],
    /// How far from singular they are, see [`Factored::independence`].
    pub independence: [f64; LANES],
}

/// Moves the configurations towards the target until they are there, or for so many
/// steps.
#[inline(never)]
pub(super) fn polished(
    frames: &Frames,
    target: &Pose,
    start: &[[f64; LANES]; 6],
    steps: usize,
) -> Polished {
    in_lanes::<Newton, _>((frames, target, start, steps))
}

struct Newton;

impl InLanes<(&Frames, &Pose, &[[f64; LANES]; 6], usize)> for Newton {
    type Output = Polished;

    #[inline(always)]
    fn run<L: Lanes>(
        (frames, target, start, steps): (&Frames, &Pose, &[[f64; LANES]; 6], usize),
    ) -> Polished {
        newton::<L>(frames, target, start, steps)
    }
}

#[inline(always)]
fn newton<L: Lanes>(
    frames: &Frames,
    target: &Pose,
    start: &[[f64; LANES]; 6],
    steps: usize,
) -> Polished {
    let mut q = of_numbers::<L>(start);
    let mut step = 0;
    let mut before = [f64::INFINITY; LANES];
    let (mut forward, mut jacobian) = (Forward::EMPTY, Factored::EMPTY);
    forward.compute(frames, target, &q);
    jacobian.factor(frames, &forward);
    loop {
        let residual = forward.residual.numbers();
        let mut open = false;
        for k in 0..LANES {
            let away = residual[k] > ROUNDING;
            let nearer = residual[k] < GAIN * before[k];
            open |= away & (nearer | (step < PATIENCE));
        }
        if step == steps || !open {
            return Polished {
                q: numbers(&q),
                residual,
                independence: jacobian.independence().numbers(),
            };
        }
        before = residual;
        let change = jacobian.solve(forward.error);
        let mut longest = L::splat(STRIDE);
        for change in &change {
            longest = longest.max(change.abs());
        }
        let share = L::splat(ROUNDING).where_less(
            forward.residual,
            longest.inverse().scaled(STRIDE),
            L::ZERO,
        );
        for (q, change) in q.iter_mut().zip(&change) {
            *q = q.plus(&share, change);
        }
        step += 1;
        forward.compute(frames, target, &q);
        let steady = forward.residual.numbers().iter().all(|&x| x < STEADY);
        if !steady || !jacobian.is_regular() {
            jacobian.factor(frames, &forward);
        }
    }
}

#[inline(always)]
pub(super) fn of_numbers<L: Lanes>(q: &[[f64; LANES]; 6]) -> Rows<L> {
    let mut out = [L::ZERO; 6];
    for i in 0..6 {
        out[i] = L::of(q[i]);
    }
    out
}

#[inline(always)]
fn numbers<L: Lanes>(q: &Rows<L>) -> [[f64; LANES]; 6] {
    let mut out = [[0.0; LANES]; 6];
    for i in 0..6 {
        out[i] = q[i].numbers();
    }
    out
}

/// Forward kinematics, and what is missing of the target; lengths in units of half the arm's size.
pub(super) struct Forward<L: Lanes> {
    /// Direction and a point of each joint's axis.
    axes: [[[L; 3]; 2]; 6],
    tip: [L; 3],
    /// What is missing of the target, as the geometric Jacobian makes it, lengths in units of the
    /// arm's size.
    pub error: Rows<L>,
    residual: L,
}

impl<L: Lanes> Forward<L> {
    /// Of nothing yet.
    pub const EMPTY: Self = Self {
        axes: [[[L::ZERO; 3]; 2]; 6],
        tip: [L::ZERO; 3],
        error: [L::ZERO; 6],
        residual: L::ZERO,
    };

    #[inline(always)]
    pub fn compute(&mut self, frames: &Frames, target: &Pose, q: &Rows<L>) {
        let mut r = [[L::ZERO; 3]; 3];
        let mut p = [L::ZERO; 3];
        for row in 0..3 {
            for j in 0..3 {
                r[row][j] = L::splat(frames.fixed[0].rotation[row][j]);
            }
            p[row] = L::splat(frames.fixed[0].translation[row]);
        }
        for i in 0..6 {
            self.axes[i] = [[r[0][2], r[1][2], r[2][2]], p];
            let slides = frames.slides(i);
            let [s, c] = match slides {
                true => [L::ZERO, L::ONE],
                false => q[i].sin_cos(),
            };
            let Pose {
                rotation: a,
                translation: t,
            } = &frames.fixed[i + 1];
            for row in 0..3 {
                let [x, y, z] = r[row];
                if slides {
                    p[row] = p[row].plus(&z, &q[i]);
                }
                let (x, y) = ((x * c).plus(&y, &s), (y * c).minus(&x, &s));
                for j in 0..3 {
                    r[row][j] = x
                        .scaled(a[0][j])
                        .plus_scaled(&y, a[1][j])
                        .plus_scaled(&z, a[2][j]);
                }
                p[row] = p[row]
                    .plus_scaled(&x, t[0])
                    .plus_scaled(&y, t[1])
                    .plus_scaled(&z, t[2]);
            }
        }
        self.tip = p;
        let wanted = &target.rotation;
        let (mut error, mut square) = ([L::ZERO; 6], L::ZERO);
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            error[i] = (L::splat(target.translation[i]) - p[i]).scaled(0.5);
            square = square.plus(&error[i], &error[i]);
            for column in 0..3 {
                error[3 + i] = error[3 + i]
                    .plus_scaled(&r[j][column], 0.5 * wanted[l][column])
                    .plus_scaled(&r[l][column], -0.5 * wanted[j][column]);
                let apart = r[i][column] - L::splat(wanted[i][column]);
                square = square.plus(&apart, &apart.scaled(0.5));
            }
        }
        self.error = error;
        self.residual = square.sqrt();
    }

    /// A column of the geometric Jacobian.
    #[inline(always)]
    fn column(&self, frames: &Frames, joint: usize) -> Rows<L> {
        let [z, o] = &self.axes[joint];
        let mut column = [L::ZERO; 6];
        if frames.slides(joint) {
            for i in 0..3 {
                column[i] = z[i].scaled(0.5);
            }
            return column;
        }
        let mut arm = [L::ZERO; 3];
        for i in 0..3 {
            arm[i] = (self.tip[i] - o[i]).scaled(0.5);
        }
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            column[i] = (z[j] * arm[l]).minus(&z[l], &arm[j]);
            column[3 + i] = z[i];
        }
        column
    }
}

/// J = Q R by the modified method of Gram and Schmidt, without roots: the columns of Q are
/// at right angles and have the lengths of the pivots; R has ones on its diagonal. What is
/// solved with both in turn is as good as by reflections (Å. Björck, "Solving linear least
/// squares problems by Gram-Schmidt orthogonalization", BIT 7, 1967).
pub(super) struct Factored<L: Lanes> {
    orthogonal: [Rows<L>; 6],
    /// By row.
    above: [Rows<L>; 6],
    squares: Rows<L>,
    inverses: Rows<L>,
}

/// No square of a pivot is taken for less.
const LEAST_SQUARE: f64 = 1e-24;

impl<L: Lanes> Factored<L> {
    /// Of nothing yet.
    pub const EMPTY: Self = Self {
        orthogonal: [[L::ZERO; 6]; 6],
        above: [[L::ZERO; 6]; 6],
        squares: [L::ZERO; 6],
        inverses: [L::ZERO; 6],
    };

    #[inline(always)]
    pub fn factor(&mut self, frames: &Frames, forward: &Forward<L>) {
        for joint in 0..6 {
            self.orthogonal[joint] = forward.column(frames, joint);
        }
        for j in 0..6 {
            let (done, rest) = self.orthogonal.split_at_mut(j + 1);
            let column = &done[j];
            self.squares[j] = dot(column, column).max(L::splat(LEAST_SQUARE));
            let inverse = self.squares[j].inverse();
            self.inverses[j] = inverse;
            for (l, other) in (j + 1..6).zip(rest) {
                let along = dot(column, other) * inverse;
                self.above[j][l] = along;
                for i in 0..6 {
                    other[i] = other[i].minus(&along, &column[i]);
                }
            }
        }
    }

    /// J⁻¹ e.
    #[inline(always)]
    pub fn solve(&self, mut e: Rows<L>) -> Rows<L> {
        let mut x = [L::ZERO; 6];
        for j in 0..6 {
            let column = &self.orthogonal[j];
            x[j] = dot(column, &e) * self.inverses[j];
            for i in 0..6 {
                e[i] = e[i].minus(&x[j], &column[i]);
            }
        }
        self.back_substituted(x)
    }

    /// R⁻¹ x.
    #[inline(always)]
    fn back_substituted(&self, mut x: Rows<L>) -> Rows<L> {
        for j in (0..6).rev() {
            for l in j + 1..6 {
                x[j] = x[j].minus(&self.above[j][l], &x[l]);
            }
        }
        x
    }

    /// The squares of the least and the largest pivot.
    #[inline(always)]
    fn extremes(&self) -> [L; 2] {
        let (mut least, mut largest) = (self.squares[0], self.squares[0]);
        for square in &self.squares[1..] {
            least = least.min(*square);
            largest = largest.max(*square);
        }
        [least, largest]
    }

    /// How far from singular: 1 / (‖J⁻¹‖ · the largest pivot). By the norm of all entries 1 / ‖J⁻¹‖ is
    /// the least singular value but for a factor of √6; a pivot may be far above that.
    #[inline(always)]
    fn independence(&self) -> L {
        let mut sum = L::ZERO;
        for j in 0..6 {
            // Column j of R⁻¹, and J⁻¹ = R⁻¹ D⁻¹ Qᵀ.
            let mut column = [L::ZERO; 6];
            column[j] = L::ONE;
            let mut square = L::ONE;
            for i in (0..j).rev() {
                for l in i + 1..=j {
                    column[i] = column[i].minus(&self.above[i][l], &column[l]);
                }
                square = square.plus(&column[i], &column[i]);
            }
            sum = sum.plus(&square, &self.inverses[j]);
        }
        let [_, largest] = self.extremes();
        (sum * largest).inverse().sqrt()
    }

    #[inline(always)]
    fn is_regular(&self) -> bool {
        let [least, largest] = self.extremes();
        let enough = largest.scaled(REGULAR * REGULAR).numbers();
        least.numbers().iter().zip(&enough).all(|(a, b)| a > b)
    }

    /// The motion of the joints that moves the tip least, of length 1, among those at right angles to
    /// `others`: the least right singular vector, by inverse iteration on JᵀJ.
    #[inline(always)]
    pub fn weak(&self, others: &[Rows<L>]) -> Rows<L> {
        let mut x = [L::ZERO; 6];
        for (i, x) in x.iter_mut().enumerate() {
            // A start that no arm is square to.
            *x = L::splat(1.0 + 0.3 * i as f64);
        }
        for _ in 0..2 {
            across(&mut x, others);
            for j in 0..6 {
                for i in 0..j {
                    x[j] = x[j].minus(&self.above[i][j], &x[i]);
                }
            }
            for j in 0..6 {
                x[j] *= self.inverses[j];
            }
            x = self.back_substituted(x);
            across(&mut x, others);
            let share = dot(&x, &x).sqrt().inverse();
            x.iter_mut().for_each(|x| *x *= share);
        }
        x
    }
}

/// Takes away what of x is along others of length 1, which are at right angles to each other.
#[inline(always)]
pub(super) fn across<L: Lanes>(x: &mut Rows<L>, others: &[Rows<L>]) {
    for other in others {
        let along = dot(x, other);
        for i in 0..6 {
            x[i] = x[i].minus(&along, &other[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::singular_values::SingularValues;
    use core::f64::consts::PI;

    /// The rows of the Jacobian, by differences of forward kinematics; lengths as in
    /// [`Forward::column`].
    fn rows(frames: &Frames, q: &[f64; 6]) -> [[f64; 6]; 6] {
        const H: f64 = 1e-5;
        let moved = |joint: usize, by: f64| {
            let mut q = *q;
            q[joint] += by;
            frames.forward(&q)
        };
        core::array::from_fn(|i| {
            core::array::from_fn(|joint| {
                let (ahead, behind) = (moved(joint, H), moved(joint, -H));
                let change = match i {
                    0..3 => 0.5 * (ahead.translation[i] - behind.translation[i]),
                    _ => {
                        let turn = Pose {
                            translation: [0.0; 3],
                            ..ahead * behind.inverse()
                        };
                        turn.log().angular[i - 3]
                    }
                };
                change / (2.0 * H)
            })
        })
    }

    /// Of random arms, and of configurations as near to singular as they come by.
    #[test]
    fn independence_is_the_least_singular_value_but_for_the_root_of_six() {
        // Fractions of multiples of the golden ratio.
        let mut number = 0.0;
        let mut random = |most: f64| {
            number = (number + 0.618_033_988_749_895) % 1.0;
            most * (2.0 * number - 1.0)
        };
        let mut least = f64::INFINITY;
        for _ in 0..500 {
            let mut three = |most: f64| core::array::from_fn(|_| random(most));
            let fixed =
                core::array::from_fn(|_| Pose::from_axis_angle(three(1.0), 2.0, three(0.5)));
            let frames = Frames {
                fixed,
                prismatic: 0,
            };
            let q: [f64; 6] = core::array::from_fn(|_| random(PI));
            let arrived = polished(&frames, &frames.forward(&q), &q.map(|q| [q; LANES]), 0);
            let rows = rows(&frames, &q);
            let values = SingularValues::<6, 6>::new(&rows).values;
            let first: f64 = rows.iter().map(|row| row[0] * row[0]).sum::<f64>().sqrt();
            // The largest pivot is between the first column and the largest singular value.
            let [low, high] = [values[0] * 6.0_f64.sqrt(), first].map(|by| values[5] / by);
            let said = arrived.independence[0];
            assert!(
                said > 0.999 * low && said < 1.001 * high,
                "{low} {said} {high}"
            );
            least = least.min(said);
        }
        assert!(least < 1e-3, "{least}");
    }
}
