//! The examples of MLS chapter 3, with l0 = 0.5, l1 = 0.4, l2 = 0.3: their
//! closed formulas, and values computed independently of this project.

mod elbow;
mod planar;
mod scara;
mod stanford;

use crate::measure::largest;
use kinematics::{Jacobian, Pose, Solution};
use nalgebra::DMatrix;

const L0: f64 = 0.5;
const L1: f64 = 0.4;
const L2: f64 = 0.3;

/// Published digits.
const DIGITS: f64 = 1e-9;
/// Rounding of a few operations.
const ROUNDING: f64 = 1e-14;

fn assert_close<const N: usize>(found: [f64; N], expected: [f64; N], tolerance: f64) {
    let difference = largest((0..N).map(|i| found[i] - expected[i]));
    assert!(difference < tolerance, "{found:?} is not {expected:?}");
}

/// The determinant of some rows of a Jacobian.
fn determinant<const N: usize>(jacobian: &Jacobian<N>, rows: [usize; N]) -> f64 {
    DMatrix::from_fn(N, N, |i, j| jacobian.rows[rows[i]][j]).determinant()
}

/// Whether one of the solutions is `q`, to `tolerance`.
fn contains<const N: usize>(solutions: &[Solution<N>], q: &[f64; N], tolerance: f64) -> bool {
    let apart =
        |a: &[f64; N]| largest((0..N).map(|i| kinematics::__private::math::wrap(a[i] - q[i])));
    solutions
        .iter()
        .any(|solution| apart(&solution.q) < tolerance)
}

/// The angle of a rotation about z.
fn yaw(pose: &Pose) -> f64 {
    pose.rotation[1][0].atan2(pose.rotation[0][0])
}
