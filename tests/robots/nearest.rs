//! The one solution that a controller asks for, and why there is none.

use crate::measure::largest;
use crate::random::Random;
use crate::subject::Subject;
use kinematics::{JointLimit, Kinematics, Nearest, NoSolution, Pose, Robot};
use kinematics::{RobotOptions, RobotSource, Target};
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

for_every_robot!(the_nearest_is_that_of_all_solutions);
for_every_robot!(a_small_step_stays_near);
for_every_robot!(the_reason_for_none_is_true);

/// Limits that leave some solutions outside, weights, and bounds on steps.
fn choices<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    seed: [f64; N],
) -> [([JointLimit; N], Nearest<N>); 4] {
    let narrow = |i: usize| match robot.turns(i) {
        true => JointLimit::revolute(seed[i] - 2.0, seed[i] + 1.5),
        false => K::LIMITS[i],
    };
    let narrow = std::array::from_fn(narrow);
    let by_limits = Nearest::new(seed, &K::LIMITS);
    let (mut weighted, mut stepping) = (by_limits, by_limits);
    weighted.weights = std::array::from_fn(|i| (i % 3) as f64);
    stepping.step = std::array::from_fn(|i| 1.0 + i as f64);
    [
        (K::LIMITS, by_limits),
        (narrow, Nearest::new(seed, &narrow)),
        (K::LIMITS, weighted),
        (K::LIMITS, stepping),
    ]
}

/// Side by side and one by one, and at singular targets, too.
pub fn the_nearest_is_that_of_all_solutions<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    let seeds = robot.random(500).skip(200);
    let targets = robot.random(200).chain(robot.structured().take(100));
    let mut found = 0;
    for (q, seed) in targets.zip(seeds) {
        let target = robot.chain.fk(&q);
        for (_, nearest) in choices(robot, seed) {
            let expected = robot.arm.ik_seeded(&target, &seed).nearest_by(&nearest);
            let solution = robot.arm.ik_nearest_by(&target, &nearest);
            assert_eq!(solution, expected, "{target:?}, {nearest:?}");
            found += usize::from(solution.is_some());
        }
        let solution = robot.arm.ik_nearest(&target, &seed);
        assert_eq!(
            solution,
            robot
                .arm
                .ik_seeded(&target, &seed)
                .nearest(&seed, &K::LIMITS)
        );
    }
    assert!(found > 200, "{found} solutions tell nothing");
}

pub fn a_small_step_stays_near<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let between = |i: usize, q: f64| q.clamp(K::LIMITS[i].lower(), K::LIMITS[i].upper());
    for q in robot.random(200) {
        let q: [f64; N] = std::array::from_fn(|i| between(i, q[i]));
        if robot.conditioning(&q) < 1e-2 {
            continue;
        }
        let moved = q.map(|x| x - 1e-6 * x.signum());
        let next = robot.arm.ik_nearest(&robot.chain.fk(&moved), &q).unwrap();
        let apart = largest((0..N).map(|i| next.q[i] - moved[i]));
        assert!(apart < 1e-7, "{next:?} for {moved:?}");
    }
}

pub fn the_reason_for_none_is_true<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let seeds = robot.random(200).skip(100);
    for (q, seed) in robot.random(100).zip(seeds) {
        let target = robot.chain.fk(&q);
        for (limits, nearest) in choices(robot, seed) {
            is_true(robot, &target, &limits, &nearest);
        }
        // Limits and steps that no solution meets.
        let limits = K::LIMITS.map(|limit| match limit {
            JointLimit::Prismatic { .. } => JointLimit::prismatic(80.0, 90.0),
            _ => JointLimit::revolute(seed[0] + 0.1, seed[0] + 0.1001),
        });
        is_true(robot, &target, &limits, &Nearest::new(seed, &limits));
        let mut at_once = Nearest::new(seed, &K::LIMITS);
        at_once.step = [1e-9; N];
        is_true(robot, &target, &K::LIMITS, &at_once);
    }
    let home = robot.chain.fk(&[0.1; N]);
    let nearest = Nearest::new([0.0; N], &K::LIMITS);
    let far = Pose {
        translation: [100.0 * robot.size; 3],
        ..home
    };
    if robot.arm.ik(&far).is_empty() {
        let reason = robot.arm.try_ik_nearest(&far, &nearest).unwrap_err();
        let NoSolution::OutOfReach { approximate } = reason else {
            panic!("{reason:?}");
        };
        assert_eq!(approximate, robot.arm.ik_approximate(&far));
    }
    let no_number = Pose {
        translation: [f64::NAN; 3],
        rotation: [[f64::NAN; 3]; 3],
    };
    let reason = robot.arm.try_ik_nearest(&no_number, &nearest);
    assert_eq!(reason, Err(NoSolution::NotFinite));
    let sheared = Pose {
        rotation: home.rotation.map(|row| row.map(|x| 1.1 * x)),
        ..home
    };
    if robot.arm.ik(&sheared).is_empty() {
        let reason = robot.arm.try_ik_nearest(&sheared, &nearest).unwrap_err();
        let NoSolution::NotRotation { error } = reason else {
            panic!("{reason:?}");
        };
        assert!((0.09..0.5).contains(&error), "{error}");
    }
}

/// Every solution is as far outside, or takes as long a step, as is said.
fn is_true<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    target: &Pose,
    limits: &[JointLimit; N],
    nearest: &Nearest<N>,
) {
    let Err(reason) = robot.arm.try_ik_nearest(target, nearest) else {
        return;
    };
    let all = robot.arm.ik_seeded(target, &nearest.seed);
    let inside = all.within_limits(limits);
    match reason {
        NoSolution::OutsideLimits {
            solution,
            joint,
            by,
        } => {
            assert!(inside.is_empty() && by > 0.0, "{reason:?}");
            assert!(all.contains(&solution), "{reason:?}");
            let mut wider = *limits;
            for (i, limit) in wider.iter_mut().enumerate() {
                *limit = widened(*limit, 1.000_001 * by, robot.turns(i));
            }
            assert!(!all.within_limits(&wider).is_empty(), "{reason:?}");
            let less = 0.999_999 * by - 2.0 * JointLimit::TOLERANCE;
            wider[joint] = widened(limits[joint], less, robot.turns(joint));
            let own = all.iter().filter(|s| **s == solution);
            let mut only = kinematics::Solutions::new();
            own.for_each(|s| only.push(*s));
            assert!(only.within_limits(&wider).is_empty(), "{reason:?}");
        }
        NoSolution::BeyondStep {
            solution,
            joint,
            by,
        } => {
            assert!(!inside.is_empty() && by > 0.0, "{reason:?}");
            assert!(all.contains(&solution), "{reason:?}");
            let mut longer = *nearest;
            longer.step = nearest.step.map(|step| step + 1.000_001 * by);
            assert!(
                robot.arm.ik_nearest_by(target, &longer).is_some(),
                "{reason:?}"
            );
            assert!(joint < N, "{reason:?}");
        }
        _ => assert!(all.is_empty(), "{reason:?}"),
    }
}

fn widened(limit: JointLimit, by: f64, turns: bool) -> JointLimit {
    let (lower, upper) = (limit.lower() - by, limit.upper() + by);
    match turns {
        true => JointLimit::revolute(lower, upper),
        false => JointLimit::prismatic(lower, upper),
    }
}

/// A joint without a seed takes no part, and what a singular target leaves free of it is at 0.
#[test]
fn a_seed_that_is_no_number_loses_no_solution() {
    let arm = crate::zoo::Kr6R900;
    let q = [0.3, -1.0, 1.2, 0.4, 0.0, -0.3];
    let target = arm.fk(&q);
    for (joint, nothing) in (0..6).flat_map(|i| [f64::NAN, f64::INFINITY].map(|x| (i, x))) {
        let mut seed = q;
        seed[joint] = nothing;
        assert_eq!(arm.ik_seeded(&target, &seed).len(), arm.ik(&target).len());
        let nearest =
            arm.try_ik_nearest(&target, &Nearest::new(seed, &crate::zoo::Kr6R900::LIMITS));
        let found = nearest.unwrap().q;
        assert!((0..3).all(|i| (found[i] - q[i]).abs() < 1e-9), "{found:?}");
    }
}

/// Nor one that moves where a free joint at its seed leaves a later step no root.
#[test]
fn a_free_joint_without_a_seed_turns_too() {
    let arm = crate::zoo::Ur5e;
    let q = [-2.581468, 2.695962, 0.155972, -2.483665, 0.0, 0.979362];
    let target = arm.fk(&q);
    let all = arm.ik(&target).len();
    assert!(all > 0);
    for joint in 0..6 {
        let mut seed = q;
        seed[joint] = f64::NAN;
        assert!(arm.ik_seeded(&target, &seed).len() >= all, "{joint}");
    }
}

/// Nor is an arm in the plane of its rail lost, or next to that plane, where it does not reach from the
/// middle of the rail.
#[test]
fn a_free_slide_moves_to_where_the_arm_reaches() {
    let arm: Robot = include_str!("along_rail.yaml").parse().unwrap();
    let mut random = Random::new(0x51de);
    for off in [0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4] {
        for _ in 0..100 {
            let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-2.0, 2.0));
            q[1] = off
                + if random.between(0.0, 1.0) < 0.5 {
                    0.0
                } else {
                    PI
                };
            let target = arm.fk(&q);
            let solutions = arm.ik(&target);
            assert!(!solutions.is_empty(), "off by {off:e}: {q:?}");
            for solution in solutions.iter() {
                let reached = arm.fk(solution.q);
                // A billionth of the arm's size.
                assert!(reached.translation_distance(&target) < 1.7e-9, "{q:?}");
                assert!(reached.rotation_distance(&target) < 1e-9, "{q:?}");
            }
        }
    }
}

/// Holding a pose, from seeds that are off by as much; no joint moves by more than the root of that, as
/// where two solutions meet.
fn is_held(robot: &Robot, file: &str, home: [f64; 6], seeds: u64) {
    let target = robot.fk(&home);
    let mut random = Random::new(11);
    for k in 0..seeds {
        let off = 10_f64.powi(-12 + (k % 10) as i32);
        let seed = home.map(|q| q + random.between(-off, off));
        let found = robot.ik_nearest(&target, &seed).unwrap();
        let moved = found.q.iter().zip(&seed).map(|(q, seed)| (q - seed).abs());
        let moved = moved.fold(0.0, f64::max);
        assert!(
            moved < 10.0 * off.sqrt() + 1e-6,
            "{file}, {home:?}: {moved:e} from {seed:?}"
        );
    }
}

/// Holding a pose in which the arm is stretched and its wrist aligned: a joint that is free there
/// stays next to where the seed has it, though beside the target's own value the elbow may have no
/// root. Where it has one, the elbow bends by the root of what the seed is off.
#[test]
fn at_rest_where_arm_and_wrist_are_stretched_no_elbow_jumps() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (file, home) in [
        ("robots/ur5e.urdf", [0.3, 0.0, 0.0, 0.0, 0.0, 0.4]),
        ("robots/ur5e.urdf", [0.0; 6]),
        (
            "robots/ur5e.urdf",
            [-1.0, -FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0],
        ),
        ("robots/ur10e.yaml", [0.3, 0.7, 0.0, -0.2, 0.0, 0.4]),
        // Straight but for rounding, and for what the steps before leave of it.
        ("robots/ur5e.urdf", [0.3, -1.2, 1.5, -0.7, 1e-12, 0.4]),
        ("robots/kr6_r900.yaml", [0.3, -1.2, 1.5, -0.7, 5e-12, 0.4]),
    ] {
        let robot = match file.ends_with("urdf") {
            true => Robot::from_urdf(folder.join(file)),
            false => Robot::from_yaml(folder.join(file)),
        };
        is_held(&robot.unwrap(), file, home, 400);
    }
}

/// Where the Jacobian loses two ranks at once, Newton's steps lead away from a solution next to them.
#[test]
fn at_rest_where_axes_line_up_twice_no_joint_jumps() {
    let file = "tests/robots/crx10ial.yaml";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let robot = Robot::from_yaml(folder.join(file)).unwrap();
    for home in [
        [FRAC_PI_2, 0.0, FRAC_PI_2, 0.0, FRAC_PI_2, PI],
        [0.0, 0.0, FRAC_PI_2, PI, FRAC_PI_2, 0.0],
        [0.0; 6],
    ] {
        is_held(&robot, file, home, 100);
    }
}

/// An elbow next to where it is stretched is known to rounding over how far it is off, and where its two
/// branches are taken for one to the root of rounding: what that leaves of a straight wrist tells no
/// angle of joints 4 and 6.
#[test]
fn a_straight_wrist_rests_while_the_elbow_is_nearly_stretched() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut random = Random::new(31);
    for (file, stretched) in [
        ("robots/tx60.yaml", 0.0),
        ("robots/puma560.yaml", 1.617_633_439_908_15),
        ("robots/irb6640.yaml", -1.397_497_581_786_31),
    ] {
        let robot = Robot::from_yaml(folder.join(file)).unwrap();
        for k in 0..1300 {
            let off = 10_f64.powi(-1 - k % 13) * random.between(1.0, 2.0);
            let side = [1.0, -1.0][random.below(2)];
            let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-1.0, 1.0));
            q[2] = stretched + side * off;
            q[4] = [0.0, 1e-12, -1e-13][k as usize % 3];
            let inside = q.iter().zip(robot.limits());
            if !inside
                .clone()
                .all(|(q, it)| (it.lower()..it.upper()).contains(q))
            {
                continue;
            }
            let nearest = robot.ik_nearest(&robot.fk(&q), &q).unwrap();
            let moved = nearest.q.iter().zip(&q).map(|(a, b)| (a - b).abs());
            let moved = moved.fold(0.0, f64::max);
            assert!(moved < 1e-8, "{file}: {moved} from {q:?}");
        }
    }
}

/// With the elbow straight and the wrist aligned, what tells the shoulder's angles is shorter than the
/// rounding of what is before it.
#[test]
fn beside_two_singularities_it_rests() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let robot = Robot::from_urdf(folder.join("robots/ur5e.urdf")).unwrap();
    let mut random = Random::new(53);
    for k in 0..1400 {
        let off = 10_f64.powi(-7 - k % 7);
        let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        q[2] = off * random.between(-1.0, 1.0);
        q[4] = off * random.between(-1.0, 1.0);
        let target = robot.fk(&q);
        let generated = crate::zoo::Ur5e.ik_nearest(&target, &q).unwrap();
        let at_run_time = robot.ik_nearest(&target, &q).unwrap();
        for nearest in [&generated.q[..], &at_run_time.q] {
            let moved = largest(nearest.iter().zip(&q).map(|(a, b)| a - b));
            assert!(moved < 1e-6, "{moved} from {q:?}");
        }
    }
}

/// The elbow is folded next to its limit of half a turn: what rounding does not tell from the seed is
/// on the other side of it, with no other turn inside the limits.
#[test]
fn folded_next_to_a_limit_it_rests() {
    let robot = crate::zoo::Ur5e;
    let mut limits = crate::zoo::Ur5e::LIMITS;
    limits[2] = JointLimit::revolute(-PI, PI);
    let mut random = Random::new(54);
    for k in 0..4000 {
        let off = 10_f64.powi(-6 - k % 7);
        let mut q: [f64; 6] =
            std::array::from_fn(|_| random.between(-2.0, 3.0).floor() * FRAC_PI_2);
        q[2] = PI - off;
        q[4] = 0.0;
        for q in &mut q {
            *q += off * random.between(-1.0, 1.0);
        }
        let target = robot.fk(&q);
        let nearest = robot
            .ik_nearest_by(&target, &Nearest::new(q, &limits))
            .unwrap();
        let moved = largest(nearest.q.iter().zip(&q).map(|(a, b)| a - b));
        assert!(moved < 1e-4, "{moved} from {q:?}");
    }
}

fn read(text: &str, target: Target) -> Robot {
    let source = RobotSource {
        path: "arm.yaml".into(),
        text: text.into(),
    };
    let options = RobotOptions {
        target: Some(target),
        ..RobotOptions::default()
    };
    Robot::load(&source, &options).unwrap()
}

/// A mill whose tool is along the axis of its table where the head is upright, and there another turn of
/// the table in sum with that of the tool, which no target tells, is as good.
#[test]
fn where_the_tool_is_along_a_joint_it_rests() {
    let mill = "
robot: mill
units: {angle: deg, length: mm}
screws:
  - {name: c, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: x, axis: [1, 0, 0], type: prismatic}
  - {name: y, axis: [0, 1, 0], type: prismatic}
  - {name: z, axis: [0, 0, 1], type: prismatic}
  - {name: b, axis: [0, 1, 0], point: [0, 0, 500]}
home: {xyz: [0, 0, 300], rpy: [180, 0, 0]}
";
    let robot = read(mill, Target::PositionAxis);
    let mut random = Random::new(37);
    for k in 0..600 {
        let mut q: [f64; 5] = std::array::from_fn(|_| random.between(-0.5, 0.5));
        q[0] = random.angle();
        q[4] = [0.0, PI, 1e-12, -1e-9, 1e-6, 0.3][k % 6];
        let target = robot.fk(&q);
        let nearest = robot.ik_nearest(&target, &q).unwrap();
        let moved = largest(nearest.q.iter().zip(&q).map(|(a, b)| a - b));
        assert!(moved < 1e-8, "{moved} from {q:?}");
        let rests = |it: &[f64]| it.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-8);
        let seeded = robot.ik_seeded(&target, &q);
        assert!(seeded.iter().any(|it| rests(it.q)), "{q:?}");
    }
}

/// A turning arm on a rail that it reaches along: what one slides the other may slide back.
#[test]
fn slides_that_are_parallel_rest() {
    let arm = "
robot: rail_cylindrical
units: {angle: deg, length: mm}
screws:
  - {name: rail, axis: [1, 0, 0], type: prismatic}
  - {name: turn, axis: [0, 0, 1], point: [0, 0, 0]}
  - {name: reach, axis: [0, -1, 0], type: prismatic}
  - {name: lift, axis: [0, 0, 1], type: prismatic}
home: {xyz: [100, -300, 0], rpy: [180, 0, 0]}
";
    for text in [
        arm,
        &arm.replace(
            "name: lift, axis: [0, 0, 1]",
            "name: lift, axis: [0, 0.6, 0.8]",
        ),
    ] {
        let robot = read(text, Target::Pose);
        let mut random = Random::new(41);
        for k in 0..400 {
            let mut q: [f64; 4] = std::array::from_fn(|_| random.between(-0.5, 0.5));
            q[1] = [FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2 - 1e-12, 0.4][k % 4];
            let target = robot.fk(&q);
            let nearest = robot.ik_nearest(&target, &q).unwrap();
            let moved = largest(nearest.q.iter().zip(&q).map(|(a, b)| a - b));
            assert!(moved < 1e-8, "{moved} from {q:?}");
            // From elsewhere as well it is reached, and by slides no longer than the arm.
            let other = robot.ik(&target);
            let slides = |it: &[f64]| largest([it[0], it[2], it[3]]);
            assert!(other.iter().any(|it| slides(it.q) < 3.0), "{q:?}");
            assert!(robot.ik_approximate(&target).is_some(), "{q:?}");
        }
    }
}
