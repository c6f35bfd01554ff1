//! Manipulability, statics and redundancy for one to ten joints, on Jacobians
//! of every rank, against nalgebra.

use super::differences::{assert_close, derivative};
use super::random::Random;
use kinematics::{Hessian, Jacobian};
use nalgebra::SMatrix;

const ROUNDING: f64 = 1e-13;

macro_rules! for_one_to_ten_joints {
    ($check:ident) => {{
        $check::<1>();
        $check::<2>();
        $check::<3>();
        $check::<4>();
        $check::<5>();
        $check::<6>();
        $check::<7>();
        $check::<8>();
        $check::<9>();
        $check::<10>();
    }};
}

fn random_jacobian<const N: usize>(random: &mut Random) -> Jacobian<N> {
    Jacobian {
        rows: std::array::from_fn(|_| random.unit_cube()),
    }
}

/// Jacobians with the ranks 0 to the greatest: random ones as sums of so many
/// products; and entries of 0 and ±1.
fn jacobians<const N: usize>() -> Vec<(Jacobian<N>, usize)> {
    let mut random = Random::new(N as u64);
    let mut all = Vec::new();
    for rank in 0..=N.min(6) {
        for _ in 0..20 {
            let mut jacobian = Jacobian::default();
            for _ in 0..rank {
                let (left, right) = (random.unit_cube::<6>(), random.unit_cube::<N>());
                for i in 0..6 {
                    for j in 0..N {
                        jacobian.rows[i][j] += left[i] * right[j];
                    }
                }
            }
            all.push((jacobian, rank));
        }
    }
    for _ in 0..50 {
        let rows = std::array::from_fn(|_| random.unit_cube::<N>().map(|x| (1.5 * x).round()));
        let jacobian = Jacobian { rows };
        let rank = matrix(&jacobian).rank(1e-9);
        all.push((jacobian, rank));
    }
    all
}

fn matrix<const N: usize>(jacobian: &Jacobian<N>) -> nalgebra::DMatrix<f64> {
    nalgebra::DMatrix::from_fn(6, N, |i, j| jacobian.rows[i][j])
}

#[test]
fn singular_values_of_any_number_of_joints() {
    for_one_to_ten_joints!(singular_values);
}

fn singular_values<const N: usize>() {
    for (jacobian, rank) in jacobians::<N>() {
        let mut expected = matrix(&jacobian).singular_values().as_slice().to_vec();
        expected.sort_by(|a, b| b.total_cmp(a));
        expected.resize(6, 0.0);
        assert_close(jacobian.singular_values(), &expected, ROUNDING);
        assert_eq!(jacobian.rank(), rank);
        let measures = jacobian.manipulability();
        let count = N.min(6);
        assert_close([measures.sigma_min], [expected[count - 1]], ROUNDING);
        let product = expected[..count].iter().product::<f64>();
        assert_close([measures.volume], [product], 1e-12 * product.max(1.0));
    }
}

#[test]
fn internal_motions_and_structural_wrenches_complete_the_rank() {
    for_one_to_ten_joints!(complete);
}

fn complete<const N: usize>() {
    for (jacobian, rank) in jacobians::<N>() {
        let motions = jacobian.internal_motions();
        assert_eq!(motions.len(), N - rank);
        for motion in &motions {
            assert_close(jacobian.velocity(motion).to_array(), [0.0; 6], ROUNDING);
        }
        let square = SMatrix::<f64, N, N>::from_fn(|i, j| {
            (0..motions.len())
                .map(|k| motions[k][i] * motions[k][j])
                .sum()
        });
        // They are orthonormal: the sum of their products is a projector.
        assert!((square * square - square).amax() < ROUNDING);
        let wrenches = jacobian.structural_wrenches();
        assert_eq!(wrenches.len(), 6 - rank);
        for wrench in &wrenches {
            assert_close(jacobian.torques(wrench), [0.0; N], ROUNDING);
            assert_close(
                [wrench.power(&kinematics::Twist::from_array(wrench.to_array()))],
                [1.0],
                ROUNDING,
            );
        }
    }
}

#[test]
fn rates_are_least_squares_with_and_without_damping() {
    for_one_to_ten_joints!(rates);
}

fn rates<const N: usize>() {
    let mut random = Random::new(9);
    for (jacobian, _) in jacobians::<N>() {
        let wanted = kinematics::Twist::from_array(random.unit_cube());
        let twist = nalgebra::DVector::from_row_slice(&wanted.to_array());
        let j = matrix(&jacobian);
        // What makes it the pseudo-inverse's: what is left over is orthogonal to
        // all that the arm can do, and no internal motion takes part. (nalgebra's
        // own factors do not multiply to the matrix for some of these.)
        let found = nalgebra::DVector::from_row_slice(&jacobian.least_squares_rates(&wanted));
        let values = jacobian.singular_values();
        let counting = values.into_iter().filter(|&x| x > 1e-9 * values[0]);
        // By the perturbation of pseudo-inverses: rounding times |J⁺|².
        let tolerance = ROUNDING / counting.fold(1.0, f64::min).powi(2);
        assert!((j.transpose() * (&j * &found - &twist)).amax() < tolerance);
        for motion in &jacobian.internal_motions() {
            let along: f64 = (0..N).map(|i| motion[i] * found[i]).sum();
            assert!(along.abs() < tolerance);
        }
        let damping: f64 = 0.1;
        let normal = j.transpose() * &j + nalgebra::DMatrix::identity(N, N) * damping.powi(2);
        let expected = normal.cholesky().unwrap().solve(&(j.transpose() * &twist));
        assert_close(
            jacobian.damped_rates(&wanted, damping),
            expected.as_slice(),
            1e-11,
        );
        let greatest = twist.norm() / (2.0 * damping);
        let found = nalgebra::DVector::from_row_slice(&jacobian.damped_rates(&wanted, damping));
        assert!(found.norm() <= greatest);
    }
}

/// On Jacobians that are linear in the joints, so that their derivatives are
/// any matrices whatever.
#[test]
fn gradient_of_the_measure_for_any_derivatives() {
    for_one_to_ten_joints!(gradient);
}

fn gradient<const N: usize>() {
    let mut random = Random::new(N as u64);
    for _ in 0..20 {
        let now = random_jacobian::<N>(&mut random);
        let hessian = Hessian {
            derivatives: std::array::from_fn(|_| random_jacobian(&mut random)),
        };
        if now.manipulability().sigma_min < 0.2 {
            continue;
        }
        let moved = |k: usize, t: f64| Jacobian::<N> {
            rows: std::array::from_fn(|i| {
                std::array::from_fn(|j| now.rows[i][j] + t * hessian.derivatives[k].rows[i][j])
            }),
        };
        let volume = |k: usize| derivative(|t| [moved(k, t).manipulability().volume])[0];
        let expected: [f64; N] = std::array::from_fn(volume);
        assert_close(now.manipulability_gradient(&hessian), expected, 1e-8);
    }
}
