//! Slides whose stops are far away, or are not there.

use crate::random::Random;
use kinematics::{Criterion, JointLimit, Pose, Robot, RobotOptions, RobotSource};
use std::f64::consts::PI;
use std::path::Path;

/// The UR5e on a rail with other stops, millimetres.
fn rail(stops: &str) -> Robot {
    loaded(stops, "rail")
}

/// With one joint given.
fn loaded(stops: &str, given: &str) -> Robot {
    let path = "robots/redundant/rail.yaml";
    let mut source = RobotSource::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    source.text = source.text.replace(", limits: [-1500, 1500]", stops);
    let options = RobotOptions {
        free: vec![given.into()],
        ..RobotOptions::default()
    };
    Robot::load(&source, &options).unwrap()
}

/// The arm reaches less than a metre along the rail, wherever it stands.
#[test]
fn a_rail_may_be_long_or_far_away() {
    for (stops, places) in [
        (", limits: [0, 20000]", [0.5, 9.9, 15.0, 19.5]),
        (", limits: [12000, 15000]", [12.4, 13.0, 14.0, 14.8]),
        (", limits: [-40000, -20000]", [-39.0, -30.0, -21.0, -20.2]),
        ("", [-60.0, -3.0, 0.0, 45.0]),
        (
            ", limits: [-1000000000, 1000000000]",
            [-60.0, -3.0, 0.0, 45.0],
        ),
    ] {
        let arm = rail(stops);
        let along = arm.along(0, &[0.0]);
        for place in places {
            let q = [place, 0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
            let pose = arm.fk(&q);
            for intervals in [
                along.feasible(&pose),
                along.feasible_within(&pose, arm.limits()),
            ] {
                assert!(
                    intervals.iter().any(|it| it.contains(place)),
                    "{stops} {place}"
                );
                for interval in &intervals {
                    let [from, to] = [interval.from, interval.to];
                    assert!(
                        from <= to && place - 2.0 < from && to < place + 2.0,
                        "{interval:?}"
                    );
                    assert!(
                        !along.ik_at(&pose, 0.5 * (from + to)).is_empty(),
                        "{interval:?}"
                    );
                }
            }
            let best: [f64; 7] = along.ik_best(&pose, &Criterion::Nearest(q)).unwrap();
            assert!(
                best.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-6),
                "{best:?}"
            );
        }
    }
}

#[test]
fn what_has_no_ends_is_not_swept() {
    let pose = Pose::from_rpy([PI, 0.0, 0.0], [0.4, 0.2, 0.6]);
    let counts = [", limits: [-3141.592653589793, 3141.592653589793]", ""].map(|stops| {
        let swept = rail(stops).along(0, &[0.0]).ik_sweep(&pose, 7);
        swept
            .iter()
            .map(|answers| answers.len())
            .collect::<Vec<_>>()
    });
    assert_eq!(counts[0].len(), 7);
    // The ends are as far away as the arm does not reach, both of them.
    assert_eq!((counts[0][0], counts[0][6]), (0, 0));
    assert!(counts[0][3] > 0 && counts[1].is_empty(), "{counts:?}");
}

/// Between two stops that are near each other a joint is so shortly that samples do not see it.
#[test]
fn narrow_stops_leave_short_intervals() {
    let arm = loaded("", "shoulder_pan");
    let along = arm.along(0, &[0.0]);
    let mut random = Random::new(31);
    for wide in [1e-2, 1e-4, 1e-6, 1e-7] {
        for _ in 0..10 {
            let mut q: [f64; 7] = std::array::from_fn(|_| random.angle());
            q[0] *= 0.2;
            let pose = arm.fk(&q);
            for narrow in [0, 2, 5] {
                let from = q[narrow] - random.between(0.2, 0.8) * wide;
                let mut limits = arm.limits().to_vec();
                limits[narrow] = match narrow {
                    0 => JointLimit::prismatic(from, from + wide),
                    _ => JointLimit::revolute(from, from + wide),
                };
                let within = along.feasible_within(&pose, &limits);
                let of = (wide, narrow, q);
                assert!(
                    within.iter().any(|it| it.contains(q[1])),
                    "{of:?}: {within:?}"
                );
                for interval in &within {
                    let value = limits[narrow].nearest(interval.middle[narrow], 0.0);
                    assert!(value.is_some(), "{of:?}: {interval:?}");
                }
            }
        }
    }
}
