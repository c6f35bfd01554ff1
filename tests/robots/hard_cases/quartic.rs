//! Where both roots of a quartic meet, rounding loses them if it is ill-conditioned: an elimination tells
//! the solutions.

use crate::cached::cached;
use crate::random::Random;
use crate::subject::Subject;
use crate::zoo::NearlyParallel;
use kinematics::RobotOptions;
use std::f64::consts::PI;

const PATH: &str = "robots/table/nearly_parallel.yaml";
/// How far the wrist is from where axis 1 does not move it, radians of the second joint.
const OFF: [f64; 8] = [0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];
/// Of the arm's size.
const SOUND: f64 = 1e-9;

/// How far the wrist, which the tip is at, is from axis 1 along the arm.
fn aside(robot: &Subject<NearlyParallel, 6>, q: &[f64; 6]) -> f64 {
    let [x, y, _] = robot.chain.fk(q).translation;
    x * q[0].cos() + y * q[0].sin()
}

/// The second joint moved to where the wrist is not aside, if it can be.
fn above_the_base(robot: &Subject<NearlyParallel, 6>, mut q: [f64; 6]) -> Option<[f64; 6]> {
    let (mut from, mut to) = (q[1], q[1] + PI);
    let mut at = |angle: f64| {
        q[1] = angle;
        aside(robot, &q)
    };
    let low = at(from);
    if low * at(to) > 0.0 {
        return None;
    }
    for _ in 0..80 {
        let middle = 0.5 * (from + to);
        match at(middle) * low > 0.0 {
            true => from = middle,
            false => to = middle,
        }
    }
    Some(q)
}

#[test]
fn with_its_wrist_next_to_axis_1_an_arm_has_answers() {
    let robot = Subject::new(NearlyParallel, PATH);
    let loaded = cached(PATH, &RobotOptions::default());
    let mut random = Random::new(0x5b6);
    let all = std::iter::repeat_with(|| std::array::from_fn(|_| random.angle()));
    let shoulder: Vec<[f64; 6]> = all
        .filter_map(|q| above_the_base(&robot, q))
        .take(60)
        .collect();
    for off in OFF.into_iter().flat_map(|off| [off, -off]) {
        for q in &shoulder {
            let mut q = *q;
            q[1] += off;
            let target = robot.chain.fk(&q);
            let answers = robot.ik(&target);
            assert!(!answers.is_empty(), "{q:?}, {off:e}");
            for answer in &answers {
                let miss = robot.miss(&answer.q, &target);
                assert!(miss <= SOUND, "{answer:?} misses that of {q:?} by {miss:e}");
            }
            assert_eq!(loaded.ik(&target).len(), answers.len(), "{q:?}");
        }
    }
}
