//! f = 457.3, e = 115, rf = 112, re = 232 millimetres: three spheres, and the
//! arms' angles by the formula of circles.

use super::{CLOSED, Delta};
use crate::chapter3::random::Random;
use kinematics::{Pose, Solution};
use nalgebra::Vector3;

const UPPER: f64 = 0.112;
const ROD: f64 = 0.232;

fn base() -> f64 {
    0.4573 / (2.0 * 3_f64.sqrt())
}

fn platform() -> f64 {
    0.115 / (2.0 * 3_f64.sqrt())
}

/// The angles at which one arm, in its own vertical plane, holds the platform's
/// centre at (x, y, z): the elbow on a circle about the motor is a rod away.
fn arm([x, y, z]: [f64; 3], turned: f64) -> Vec<f64> {
    let (s, c) = turned.sin_cos();
    let (out, side) = (c * x + s * y + platform() - base(), c * y - s * x);
    // |(UPPER cos q, −UPPER sin q) − (out, z)|² = ROD² − side².
    let constant = (out * out + z * z + UPPER * UPPER - ROD * ROD + side * side) / (2.0 * UPPER);
    let length = out.hypot(z);
    if constant.abs() > length {
        return Vec::new();
    }
    let middle = (-z).atan2(out);
    let half = (constant / length).acos();
    vec![middle + half, middle - half]
}

const ARMS: [f64; 3] = [0.0, 2.0943951023931953, -2.0943951023931953];

fn point(random: &mut Random) -> [f64; 3] {
    [
        random.between(-0.08, 0.08),
        random.between(-0.08, 0.08),
        random.between(-0.25, -0.12),
    ]
}

#[test]
fn motors_turn_to_the_angles_of_the_formula() {
    let mut random = Random::new(11);
    let mut reached = 0;
    for _ in 0..1000 {
        let position = point(&mut random);
        let postures = Delta.ik(&Pose::from_translation(position));
        for (k, turned) in ARMS.into_iter().enumerate() {
            let expected = arm(position, turned);
            for q in postures.of_chain(k) {
                let near = |x: &f64| kinematics::__private::math::wrap(x - q[0]).abs() < 1e-9;
                assert!(expected.iter().any(near), "{position:?} {expected:?} {q:?}");
            }
            for x in &expected {
                let near = |q: &[f64]| kinematics::__private::math::wrap(x - q[0]).abs() < 1e-9;
                assert!(postures.of_chain(k).any(near), "{position:?} {x} arm {k}");
            }
        }
        reached += usize::from(!postures.is_empty());
    }
    assert!(reached > 500, "{reached}");
}

#[test]
fn the_platform_never_turns() {
    let mut random = Random::new(12);
    for _ in 0..300 {
        let motors = [(); 3].map(|()| random.between(-0.4, 0.9));
        for assembly in &Delta.fk(&motors) {
            let turned = Delta
                .platform(&assembly.q)
                .rotation_distance(&Pose::IDENTITY);
            assert!(turned < 1e-13);
        }
    }
}

/// The rods' upper ends, less the arms of the platform, are the centres.
#[test]
fn assembly_modes_lie_on_three_spheres() {
    let mut random = Random::new(13);
    let mut both = 0;
    for _ in 0..1000 {
        let motors = [(); 3].map(|()| random.between(-0.6, 1.2));
        let found = Delta.fk(&motors);
        both += usize::from(found.len() == 2);
        for assembly in &found {
            assert!(assembly.residual < CLOSED * Delta::LENGTH, "{assembly:?}");
            assert!((0..3).all(|i| (Delta.actuated(&assembly.q)[i] - motors[i]).abs() < 1e-9));
            let p = Delta.platform(&assembly.q).translation;
            for (motor, turned) in motors.into_iter().zip(ARMS) {
                let out = base() + UPPER * motor.cos() - platform();
                let elbow = [out * turned.cos(), out * turned.sin(), -UPPER * motor.sin()];
                let square: f64 = (0..3).map(|i| (p[i] - elbow[i]).powi(2)).sum();
                assert!((square.sqrt() - ROD).abs() < 1e-14);
            }
        }
    }
    assert!(both > 900, "{both}");
}

/// Spheres of one size meet where the circle through their centres is smaller.
#[test]
fn motors_that_no_platform_fits_have_no_assembly_modes() {
    let mut random = Random::new(15);
    let mut without = 0;
    for _ in 0..3000 {
        let motors = [(); 3].map(|()| random.angle());
        let centres: Vec<Vector3<f64>> = motors
            .into_iter()
            .zip(ARMS)
            .map(|(motor, turned)| {
                let out = base() + UPPER * motor.cos() - platform();
                Vector3::new(out * turned.cos(), out * turned.sin(), -UPPER * motor.sin())
            })
            .collect();
        let [a, b, c] = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| centres[i] - centres[j]);
        let circle = a.norm() * b.norm() * c.norm() / (2.0 * a.cross(&b).norm());
        let found = Delta.fk(&motors).len();
        if circle > ROD * (1.0 + 1e-9) {
            assert_eq!(found, 0, "{motors:?}");
            // What closes all the same has left the mode in which it translates.
            let other = Delta.fk_near(&motors, &[0.0; 15]);
            assert!(other.is_none_or(|s| {
                let turned = Delta.platform(&s.q).rotation_distance(&Pose::IDENTITY);
                turned > 1e-3 && s.residual < CLOSED * Delta::LENGTH
            }));
            without += 1;
        } else if circle < ROD * (1.0 - 1e-9) {
            assert_eq!(found, 2, "{motors:?}");
        }
    }
    assert!(without > 20, "{without}");
}

#[test]
fn out_of_reach_there_is_nothing() {
    assert!(
        Delta
            .ik(&Pose::from_translation([0.0, 0.0, -0.6]))
            .is_empty()
    );
    assert!(Delta.ik(&Pose::from_translation([f64::NAN; 3])).is_empty());
    assert!(Delta.fk(&[f64::NAN; 3]).is_empty());
    assert!(Delta.fk_near(&[f64::NAN; 3], &[0.0; 15]).is_none());
}

/// Where a rod and its arm are in line, the inverse Jacobian grows without
/// bound; straight below the centre all three are at once.
#[test]
fn an_arm_in_line_with_its_rod_cannot_follow() {
    let out = base() - platform();
    let lowest = -((UPPER + ROD).powi(2) - out * out).sqrt();
    let rows = |above: f64| {
        let target = Pose::from_translation([0.0, 0.0, lowest + above]);
        let q = Delta.ik(&target).iter().next().unwrap();
        Delta.inverse_jacobian(&q).unwrap()
    };
    for a in 0..3 {
        assert!(rows(1e-8)[a][2].abs() > 100.0 * rows(1e-2)[a][2].abs());
    }
    assert!(
        Delta
            .ik(&Pose::from_translation([0.0, 0.0, lowest - 1e-6]))
            .is_empty()
    );
}

#[test]
fn forward_after_inverse_is_the_identity() {
    let mut random = Random::new(14);
    let mut tried = 0;
    while tried < 3000 {
        let position = point(&mut random);
        let target = Pose::from_translation(position);
        let Some(q) = Delta.ik(&target).nearest(&[0.0; 15], &Delta::LIMITS) else {
            continue;
        };
        tried += 1;
        assert!(Delta.gap(&q) < CLOSED * Delta::LENGTH);
        let found = Delta.fk(&Delta.actuated(&q));
        let back = |s: &Solution<15>| Delta.platform(&s.q).translation_distance(&target) < 1e-12;
        assert!(found.iter().any(back), "{position:?}");
    }
}

/// Row a of the inverse Jacobian for translations: the rod's direction, by its
/// part along the elbow's motion.
#[test]
fn the_inverse_jacobian_is_that_of_the_rods() {
    let target = Pose::from_translation([0.03, -0.02, -0.17]);
    let q = Delta
        .ik(&target)
        .nearest(&[0.0; 15], &Delta::LIMITS)
        .unwrap();
    let rows = Delta.inverse_jacobian(&q).unwrap();
    let motors = Delta.actuated(&q);
    for (a, (motor, turned)) in motors.into_iter().zip(ARMS).enumerate() {
        let out = base() + UPPER * motor.cos() - platform();
        let elbow = [out * turned.cos(), out * turned.sin(), -UPPER * motor.sin()];
        let rod: [f64; 3] = std::array::from_fn(|i| target.translation[i] - elbow[i]);
        let inwards = -UPPER * motor.sin();
        let motion = [
            inwards * turned.cos(),
            inwards * turned.sin(),
            -UPPER * motor.cos(),
        ];
        let along: f64 = (0..3).map(|i| rod[i] * motion[i]).sum();
        for i in 0..3 {
            assert!((rows[a][i] - rod[i] / along).abs() < 1e-11, "{a} {i}");
        }
    }
}

/// Where an arm and its rod are in line its motor holds the platform in two ways that are one, and next to
/// that in two that are near each other.
#[test]
fn assemblies_next_to_a_straight_leg_are_driven_as_asked() {
    let mut random = Random::new(0xde17);
    let (mut checked, mut worst) = (0, 0.0_f64);
    for _ in 0..200 {
        let out: [f64; 3] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let at =
            |way: f64| Pose::from_translation([out[0] * way, out[1] * way, -0.17 + out[2] * way]);
        let (mut reached, mut beyond) = (0.0, 1.0);
        for _ in 0..70 {
            let middle = 0.5 * (reached + beyond);
            match Delta.ik(&at(middle)).is_empty() {
                true => beyond = middle,
                false => reached = middle,
            }
        }
        for short in [0.0, 1e-14, 1e-13, 1e-12, 1e-10] {
            for q in Delta.ik(&at(reached - short)).iter().take(4) {
                let asked = Delta.actuated(&q);
                for found in &Delta.fk(&asked) {
                    let driven = Delta.actuated(&found.q);
                    let off = (0..3).map(|k| (asked[k] - driven[k]).abs());
                    let off = off.fold(0.0, f64::max);
                    worst = worst.max(off);
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 2000, "{checked}");
    // The motor turns by the root of what rounding moves the platform by.
    assert!(worst < 4e-7, "{worst:e}");
}
