//! Cranks and rods of 0.1, motors 0.12 apart: two circles that meet.

use super::{CLOSED, FiveBar};
use crate::chapter3::random::Random;
use kinematics::Pose;

const LINK: f64 = 0.1;
const FRAME: f64 = 0.12;

/// The elbows for motor values, which are 0 where the cranks point along y.
fn elbows(motors: [f64; 2]) -> [[f64; 2]; 2] {
    let elbow = |x: f64, q: f64| [x - LINK * q.sin(), LINK * q.cos()];
    [elbow(0.0, motors[0]), elbow(FRAME, motors[1])]
}

/// The points at the distance of a rod from both elbows.
fn circles(motors: [f64; 2]) -> Vec<[f64; 2]> {
    let [a, b] = elbows(motors);
    let (u, v) = (b[0] - a[0], b[1] - a[1]);
    let half = 0.5 * u.hypot(v);
    if half > LINK {
        return Vec::new();
    }
    let height = (LINK * LINK - half * half).sqrt() / (2.0 * half);
    let point = |sign: f64| {
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        [middle[0] - sign * height * v, middle[1] + sign * height * u]
    };
    vec![point(1.0), point(-1.0)]
}

#[test]
fn assembly_modes_are_where_two_circles_meet() {
    let mut random = Random::new(5);
    let mut without = 0;
    for _ in 0..2000 {
        let motors = [random.angle(), random.angle()];
        let [a, b] = elbows(motors);
        let apart = (a[0] - b[0]).hypot(a[1] - b[1]);
        if apart < 1e-3 || (apart - 2.0 * LINK).abs() < 1e-6 {
            continue;
        }
        let expected = circles(motors);
        let found = FiveBar.fk(&motors);
        assert_eq!(found.len(), expected.len(), "{motors:?}");
        without += usize::from(expected.is_empty());
        for [x, y] in expected {
            let at = |s: &kinematics::Solution<5>| {
                let p = FiveBar.platform(&s.q).translation;
                (p[0] - x).hypot(p[1] - y) < 1e-11
            };
            assert!(found.iter().any(at), "{motors:?}");
        }
        assert!(found.iter().all(|s| s.residual < CLOSED * FiveBar::LENGTH));
    }
    assert!(without > 100);
}

/// Both elbows in one point: the rods turn freely about it.
#[test]
fn elbows_in_one_point_leave_a_family_of_which_one_is_told() {
    let motor = (0.5 * FRAME / LINK).asin();
    let found = FiveBar.fk(&[-motor, motor]);
    assert!(!found.is_empty());
    for assembly in &found {
        assert!(
            assembly.singular && assembly.residual < 1e-9,
            "{assembly:?}"
        );
        assert!(FiveBar.actuator_singularity(&assembly.q) < 1e-6);
        assert!(FiveBar.forward_jacobian(&assembly.q).is_none());
    }
}

#[test]
fn a_point_is_held_in_four_ways() {
    let postures = FiveBar.ik(&Pose::from_translation([0.05, 0.15, 0.0]));
    assert_eq!(postures.len(), 4);
    for q in postures.iter() {
        assert!(FiveBar.gap(&q) < CLOSED * FiveBar::LENGTH);
        let p = FiveBar.platform(&q).translation;
        assert!((p[0] - 0.05).abs() < 1e-14 && (p[1] - 0.15).abs() < 1e-14);
    }
    assert!(
        FiveBar
            .ik(&Pose::from_translation([0.05, 0.5, 0.0]))
            .is_empty()
    );
}

/// In line the rods cannot be held by the cranks; with a crank and its rod in
/// line the tool cannot be moved outwards.
#[test]
fn both_kinds_of_singularity() {
    // Elbows as far apart as both rods are long.
    let spread = 0.5 * (2.0 * LINK - FRAME);
    let motor = (spread / LINK).asin();
    let near = |off: f64| {
        let motors = [motor - off, -motor + off];
        let q = FiveBar.fk(&motors)[0].q;
        FiveBar.actuator_singularity(&q)
    };
    assert!(
        near(1e-10) < 1e-4 && near(0.3) > 0.1,
        "{} {}",
        near(1e-10),
        near(0.3)
    );
    // The right arm stretched: to the point (0, 0.16), 0.2 from its motor. The
    // left rod is the platform, whose turning counts: its own arm has no such
    // place.
    let rows = |off: f64| {
        let target = Pose::from_translation([off, 0.16, 0.0]);
        let q = FiveBar.ik(&target).iter().next().unwrap();
        FiveBar.inverse_jacobian(&q).unwrap()
    };
    let norm = |row: [f64; 6]| row.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!(norm(rows(1e-9)[1]) > 100.0 * norm(rows(1e-2)[1]));
    assert!(norm(rows(1e-9)[0]) < 2.0 * norm(rows(1e-2)[0]));
}
