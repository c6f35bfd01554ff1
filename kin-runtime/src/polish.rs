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
/// ```
/// use kin_runtime::{Jacobian, Pose, Twist, polish::{Aim, polish}};
/// // One joint about z, with the tool one metre out.
/// let arm = |q: &[f64; 1]| {
///     let turn = Pose::from_axis_angle([0.0, 0.0, 1.0], q[0], [0.0; 3]);
///     let out = Pose { translation: [1.0, 0.0, 0.0], ..Pose::IDENTITY };
///     (turn * out, Jacobian::from_columns([Twist::revolute([0.0, 0.0, 1.0], [0.0; 3])]))
/// };
/// let (target, _) = arm(&[0.5]);
/// let landed = polish(arm, &target, [0.501], 1.0, Aim::Pose, 4);
/// assert!((landed.q[0] - 0.5).abs() < 1e-15 && landed.residual < 1e-15);
/// ```
#[inline]
pub fn polish<const N: usize>(
    fk_jacobian: impl Fn(&[f64; N]) -> (Pose, Jacobian<N>),
    target: &Pose,
    q: [f64; N],
    size: f64,
    aim: Aim,
    steps: usize,
) -> Polished<N> {
    let look = |q: [f64; N]| Place::new(q, &fk_jacobian, target, size, aim);
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

/// What of a target counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// All of it.
    Pose,
    /// The tip's origin.
    Position,
    /// The tip's origin and the direction of its z axis.
    PositionAxis,
    /// The direction of the tip's z axis.
    Direction,
    /// The orientation.
    Orientation,
}

/// A configuration as the target sees it.
struct Place<const N: usize> {
    q: [f64; N],
    residual: f64,
    /// What is missing, and the Jacobian's rows that make it, with lengths in
    /// units of the arm's size; zero where the target does not count.
    error: [f64; 6],
    rows: [[f64; N]; 6],
}

impl<const N: usize> Place<N> {
    fn new(
        q: [f64; N],
        fk_jacobian: &impl Fn(&[f64; N]) -> (Pose, Jacobian<N>),
        target: &Pose,
        size: f64,
        aim: Aim,
    ) -> Self {
        let (pose, spatial) = fk_jacobian(&q);
        let mut error = [0.0; 6];
        let mut rows = [[0.0; N]; 6];
        if aim.has_position() {
            shift(&pose, target, &spatial, size, &mut error, &mut rows);
        }
        match aim {
            Aim::Pose | Aim::Orientation => turn(&pose, target, &spatial, &mut error, &mut rows),
            Aim::PositionAxis | Aim::Direction => {
                tilt(&pose, target, &spatial, &mut error, &mut rows);
            }
            Aim::Position => {}
        }
        let residual = aim.distance(&pose, target, size);
        Self {
            q,
            residual,
            error,
            rows,
        }
    }
}

fn norm<const N: usize>(x: &[f64; N]) -> f64 {
    math::sqrt(x.iter().map(|x| x * x).sum())
}

impl Aim {
    fn has_position(self) -> bool {
        matches!(self, Aim::Pose | Aim::Position | Aim::PositionAxis)
    }

    /// How far a pose is from a target, as far as the target counts: the
    /// translation and the angle times `size`, as the legs of a right triangle.
    pub fn distance(self, pose: &Pose, target: &Pose, size: f64) -> f64 {
        let (r, t) = (&pose.rotation, &target.rotation);
        let square = |a: f64, b: f64| (a - b) * (a - b);
        let shift: f64 = (0..3)
            .map(|i| square(pose.translation[i], target.translation[i]))
            .sum();
        let column = |j: usize| (0..3).map(|i| square(r[i][j], t[i][j])).sum::<f64>();
        let turn = match self {
            // The Frobenius norm of a small rotation's difference is √2 θ.
            Aim::Pose | Aim::Orientation => 0.5 * (column(0) + column(1) + column(2)),
            Aim::PositionAxis | Aim::Direction => column(2),
            Aim::Position => 0.0,
        };
        let shift = if self.has_position() { shift } else { 0.0 };
        math::sqrt(shift + size * size * turn)
    }
}

/// Rows 0 to 2: the velocity of the tip's origin, v + ω × p.
fn shift<const N: usize>(
    pose: &Pose,
    target: &Pose,
    spatial: &Jacobian<N>,
    size: f64,
    error: &mut [f64; 6],
    rows: &mut [[f64; N]; 6],
) {
    let (p, j) = (pose.translation, &spatial.rows);
    for i in 0..3 {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        error[i] = (target.translation[i] - p[i]) / size;
        for k in 0..N {
            rows[i][k] = (j[i][k] + j[3 + a][k] * p[b] - j[3 + b][k] * p[a]) / size;
        }
    }
}

/// Rows 3 to 5: the angular velocity, and the rotation that is missing.
fn turn<const N: usize>(
    pose: &Pose,
    target: &Pose,
    spatial: &Jacobian<N>,
    error: &mut [f64; 6],
    rows: &mut [[f64; N]; 6],
) {
    let (r, t) = (&pose.rotation, &target.rotation);
    // Entry (i, j) of target · poseᵀ.
    let entry = |i: usize, j: usize| (0..3).map(|k| t[i][k] * r[j][k]).sum::<f64>();
    for i in 0..3 {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        error[3 + i] = 0.5 * (entry(b, a) - entry(a, b));
        rows[3 + i] = spatial.rows[3 + i];
    }
}

/// Rows 3 to 5: the velocity ω × z of the tip's z axis.
fn tilt<const N: usize>(
    pose: &Pose,
    target: &Pose,
    spatial: &Jacobian<N>,
    error: &mut [f64; 6],
    rows: &mut [[f64; N]; 6],
) {
    let j = &spatial.rows;
    let z: [f64; 3] = core::array::from_fn(|i| pose.rotation[i][2]);
    for i in 0..3 {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        error[3 + i] = target.rotation[i][2] - z[i];
        for k in 0..N {
            rows[3 + i][k] = j[3 + a][k] * z[b] - j[3 + b][k] * z[a];
        }
    }
}

/// The normal equations JᵀJ x = Jᵀe, factored.
struct Factor<const N: usize> {
    rows: [[f64; N]; 6],
    /// Cholesky's L below the diagonal.
    lower: [[f64; N]; N],
    /// One over its diagonal.
    inverse: [f64; N],
}

impl<const N: usize> Factor<N> {
    fn new(rows: &[[f64; N]; 6]) -> Self {
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

    fn solve(&self, error: &[f64; 6]) -> [f64; N] {
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
