//! Forces on the tool and torques at the joints.

use super::arms::{Elbow, L0, Scara, configurations, for_every_arm};
use super::differences::assert_close;
use super::random::Random;
use kinematics::{Kinematics, Wrench};
use nalgebra::DMatrix;

const ROUNDING: f64 = 1e-13;

/// τ = J_sᵀ F_s = J_bᵀ F_t.
#[test]
fn torques_are_the_same_in_all_frames() {
    for_every_arm!(torques);
}

fn torques<K: Kinematics<N>, const N: usize>(arm: &K) {
    let mut random = Random::new(1);
    for q in configurations(arm) {
        let pose = arm.fk(&q);
        let wrench = Wrench::from_array(random.unit_cube());
        let expected = arm.spatial_torques(&q, &wrench);
        let body = wrench.spatial_to_body(&pose);
        assert_close(arm.body_torques(&q, &body), expected, ROUNDING);
        assert_close(
            body.body_to_spatial(&pose).to_array(),
            wrench.to_array(),
            ROUNDING,
        );
        let geometric = wrench.spatial_to_geometric(&pose);
        assert_close(arm.geometric_torques(&q, &geometric), expected, ROUNDING);
        assert_close(
            geometric.geometric_to_spatial(&pose).to_array(),
            wrench.to_array(),
            ROUNDING,
        );
    }
}

/// What the joints do is what the tool does: τ · q̇ = F · V.
#[test]
fn power_is_the_same_at_the_joints_and_at_the_tool() {
    for_every_arm!(power);
}

fn power<K: Kinematics<N>, const N: usize>(arm: &K) {
    let mut random = Random::new(2);
    for q in configurations(arm) {
        let (rates, wrench) = (
            random.unit_cube::<N>(),
            Wrench::from_array(random.unit_cube()),
        );
        let at_joints = |torques: [f64; N]| (0..N).map(|i| torques[i] * rates[i]).sum::<f64>();
        let powers = [
            at_joints(arm.spatial_torques(&q, &wrench))
                - wrench.power(&arm.spatial_velocity(&q, &rates)),
            at_joints(arm.body_torques(&q, &wrench)) - wrench.power(&arm.body_velocity(&q, &rates)),
            at_joints(arm.geometric_torques(&q, &wrench))
                - wrench.power(&arm.geometric_velocity(&q, &rates)),
        ];
        assert_close(powers, [0.0; 3], ROUNDING);
    }
}

/// The SCARA's are pure moments about x and y.
#[test]
fn structural_wrenches_of_the_scara() {
    let mut random = Random::new(3);
    for _ in 0..50 {
        let q = std::array::from_fn(|_| random.angle());
        let wrenches = Scara.structural_wrenches(&q);
        assert_eq!(wrenches.len(), 2);
        for wrench in &wrenches {
            assert_close(wrench.force, [0.0; 3], ROUNDING);
            assert_close([wrench.moment[2]], [0.0], ROUNDING);
        }
    }
    // Stretched out, it bears a push along its arm as well.
    assert_eq!(Scara.structural_wrenches(&[0.3, 0.0, 0.1, 0.2]).len(), 3);
}

/// Each takes no torque; they are orthonormal; and with the velocities that the
/// arm has they fill all six dimensions.
#[test]
fn structural_wrenches_need_no_torque() {
    for_every_arm!(structural);
}

fn structural<K: Kinematics<N>, const N: usize>(arm: &K) {
    for q in configurations(arm) {
        let wrenches = arm.structural_wrenches(&q);
        let jacobian = arm.spatial_jacobian(&q);
        let matrix = DMatrix::from_fn(6, N, |i, j| jacobian.rows[i][j]);
        assert_eq!(wrenches.len(), 6 - matrix.rank(1e-8));
        assert_eq!(jacobian.rank(), matrix.rank(1e-8));
        for (i, wrench) in wrenches.iter().enumerate() {
            assert_close(arm.spatial_torques(&q, wrench), [0.0; N], ROUNDING);
            for (j, other) in wrenches.iter().enumerate() {
                let (a, b) = (wrench.to_array(), other.to_array());
                let product: f64 = (0..6).map(|k| a[k] * b[k]).sum();
                assert_close([product], [f64::from(u8::from(i == j))], ROUNDING);
            }
        }
    }
}

/// The elbow manipulator stretched out bears a push along its arm.
#[test]
fn structural_wrenches_of_a_stretched_elbow() {
    let wrenches = Elbow.structural_wrenches(&[0.0, 0.0, 0.0, 0.3, 0.4, 0.5]);
    assert_eq!(wrenches.len(), 1);
    // Along y at the height of the shoulder.
    let expected = Wrench {
        force: [0.0, 1.0, 0.0],
        moment: [-L0, 0.0, 0.0],
    };
    let scale = wrenches[0].force[1];
    assert_close(
        (expected * scale).to_array(),
        wrenches[0].to_array(),
        ROUNDING,
    );
}
