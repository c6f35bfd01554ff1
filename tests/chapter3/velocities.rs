//! Velocities of the tool, and how they change.

use super::arms::{L0, L1, L2, Scara, Stanford, Ur5e, configurations, for_every_arm};
use super::differences::{DIFFERENCES, along, assert_close, derivative, spatial_velocity};
use super::random::Random;
use kinematics::{Hessian, Jacobian, Kinematics, Pose, Twist, WithBase, WithTool};

const ROUNDING: f64 = 1e-13;

fn flat<const N: usize>(jacobian: &Jacobian<N>) -> Vec<f64> {
    jacobian.rows.as_flattened().to_vec()
}

#[test]
fn jacobians_of_the_scara() {
    let q: [f64; 4] = [0.3, -0.5, 0.7, 0.1];
    let ((s1, c1), (s12, c12)) = (q[0].sin_cos(), (q[0] + q[1]).sin_cos());
    let columns = [
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [L1 * c1, L1 * s1, 0.0, 0.0, 0.0, 1.0],
        [L1 * c1 + L2 * c12, L1 * s1 + L2 * s12, 0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    ];
    for (found, expected) in Scara.spatial_jacobian(&q).columns().iter().zip(columns) {
        assert_close(found.to_array(), expected, ROUNDING);
    }
}

#[test]
fn jacobians_of_the_stanford_manipulator() {
    let (s1, c1) = f64::sin_cos(0.1);
    let second = Stanford
        .spatial_jacobian(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
        .column(1);
    assert_close(
        second.to_array(),
        [L0 * s1, -L0 * c1, 0.0, -c1, -s1, 0.0],
        ROUNDING,
    );
}

#[test]
fn jacobians_give_the_velocities() {
    for_every_arm!(velocities);
}

fn velocities<K: Kinematics<N>, const N: usize>(arm: &K) {
    let mut random = Random::new(1);
    for q in configurations(arm) {
        let rates = random.unit_cube();
        let expected = spatial_velocity(|t| arm.fk(&along(&q, &rates, t)));
        let pose = arm.fk(&q);
        let spatial = arm.spatial_velocity(&q, &rates);
        assert_close(spatial.to_array(), expected.to_array(), DIFFERENCES);
        let body = arm.body_velocity(&q, &rates);
        assert_close(
            body.body_to_spatial(&pose).to_array(),
            spatial.to_array(),
            ROUNDING,
        );
        assert_close(
            spatial.spatial_to_body(&pose).to_array(),
            body.to_array(),
            ROUNDING,
        );
        let geometric = arm.geometric_velocity(&q, &rates);
        assert_close(
            geometric.geometric_to_spatial(&pose).to_array(),
            spatial.to_array(),
            ROUNDING,
        );
        let origin = derivative(|t| arm.fk(&along(&q, &rates, t)).translation);
        assert_close(geometric.linear, origin, DIFFERENCES);
        assert_close(geometric.angular, spatial.angular, ROUNDING);
    }
}

/// ξᵢ† = Ad⁻¹ of what follows joint i, so J_s = Ad_g J_b.
#[test]
fn jacobians_are_related_by_the_adjoint() {
    for_every_arm!(adjoint);
}

fn adjoint<K: Kinematics<N>, const N: usize>(arm: &K) {
    for q in configurations(arm) {
        let (pose, spatial) = arm.fk_jacobian(&q);
        let body = arm.body_jacobian(&q);
        assert_close(flat(&body.body_to_spatial(&pose)), flat(&spatial), ROUNDING);
        let geometric = arm.geometric_jacobian(&q);
        assert_close(
            flat(&geometric.geometric_to_spatial(&pose)),
            flat(&spatial),
            ROUNDING,
        );
    }
}

/// ∂ξ′ⱼ/∂θₖ = [ξ′ₖ, ξ′ⱼ] for k < j.
#[test]
fn jacobians_change_by_brackets() {
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let (columns, hessian) = (Ur5e.spatial_jacobian(&q).columns(), Ur5e.hessian(&q));
    for k in 0..6 {
        for j in 0..6 {
            let expected = if k < j {
                columns[k].bracket(&columns[j])
            } else {
                Twist::default()
            };
            let found = hessian.derivatives[k].column(j);
            assert_close(found.to_array(), expected.to_array(), ROUNDING);
        }
    }
}

#[test]
fn jacobian_dot_is_the_change_along_a_motion() {
    for_every_arm!(jacobian_dot);
    let (tool, base) = offsets();
    jacobian_dot(&WithTool { robot: Ur5e, tool });
    jacobian_dot(&WithBase { robot: Ur5e, base });
    jacobian_dot(&WithBase {
        robot: WithTool {
            robot: super::arms::Palletizer,
            tool,
        },
        base,
    });
}

fn offsets() -> (Pose, Pose) {
    let tool = Pose::from_rpy([0.3, -0.2, 0.9], [0.1, -0.05, 0.2]);
    (tool, Pose::from_rpy([1.3, 0.4, -0.6], [0.5, 1.0, -0.7]))
}

fn jacobian_dot<K: Kinematics<N>, const N: usize>(arm: &K) {
    let mut random = Random::new(2);
    for q in configurations(arm) {
        let rates = random.unit_cube();
        let change = |of: &dyn Fn(&[f64; N]) -> Jacobian<N>| -> Vec<f64> {
            let row = |i: usize| derivative(|t| of(&along(&q, &rates, t)).rows[i]).to_vec();
            (0..6).flat_map(row).collect()
        };
        let expected = change(&|q| arm.spatial_jacobian(q));
        assert_close(flat(&arm.jacobian_dot(&q, &rates)), expected, DIFFERENCES);
        let expected = change(&|q| arm.body_jacobian(q));
        assert_close(
            flat(&arm.body_jacobian_dot(&q, &rates)),
            expected,
            DIFFERENCES,
        );
        let expected = change(&|q| arm.geometric_jacobian(q));
        assert_close(
            flat(&arm.geometric_jacobian_dot(&q, &rates)),
            expected,
            DIFFERENCES,
        );
    }
}

/// Against second differences of forward kinematics, without a Jacobian: the
/// acceleration of the tool's origin at constant rates.
#[test]
fn jacobian_dot_is_the_acceleration_at_constant_rates() {
    for_every_arm!(acceleration);
}

fn acceleration<K: Kinematics<N>, const N: usize>(arm: &K) {
    let mut random = Random::new(3);
    for q in configurations(arm) {
        let rates = random.unit_cube();
        let origin = |t: f64| arm.fk(&along(&q, &rates, t)).translation;
        let expected = derivative(|t| derivative(|u| origin(t + u)));
        let found = arm
            .geometric_jacobian_dot(&q, &rates)
            .velocity(&rates)
            .linear;
        assert_close(found, expected, DIFFERENCES);
    }
}

#[test]
fn hessian_is_jacobian_dot_joint_by_joint() {
    for_every_arm!(hessian);
    let (tool, base) = offsets();
    hessian(&WithTool { robot: Ur5e, tool });
    hessian(&WithBase { robot: Ur5e, base });
}

fn hessian<K: Kinematics<N>, const N: usize>(arm: &K) {
    let mut random = Random::new(4);
    for q in configurations(arm) {
        let all = |hessian: &Hessian<N>| -> Vec<f64> {
            hessian.derivatives.iter().flat_map(flat).collect()
        };
        let by_joint = |of: &dyn Fn(&[f64; N]) -> Jacobian<N>| -> Vec<f64> {
            let unit = |k: usize| std::array::from_fn(|j| f64::from(u8::from(j == k)));
            let entry = |k: usize, i: usize| derivative(|t| of(&along(&q, &unit(k), t)).rows[i]);
            (0..N)
                .flat_map(|k| (0..6).flat_map(move |i| entry(k, i)))
                .collect()
        };
        assert_close(
            all(&arm.hessian(&q)),
            by_joint(&|q| arm.spatial_jacobian(q)),
            DIFFERENCES,
        );
        assert_close(
            all(&arm.body_hessian(&q)),
            by_joint(&|q| arm.body_jacobian(q)),
            DIFFERENCES,
        );
        let geometric = arm.geometric_hessian(&q);
        assert_close(
            all(&geometric),
            by_joint(&|q| arm.geometric_jacobian(q)),
            DIFFERENCES,
        );
        let rates = random.unit_cube();
        let along = geometric.along(&rates);
        assert_close(
            flat(&along),
            flat(&arm.geometric_jacobian_dot(&q, &rates)),
            ROUNDING,
        );
    }
}
