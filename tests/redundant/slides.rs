//! Slides whose stops are far away, or are not there.

use crate::random::Random;
use kinematics::{
    Criterion, JointLimit, Parameter, Pose, RedundantKinematics, Robot, RobotOptions, RobotSource,
    kinematics,
};
use std::f64::consts::PI;
use std::path::Path;

kinematics!("robots/redundant/column.yaml");
kinematics!("robots/coupled/palletizer_on_rail.yaml");

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

/// The UR5e on a column of two stages, and on one of a single stage that goes as far.
fn columns() -> [Robot; 2] {
    let two = "robots/redundant/column.yaml";
    let two = RobotSource::read(two, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let mut one = two.clone();
    let (before, rest) = one.text.split_once("  - {name: lower,").unwrap();
    let (_, rest) = rest.split_once("offset: 15}}\n").unwrap();
    let slide =
        "{name: lift, xyz: [0, 0, 355], axis: [0, 0, 1], type: prismatic, limits: [0, 900]}";
    one.text = format!("{before}  - {slide}\n{rest}");
    [two, one].map(|source| Robot::load(&source, &RobotOptions::default()).unwrap())
}

/// Stages that slide along each other are one slide, that goes twice as far for each metre of the
/// first.
#[test]
fn the_stages_of_a_column_are_one_slide() {
    let [two, one] = columns();
    assert_eq!(two.parameter_names(), ["lower"]);
    assert_eq!(Column::PARAMETER, Parameter::Joint(0));
    let (by_two, by_one) = (two.along(0, &[0.0]), one.along(0, &[0.0]));
    let mut random = Random::new(77);
    for k in 0..200 {
        let mut q: [f64; 7] = std::array::from_fn(|_| random.angle());
        q[0] = random.between(0.0, 0.45);
        let mut single = q;
        single[0] = 2.0 * q[0];
        let pose = two.fk(&q);
        assert!(pose.translation_distance(&one.fk(&single)) < 1e-14);
        let halved = |q: &[f64]| [&[0.5 * q[0]], &q[1..]].concat();
        let found = by_two.ik_at(&pose, q[0]);
        let wanted = by_one.ik_at(&pose, 2.0 * q[0]);
        assert_eq!(found.len(), wanted.len(), "{q:?}");
        for (found, wanted) in found.iter().zip(wanted.iter()) {
            assert!(
                apart(found.q, &halved(wanted.q)) < 1e-9,
                "{found:?} {wanted:?}"
            );
            assert!(pose.translation_distance(&two.fk(found.q)) < 1e-12);
        }
        let compiled = Column.ik_at(&Column.fk(&q), q[0]);
        assert_eq!(compiled.len(), wanted.len(), "{q:?}");
        for (compiled, wanted) in compiled.iter().zip(wanted.iter()) {
            assert!(apart(&compiled.q, &halved(wanted.q)) < 1e-9, "{compiled:?}");
        }
        if k % 20 != 0 {
            continue;
        }
        let found = by_two.feasible_within(&pose, two.limits());
        let wanted = by_one.feasible_within(&pose, one.limits());
        assert_eq!(found.len(), wanted.len(), "{q:?}");
        for (found, wanted) in found.iter().zip(&wanted) {
            let ends = [found.from - 0.5 * wanted.from, found.to - 0.5 * wanted.to];
            assert!(ends.iter().all(|d| d.abs() < 1e-6), "{found:?} {wanted:?}");
        }
        let best: [f64; 7] = by_two.ik_best(&pose, &Criterion::Nearest(q)).unwrap();
        assert!(apart(&best, &q) < 1e-6, "{q:?}: {best:?}");
    }
}

/// The quill of a SCARA does the same as the column that it stands on, and is no stage of it.
#[test]
fn a_column_is_given_below_a_quill() {
    let mut source = RobotSource::read(
        "robots/redundant/column.yaml",
        Path::new(env!("CARGO_MANIFEST_DIR")),
    )
    .unwrap();
    let (column, _) = source.text.split_once("  - {name: shoulder_pan").unwrap();
    source.text = format!(
        "{column}  - {{name: j1, xyz: [0, 0, 200], axis: [0, 0, 1], limits: [-150, 150]}}
  - {{name: j2, xyz: [300, 0, 0], axis: [0, 0, 1], limits: [-150, 150]}}
  - {{name: quill, xyz: [250, 0, 0], axis: [0, 0, -1], type: prismatic, limits: [0, 200]}}
  - {{name: j4, axis: [0, 0, 1], limits: [-360, 360]}}
tip: tool0
"
    );
    let arm = Robot::load(&source, &RobotOptions::default()).unwrap();
    assert_eq!(arm.parameter_names(), ["lower"]);
    let mut random = Random::new(5);
    for _ in 0..100 {
        let mut q: [f64; 5] = std::array::from_fn(|_| random.angle());
        (q[0], q[3]) = (random.between(0.0, 0.45), random.between(0.0, 0.2));
        let solutions = arm.ik_at(&arm.fk(&q), &[q[0]]);
        assert_eq!(solutions.len(), 2, "{q:?}");
        let is_among = solutions.iter().any(|it| apart(it.q, &q) < 1e-9);
        assert!(is_among, "{q:?}: {solutions:?}");
    }
}

/// Its joints mimic others, and what carries them is given.
#[test]
fn a_palletizer_on_a_rail_has_all_its_solutions() {
    let arm = PalletizerOnRail;
    assert_eq!(PalletizerOnRail::PARAMETER, Parameter::Joint(0));
    let path = "robots/coupled/palletizer_on_rail.yaml";
    let source = RobotSource::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let loaded = Robot::load(&source, &RobotOptions::default()).unwrap();
    let mut random = Random::new(404);
    for k in 0..200 {
        let q: [f64; 5] = std::array::from_fn(|i| {
            let limit = &PalletizerOnRail::LIMITS[i];
            random.between(limit.lower(), limit.upper())
        });
        let pose = arm.fk(&q);
        assert!(pose.translation_distance(&loaded.fk(&q)) < 1e-14);
        let found = arm.ik_at(&pose, q[0]);
        let wanted = loaded.ik_at(&pose, &[q[0]]);
        assert_eq!(found.len(), wanted.len(), "{q:?}");
        for (found, wanted) in found.iter().zip(wanted.iter()) {
            assert!(apart(&found.q, wanted.q) < 1e-12, "{q:?}");
            assert!(pose.translation_distance(&arm.fk(&found.q)) < 1e-12);
            assert!(pose.rotation_distance(&arm.fk(&found.q)) < 1e-12);
        }
        let is_among = found.iter().any(|it| apart(&it.q, &q) < 1e-9);
        assert!(is_among, "{q:?}: {found:?}");
        if k % 20 == 0 {
            let intervals = arm.feasible(&pose);
            assert!(intervals.iter().any(|it| it.contains(q[0])), "{q:?}");
            let best = arm.ik_best(&pose, &Criterion::Nearest(q)).unwrap();
            assert!(apart(&best, &q) < 1e-6, "{q:?}: {best:?}");
        }
    }
}

/// A slide whose stages go farther than its coordinate is not
/// solved for.
#[test]
fn a_column_of_stages_is_always_given() {
    let path = "robots/redundant/column.yaml";
    let source = RobotSource::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let options = RobotOptions {
        free: vec!["elbow".into()],
        ..RobotOptions::default()
    };
    let refused = Robot::load(&source, &options).err().unwrap().to_string();
    assert!(
        refused.contains("help: name it in `free`, or leave that out"),
        "{refused}"
    );
    assert!(
        refused.contains(
            "`lower`, which others slide along with, has to be one of those that stay free"
        ),
        "{refused}"
    );
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    let each = a.iter().zip(b).map(|(a, b)| {
        let d = (a - b).abs() % (2.0 * PI);
        d.min(2.0 * PI - d)
    });
    each.fold(0.0, f64::max)
}
