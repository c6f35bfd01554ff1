//! The edges of what two joints can point at.

use crate::zoo::{Antenna, Gimbal};
use kinematics::Pose;
use std::f64::consts::{FRAC_PI_2, PI};

/// The direction at an angle from straight up, towards a compass angle.
fn pointing(from_up: f64, towards: f64) -> Pose {
    Pose::from_rpy([0.0, from_up, towards], [0.0; 3])
}

/// How far the antenna's elevation axis is from level: it cannot point nearer
/// to straight up or down.
const LEAN: f64 = 5.0 * PI / 180.0;

#[test]
fn an_antenna_points_both_ways_at_what_it_can_see() {
    for k in 0..24 {
        let towards = f64::from(k) * PI / 12.0;
        for from_up in [1e-6, 1e-3, 0.1, 1.0, FRAC_PI_2 - LEAN] {
            for from_up in [LEAN + from_up, PI - LEAN - from_up] {
                let answers = Antenna.ik(&pointing(from_up, towards));
                assert_eq!(answers.len(), 2, "{from_up}, {towards}");
                assert!(
                    answers
                        .iter()
                        .all(|answer| !answer.singular || from_up < 0.1)
                );
            }
        }
    }
}

#[test]
fn an_antenna_does_not_see_straight_up() {
    for from_up in [0.0, 1e-9, 0.5 * LEAN, LEAN - 1e-3, LEAN - 1e-6, LEAN - 1e-8] {
        for from_up in [from_up, PI - from_up] {
            let answers = Antenna.ik(&pointing(from_up, 0.7));
            assert!(answers.is_empty(), "{from_up}: {answers:?}");
        }
    }
}

#[test]
fn an_antenna_at_its_edge_has_one_flagged_answer() {
    for k in 0..24 {
        let towards = f64::from(k) * PI / 12.0;
        for edge in [LEAN, PI - LEAN] {
            let answers = Antenna.ik(&pointing(edge, towards));
            assert_eq!(answers.len(), 1, "{edge}, {towards}: {answers:?}");
            assert!(answers[0].singular);
        }
    }
}

/// Middle ring at ±π/2: the outer rings turn about one axis.
#[test]
fn a_gimbal_locks() {
    for middle in [FRAC_PI_2, -FRAC_PI_2] {
        let q = [0.4, middle, -0.9];
        let answers = Gimbal.ik(&Gimbal.fk(&q));
        assert!(!answers.is_empty());
        assert!(answers.iter().all(|answer| answer.singular), "{answers:?}");
        let kept = Gimbal.ik_seeded(&Gimbal.fk(&q), &q);
        assert!((kept[0].q[0] - q[0]).abs() < 1e-7, "{kept:?}");
    }
}

/// Where the arm's own links are is no matter to an orientation.
#[test]
fn a_gimbal_answers_wherever_the_target_is() {
    let mut target = Gimbal.fk(&[0.4, 0.3, -0.9]);
    target.translation = [1e9, -3.0, 0.0];
    assert_eq!(Gimbal.ik(&target).len(), 2);
}
