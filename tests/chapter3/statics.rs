//! Forces on the tool and torques at the joints.

use super::arms::{configurations, for_every_arm};
use super::differences::assert_close;
use super::random::Random;
use kinematics::{Kinematics, Wrench};

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
