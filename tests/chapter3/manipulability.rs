//! Measures of manipulability and the ellipsoids of velocities and forces.

use super::arms::*;
use super::differences::{along, assert_close, derivative};
use super::random::Random;
use kinematics::{Ellipsoid, Jacobian, Kinematics, Manipulability};
use nalgebra::DMatrix;
use std::f64::consts::PI;

kinematics::kinematics!("robots/book/isotropic_2r.yaml");

const ROUNDING: f64 = 1e-13;

fn matrix<const R: usize, const N: usize>(rows: &[[f64; N]; R]) -> DMatrix<f64> {
    DMatrix::from_fn(R, N, |i, j| rows[i][j])
}

/// By nalgebra, the largest first.
fn singular_values<const R: usize, const N: usize>(rows: &[[f64; N]; R]) -> Vec<f64> {
    let mut values = matrix(rows).singular_values().as_slice().to_vec();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// σ_min, σ_min / σ_max, and √det of the smaller of J Jᵀ and Jᵀ J.
#[test]
fn measures_are_those_of_the_singular_values() {
    for_every_arm!(measures);
}

fn measures<K: Kinematics<N>, const N: usize>(arm: &K) {
    for q in configurations(arm) {
        let jacobian = arm.geometric_jacobian(&q);
        let values = singular_values(&jacobian.rows);
        let found = jacobian.singular_values();
        assert_close(&found[..values.len()], &values, ROUNDING);
        assert!(found[values.len()..].iter().all(|&x| x == 0.0));
        assert_close(arm.body_jacobian(&q).singular_values(), found, ROUNDING);
        compare(arm.manipulability(&q), &jacobian.rows);
        compare(
            arm.translational_manipulability(&q),
            &jacobian.translational(),
        );
        compare(arm.rotational_manipulability(&q), &jacobian.rotational());
    }
}

fn compare<const R: usize, const N: usize>(found: Manipulability, rows: &[[f64; N]; R]) {
    let values = singular_values(rows);
    let (most, least) = (values[0], values[values.len() - 1]);
    assert_close([found.sigma_min], [least], ROUNDING);
    let expected = if most > 0.0 { least / most } else { 0.0 };
    assert_close([found.inverse_condition], [expected], ROUNDING);
    let j = matrix(rows);
    let gram = if R <= N {
        &j * j.transpose()
    } else {
        j.transpose() * &j
    };
    // The square root of a rounded 0 is 1e-8.
    let squared = gram.determinant();
    assert_close([found.volume * found.volume], [squared], 1e-12);
}

#[test]
fn determinant_of_the_scara() {
    for q in configurations(&Scara) {
        let expected = L1 * L2 * q[1].sin().abs();
        assert_close([Scara.manipulability(&q).volume], [expected], ROUNDING);
    }
}

#[test]
fn determinant_of_the_elbow_manipulator() {
    let golden = Elbow.manipulability(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]).volume;
    assert_close([golden], [0.020393770], 1e-9);
    for q in configurations(&Elbow) {
        let reach = L1 * q[1].cos() + L2 * (q[1] + q[2]).cos();
        let expected = L1 * L2 * (q[2].sin() * reach * q[4].cos()).abs();
        assert_close([Elbow.manipulability(&q).volume], [expected], ROUNDING);
    }
}

#[test]
fn determinant_of_the_stanford_manipulator() {
    let golden = Stanford
        .manipulability(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
        .volume;
    assert_close([golden], [0.421443776], 1e-9);
    for q in configurations(&Stanford) {
        let expected = ((L1 + q[2]).powi(2) * q[1].cos() * q[4].cos()).abs();
        assert_close([Stanford.manipulability(&q).volume], [expected], 1e-12);
    }
}

/// |det| = l1 l2 |s2|.
#[test]
fn determinant_of_the_planar_2r() {
    for q in configurations(&Planar2r) {
        let expected = L1 * L2 * q[1].sin().abs();
        let found = Planar2r.translational_manipulability(&q);
        assert_close([found.volume], [expected], ROUNDING);
    }
}

/// With l1 = √2 l2 and the elbow at ±135°, both singular values are l2, and the
/// ellipsoid is a circle.
#[test]
fn planar_2r_is_isotropic_at_135_degrees() {
    for elbow in [-0.75 * PI, 0.75 * PI] {
        let q = [0.7, elbow];
        let found = Isotropic2r.translational_manipulability(&q);
        assert_close([found.sigma_min, found.inverse_condition], [L2, 1.0], 1e-9);
        let jacobian = Isotropic2r.geometric_jacobian(&q);
        let ellipsoid = jacobian.translational_velocity_ellipsoid();
        assert_close(ellipsoid.lengths, [L2, L2, 0.0], 1e-9);
        assert_close(ellipsoid.axes[2].map(f64::abs), [0.0, 0.0, 1.0], ROUNDING);
        let gradient = Isotropic2r.translational_manipulability_gradient(&q);
        assert_close(
            gradient,
            [
                0.0,
                2.0_f64.sqrt() * L2 * L2 * elbow.sin().signum() * elbow.cos(),
            ],
            1e-9,
        );
    }
}

/// Unit rates reach the surface of the velocity ellipsoid, unit torques that
/// of the force ellipsoid, and the two are each other's inverse.
#[test]
fn ellipsoids_of_velocities_and_forces() {
    for_every_arm!(ellipsoids);
}

fn ellipsoids<K: Kinematics<N>, const N: usize>(arm: &K) {
    for q in configurations(arm) {
        let size = 0.7;
        let jacobian = arm.geometric_jacobian(&q);
        let scaled = jacobian.in_lengths_of(size);
        for j in 0..N {
            let (a, b) = (jacobian.column(j), scaled.column(j));
            assert_close(b.linear.map(|x| x * size), a.linear, ROUNDING);
            assert_eq!(b.angular, a.angular);
        }
        check(
            &scaled.rows,
            scaled.velocity_ellipsoid(),
            scaled.force_ellipsoid(),
        );
        let rows = jacobian.translational();
        check(
            &rows,
            jacobian.translational_velocity_ellipsoid(),
            jacobian.translational_force_ellipsoid(),
        );
        let rows = jacobian.rotational();
        check(
            &rows,
            jacobian.rotational_velocity_ellipsoid(),
            jacobian.rotational_force_ellipsoid(),
        );
    }
}

/// J Jᵀ = Σ lᵢ² uᵢ uᵢᵀ for velocities, and |Jᵀ f| = 1 where a force ends on its
/// ellipsoid.
fn check<const R: usize, const N: usize>(
    rows: &[[f64; N]; R],
    velocities: Ellipsoid<R>,
    forces: Ellipsoid<R>,
) {
    let j = matrix(rows);
    let axis =
        |ellipsoid: &Ellipsoid<R>, i: usize| DMatrix::from_column_slice(R, 1, &ellipsoid.axes[i]);
    let mut spread = DMatrix::zeros(R, R);
    for i in 0..R {
        let u = axis(&velocities, i);
        spread += &u * u.transpose() * velocities.lengths[i].powi(2);
    }
    assert!((spread - &j * j.transpose()).amax() < 1e-12);
    assert!(velocities.lengths.is_sorted_by(|a, b| a >= b));
    for i in 0..R {
        let torque = (j.transpose() * axis(&forces, i)).norm();
        match forces.lengths[i] {
            f64::INFINITY => assert!(torque < ROUNDING),
            length => assert_close([torque * length], [1.0], 1e-13 * length.max(1.0)),
        }
        assert_eq!(forces.lengths[i], 1.0 / velocities.lengths[R - 1 - i]);
    }
}

/// By finite differences of the measure, away from its kinks.
#[test]
fn gradient_of_the_measure() {
    for_every_arm!(gradient);
}

fn gradient<K: Kinematics<N>, const N: usize>(arm: &K) {
    let mut random = Random::new(5);
    let mut regular = 0;
    for q in configurations(arm) {
        let q = q.map(|x| x + random.between(-0.01, 0.01));
        let difference = |measure: &dyn Fn(&[f64; N]) -> f64| -> [f64; N] {
            let unit = |k: usize| std::array::from_fn(|j| f64::from(u8::from(j == k)));
            // The steps of the differences stay on one side of the kinks.
            std::array::from_fn(|k| {
                derivative(|t| [measure(&along(&q, &unit(k), 0.1 * t))])[0] * 10.0
            })
        };
        let jacobian = arm.geometric_jacobian(&q);
        let whole = jacobian.manipulability();
        // A kink bends differences: the gradient's error grows like one over
        // the distance from it cubed.
        let cases = [
            (
                whole,
                arm.manipulability_gradient(&q),
                difference(&|q| arm.manipulability(q).volume),
            ),
            (
                jacobian.translational_manipulability(),
                arm.translational_manipulability_gradient(&q),
                difference(&|q| arm.translational_manipulability(q).volume),
            ),
            (
                jacobian.rotational_manipulability(),
                arm.rotational_manipulability_gradient(&q),
                difference(&|q| arm.rotational_manipulability(q).volume),
            ),
        ];
        for (measure, found, expected) in cases {
            if measure.sigma_min > 0.02 {
                assert_close(found, expected, 1e-7);
                regular += 1;
            }
        }
    }
    assert!(regular > 10, "{regular}");
}

/// At a singularity the measure is least and has a kink: no direction is
/// better than another to first order, and nothing is not a number.
#[test]
fn gradient_at_a_singularity_is_zero() {
    let singular = [[0.0; 6], [0.3, 0.4, 0.0, 0.2, 0.5, 0.1]];
    for q in singular {
        assert_eq!(Elbow.manipulability_gradient(&q), [0.0; 6]);
        assert_eq!(Elbow.manipulability(&q).volume, 0.0);
    }
    // Two singular values at once.
    let twice = Jacobian::<6>::default();
    assert_eq!(twice.manipulability_gradient(&Default::default()), [0.0; 6]);
}

/// The gradient leads away from singularities.
#[test]
fn climbing_the_gradient_makes_an_arm_dextrous() {
    let mut q = [0.3, -0.6, 0.05, 0.2, 1.3, 0.1];
    let before = Elbow.manipulability(&q).volume;
    for _ in 0..2000 {
        let gradient = Elbow.manipulability_gradient(&q);
        q = along(&q, &gradient, 0.5);
    }
    let best = Elbow.manipulability(&q).volume;
    assert!(best > 5.0 * before);
    // The greatest of l1 l2 |s3 (l1 c2 + l2 c23) c5| has c5 = 1, and s3 and the
    // reach r = √(l1² + l2² + 2 l1 l2 c3) at their best.
    let volume = |q3: f64| {
        let reach = (L1 * L1 + L2 * L2 + 2.0 * L1 * L2 * q3.cos()).sqrt();
        L1 * L2 * q3.sin() * reach
    };
    let greatest = (0..10000)
        .map(|k| volume(f64::from(k) * PI / 1e4))
        .fold(0.0, f64::max);
    assert_close([best], [greatest], 1e-8);
}
