//! Derivatives by finite differences, to hold formulas against.

use kinematics::{Pose, Twist};
use nalgebra::Matrix4;

/// What derivatives by differences are worth: truncation and rounding are both
/// near 1e-12 for functions and arms of size one.
pub const DIFFERENCES: f64 = 1e-9;

/// f′(0) by the central difference of fourth order.
pub fn derivative<const D: usize>(f: impl Fn(f64) -> [f64; D]) -> [f64; D] {
    const STEP: f64 = 1e-3;
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| f(k * STEP));
    std::array::from_fn(|i| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * STEP))
}

/// The spatial velocity ġ g⁻¹ of a motion at time 0.
pub fn spatial_velocity(motion: impl Fn(f64) -> Pose) -> Twist {
    let entries: [f64; 16] =
        derivative(|t| motion(t).to_matrix().as_flattened().try_into().unwrap());
    let now = Matrix4::from(motion(0.0).inverse());
    let hat = Matrix4::from_row_slice(&entries) * now;
    Twist {
        linear: [hat[(0, 3)], hat[(1, 3)], hat[(2, 3)]],
        angular: [hat[(2, 1)], hat[(0, 2)], hat[(1, 0)]],
    }
}

/// q + t q̇.
pub fn along<const N: usize>(q: &[f64; N], rates: &[f64; N], t: f64) -> [f64; N] {
    std::array::from_fn(|i| q[i] + t * rates[i])
}

#[track_caller]
pub fn assert_close(found: impl AsRef<[f64]>, expected: impl AsRef<[f64]>, tolerance: f64) {
    let (found, expected) = (found.as_ref(), expected.as_ref());
    assert_eq!(found.len(), expected.len());
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance;
    assert!(
        found.iter().zip(expected).all(close),
        "{found:?} is not {expected:?} to {tolerance:e}"
    );
}
