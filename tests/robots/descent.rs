//! Descending from a configuration to where the tool is locally nearest to a
//! target.

use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{Kinematics, Pose};
use nalgebra::{DMatrix, DVector};

/// The least distance from the target, relative to the arm's size, that the
/// Levenberg-Marquardt method arrives at from `q`.
pub fn descend<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    mut q: [f64; N],
    target: &Pose,
) -> f64 {
    let mut least = robot.miss(&q, target);
    let mut damping = 1e-3;
    while damping < 1e6 {
        let (jacobian, error) = linearized(robot, &q, target);
        let damped = jacobian.tr_mul(&jacobian) + DMatrix::identity(N, N) * damping;
        let slope = jacobian.tr_mul(&error);
        let Some(step) = damped.lu().solve(&slope) else {
            break;
        };
        let next = std::array::from_fn(|i| q[i] + step[i]);
        let distance = robot.miss(&next, target);
        if distance < least {
            let gained = least - distance > 1e-9 * least;
            (q, least) = (next, distance);
            damping = (0.2 * damping).max(1e-9);
            if !gained {
                break;
            }
        } else {
            damping *= 4.0;
        }
    }
    least
}

/// The Jacobian and what is missing; lengths in units of the arm's size, the
/// rotation as axis times angle.
fn linearized<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    q: &[f64; N],
    target: &Pose,
) -> (DMatrix<f64>, DVector<f64>) {
    let pose = robot.chain.fk(q);
    let columns = robot.chain.geometric_jacobian(q);
    let rows = if robot.counts == Target::Position {
        3
    } else {
        6
    };
    let scale = |i: usize| if i < 3 { 1.0 / robot.size } else { 1.0 };
    let jacobian = DMatrix::from_fn(rows, N, |i, j| columns[j].to_array()[i] * scale(i));
    let shift = |i: usize| (target.translation[i] - pose.translation[i]) / robot.size;
    let [x, y, z, w] = (*target * pose.inverse()).quaternion();
    let sine = (x * x + y * y + z * z).sqrt();
    let stretch = if sine > 0.0 {
        2.0 * sine.atan2(w) / sine
    } else {
        2.0
    };
    let turn = [x, y, z].map(|x| x * stretch);
    let error = DVector::from_fn(rows, |i, _| if i < 3 { shift(i) } else { turn[i - 3] });
    (jacobian, error)
}
