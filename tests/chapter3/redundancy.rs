//! Internal motions and what is done with them.

use super::arms::*;
use super::differences::{DIFFERENCES, along, assert_close, derivative};
use super::random::Random;
use kinematics::{Kinematics, Pose, centering_gradient, null_space};
use nalgebra::{DMatrix, SMatrix};

const ROUNDING: f64 = 1e-13;

/// J θ′ = 0, orthonormal, and as many as nalgebra's rank leaves.
#[test]
fn internal_motions_leave_the_tool_at_rest() {
    for_every_arm!(internal_motions);
}

fn internal_motions<K: Kinematics<N>, const N: usize>(arm: &K) {
    for q in configurations(arm) {
        let jacobian = arm.geometric_jacobian(&q);
        let motions = arm.internal_motions(&q);
        let matrix = DMatrix::from_fn(6, N, |i, j| jacobian.rows[i][j]);
        assert_eq!(motions.len(), N - matrix.rank(1e-8), "{q:?}");
        for (i, a) in motions.iter().enumerate() {
            assert_close(jacobian.velocity(a).to_array(), [0.0; 6], ROUNDING);
            for (j, b) in motions.iter().enumerate() {
                let product: f64 = (0..N).map(|k| a[k] * b[k]).sum();
                assert_close([product], [f64::from(u8::from(i == j))], ROUNDING);
            }
        }
    }
}

/// For seven joints the one vector is that of the signed minors, which is
/// continuous, not just one of two signs.
#[test]
fn internal_motion_of_seven_joints_is_that_of_the_signed_minors() {
    let mut random = Random::new(3);
    for _ in 0..200 {
        let q = std::array::from_fn(|_| random.angle());
        let rows = Seven.geometric_jacobian(&q).rows;
        let minor = |skip: usize| {
            let column = |j: usize| if j < skip { j } else { j + 1 };
            let square = SMatrix::<f64, 6, 6>::from_fn(|i, j| rows[i][column(j)]);
            let sign = if skip.is_multiple_of(2) { 1.0 } else { -1.0 };
            sign * square.determinant()
        };
        let minors: [f64; 7] = std::array::from_fn(minor);
        let volume = minors.iter().map(|x| x * x).sum::<f64>().sqrt();
        let motions = Seven.internal_motions(&q);
        assert_eq!(motions.len(), 1);
        if volume > 1e-6 {
            assert_close(motions[0], minors.map(|x| x / volume), 1e-13 / volume);
        }
        // Binet and Cauchy: the minors' length is √det(J Jᵀ).
        assert_close([Seven.manipulability(&q).volume], [volume], ROUNDING);
    }
}

/// By finite differences: the tool stays to first order.
#[test]
fn projection_of_a_secondary_task_does_not_move_the_tool() {
    let mut random = Random::new(4);
    for _ in 0..50 {
        let q: [f64; 7] = std::array::from_fn(|_| random.angle());
        let wish: [f64; 7] = random.unit_cube();
        let rates = Seven.null_space_projection(&q, &wish);
        let entries = |t: f64| -> [f64; 16] {
            Seven
                .fk(&along(&q, &rates, t))
                .to_matrix()
                .as_flattened()
                .try_into()
                .unwrap()
        };
        assert_close(derivative(entries), [0.0; 16], DIFFERENCES);
        assert_close(Seven.null_space_projection(&q, &rates), rates, ROUNDING);
        // What was left out is orthogonal to all that is allowed.
        let left_out: f64 = (0..7).map(|i| (wish[i] - rates[i]) * rates[i]).sum();
        assert_close([left_out], [0.0], ROUNDING);
    }
}

/// I − J⁺ J, by nalgebra's pseudo-inverse.
#[test]
fn projection_is_that_of_the_pseudo_inverse() {
    let mut random = Random::new(5);
    for q in configurations(&Seven) {
        let wish: [f64; 7] = random.unit_cube();
        let jacobian = SMatrix::<f64, 6, 7>::from(Seven.geometric_jacobian(&q));
        let projector =
            SMatrix::<f64, 7, 7>::identity() - jacobian.pseudo_inverse(1e-8).unwrap() * jacobian;
        let expected = projector * SMatrix::<f64, 7, 1>::from(wish);
        assert_close(
            Seven.null_space_projection(&q, &wish),
            expected.as_slice(),
            1e-12,
        );
    }
}

/// A secondary task: a posture amid the limits, and one far from singularities,
/// with the tool at rest. Each goes as far as it can.
#[test]
fn secondary_tasks_improve_while_the_tool_rests() {
    let start = [1.6, 0.9, -1.5, 1.2, 0.7, -0.8, 0.2];
    let target = Seven.fk(&start);
    let centered = |q: &[f64; 7]| centering_gradient(&Seven::LIMITS, q).map(|x| -30.0 * x);
    let cost = |q: &[f64; 7]| -> f64 {
        let share = |i: usize| q[i] / (2.0 * Seven::LIMITS[i].upper());
        (0..7).map(|i| 0.5 * share(i).powi(2)).sum()
    };
    let q = rest(&start, centered);
    assert!(cost(&q) < 0.97 * cost(&start));
    assert_rest(&q, &target);
    assert_close(
        Seven.null_space_projection(&q, &centered(&q)),
        [0.0; 7],
        1e-6,
    );
    let dextrous = |q: &[f64; 7]| Seven.manipulability_gradient(q).map(|x| 30.0 * x);
    let volume = |q: &[f64; 7]| Seven.manipulability(q).volume;
    let q = rest(&start, dextrous);
    assert!(volume(&q) > 1.4 * volume(&start));
    assert_rest(&q, &target);
    assert_close(
        Seven.null_space_projection(&q, &dextrous(&q)),
        [0.0; 7],
        1e-6,
    );
}

#[track_caller]
fn assert_rest(q: &[f64; 7], target: &Pose) {
    let (found, target) = (Seven.fk(q).to_matrix(), target.to_matrix());
    assert_close(found.as_flattened(), target.as_flattened(), 1e-9);
}

/// Follows a task in the null space with the tool held at its place.
fn rest(start: &[f64; 7], task: impl Fn(&[f64; 7]) -> [f64; 7]) -> [f64; 7] {
    let target = Seven.fk(start);
    let mut q = *start;
    for _ in 0..4000 {
        let rates = Seven.null_space_projection(&q, &task(&q));
        q = along(&q, &rates, 0.02);
        let pose = Seven.fk(&q);
        let back = (target * pose.inverse()).log();
        let correction = Seven.spatial_jacobian(&q).least_squares_rates(&back);
        q = along(&q, &correction, 1.0);
    }
    q
}

/// More joints than one too many have more motions; a task that leaves the
/// orientation open has more still.
#[test]
fn internal_motions_of_a_position_task() {
    let mut random = Random::new(6);
    for _ in 0..50 {
        let q: [f64; 7] = std::array::from_fn(|_| random.angle());
        let jacobian = Seven.geometric_jacobian(&q);
        let motions = null_space(&jacobian.translational());
        assert_eq!(motions.len(), 4);
        for motion in &motions {
            assert_close(jacobian.velocity(motion).linear, [0.0; 3], ROUNDING);
        }
        // A planar arm of three joints has one.
        let q: [f64; 3] = std::array::from_fn(|_| random.angle());
        assert_eq!(
            null_space(&Planar3r.geometric_jacobian(&q).translational()).len(),
            1
        );
    }
}
