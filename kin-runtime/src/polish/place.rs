//! A configuration as the target sees it: what is missing, and how the joints
//! make it.

use crate::{Jacobian, Pose, math};

/// A target for an arm.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a, F> {
    /// Gives the pose and the spatial Jacobian of a configuration.
    pub fk_jacobian: F,
    /// Where the tip has to go.
    pub target: &'a Pose,
    /// The arm's size, metres: angles count as lengths at this distance.
    pub size: f64,
    /// What of the target counts.
    pub aim: Aim,
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
pub(super) struct Place<const N: usize> {
    pub q: [f64; N],
    pub residual: f64,
    /// What is missing, and the Jacobian's rows that make it, with lengths in
    /// units of the arm's size; zero where the target does not count.
    pub error: [f64; 6],
    pub rows: [[f64; N]; 6],
    /// Unit vectors along which nothing can be missing; see [`Aim::idle`].
    pub idle: [[f64; 6]; 4],
}

impl<const N: usize> Place<N> {
    pub fn new(q: [f64; N], problem: &Problem<impl Fn(&[f64; N]) -> (Pose, Jacobian<N>)>) -> Self {
        let &Problem {
            ref fk_jacobian,
            target,
            size,
            aim,
        } = problem;
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
        Self {
            q,
            residual: aim.distance(&pose, target, size),
            error,
            rows,
            idle: aim.idle_directions(&pose),
        }
    }
}

impl Aim {
    fn has_position(self) -> bool {
        matches!(self, Aim::Pose | Aim::Position | Aim::PositionAxis)
    }

    /// In how many of six directions nothing can be missing.
    pub(super) fn idle(self) -> usize {
        match self {
            Aim::Pose => 0,
            Aim::PositionAxis => 1,
            Aim::Position | Aim::Orientation => 3,
            Aim::Direction => 4,
        }
    }

    /// These directions, from the front; a turn about the z axis leaves it in
    /// place.
    fn idle_directions(self, pose: &Pose) -> [[f64; 6]; 4] {
        let unit = |i: usize| core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
        let z = [0, 1, 2].map(|i| pose.rotation[i][2]);
        let about_z = [0.0, 0.0, 0.0, z[0], z[1], z[2]];
        match self {
            Aim::Position => [unit(3), unit(4), unit(5), about_z],
            Aim::PositionAxis => [about_z; 4],
            _ => [unit(0), unit(1), unit(2), about_z],
        }
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
