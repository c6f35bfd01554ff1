//! Rigid motions and what moves with them.

use core::f64::consts::{FRAC_PI_2, PI};
use kin_runtime::{Jacobian, Pose, Twist, Wrench};
use proptest::prelude::*;

fn close(a: &Pose, b: &Pose, tolerance: f64) -> bool {
    a.translation_distance(b) <= tolerance && a.rotation_distance(b) <= tolerance
}

fn near(a: [f64; 6], b: [f64; 6], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(x, y)| (x - y).abs() <= tolerance)
}

fn vectors() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-2.0..2.0)
}

fn twists() -> impl Strategy<Value = Twist> {
    prop::array::uniform6(-2.0..2.0).prop_map(Twist::from_array)
}

fn poses() -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-PI..PI), vectors()).prop_map(|(rpy, p)| Pose::from_rpy(rpy, p))
}

proptest! {
    #[test]
    fn composition_is_application_in_turn(g in poses(), h in poses(), x in vectors()) {
        let composed = (g * h).transform_point(x);
        let in_turn = g.transform_point(h.transform_point(x));
        prop_assert!((0..3).all(|i| (composed[i] - in_turn[i]).abs() < 1e-14));
        prop_assert!(close(&(g * g.inverse()), &Pose::IDENTITY, 1e-14));
    }

    #[test]
    fn orientations_survive_every_notation(g in poses()) {
        let p = g.translation;
        prop_assert!(close(&Pose::from_quaternion(g.quaternion(), p), &g, 4e-15));
        prop_assert!(close(&Pose::from_rpy(g.rpy(), p), &g, 4e-15));
        prop_assert_eq!(Pose::from_matrix(&g.to_matrix()), g);
        prop_assert!(g.quaternion()[3] >= 0.0);
    }

    #[test]
    fn the_logarithm_undoes_the_exponential(g in poses()) {
        prop_assert!(close(&Pose::exp(&g.log(), 1.0), &g, 1e-14));
    }

    #[test]
    fn the_exponential_undoes_the_logarithm(xi in twists(), theta in -1.5..1.5) {
        let turned: f64 = theta * xi.angular.iter().map(|x| x * x).sum::<f64>().sqrt();
        prop_assume!(turned.abs() < 3.1);
        let back = Pose::exp(&xi, theta).log();
        prop_assert!(near(back.to_array(), (xi * theta).to_array(), 1e-12));
    }

    #[test]
    fn exponentials_of_one_screw_add_up(xi in twists(), a in -2.0..2.0, b in -2.0..2.0) {
        let both = Pose::exp(&xi, a) * Pose::exp(&xi, b);
        prop_assert!(close(&both, &Pose::exp(&xi, a + b), 1e-13));
    }

    #[test]
    fn the_adjoint_conjugates(g in poses(), xi in twists()) {
        let carried = g * Pose::exp(&xi, 1.0) * g.inverse();
        prop_assert!(close(&carried, &Pose::exp(&g.adjoint(&xi), 1.0), 1e-13));
        let back = g.adjoint_inverse(&g.adjoint(&xi));
        prop_assert!(near(back.to_array(), xi.to_array(), 1e-13));
    }

    #[test]
    fn wrenches_keep_their_power(g in poses(), xi in twists(), f in twists()) {
        let wrench = Wrench::from_array(f.to_array());
        let seen = g.adjoint_transpose(&wrench);
        prop_assert!((wrench.power(&g.adjoint(&xi)) - seen.power(&xi)).abs() < 1e-12);
        let back = g.adjoint_inverse_transpose(&seen);
        prop_assert!(near(back.to_array(), wrench.to_array(), 1e-13));
    }

    #[test]
    fn jacobians_are_one_in_three_coordinates(
        g in poses(), a in twists(), b in twists(), rates in prop::array::uniform2(-2.0..2.0),
        load in twists(),
    ) {
        let spatial = Jacobian::from_columns([a, b]);
        let velocity = spatial.velocity(&rates);
        prop_assert!(near(velocity.to_array(), (a * rates[0] + b * rates[1]).to_array(), 1e-14));

        let body = spatial.spatial_to_body(&g);
        let seen = g.adjoint_inverse(&velocity);
        prop_assert!(near(body.velocity(&rates).to_array(), seen.to_array(), 1e-13));
        let back = body.body_to_spatial(&g);
        prop_assert!(near(back.velocity(&rates).to_array(), velocity.to_array(), 1e-12));

        let hybrid = spatial.spatial_to_geometric(&g).velocity(&rates);
        prop_assert!(near(hybrid.to_array(), [
            g.rotate(seen.linear), g.rotate(seen.angular),
        ].concat().try_into().unwrap(), 1e-12));

        // The same torques from the same load, wherever it is written down.
        let load = Wrench::from_array(load.to_array());
        let [t, s] = [spatial.torques(&load), body.torques(&g.adjoint_transpose(&load))];
        prop_assert!((t[0] - s[0]).abs() < 1e-12 && (t[1] - s[1]).abs() < 1e-12);
    }

    #[test]
    fn rotation_distances_are_exact_at_any_angle(axis in vectors(), angle in 0.0..PI) {
        prop_assume!(axis.iter().any(|x| x.abs() > 1e-3));
        for angle in [angle, 1e-9 * angle, PI - 1e-9 * angle] {
            let turned = Pose::from_axis_angle(axis, angle, [0.0; 3]);
            prop_assert!((turned.rotation_distance(&Pose::IDENTITY) - angle).abs() < 2e-15);
        }
    }
}

#[test]
fn rotations_are_right_handed() {
    let quarter = Pose::from_axis_angle([0.0, 0.0, 3.0], FRAC_PI_2, [0.0; 3]);
    assert!((quarter.rotate([1.0, 0.0, 0.0])[1] - 1.0).abs() < 1e-15);
    assert_eq!(
        Pose::from_axis_angle([0.0; 3], 1.0, [1.0; 3]),
        Pose::from_translation([1.0; 3])
    );
}

#[test]
fn a_half_turn_has_a_logarithm() {
    for axis in [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.6, 0.0, -0.8],
    ] {
        let half = Pose::from_axis_angle(axis, PI, [1.0, 2.0, 3.0]);
        assert!(close(&Pose::exp(&half.log(), 1.0), &half, 1e-14));
    }
    assert_eq!(Pose::IDENTITY.log(), Twist::default());
    assert_eq!(
        Pose::exp(&Twist::prismatic([0.0, 1.0, 0.0]), 2.0).translation,
        [0.0, 2.0, 0.0]
    );
}

#[test]
fn gimbal_lock_keeps_the_orientation() {
    for pitch in [FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2 - 1e-9] {
        let pose = Pose::from_rpy([0.4, pitch, -1.1], [0.0; 3]);
        assert!(close(&Pose::from_rpy(pose.rpy(), [0.0; 3]), &pose, 1e-15));
    }
}
