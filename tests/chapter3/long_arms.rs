//! The same of arms of more joints than have inverse kinematics, which are read at run time:
//! snakes, and arms without structure.

use super::differences::{DIFFERENCES, assert_close, derivative, spatial_velocity};
use super::random::Random;
use kinematics::{Ik, Pose, Robot, RobotOptions, RobotSource, Twist, Wrench};
use nalgebra::DMatrix;
use std::fmt::Write;
use std::sync::LazyLock;

const ROUNDING: f64 = 1e-12;

fn loaded(text: String) -> Result<Robot, kinematics::LoadError> {
    loaded_with(text, Ik::None)
}

fn loaded_with(text: String, ik: Ik) -> Result<Robot, kinematics::LoadError> {
    let options = RobotOptions {
        ik,
        ..RobotOptions::default()
    };
    let path = "long.yaml".into();
    Robot::load(&RobotSource { path, text }, &options)
}

const HEAD: &str = "robot: long\nunits: {angle: rad, length: m}\njoints:\n";

/// Joints that turn about z and y by turns.
fn snake(joints: usize) -> String {
    (0..joints).fold(HEAD.to_owned(), |mut text, i| {
        let axis = [[0, 0, 1], [0, 1, 0]][i % 2];
        writeln!(text, "  - {{name: j{i}, xyz: [0.1, 0, 0], axis: {axis:?}}}").unwrap();
        text
    })
}

/// Every fourth joint slides; of a coupled one every fifth mimics the joint before.
fn general(joints: usize, is_coupled: bool) -> String {
    let mut random = Random::new(joints as u64);
    let (mut text, mut row, mut own) = (HEAD.to_owned(), 0, 0);
    while own < joints {
        let [xyz, rpy, axis]: [[f64; 3]; 3] = std::array::from_fn(|_| random.unit_cube());
        let xyz = xyz.map(|x| 0.2 * x);
        let more = match (is_coupled && row % 5 == 4, row % 4) {
            (true, _) => format!(
                "mimic: {{joint: j{}, multiplier: -0.5, offset: 0.2}}",
                row - 1
            ),
            (false, 2) => "type: prismatic".into(),
            (false, _) => "type: revolute".into(),
        };
        own += usize::from(!more.starts_with("mimic"));
        let place = format!("xyz: {xyz:?}, rpy: {rpy:?}, axis: {axis:?}");
        writeln!(text, "  - {{name: j{row}, {place}, {more}}}").unwrap();
        row += 1;
    }
    text
}

/// Of numbers of joints on both sides of those at which the code changes.
fn all() -> &'static [Robot] {
    static ALL: LazyLock<Vec<Robot>> = LazyLock::new(|| {
        let snakes = [9, 17, 64].map(snake);
        let others = [8, 16, 40].map(|joints| general(joints, false));
        let coupled = [5, 12].map(|joints| general(joints, true));
        let texts = snakes.into_iter().chain(others).chain(coupled);
        texts.map(|text| loaded(text).unwrap()).collect()
    });
    &ALL
}

fn values(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.between(-1.0, 1.0)).collect()
}

fn along(q: &[f64], rates: &[f64], t: f64) -> Vec<f64> {
    q.iter().zip(rates).map(|(q, rate)| q + t * rate).collect()
}

fn flat(columns: &[Twist]) -> Vec<f64> {
    columns.iter().flat_map(|it| it.to_array()).collect()
}

/// The derivative of a vector whose length is known when the program runs.
fn derivatives(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let entry = |i: usize| derivative(|t| [f(t)[i]])[0];
    (0..f(0.0).len()).map(entry).collect()
}

fn matrix(columns: &[Twist]) -> DMatrix<f64> {
    DMatrix::from_iterator(6, columns.len(), flat(columns))
}

fn sum(columns: &[Twist], rates: &[f64]) -> Vec<f64> {
    let product = matrix(columns) * DMatrix::from_column_slice(rates.len(), 1, rates);
    product.as_slice().to_vec()
}

#[track_caller]
fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!(
            (a - b).abs() <= tolerance,
            "{a} {b} of {found:?} {expected:?}"
        );
    }
}

#[test]
fn poses_are_those_of_the_product_of_exponentials() {
    let mut random = Random::new(1);
    for arm in all() {
        let q = values(&mut random, arm.joints());
        let apart = |a: Pose, b: Pose| a.translation_distance(&b) + a.rotation_distance(&b);
        // Of a coupled arm that has other joints.
        let chain = arm.chain();
        if chain.twists().len() == q.len() {
            assert!(apart(arm.fk(&q), chain.fk(&q)) < ROUNDING);
            close(
                &flat(&arm.geometric_jacobian(&q)),
                &flat(&chain.geometric_jacobian(&q)),
                ROUNDING,
            );
        }
        assert!(apart(arm.fk(&q), *arm.fk_links(&q).last().unwrap()) < 1.0);
        assert_eq!(arm.fk_batch(&[&q[..], &q].concat()), [arm.fk(&q); 2]);
    }
}

#[test]
fn velocities_and_torques() {
    let mut random = Random::new(2);
    for arm in all() {
        let n = arm.joints();
        let (q, rates) = (values(&mut random, n), values(&mut random, n));
        let expected = spatial_velocity(|t| arm.fk(&along(&q, &rates, t)));
        let found = arm.spatial_velocity(&q, &rates);
        assert_close(found.to_array(), expected.to_array(), 10.0 * DIFFERENCES);
        let wrench = Wrench::from_array(random.unit_cube());
        for (jacobian, velocity, torques) in [
            (
                arm.spatial_jacobian(&q),
                found,
                arm.spatial_torques(&q, &wrench),
            ),
            (
                arm.body_jacobian(&q),
                arm.body_velocity(&q, &rates),
                arm.body_torques(&q, &wrench),
            ),
            (
                arm.geometric_jacobian(&q),
                arm.geometric_velocity(&q, &rates),
                arm.geometric_torques(&q, &wrench),
            ),
        ] {
            close(&velocity.to_array(), &sum(&jacobian, &rates), ROUNDING);
            let power: Vec<f64> = jacobian.iter().map(|it| wrench.power(it)).collect();
            close(&torques, &power, ROUNDING);
        }
    }
}

#[test]
fn derivatives_of_the_jacobians() {
    type Columns = fn(&Robot, &[f64]) -> Vec<Twist>;
    type Dot = fn(&Robot, &[f64], &[f64]) -> Vec<Twist>;
    type ByJoint = fn(&Robot, &[f64]) -> Vec<Vec<Twist>>;
    let kinds: [(Columns, Dot, ByJoint); 3] = [
        (Robot::spatial_jacobian, Robot::jacobian_dot, Robot::hessian),
        (
            Robot::body_jacobian,
            Robot::body_jacobian_dot,
            Robot::body_hessian,
        ),
        (
            Robot::geometric_jacobian,
            Robot::geometric_jacobian_dot,
            Robot::geometric_hessian,
        ),
    ];
    let mut random = Random::new(3);
    for arm in all().iter().filter(|arm| arm.joints() < 20) {
        let n = arm.joints();
        let (q, rates) = (values(&mut random, n), values(&mut random, n));
        for (jacobian, dot, by_joint) in kinds {
            let found = flat(&dot(arm, &q, &rates));
            let expected = derivatives(|t| flat(&jacobian(arm, &along(&q, &rates, t))));
            close(&found, &expected, 1e-7);
            let slices = by_joint(arm, &q);
            assert_eq!(slices.len(), n);
            let rows: Vec<f64> = slices.iter().flat_map(|it| flat(it)).collect();
            let sums = DMatrix::from_vec(6 * n, n, rows) * DMatrix::from_column_slice(n, 1, &rates);
            close(sums.as_slice(), &found, 1e-10);
        }
    }
}

/// On a stack of a megabyte, of which the derivatives of 64 joints take a fifth.
#[test]
fn derivatives_of_many_joints_fit_on_a_stack() {
    let run = || {
        let mut random = Random::new(4);
        for arm in all().iter().filter(|arm| arm.joints() >= 40) {
            let n = arm.joints();
            let q = values(&mut random, n);
            for (by_joint, dot) in [
                (arm.hessian(&q), Robot::jacobian_dot as fn(&_, &_, &_) -> _),
                (arm.body_hessian(&q), Robot::body_jacobian_dot),
                (arm.geometric_hessian(&q), Robot::geometric_jacobian_dot),
            ] {
                let mut unit = vec![0.0; n];
                unit[n / 2] = 1.0;
                close(&flat(&by_joint[n / 2]), &flat(&dot(arm, &q, &unit)), 1e-9);
            }
        }
    };
    let thread = std::thread::Builder::new().stack_size(1 << 20);
    thread.spawn(run).unwrap().join().unwrap();
}

#[test]
fn manipulability_and_its_gradient() {
    let mut random = Random::new(5);
    for arm in all() {
        let q = values(&mut random, arm.joints());
        let jacobian = matrix(&arm.geometric_jacobian(&q));
        for (found, rows) in [
            (arm.manipulability(&q), 0..6),
            (arm.translational_manipulability(&q), 0..3),
            (arm.rotational_manipulability(&q), 3..6),
        ] {
            let values = jacobian.rows(rows.start, rows.len()).singular_values();
            let [most, least] = [values.max(), values.min()];
            close(
                &[found.sigma_min, found.inverse_condition, found.volume],
                &[least, least / most, values.product()],
                ROUNDING * (1.0 + values.product()),
            );
        }
        type Volume = fn(&Robot, &[f64]) -> kinematics::Manipulability;
        for (gradient, volume) in [
            (
                arm.manipulability_gradient(&q),
                Robot::manipulability as Volume,
            ),
            (
                arm.translational_manipulability_gradient(&q),
                Robot::translational_manipulability,
            ),
            (
                arm.rotational_manipulability_gradient(&q),
                Robot::rotational_manipulability,
            ),
        ] {
            assert_eq!(gradient.len(), q.len());
            let step = values(&mut random, q.len());
            let expected = derivative(|t| [volume(arm, &along(&q, &step, t)).volume])[0];
            let found: f64 = gradient.iter().zip(&step).map(|(a, b)| a * b).sum();
            let size = 1.0 + volume(arm, &q).volume;
            assert!((found - expected).abs() < 1e-8 * size, "{found} {expected}");
        }
    }
}

#[test]
fn what_moves_nothing_and_what_takes_no_effort() {
    let mut random = Random::new(6);
    for arm in all() {
        let n = arm.joints();
        // Stretched out, a snake is singular.
        for q in [values(&mut random, n), vec![0.0; n]] {
            let jacobian = arm.geometric_jacobian(&q);
            let rank = matrix(&jacobian).rank(1e-9);
            let motions = arm.internal_motions(&q);
            assert_eq!((motions.len(), n), (n - rank, arm.joints()));
            for (i, motion) in motions.iter().enumerate() {
                close(&sum(&jacobian, motion), &[0.0; 6], ROUNDING);
                for (j, other) in motions.iter().enumerate() {
                    let product: f64 = motion.iter().zip(other).map(|(a, b)| a * b).sum();
                    assert!((product - f64::from(u8::from(i == j))).abs() < ROUNDING);
                }
            }
            let wish = values(&mut random, n);
            let projected = arm.null_space_projection(&q, &wish);
            close(&sum(&jacobian, &projected), &[0.0; 6], ROUNDING);
            let rest: Vec<f64> = wish.iter().zip(&projected).map(|(a, b)| a - b).collect();
            let across = |motion: &Vec<f64>| motion.iter().zip(&rest).map(|(a, b)| a * b).sum();
            close(
                &motions.iter().map(across).collect::<Vec<f64>>(),
                &vec![0.0; motions.len()],
                ROUNDING,
            );
            let wrenches = arm.structural_wrenches(&q);
            assert_eq!(wrenches.len(), 6 - rank);
            for wrench in wrenches.iter() {
                close(&arm.spatial_torques(&q, wrench), &vec![0.0; n], ROUNDING);
            }
        }
    }
}

/// What is given beside a target is most of their joints, one of which slides behind 32 others.
#[test]
fn inverse_kinematics_with_most_joints_given() {
    let mut random = Random::new(7);
    for joints in [9, 36] {
        let arm = loaded_with(general(joints, false), Ik::ClosedForm).unwrap();
        assert_eq!(arm.parameters(), joints - 6);
        for _ in 0..10 {
            let q = values(&mut random, joints);
            let target = arm.fk(&q);
            let given = arm.redundancy(&target, &q);
            let solutions = arm.ik_at(&target, &given);
            let off = |found: &[f64]| {
                let each = found.iter().zip(&q).map(|(a, b)| (a - b).abs());
                each.fold(0.0, f64::max)
            };
            assert!(solutions.iter().any(|it| off(it.q) < 1e-7), "{q:?}");
            for it in solutions.iter() {
                let pose = arm.fk(it.q);
                let miss = pose.translation_distance(&target) + pose.rotation_distance(&target);
                assert!(miss < 1e-8 && arm.redundancy(&target, it.q) == given);
            }
            let nearest = arm.ik_nearest_at(&target, &given, &q).unwrap();
            assert!(off(&nearest.q) < 1e-7, "{q:?}");
            let along = arm.along(0, &given);
            assert_eq!(along.ik_at(&target, given[0]), solutions);
            assert_eq!(along.ik_sweep(&target, 3).len(), 3);
        }
    }
}

#[test]
fn an_arm_of_too_many_joints_is_refused_when_it_is_read() {
    let refusal = loaded(snake(65)).unwrap_err().to_string();
    for words in ["65 joints", "64 at most", "shorter chain"] {
        assert!(refusal.contains(words), "{refusal}");
    }
    // With their mimics there are more.
    assert!(loaded(general(60, true)).is_err());
}
