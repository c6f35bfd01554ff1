//! Landing a nearly right configuration on the literal arm.

use crate::{Jacobian, Pose, math};

/// Relative to the arm's size, a residual below this is rounding.
const ROUNDING: f64 = 1e-14;

/// No joint moves by more than this in one step; radians or metres. Short steps follow Newton's flow, along which the error
/// shrinks in its own direction, and so stay on the branch that they are on.
const STRIDE: f64 = 0.1;

/// Below this a pivot of the Jacobian, relative to the largest, is that of a
/// singular configuration.
const SINGULAR: f64 = 1e-5;

/// Where [`polish`] has landed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polished<const N: usize> {
    /// The best configuration; angles are not wrapped.
    pub q: [f64; N],
    /// Its distance from the target, metres: the translation error and the
    /// angle times the arm's size, as the legs of a right triangle.
    pub residual: f64,
    /// The Jacobian loses rank there.
    pub singular: bool,
}

/// Levenberg-Marquardt from a configuration that nearly reaches the target,
/// until it is there to rounding, for at most `steps` evaluations.
///
/// `fk_jacobian` gives the pose and the spatial Jacobian; `size` is the arm's
/// size in metres, which weighs angles against lengths. The damping begins as
/// the square of the error, so that convergence is quadratic at a regular
/// configuration, and grows where a step does not help, as near a singular
/// one.
///
/// `ROWS` is 6 for a full pose and 3 for a position alone.
///
/// ```
/// use kin_runtime::{Jacobian, Pose, Twist, polish::polish};
/// // One joint about z, with the tool one metre out.
/// let arm = |q: &[f64; 1]| {
///     let turn = Pose::from_axis_angle([0.0, 0.0, 1.0], q[0], [0.0; 3]);
///     let out = Pose { translation: [1.0, 0.0, 0.0], ..Pose::IDENTITY };
///     (turn * out, Jacobian::from_columns([Twist::revolute([0.0, 0.0, 1.0], [0.0; 3])]))
/// };
/// let (target, _) = arm(&[0.5]);
/// let landed = polish::<1, 6>(arm, &target, [0.501], 1.0, 4);
/// assert!((landed.q[0] - 0.5).abs() < 1e-15 && landed.residual < 1e-15);
/// ```
#[inline]
pub fn polish<const N: usize, const ROWS: usize>(
    fk_jacobian: impl Fn(&[f64; N]) -> (Pose, Jacobian<N>),
    target: &Pose,
    mut q: [f64; N],
    size: f64,
    steps: usize,
) -> Polished<N> {
    let (mut pose, mut spatial) = fk_jacobian(&q);
    let mut residual = distance::<ROWS>(&pose, target, size);
    let mut caution = 1.0;
    let mut singular = false;
    for step in 1..steps {
        // The first step is taken in any case, to see the Jacobian's pivots.
        if residual < ROUNDING * size && step > 1 {
            break;
        }
        let (error, rows) = if ROWS == 6 {
            (spatial_error(&pose, target), spatial.rows)
        } else {
            position_error(&pose, target, &spatial)
        };
        let damping = caution * (residual / size) * (residual / size);
        let (step, weakest) = damped_least_squares::<N, ROWS>(&rows, &error, size, damping);
        singular = weakest < SINGULAR;
        let longest = step.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let stride = STRIDE / longest.max(STRIDE);
        let trial = core::array::from_fn(|i| q[i] + stride * step[i]);
        let (trial_pose, trial_spatial) = fk_jacobian(&trial);
        let trial_residual = distance::<ROWS>(&trial_pose, target, size);
        if trial_residual < residual {
            (q, pose, spatial, residual) = (trial, trial_pose, trial_spatial, trial_residual);
            caution *= 0.1;
        } else {
            caution *= 30.0;
        }
    }
    Polished {
        q,
        residual,
        singular,
    }
}

fn distance<const ROWS: usize>(pose: &Pose, target: &Pose, size: f64) -> f64 {
    let square =
        |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>();
    let shift = square(&pose.translation, &target.translation);
    let turn = (0..3)
        .map(|i| square(&pose.rotation[i], &target.rotation[i]))
        .sum::<f64>();
    let weight = if ROWS == 6 { 0.5 * size * size } else { 0.0 };
    math::sqrt(shift + weight * turn)
}

/// The spatial twist that takes `pose` to `target`, to first order.
fn spatial_error(pose: &Pose, target: &Pose) -> [f64; 6] {
    let (r, t) = (&pose.rotation, &target.rotation);
    // Entry (i, j) of target · poseᵀ.
    let entry = |i: usize, j: usize| (0..3).map(|k| t[i][k] * r[j][k]).sum::<f64>();
    let w = [
        0.5 * (entry(2, 1) - entry(1, 2)),
        0.5 * (entry(0, 2) - entry(2, 0)),
        0.5 * (entry(1, 0) - entry(0, 1)),
    ];
    let p = pose.translation;
    let d: [f64; 3] = core::array::from_fn(|i| target.translation[i] - p[i]);
    [
        d[0] - (w[1] * p[2] - w[2] * p[1]),
        d[1] - (w[2] * p[0] - w[0] * p[2]),
        d[2] - (w[0] * p[1] - w[1] * p[0]),
        w[0],
        w[1],
        w[2],
    ]
}

/// The position error, and the rows that move the tip's origin: v + ω × p.
fn position_error<const N: usize>(
    pose: &Pose,
    target: &Pose,
    spatial: &Jacobian<N>,
) -> ([f64; 6], [[f64; N]; 6]) {
    let p = pose.translation;
    let j = &spatial.rows;
    let mut error = [0.0; 6];
    let mut rows = [[0.0; N]; 6];
    for i in 0..3 {
        error[i] = target.translation[i] - p[i];
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        for k in 0..N {
            rows[i][k] = j[i][k] + j[3 + a][k] * p[b] - j[3 + b][k] * p[a];
        }
    }
    (error, rows)
}

/// (JᵀJ + λ I) x = Jᵀe with linear rows in units of `size`, by Cholesky; and
/// the least pivot of J relative to the largest.
fn damped_least_squares<const N: usize, const ROWS: usize>(
    rows: &[[f64; N]; 6],
    error: &[f64; 6],
    size: f64,
    damping: f64,
) -> ([f64; N], f64) {
    let weight: [f64; 6] = core::array::from_fn(|i| if i < 3 { 1.0 / (size * size) } else { 1.0 });
    let mut a = [[0.0; N]; N];
    let mut x = [0.0; N];
    for r in 0..ROWS {
        for i in 0..N {
            let scaled = weight[r] * rows[r][i];
            x[i] += scaled * error[r];
            for k in 0..=i {
                a[i][k] += scaled * rows[r][k];
            }
        }
    }
    let weakest = cholesky_solve(&mut a, &mut x, damping);
    (x, weakest)
}

/// Solves (A + λ I) x = b in place; only the lower triangle of A is read.
/// Returns the least diagonal entry of the factor relative to the largest.
fn cholesky_solve<const N: usize>(a: &mut [[f64; N]; N], x: &mut [f64; N], damping: f64) -> f64 {
    let mut inverse = [0.0; N];
    for i in 0..N {
        a[i][i] += damping;
        for k in 0..i {
            let mut sum = a[i][k];
            for m in 0..k {
                sum -= a[i][m] * a[k][m];
            }
            a[i][k] = sum * inverse[k];
            a[i][i] -= a[i][k] * a[i][k];
        }
        inverse[i] = 1.0 / math::sqrt(a[i][i].max(1e-30));
    }
    for i in 0..N {
        for k in 0..i {
            x[i] -= a[i][k] * x[k];
        }
        x[i] *= inverse[i];
    }
    for i in (0..N).rev() {
        for k in i + 1..N {
            x[i] -= a[k][i] * x[k];
        }
        x[i] *= inverse[i];
    }
    let least = inverse.iter().fold(0.0, |most: f64, x| most.max(*x));
    let largest = inverse
        .iter()
        .fold(f64::INFINITY, |least: f64, x| least.min(*x));
    largest / least
}
