//! The same robots read while the program runs: what generated code computes, to the last bit.

use crate::cached::cached;
use crate::random::Random;
use crate::subject::Subject;
use crate::zoo::EXACT;
use kinematics::{Kinematics, Nearest, Pose, Posture, Robot, RobotOptions, Twist, Wrench};
use std::mem::discriminant;

for_every_robot!(forward_kinematics_is_the_same);
for_every_robot!(solutions_are_the_same);
for_every_robot!(the_rest_is_the_same);
for_every_robot!(batches_are_single_calls);

mod noisy {
    use super::*;
    for_every_noisy_robot!(forward_kinematics_is_the_same);
    for_every_noisy_robot!(solutions_are_the_same);
    for_every_noisy_robot!(the_rest_is_the_same);
    for_every_noisy_robot!(batches_are_single_calls);
}

mod table {
    use super::*;
    for_every_table_row!(forward_kinematics_is_the_same);
    for_every_table_row!(solutions_are_the_same);
    for_every_table_row!(the_rest_is_the_same);
    for_every_table_row!(batches_are_single_calls);
}

mod targets {
    use super::*;
    for_every_aimed_robot!(forward_kinematics_is_the_same);
    for_every_aimed_robot!(solutions_are_the_same);
    for_every_aimed_robot!(the_rest_is_the_same);
}

/// Of a few dozen operations.
const ROUNDING: f64 = 1e-14;

fn loaded<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) -> Robot {
    let options = RobotOptions {
        target: Some(robot.counts),
        ..RobotOptions::default()
    };
    cached(robot.path, &options)
}

fn entries(pose: &Pose) -> Vec<f64> {
    let rotation = pose.rotation.iter().flatten();
    rotation.chain(&pose.translation).copied().collect()
}

fn of_columns(columns: &[Twist]) -> Vec<f64> {
    columns.iter().flat_map(|it| it.to_array()).collect()
}

pub fn forward_kinematics_is_the_same<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let (arm, loaded) = (&robot.arm, loaded(robot));
    assert_eq!(loaded.joint_names(), K::JOINT_NAMES);
    assert_eq!(loaded.link_names(), K::LINK_NAMES);
    assert_eq!((loaded.base(), loaded.tip()), (K::BASE, K::TIP));
    assert_eq!(loaded.limits(), K::LIMITS);
    assert_eq!(loaded.velocity_limits(), K::VELOCITY_LIMITS);
    assert_eq!(loaded.effort_limits(), K::EFFORT_LIMITS);
    assert_eq!(
        (loaded.target(), loaded.branches()),
        (K::TARGET, K::BRANCHES)
    );
    for q in robot.random(20).chain(robot.structured()) {
        assert_eq!(entries(&loaded.fk(&q)), entries(&arm.fk(&q)), "{q:?}");
        let links = arm.fk_links(&q).map(|pose| entries(&pose));
        let there: Vec<_> = loaded.fk_links(&q).iter().map(entries).collect();
        assert_eq!(there, links, "{q:?}");
        let (pose, spatial) = loaded.fk_jacobian(&q);
        assert_eq!(pose, arm.fk_jacobian(&q).0, "{q:?}");
        for (columns, jacobian) in [
            (spatial, arm.fk_jacobian(&q).1),
            (loaded.spatial_jacobian(&q), arm.spatial_jacobian(&q)),
            (loaded.body_jacobian(&q), arm.body_jacobian(&q)),
            (loaded.geometric_jacobian(&q), arm.geometric_jacobian(&q)),
        ] {
            assert_eq!(
                of_columns(&columns),
                of_columns(&jacobian.columns()),
                "{q:?}"
            );
        }
        for frame in K::FRAMES {
            let (a, b) = (
                loaded.fk_frame(&q, frame.name).unwrap(),
                arm.fk_frame(&q, frame),
            );
            let apart = a.translation_distance(&b) + a.rotation_distance(&b);
            assert!(apart < 1e-12, "{apart} of {}", frame.name);
        }
        let determinants = [
            loaded.jacobian_determinant(&q),
            arm.jacobian_determinant(&q),
        ];
        if let [Some(a), Some(b)] = determinants {
            assert!(
                (a - b).abs() < 1e-12 * robot.size.powi(3).max(1.0),
                "{a} {b}"
            );
        }
        let values = loaded.singularities(&q);
        assert_eq!(values.len(), arm.singularities(&q).len());
        for ((name, value), known) in values.into_iter().zip(arm.singularities(&q).iter()) {
            assert_eq!((name, value), (known.name, known.value));
        }
    }
}

/// What is made of Jacobians, postures, and what comes nearest.
pub fn the_rest_is_the_same<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let (arm, loaded) = (&robot.arm, loaded(robot));
    let mut random = Random::new(29);
    for q in robot.random(6).chain(robot.structured().take(8)) {
        let rates: [f64; N] = random.unit_cube();
        let wrench = Wrench::from_array(random.unit_cube());
        for (there, here) in [
            (
                loaded.jacobian_dot(&q, &rates),
                arm.jacobian_dot(&q, &rates),
            ),
            (
                loaded.body_jacobian_dot(&q, &rates),
                arm.body_jacobian_dot(&q, &rates),
            ),
            (
                loaded.geometric_jacobian_dot(&q, &rates),
                arm.geometric_jacobian_dot(&q, &rates),
            ),
        ] {
            assert_eq!(there, here.columns(), "{q:?}");
        }
        for (there, here) in [
            (loaded.hessian(&q), arm.hessian(&q)),
            (loaded.body_hessian(&q), arm.body_hessian(&q)),
            (loaded.geometric_hessian(&q), arm.geometric_hessian(&q)),
        ] {
            assert_eq!(
                there,
                here.derivatives.map(|it| it.columns().to_vec()),
                "{q:?}"
            );
        }
        for (there, here) in [
            (
                loaded.spatial_velocity(&q, &rates),
                arm.spatial_velocity(&q, &rates),
            ),
            (
                loaded.body_velocity(&q, &rates),
                arm.body_velocity(&q, &rates),
            ),
            (
                loaded.geometric_velocity(&q, &rates),
                arm.geometric_velocity(&q, &rates),
            ),
        ] {
            assert_eq!(there, here, "{q:?}");
        }
        for (there, here) in [
            (
                loaded.spatial_torques(&q, &wrench),
                arm.spatial_torques(&q, &wrench),
            ),
            (
                loaded.body_torques(&q, &wrench),
                arm.body_torques(&q, &wrench),
            ),
            (
                loaded.geometric_torques(&q, &wrench),
                arm.geometric_torques(&q, &wrench),
            ),
            (
                loaded.manipulability_gradient(&q),
                arm.manipulability_gradient(&q),
            ),
            (
                loaded.translational_manipulability_gradient(&q),
                arm.translational_manipulability_gradient(&q),
            ),
            (
                loaded.rotational_manipulability_gradient(&q),
                arm.rotational_manipulability_gradient(&q),
            ),
            (
                loaded.null_space_projection(&q, &rates),
                arm.null_space_projection(&q, &rates),
            ),
        ] {
            assert_eq!(there, here, "{q:?}");
        }
        assert_eq!(loaded.manipulability(&q), arm.manipulability(&q));
        assert_eq!(
            loaded.translational_manipulability(&q),
            arm.translational_manipulability(&q)
        );
        assert_eq!(
            loaded.rotational_manipulability(&q),
            arm.rotational_manipulability(&q)
        );
        assert_eq!(
            loaded.structural_wrenches(&q)[..],
            arm.structural_wrenches(&q)[..]
        );
        let internal = arm.internal_motions(&q);
        assert_eq!(
            loaded.internal_motions(&q),
            internal.iter().collect::<Vec<_>>()
        );
        let told = |posture: Posture| posture.to_string();
        let there = loaded.posture(&q).map(ToString::to_string);
        assert_eq!(there, arm.posture(&q).map(told), "{q:?}");
        approximates_alike(robot, &loaded, &q);
    }
    let postures: Vec<String> = loaded.postures().iter().map(ToString::to_string).collect();
    assert_eq!(
        postures,
        K::POSTURES
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
    );
}

/// Of a target in reach, one out of it, and one that is no number.
fn approximates_alike<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    loaded: &Robot,
    q: &[f64; N],
) {
    let arm = &robot.arm;
    let there = arm.fk(q);
    let scaled = |x: f64| Pose {
        translation: there.translation.map(|t| x * (t + 0.1 * robot.size)),
        ..there
    };
    for target in [there, scaled(1.1), scaled(5.0), scaled(f64::NAN)] {
        let limits = std::array::from_fn(|i| loaded.limits()[i]);
        let mut nearest = Nearest::new(*q, &limits);
        nearest.step = [0.3; N];
        let [there, here] = [
            loaded.try_ik_nearest(&target, &nearest),
            arm.try_ik_nearest(&target, &nearest),
        ];
        assert_eq!(
            discriminant(&there),
            discriminant(&here),
            "{there:?} {here:?}"
        );
        if let (Err(there), Err(here)) = (there, here) {
            assert_eq!(
                discriminant(&there),
                discriminant(&here),
                "{there:?} {here:?}"
            );
        }
        assert_eq!(
            loaded.is_reachable_pose(&target),
            arm.is_reachable_pose(&target)
        );
        let [there, here] = [
            loaded.ik_approximate(&target).map(|it| (it.q, it.residual)),
            arm.ik_approximate(&target)
                .map(|it| (it.q.to_vec(), it.residual)),
        ];
        assert_eq!(there.is_some(), here.is_some());
        if let (Some(there), Some(here)) = (there, here) {
            assert!(
                (there.1 - here.1).abs() < 1e-9 * robot.size,
                "{there:?} {here:?} of {q:?}"
            );
            if EXACT.contains(&robot.path) && here.1 > 1e-6 * robot.size {
                assert_eq!(there, here, "{q:?}");
            }
        }
    }
}

/// Many at once, of every number of leftovers.
pub fn batches_are_single_calls<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let loaded = loaded(robot);
    let all: Vec<[f64; N]> = robot
        .random(13)
        .chain(robot.structured().take(32))
        .collect();
    for count in [0, 1, 7, 8, 9, all.len()] {
        let (some, flat) = (&all[..count], all[..count].concat());
        let poses = loaded.fk_batch(&flat);
        assert_eq!(poses, some.iter().map(|q| loaded.fk(q)).collect::<Vec<_>>());
        let both = loaded.fk_jacobian_batch(&flat);
        assert_eq!(
            both,
            some.iter()
                .map(|q| loaded.fk_jacobian(q))
                .collect::<Vec<_>>()
        );
        let answers = loaded.ik_batch(&poses);
        assert_eq!(
            answers,
            poses.iter().map(|pose| loaded.ik(pose)).collect::<Vec<_>>()
        );
    }
}

pub fn solutions_are_the_same<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let loaded = loaded(robot);
    let mut compared = 0;
    for q in robot.random(40).chain(robot.structured()) {
        let target = robot.arm.fk(&q);
        let (there, here) = (loaded.ik(&target), robot.arm.ik(&target));
        assert_eq!(there.len(), here.len(), "{q:?}: {there:#?}, {here:#?}");
        for (there, here) in there.iter().zip(&here) {
            // Only what is refined or corrected goes through other operations of forward
            // kinematics, whose rounding a singular target magnifies.
            let apart = robot.apart(there.q, &here.q);
            let conditioning = robot.conditioning(&here.q).max(1e-12);
            let tolerance = if EXACT.contains(&robot.path) && !here.singular {
                0.0
            } else {
                ROUNDING / conditioning
            };
            assert!(apart <= tolerance, "{apart} of {q:?}");
            assert_eq!((there.branch, there.singular), (here.branch, here.singular));
            compared += 1;
        }
        let (there, here) = (
            loaded.ik_seeded(&target, &q),
            robot.arm.ik_seeded(&target, &q),
        );
        assert_eq!(there.len(), here.len(), "seeded at {q:?}");
        if EXACT.contains(&robot.path) {
            for (there, here) in there.iter().zip(&here).filter(|(_, here)| !here.singular) {
                assert_eq!(there.q, here.q);
            }
        }
        // A joint without a seed is at 0 where the target leaves it free.
        let mut partly = q;
        partly[compared % N] = f64::NAN;
        let (there, here) = (
            loaded.ik_seeded(&target, &partly),
            robot.arm.ik_seeded(&target, &partly),
        );
        assert_eq!(there.len(), here.len(), "seeded at {partly:?}");
        let (there, here) = (
            loaded.ik_nearest(&target, &q),
            robot.arm.ik_nearest(&target, &q),
        );
        assert_eq!(there.is_some(), here.is_some());
        if let (Some(there), Some(here)) = (there, here) {
            let apart = robot.apart(&there.q, &here.q);
            let conditioning = robot.conditioning(&here.q).max(1e-12);
            assert!(apart <= ROUNDING / conditioning, "{apart} of {q:?}");
        }
    }
    assert!(compared > 40, "{compared}");
}
