//! Newton's method on many configurations at once.

use super::LANES;
use crate::generated::dispatch::{Dispatched, dispatch};
use crate::generated::lanes::sin_cos;
use crate::{Pose, math};

type Lanes = [f64; LANES];
type Vector = [Lanes; 3];

/// Relative to the arm's size, a residual below this is rounding.
const ROUNDING: f64 = 1e-14;

/// From so many steps on, a configuration that does not come nearer by this factor in a
/// step is not waited for: at a double root Newton's method gains a factor of 4.
const PATIENCE: usize = 4;
const GAIN: f64 = 0.6;

/// No joint moves by more than this in one step, radians.
const STRIDE: f64 = 0.3;

const ZERO: Lanes = [0.0; LANES];

/// Where the configurations arrived.
pub(super) struct Polished {
    pub q: [Lanes; 6],
    /// How far the tip is from the target, in units of the arm's size.
    pub residual: Lanes,
    /// The least pivot of the Jacobian by the largest.
    pub independence: Lanes,
}

/// Moves the configurations towards the target until they are there, or for so many
/// steps. `frames` have lengths in units of half the arm's size.
#[inline(never)]
pub(super) fn polished(
    frames: &[Pose; 7],
    target: &Pose,
    start: &[Lanes; 6],
    steps: usize,
) -> Polished {
    dispatch::<Newton, _>((frames, target, start, steps))
}

struct Newton;

type NewtonOf<'a> = (&'a [Pose; 7], &'a Pose, &'a [Lanes; 6], usize);

impl Dispatched<NewtonOf<'_>> for Newton {
    type Output = Polished;

    #[inline(always)]
    fn run((frames, target, start, steps): NewtonOf) -> Polished {
        newton(frames, target, start, steps)
    }
}

#[inline(always)]
fn newton(frames: &[Pose; 7], target: &Pose, start: &[Lanes; 6], steps: usize) -> Polished {
    let mut q = *start;
    let mut step = 0;
    let mut before = [f64::INFINITY; LANES];
    loop {
        let mut system = linearized(frames, target, &q);
        let mut open = false;
        for k in 0..LANES {
            let away = system.residual[k] > ROUNDING;
            let nearer = system.residual[k] < GAIN * before[k];
            open |= away & (nearer | (step < PATIENCE));
        }
        before = system.residual;
        let triangle = solve(&mut system);
        if step == steps || !open {
            let residual = system.residual;
            let independence = independence(&triangle);
            return Polished {
                q,
                residual,
                independence,
            };
        }
        for k in 0..LANES {
            let mut longest: f64 = STRIDE;
            for i in 0..6 {
                longest = math::max(longest, system.error[i][k].abs());
            }
            let share = math::select(system.residual[k] > ROUNDING, STRIDE / longest, 0.0);
            for i in 0..6 {
                q[i][k] += share * system.error[i][k];
            }
        }
        step += 1;
    }
}

/// Near a nearly singular configuration, the two others at which the target may be
/// reached, to second order.
///
/// Where J v is small, what is missing is e = J δ + ½ H(δ, δ) with δ = α v + …, and along
/// v the roots of v·J⁻¹e = α + ½ α² v·J⁻¹H(v, v) tell α; where there are none, both are
/// where the tip comes nearest: the bifurcation equation of Lyapunov and Schmidt to second
/// order (M. Golubitsky and D. G. Schaeffer, Singularities and Groups in Bifurcation Theory
/// I, 1985, chapter I). H(v, v) is a second difference.
#[inline(never)]
pub(super) fn split(frames: &[Pose; 7], target: &Pose, q: &[Lanes; 6]) -> [[Lanes; 6]; 2] {
    dispatch::<Split, _>((frames, target, q))
}

struct Split;

type SplitOf<'a> = (&'a [Pose; 7], &'a Pose, &'a [Lanes; 6]);

impl Dispatched<SplitOf<'_>> for Split {
    type Output = [[Lanes; 6]; 2];

    #[inline(always)]
    fn run((frames, target, q): SplitOf) -> Self::Output {
        apart(frames, target, q)
    }
}

#[inline(always)]
fn apart(frames: &[Pose; 7], target: &Pose, q: &[Lanes; 6]) -> [[Lanes; 6]; 2] {
    let mut here = linearized(frames, target, q);
    let mut bend = here;
    let missing = here.error;
    let v = weak(&solve(&mut here));
    let ahead = linearized(frames, target, &moved(q, &v, BEND)).error;
    let behind = linearized(frames, target, &moved(q, &v, -BEND)).error;
    for i in 0..6 {
        for k in 0..LANES {
            bend.error[i][k] = (2.0 * missing[i][k] - ahead[i][k] - behind[i][k]) / (BEND * BEND);
        }
    }
    solve(&mut bend);
    let (step, bent) = (here.error, bend.error);
    let mut out = [*q; 2];
    for k in 0..LANES {
        let (mut e, mut a) = (0.0, 0.0);
        for i in 0..6 {
            e += v[i][k] * step[i][k];
            a += v[i][k] * bent[i][k];
        }
        let root = math::sqrt(math::max(1.0 + 2.0 * a * e, 0.0));
        // α = (−1 ± root) / a, without cancellation.
        let alphas = [2.0 * e / (1.0 + root), -(1.0 + root) / a];
        for (out, alpha) in out.iter_mut().zip(alphas) {
            let alpha = alpha.clamp(-FARTHEST, FARTHEST);
            for i in 0..6 {
                let across = |x: f64, along: f64| x - along * v[i][k];
                out[i][k] += alpha * v[i][k] + across(step[i][k], e)
                    - 0.5 * alpha * alpha * across(bent[i][k], a);
            }
        }
    }
    out
}

/// q + by v.
#[inline(always)]
fn moved(q: &[Lanes; 6], v: &[Lanes; 6], by: f64) -> [Lanes; 6] {
    let mut out = *q;
    for (out, v) in out.iter_mut().zip(v) {
        for k in 0..LANES {
            out[k] += by * v[k];
        }
    }
    out
}

/// How far the second derivative is taken, radians.
const BEND: f64 = 1e-3;

/// So far the second order may tell anything, radians.
const FARTHEST: f64 = 0.5;

/// What is missing and the geometric Jacobian that makes it, lengths in units of
/// the arm's size.
#[derive(Clone, Copy)]
struct System {
    columns: [[Lanes; 6]; 6],
    error: [Lanes; 6],
    residual: Lanes,
}

#[inline(always)]
fn linearized(frames: &[Pose; 7], target: &Pose, q: &[Lanes; 6]) -> System {
    let splat = |x: f64| [x; LANES];
    let mut r: [Vector; 3] = frames[0].rotation.map(|row| row.map(splat));
    let mut p: Vector = frames[0].translation.map(splat);
    let mut axes = [[[ZERO; 3]; 2]; 6];
    for i in 0..6 {
        axes[i] = [[r[0][2], r[1][2], r[2][2]], p];
        let (s, c) = sin_cos(q[i]);
        let Pose {
            rotation: a,
            translation: t,
        } = &frames[i + 1];
        for row in 0..3 {
            for k in 0..LANES {
                let (x, y, z) = (r[row][0][k], r[row][1][k], r[row][2][k]);
                let turned = [x * c[k] + y * s[k], y * c[k] - x * s[k], z];
                for j in 0..3 {
                    r[row][j][k] = turned[0] * a[0][j] + turned[1] * a[1][j] + turned[2] * a[2][j];
                }
                p[row][k] += turned[0] * t[0] + turned[1] * t[1] + turned[2] * t[2];
            }
        }
    }
    let mut out = System {
        columns: [[ZERO; 6]; 6],
        error: [ZERO; 6],
        residual: ZERO,
    };
    for (column, [z, o]) in out.columns.iter_mut().zip(&axes) {
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            for k in 0..LANES {
                let arm = |m: usize| 0.5 * (p[m][k] - o[m][k]);
                column[i][k] = z[j][k] * arm(l) - z[l][k] * arm(j);
                column[3 + i][k] = z[i][k];
            }
        }
    }
    let wanted = &target.rotation;
    for i in 0..3 {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        for k in 0..LANES {
            out.error[i][k] = 0.5 * (target.translation[i] - p[i][k]);
            let mut turn = 0.0;
            for column in 0..3 {
                turn += r[j][column][k] * wanted[l][column] - r[l][column][k] * wanted[j][column];
            }
            out.error[3 + i][k] = 0.5 * turn;
        }
    }
    for k in 0..LANES {
        let (mut square, mut apart) = (0.0, 0.0);
        for i in 0..3 {
            square += out.error[i][k] * out.error[i][k];
            for j in 0..3 {
                let d = r[i][j][k] - wanted[i][j];
                apart += d * d;
            }
        }
        out.residual[k] = math::sqrt(square + 0.5 * apart);
    }
    out
}

/// The step in place of what is missing, by Householder's reflections; gives R by
/// column.
#[inline(always)]
fn solve(system: &mut System) -> [[Lanes; 6]; 6] {
    let System { columns, error, .. } = system;
    for j in 0..6 {
        let (done, rest) = columns.split_at_mut(j + 1);
        let column = &mut done[j];
        let (mut weight, mut image) = (ZERO, ZERO);
        for k in 0..LANES {
            let mut square = 0.0;
            for i in j..6 {
                square += column[i][k] * column[i][k];
            }
            let x = column[j][k];
            image[k] = -math::sqrt(square).copysign(x);
            weight[k] = 1.0 / math::max(square - image[k] * x, f64::MIN_POSITIVE);
            column[j][k] = x - image[k];
        }
        for other in rest.iter_mut().chain([&mut *error]) {
            for k in 0..LANES {
                let mut along = 0.0;
                for i in j..6 {
                    along += column[i][k] * other[i][k];
                }
                along *= weight[k];
                for i in j..6 {
                    other[i][k] -= along * column[i][k];
                }
            }
        }
        column[j] = image.map(guarded);
    }
    back_substitute(columns, error);
    *columns
}

/// A pivot that can be divided by.
#[inline(always)]
fn guarded(x: f64) -> f64 {
    math::max(x.abs(), 1e-12).copysign(x)
}

/// R⁻¹ x.
#[inline(always)]
fn back_substitute(triangle: &[[Lanes; 6]; 6], x: &mut [Lanes; 6]) {
    for j in (0..6).rev() {
        for k in 0..LANES {
            x[j][k] /= triangle[j][j][k];
            for i in 0..j {
                x[i][k] -= triangle[j][i][k] * x[j][k];
            }
        }
    }
}

/// The least pivot by the largest.
#[inline(always)]
fn independence(triangle: &[[Lanes; 6]; 6]) -> Lanes {
    let (mut least, mut largest) = ([f64::INFINITY; LANES], ZERO);
    for (j, column) in triangle.iter().enumerate() {
        for k in 0..LANES {
            let pivot = column[j][k].abs();
            least[k] = math::select(pivot < least[k], pivot, least[k]);
            largest[k] = math::max(largest[k], pivot);
        }
    }
    for k in 0..LANES {
        least[k] /= largest[k];
    }
    least
}

/// The motion of the joints that moves the tip least, of length 1: the least right
/// singular vector, by inverse iteration on Rᵀ R.
#[inline(always)]
fn weak(triangle: &[[Lanes; 6]; 6]) -> [Lanes; 6] {
    // A start that no arm is square to.
    let mut x: [Lanes; 6] = core::array::from_fn(|i| [1.0 + 0.3 * i as f64; LANES]);
    for _ in 0..2 {
        for j in 0..6 {
            for k in 0..LANES {
                for i in 0..j {
                    x[j][k] -= triangle[j][i][k] * x[i][k];
                }
                x[j][k] /= triangle[j][j][k];
            }
        }
        back_substitute(triangle, &mut x);
        for k in 0..LANES {
            let mut square = 0.0;
            for i in 0..6 {
                square += x[i][k] * x[i][k];
            }
            let share = 1.0 / math::sqrt(square);
            for i in 0..6 {
                x[i][k] *= share;
            }
        }
    }
    x
}
