//! Legs between hexagons: leg_i = |p + R b_i − a_i|.

use super::{CLOSED, Stewart};
use crate::chapter3::random::Random;
use kinematics::Pose;
use nalgebra::{SMatrix, Vector3};
use std::f64::consts::FRAC_PI_2;

const HEIGHT: f64 = 0.6;

/// Points at `half` degrees to both sides of three directions.
fn hexagon(radius: f64, half: f64, first: f64) -> [Vector3<f64>; 6] {
    std::array::from_fn(|i| {
        let middle = first + 120.0 * (i / 2) as f64;
        let angle = middle + if i % 2 == 0 { -half } else { half };
        let (s, c) = angle.to_radians().sin_cos();
        Vector3::new(radius * c, radius * s, 0.0)
    })
}

/// The ends of the legs, in the base and in the platform.
fn ends() -> [[Vector3<f64>; 6]; 2] {
    let mut heads = hexagon(0.3, 20.0, 60.0);
    heads.rotate_right(1);
    [hexagon(0.5, 12.0, 0.0), heads]
}

fn legs(pose: &Pose) -> [Vector3<f64>; 6] {
    let [feet, heads] = ends();
    std::array::from_fn(|i| Vector3::from(pose.transform_point(heads[i].into())) - feet[i])
}

fn lengths(pose: &Pose) -> [f64; 6] {
    legs(pose).map(|leg| leg.norm())
}

fn home() -> Pose {
    Pose::from_translation([0.0, 0.0, HEIGHT])
}

fn pose(random: &mut Random) -> Pose {
    let [x, y, z, roll, pitch, yaw] = random.unit_cube::<6>();
    let translation = [0.08 * x, 0.08 * y, HEIGHT + 0.05 * z];
    Pose::from_rpy([0.2 * roll, 0.2 * pitch, 0.4 * yaw], translation)
}

/// Whether all slides stop short of their limits.
fn in_reach(pose: &Pose) -> bool {
    let (now, rest) = (lengths(pose), lengths(&home()));
    (0..6).all(|i| (-0.15..0.3).contains(&(now[i] - rest[i])))
}

#[test]
fn legs_have_the_lengths_of_the_formula() {
    let rest = lengths(&home());
    let mut random = Random::new(21);
    for _ in 0..1000 {
        let target = pose(&mut random);
        assert!(in_reach(&target), "{target:?}");
        let q = Stewart
            .ik(&target)
            .nearest(&[0.0; 36], &Stewart::LIMITS)
            .unwrap();
        assert!(Stewart.gap(&q) < CLOSED * Stewart::LENGTH);
        let (found, expected) = (Stewart.actuated(&q), lengths(&target));
        for i in 0..6 {
            assert!((found[i] + rest[i] - expected[i]).abs() < 1e-13);
        }
    }
}

#[test]
fn forward_after_inverse_is_the_identity() {
    let mut random = Random::new(22);
    for _ in 0..2000 {
        let target = pose(&mut random);
        let q = Stewart
            .ik(&target)
            .nearest(&[0.0; 36], &Stewart::LIMITS)
            .unwrap();
        let found = Stewart.fk_near(&Stewart.actuated(&q), &[0.0; 36]).unwrap();
        assert!(found.residual < CLOSED * Stewart::LENGTH);
        let back = Stewart.platform(&found.q);
        assert!(back.translation_distance(&target) < 1e-11, "{target:?}");
        assert!(back.rotation_distance(&target) < 1e-11);
    }
}

/// Row i is (u, R b × u) about the platform's origin.
#[test]
fn the_inverse_jacobian_is_the_textbook_s() {
    let mut random = Random::new(23);
    for _ in 0..100 {
        let target = pose(&mut random);
        let q = Stewart
            .ik(&target)
            .nearest(&[0.0; 36], &Stewart::LIMITS)
            .unwrap();
        let rows = Stewart.inverse_jacobian(&q).unwrap();
        let forward = Stewart.forward_jacobian(&q).unwrap();
        let [feet, _] = ends();
        for (i, leg) in legs(&target).into_iter().enumerate() {
            let u = leg.normalize();
            // About the base's origin, as spatial twists are.
            let moment = feet[i].cross(&u);
            let expected = [u.x, u.y, u.z, moment.x, moment.y, moment.z];
            for j in 0..6 {
                assert!((rows[i][j] - expected[j]).abs() < 1e-12);
            }
        }
        let inverse = SMatrix::<f64, 6, 6>::from_fn(|i, j| rows[i][j]);
        let forward = SMatrix::<f64, 6, 6>::from_fn(|i, j| forward.rows[i][j]);
        assert!((inverse * forward - SMatrix::identity()).amax() < 1e-10);
    }
}

/// A symmetric 6-6 loses the twist about the vertical at yaw ±90°.
#[test]
fn singular_at_a_quarter_turn() {
    let measure = |yaw: f64| {
        let target = Pose::from_rpy([0.0, 0.0, yaw], [0.0, 0.0, HEIGHT]);
        let postures = Stewart.ik(&target);
        let q = postures.iter().next().unwrap();
        Stewart.actuator_singularity(&q)
    };
    for yaw in [FRAC_PI_2, -FRAC_PI_2] {
        assert!(measure(yaw) < 1e-12, "{}", measure(yaw));
        assert!(measure(yaw + 0.1) > 1e-3);
    }
    assert!(measure(0.0) > 0.1);
}

#[test]
fn mobility_is_six() {
    let generic = super::generic("../robots/stewart.yaml");
    assert_eq!((generic.gruebler(6), generic.mobility()), (6, 6));
    assert_eq!(Stewart::MOBILITY, 6);
}

#[test]
fn loops_stay_closed_along_a_circle() {
    let mut seed = [0.0; 36];
    for k in 0..=720 {
        let (s, c) = (f64::from(k).to_radians() / 2.0).sin_cos();
        let target = Pose::from_rpy([0.2 * s, 0.1 * c, 0.3 * s], [0.06 * c, 0.06 * s, HEIGHT]);
        let actuated: [f64; 6] = {
            let (now, rest) = (lengths(&target), lengths(&home()));
            std::array::from_fn(|i| now[i] - rest[i])
        };
        let found = Stewart.fk_near(&actuated, &seed).unwrap();
        assert!(found.residual < CLOSED * Stewart::LENGTH);
        assert!(Stewart.platform(&found.q).translation_distance(&target) < 1e-11);
        seed = found.q;
    }
}

/// No seed leads to lengths that no platform fits.
#[test]
fn legs_that_do_not_fit_have_no_assembly() {
    let mut actuated = [0.0; 6];
    actuated[0] = 2.0;
    assert!(Stewart.fk_near(&actuated, &[0.0; 36]).is_none());
    assert!(Stewart.fk_near(&[f64::NAN; 6], &[0.0; 36]).is_none());
}

/// A leg has eight ways to hold its end: there and back through the base, and
/// two of either joint. They combine freely.
#[test]
fn every_combination_of_legs_closes() {
    let target = pose(&mut Random::new(24));
    let postures = Stewart.ik(&target);
    assert_eq!(postures.len(), 8_usize.pow(6));
    for q in postures.iter().step_by(997) {
        assert!(Stewart.gap(&q) < CLOSED * Stewart::LENGTH);
    }
}

/// Where the ball of a leg is in gimbal lock, the platform cannot follow all actuated rates.
#[test]
fn no_rates_are_told_that_a_leg_cannot_follow() {
    let mut leg = [0.0; 36];
    leg[..6].copy_from_slice(&[0.1, -0.05, 0.05, 0.2, FRAC_PI_2, -0.3]);
    let target = Stewart.platform(&leg);
    let rates = [0.1, 0.05, -0.03, 0.02, 0.07, -0.04];
    let seeded = Stewart.ik_seeded(&target, &leg);
    let is_locked = |q: &[f64; 36]| (0..6).all(|i| (q[i] - leg[i]).abs() < 1e-6);
    let locked = seeded.iter().find(is_locked).unwrap();
    assert!(Stewart.gap(&locked) < CLOSED);
    assert!(Stewart.joint_rates(&locked, &rates).is_none());

    let near = Stewart.ik(&Pose::from_rpy([0.02, 0.01, 0.03], [0.01, 0.0, HEIGHT]));
    let q = near.iter().next().unwrap();
    let found = Stewart.joint_rates(&q, &rates).unwrap();
    let found = Stewart.actuated(&found);
    assert!(
        (0..6).all(|i| (found[i] - rates[i]).abs() < 1e-9),
        "{found:?}"
    );
}
