//! Reachable and dextrous workspace.

use super::arms::{Elbow, Planar2r, Planar3r, Scara, Stanford, Ur5e};
use super::random::Random;
use kinematics::{Chain, Kinematics, Pose, Twist, WithTool, Workspace, WorkspaceMethod};
use std::f64::consts::PI;

kinematics::kinematics!("../robots/puma560.yaml");
kinematics::kinematics!("../robots/kr6_r900.yaml");

const NEAR: f64 = 1e-9;

fn at(radius: f64, angle: f64) -> [f64; 3] {
    [radius * angle.cos(), radius * angle.sin(), 0.0]
}

/// Reachable l1 − l2 − l3 .. l1 + l2 + l3, dextrous l1 − l2 + l3 .. l1 + l2 − l3.
#[test]
fn planar_3r_annuli() {
    let arm = Workspace::of(&Planar3r).unwrap();
    assert_eq!(arm.method(), WorkspaceMethod::Annulus);
    let annuli = [
        (arm.reachable_annulus().unwrap(), [0.5 - 0.3 - 0.1, 0.9]),
        (
            arm.dextrous_annulus().unwrap(),
            [0.5 - 0.3 + 0.1, 0.5 + 0.3 - 0.1],
        ),
    ];
    for (found, expected) in annuli {
        assert!((found[0] - expected[0]).abs() < NEAR && (found[1] - expected[1]).abs() < NEAR);
    }
    for k in 0..12 {
        let angle = f64::from(k) * PI / 6.0;
        for (inside, outside) in [(0.1 + NEAR, 0.1 - NEAR), (0.9 - NEAR, 0.9 + NEAR)] {
            assert!(arm.is_reachable(at(inside, angle)));
            assert!(!arm.is_reachable(at(outside, angle)));
        }
        for (inside, outside) in [(0.3 + NEAR, 0.3 - NEAR), (0.7 - NEAR, 0.7 + NEAR)] {
            assert!(arm.is_dextrous(at(inside, angle)));
            assert!(!arm.is_dextrous(at(outside, angle)));
        }
    }
    assert!(!arm.is_reachable([0.5, 0.0, 0.1]), "out of its plane");
    for arm in [
        arm,
        Workspace::of(&Puma560).unwrap(),
        Workspace::of(&Ur5e).unwrap(),
    ] {
        for none in [
            [f64::NAN, 0.1, 0.1],
            [0.1, f64::INFINITY, 0.1],
            [0.1, 0.1, f64::NAN],
        ] {
            assert!(
                !arm.is_reachable(none) && !arm.is_dextrous(none),
                "{none:?}"
            );
        }
    }
}

/// The annuli are those in which inverse kinematics has answers.
#[test]
fn planar_3r_annuli_are_where_inverse_kinematics_answers() {
    let arm = Workspace::of(&Planar3r).unwrap();
    let mut random = Random::new(31);
    for _ in 0..400 {
        let point = at(random.between(0.0, 1.0), random.angle());
        let turned =
            |k: u8| Pose::from_axis_angle([0.0, 0.0, 1.0], f64::from(k) * PI / 60.0, point);
        let answered = (0..120)
            .filter(|&k| Planar3r.is_reachable_pose(&turned(k)))
            .count();
        let radius = point[0].hypot(point[1]);
        let near_boundary = [0.1, 0.3, 0.7, 0.9]
            .iter()
            .any(|r| (r - radius).abs() < 1e-2);
        if !near_boundary {
            assert_eq!(arm.is_reachable(point), answered > 0, "{radius}");
            assert_eq!(arm.is_dextrous(point), answered == 120, "{radius}");
        }
    }
}

#[test]
fn planar_2r_reaches_a_disc_with_one_turn_only() {
    let arm = Workspace::of(&Planar2r).unwrap();
    let [inner, outer] = arm.reachable_annulus().unwrap();
    assert!(
        (inner - 0.1).abs() < NEAR && (outer - 0.7).abs() < NEAR,
        "{inner} {outer}"
    );
    assert_eq!(arm.dextrous_annulus(), None);
}

/// A last link longer than the hole in the middle turns all round in it, too.
#[test]
fn a_long_last_link_is_dextrous_in_the_middle() {
    let revolute = |x| Twist::revolute([0.0, 0.0, 1.0], [x, 0.0, 0.0]);
    let twists = vec![revolute(0.0), revolute(0.5), revolute(0.9)];
    let arm = Workspace::new(Chain::new(twists, Pose::from_translation([1.2, 0.0, 0.0])));
    assert!(arm.is_dextrous(at(0.2 - NEAR, 0.4)) && !arm.is_dextrous(at(0.2 + NEAR, 0.4)));
    assert!(arm.is_dextrous(at(0.4 + NEAR, 0.4)) && !arm.is_dextrous(at(0.4 - NEAR, 0.4)));
}

/// Joint 4 slides as far as one likes.
#[test]
fn scara_reaches_an_annulus_at_any_height() {
    let arm = Workspace::of(&Scara).unwrap();
    for height in [-3.0, 0.0, 0.5, 7.0] {
        let on = |radius: f64| [radius, 0.0, height];
        assert!(arm.is_dextrous(on(0.1 + NEAR)) && !arm.is_reachable(on(0.1 - NEAR)));
        assert!(arm.is_dextrous(on(0.7 - NEAR)) && !arm.is_reachable(on(0.7 + NEAR)));
    }
}

/// The tip is the wrist's centre: a spherical shell of the elbow manipulator.
#[test]
fn elbow_manipulator_is_dextrous_wherever_it_reaches() {
    let arm = Workspace::of(&Elbow).unwrap();
    assert_eq!(arm.method(), WorkspaceMethod::WristCentre);
    let mut random = Random::new(32);
    for _ in 0..200 {
        let [x, y, z] = random.unit_cube::<3>();
        let length = (x * x + y * y + z * z).sqrt();
        let at = |r: f64| [x * r / length, y * r / length, 0.5 + z * r / length];
        for (inside, outside) in [(0.1 + NEAR, 0.1 - NEAR), (0.7 - NEAR, 0.7 + NEAR)] {
            assert!(arm.is_reachable(at(inside)) && arm.is_dextrous(at(inside)));
            assert!(!arm.is_reachable(at(outside)) && !arm.is_dextrous(at(outside)));
        }
    }
}

/// Orientations for which inverse kinematics has an answer, of `count` random
/// ones.
fn answered<const N: usize>(arm: &impl Kinematics<N>, point: [f64; 3], count: usize) -> usize {
    let mut random = Random::new(33);
    let mut reached = 0;
    for _ in 0..count {
        let axis = loop {
            let axis = random.unit_cube::<4>();
            let length = axis.iter().map(|x| x * x).sum::<f64>();
            if (0.01..1.0).contains(&length) {
                break axis.map(|x| x / length.sqrt());
            }
        };
        let [w, x, y, z] = axis;
        let sine = (x * x + y * y + z * z).sqrt();
        let direction = [x / sine, y / sine, z / sine];
        let target = Pose::from_axis_angle(direction, 2.0 * sine.atan2(w), point);
        reached += usize::from(arm.is_reachable_pose(&target));
    }
    reached
}

/// The questions beside what inverse kinematics answers for many orientations.
fn agrees_with_inverse_kinematics<const N: usize>(arm: &impl Kinematics<N>, reach: f64) {
    const COUNT: usize = 400;
    let workspace = Workspace::of(arm).unwrap();
    assert_eq!(workspace.method(), WorkspaceMethod::WristCentre);
    let mut random = Random::new(34);
    let (mut reachable, mut dextrous, mut neither) = (0, 0, 0);
    for _ in 0..300 {
        let point = random.unit_cube::<3>().map(|x| x * reach);
        let seen = answered(arm, point, COUNT);
        let questions = (workspace.is_reachable(point), workspace.is_dextrous(point));
        // What is answered is reachable; what is not answered once is not
        // dextrous. The converse holds but for slivers that chance misses.
        assert!(questions.0 || seen == 0, "{point:?}: {seen}");
        assert!(!questions.1 || seen == COUNT, "{point:?}: {seen}");
        reachable += usize::from(questions.0 != (seen > 0));
        dextrous += usize::from(questions.1 != (seen == COUNT));
        neither += usize::from(questions == (true, false));
    }
    assert!(
        reachable <= 6 && dextrous <= 6,
        "{reachable} and {dextrous} of 300"
    );
    assert!(neither > 30, "points between the two boundaries: {neither}");
}

#[test]
fn spherical_wrists_on_shoulders_with_and_without_offset() {
    let tool = Pose::from_translation([0.03, 0.02, 0.15]);
    agrees_with_inverse_kinematics(
        &WithTool {
            robot: Puma560,
            tool,
        },
        1.0,
    );
    agrees_with_inverse_kinematics(&Kr6R900, 1.1);
}

/// The sphere of a tool about the wrist's centre: outermost where all is
/// stretched, in the plane of the arm.
#[test]
fn tool_length_adds_to_the_reach() {
    let arm = Workspace::of(&Kr6R900).unwrap();
    // a1 = 25 mm, 455 mm, (35, 420) mm, tool 80 mm; the shoulder is 400 mm high.
    let outer = 0.025 + 0.455 + 0.035_f64.hypot(0.42);
    for (extra, reached) in [(0.08 - 1e-8, true), (0.08 + 1e-8, false)] {
        assert_eq!(arm.is_reachable([outer + extra, 0.0, 0.4]), reached);
        assert_eq!(arm.is_reachable([0.0, outer + extra, 0.4]), reached);
    }
    // Dextrous, the tool may point inwards with the centre farther out.
    for (less, reached) in [(0.08 + 1e-8, true), (0.08 - 1e-8, false)] {
        assert_eq!(arm.is_dextrous([outer - less, 0.0, 0.4]), reached);
    }
}

/// Arms without closed-form boundaries, by descending.
#[test]
fn other_arms_are_sampled() {
    let arm = Workspace::of(&Ur5e).unwrap();
    assert_eq!(arm.method(), WorkspaceMethod::Sampled);
    let mut random = Random::new(35);
    for _ in 0..20 {
        let q = std::array::from_fn(|_| random.angle());
        assert!(arm.is_reachable(Ur5e.fk(&q).translation));
    }
    assert!(!arm.is_reachable([1.2, 0.0, 0.1625]));
    assert!(arm.is_dextrous([0.4, 0.2, 0.3]));
    assert!(!arm.is_dextrous([0.9, 0.2, 0.2]));
    let slides = Workspace::of(&Stanford).unwrap();
    assert_eq!(slides.method(), WorkspaceMethod::Sampled);
    assert!(slides.is_reachable([0.4, 0.3, 0.9]));
}

/// The wrist of an arm without an offset may be on the first axis, and not anywhere on it.
#[test]
fn points_on_the_first_axis_are_as_far_as_others() {
    let random = &mut Random::new(0xa815);
    for tool in [0.0, 0.1] {
        for _ in 0..50 {
            let [x, y, z, roll, pitch, yaw] = random.unit_cube::<6>();
            let base = Pose::from_rpy([roll, pitch, yaw], [x, y, z]);
            let arm = Chain::new(
                [
                    ([0.0, 0.0, 1.0], [0.0; 3]),
                    ([0.0, 1.0, 0.0], [0.0, 0.0, 0.3]),
                    ([0.0, 1.0, 0.0], [0.5, 0.0, 0.3]),
                    ([1.0, 0.0, 0.0], [0.9, 0.0, 0.3]),
                    ([0.0, 1.0, 0.0], [0.9, 0.0, 0.3]),
                    ([1.0, 0.0, 0.0], [0.9, 0.0, 0.3]),
                ]
                .map(|(axis, point)| {
                    Twist::revolute(base.rotate(axis), base.transform_point(point))
                })
                .to_vec(),
                base * Pose::from_translation([0.9 + tool, 0.0, 0.3]),
            );
            let arm = Workspace::new(arm);
            assert_eq!(arm.method(), WorkspaceMethod::WristCentre);
            for (height, reached) in [(50.0, false), (-20.0, false), (1.1, true), (0.0, true)] {
                let point = base.transform_point([0.0, 0.0, height]);
                assert_eq!(arm.is_reachable(point), reached, "{height} {tool}");
                assert!(reached || !arm.is_dextrous(point), "{height} {tool}");
            }
        }
    }
}
