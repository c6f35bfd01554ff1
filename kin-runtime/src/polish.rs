//! Landing a nearly right configuration on the literal arm.

use crate::{Jacobian, Pose, math};

/// Relative to the arm's size, a residual below this is rounding.
const ROUNDING: f64 = 1e-14;

/// No joint moves by more than this in one step; radians or metres. Short
/// steps follow Newton's flow and so stay on the branch that they are on.
const STRIDE: f64 = 0.3;

/// A step shorter than this share of Newton's leads nowhere.
const LEAST_SHARE: f64 = 1e-3;

/// Below this a pivot of the Jacobian, relative to the largest, is that of a
/// singular configuration.
const SINGULAR: f64 = 1e-5;

/// Where [`polish`] has landed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polished<const N: usize> {
    /// The last configuration; angles are not wrapped.
    pub q: [f64; N],
    /// Its distance from the target, metres: the translation error and the
    /// angle times the arm's size, as the legs of a right triangle.
    pub residual: f64,
    /// The Jacobian loses rank there.
    pub singular: bool,
}

/// Newton from a configuration that nearly reaches the target, until it is
/// there to rounding, for at most `steps` evaluations.
///
/// `fk_jacobian` gives the pose and the spatial Jacobian; `size` is the arm's
/// size in metres, which weighs angles against lengths. Steps are damped by
/// the natural monotonicity test (Deuflhard, Newton Methods for Nonlinear
/// Problems, section 3.3): what has to shrink is the next correction of the
/// joints, not the residual, which near a singular configuration has to grow
/// on the way to a solution that is a tenth of a radian off.
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
    q: [f64; N],
    size: f64,
    steps: usize,
) -> Polished<N> {
    let look = |q: [f64; N]| Place::<N, ROWS>::new(q, &fk_jacobian, target, size);
    let mut here = look(q);
    let mut factor = Factor::new(&here.rows);
    let mut step = factor.solve(&here.error);
    let mut share: f64 = 1.0;
    for _ in 1..steps {
        if here.residual < ROUNDING * size {
            break;
        }
        let length = norm(&step);
        share = share.min(STRIDE / length.max(STRIDE));
        let there = look(core::array::from_fn(|i| here.q[i] + share * step[i]));
        // The correction that the same Jacobian would make next.
        let next = factor.solve(&there.error);
        let unforeseen: [f64; N] = core::array::from_fn(|i| next[i] - (1.0 - share) * step[i]);
        let bend = 2.0 * norm(&unforeseen) / (share * share * length).max(f64::MIN_POSITIVE);
        if norm(&next) <= (1.0 - 0.25 * share) * length || there.residual < ROUNDING * size {
            here = there;
            factor = Factor::new(&here.rows);
            step = factor.solve(&here.error);
            share = (1.0 / bend.max(f64::MIN_POSITIVE)).clamp(share, 1.0);
        } else {
            share = (1.0 / bend).min(0.5 * share);
            if share < LEAST_SHARE {
                break;
            }
        }
    }
    Polished {
        q: here.q,
        residual: here.residual,
        singular: factor.weakest() < SINGULAR,
    }
}

/// A configuration as the target sees it.
struct Place<const N: usize, const ROWS: usize> {
    q: [f64; N],
    residual: f64,
    /// The twist or shift that is missing, and the Jacobian's rows that make
    /// it, both with lengths in units of the arm's size.
    error: [f64; ROWS],
    rows: [[f64; N]; ROWS],
}

impl<const N: usize, const ROWS: usize> Place<N, ROWS> {
    fn new(
        q: [f64; N],
        fk_jacobian: &impl Fn(&[f64; N]) -> (Pose, Jacobian<N>),
        target: &Pose,
        size: f64,
    ) -> Self {
        let (pose, spatial) = fk_jacobian(&q);
        let (error, rows) = if ROWS == 6 {
            (spatial_error(&pose, target), spatial.rows)
        } else {
            position_error(&pose, target, &spatial)
        };
        let weight = |r: usize| if r < 3 { 1.0 / size } else { 1.0 };
        Self {
            q,
            residual: distance::<ROWS>(&pose, target, size),
            error: core::array::from_fn(|r| weight(r) * error[r]),
            rows: core::array::from_fn(|r| rows[r].map(|x| weight(r) * x)),
        }
    }
}

fn norm<const N: usize>(x: &[f64; N]) -> f64 {
    math::sqrt(x.iter().map(|x| x * x).sum())
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

/// The normal equations JᵀJ x = Jᵀe, factored.
struct Factor<const N: usize, const ROWS: usize> {
    rows: [[f64; N]; ROWS],
    /// Cholesky's L below the diagonal.
    lower: [[f64; N]; N],
    /// One over its diagonal.
    inverse: [f64; N],
}

impl<const N: usize, const ROWS: usize> Factor<N, ROWS> {
    fn new(rows: &[[f64; N]; ROWS]) -> Self {
        let mut a = [[0.0; N]; N];
        for row in rows {
            for i in 0..N {
                for k in 0..=i {
                    a[i][k] += row[i] * row[k];
                }
            }
        }
        let mut inverse = [0.0; N];
        for i in 0..N {
            for k in 0..i {
                let mut sum = a[i][k];
                for m in 0..k {
                    sum -= a[i][m] * a[k][m];
                }
                a[i][k] = sum * inverse[k];
                a[i][i] -= a[i][k] * a[i][k];
            }
            // Rounding may leave a singular pivot below zero.
            inverse[i] = 1.0 / math::sqrt(a[i][i].max(1e-20));
        }
        Self {
            rows: *rows,
            lower: a,
            inverse,
        }
    }

    fn solve(&self, error: &[f64; ROWS]) -> [f64; N] {
        let mut x = [0.0; N];
        for (row, e) in self.rows.iter().zip(error) {
            for i in 0..N {
                x[i] += row[i] * e;
            }
        }
        for i in 0..N {
            for k in 0..i {
                x[i] -= self.lower[i][k] * x[k];
            }
            x[i] *= self.inverse[i];
        }
        for i in (0..N).rev() {
            for k in i + 1..N {
                x[i] -= self.lower[k][i] * x[k];
            }
            x[i] *= self.inverse[i];
        }
        x
    }

    /// The least pivot of J relative to the largest.
    fn weakest(&self) -> f64 {
        let least = self.inverse.iter().fold(0.0, |most: f64, x| most.max(*x));
        let largest = self
            .inverse
            .iter()
            .fold(f64::INFINITY, |least: f64, x| least.min(*x));
        largest / least
    }
}
