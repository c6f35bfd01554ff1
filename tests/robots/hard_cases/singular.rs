//! On the way into a singularity: answers stay sound, the configuration is
//! found as precisely as it is determined, and at the singularity itself a
//! representative is flagged.

use crate::random::Random;
use crate::subject::Subject;
use crate::zoo::{
    Elbow, InverseElbow, Irb6640, Kr6R900, Puma560, Stanford, Tx60, Ur5e, Ur10e, WristOverBase,
};
use kinematics::{Kinematics, Solutions};
use std::f64::consts::{FRAC_PI_2, PI};

/// How far from the singularity, radians.
const STEPS: [f64; 9] = [0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3];
/// What answers may miss the target by, relative to the arm's size. This near
/// to a singularity its representative is an answer.
const SOUND: f64 = 1e-9;
/// Rounding in the target, which conditioning magnifies.
const ROUNDING: f64 = 1e-12;

/// Moves one joint away from a singular configuration, to both sides.
fn approach<K: Kinematics<6>>(robot: Subject<K, 6>, singular: [f64; 6], joint: usize) {
    for step in STEPS.into_iter().flat_map(|step| [step, -step]) {
        let mut q = singular;
        q[joint] += step;
        let target = robot.chain.fk(&q);
        let answers = robot.ik(&target);
        assert!(!answers.is_empty(), "{q:?}");
        for answer in &answers {
            let miss = robot.miss(&answer.q, &target);
            assert!(miss <= SOUND, "{answer:?} misses that of {q:?} by {miss:e}");
        }
        let flagged = answers.iter().any(|answer| answer.singular);
        assert!(flagged || step != 0.0, "{q:?}: {answers:#?}");
        let tolerance = ROUNDING / robot.conditioning(&q);
        let recovered = answers
            .iter()
            .any(|answer| robot.apart(&answer.q, &q) < tolerance);
        assert!(
            recovered || step.abs() <= SOUND,
            "{q:?} to {tolerance:e}: {answers:#?}"
        );
    }
}

#[test]
fn fourth_and_sixth_axis_in_line() {
    let straight = [0.3, -0.6, 0.8, 0.4, 0.0, -0.9];
    approach(Subject::new(Irb6640, "../robots/irb6640.yaml"), straight, 4);
    approach(
        Subject::new(Kr6R900, "../robots/kr6_r900.yaml"),
        straight,
        4,
    );
    approach(Subject::new(Puma560, "../robots/puma560.yaml"), straight, 4);
    approach(Subject::new(Tx60, "../robots/tx60.yaml"), straight, 4);
    approach(Subject::new(Ur5e, "../robots/ur5e.urdf"), straight, 4);
    approach(Subject::new(Ur10e, "../robots/ur10e.yaml"), straight, 4);
    let turned_back = [0.3, -0.6, 0.8, 0.4, PI, -0.9];
    approach(Subject::new(Ur5e, "../robots/ur5e.urdf"), turned_back, 4);
    approach(
        Subject::new(Puma560, "../robots/puma560.yaml"),
        turned_back,
        4,
    );
    let quarter = [0.3, -0.6, 0.2, 0.4, FRAC_PI_2, -0.9];
    approach(
        Subject::new(Elbow, "../robots/elbow.yaml"),
        [0.3, -0.6, 0.8, 0.4, FRAC_PI_2, -0.9],
        4,
    );
    approach(
        Subject::new(Stanford, "../robots/stanford.yaml"),
        quarter,
        4,
    );
}

#[test]
fn elbow_stretched() {
    let stretched = [0.3, -0.6, 0.0, 0.4, 0.7, -0.9];
    approach(Subject::new(Elbow, "../robots/elbow.yaml"), stretched, 2);
    approach(Subject::new(Ur5e, "../robots/ur5e.urdf"), stretched, 2);
    approach(Subject::new(Ur10e, "../robots/ur10e.yaml"), stretched, 2);
    // The forearm is offset: 35 mm beside 420 mm.
    let offset = [0.3, -0.6, 35_f64.atan2(420.0), 0.4, 0.7, -0.9];
    approach(Subject::new(Kr6R900, "../robots/kr6_r900.yaml"), offset, 2);
    // Read backwards, the elbow is the fourth joint.
    let backwards = [0.9, -0.7, -0.4, 0.0, 0.6, -0.3];
    approach(
        Subject::new(InverseElbow, "../robots/inverse_elbow.yaml"),
        backwards,
        3,
    );
}

#[test]
fn elbow_folded() {
    let folded = [0.3, -0.6, PI, 0.4, 0.7, -0.9];
    approach(Subject::new(Elbow, "../robots/elbow.yaml"), folded, 2);
    approach(Subject::new(Ur5e, "../robots/ur5e.urdf"), folded, 2);
}
/// The elbow manipulator's wrist is above its shoulder where
/// 0.4 cos q2 + 0.3 cos(q2 + q3) = 0.
#[test]
fn wrist_on_the_shoulder_axis() {
    let shoulder: f64 = 1.2;
    let elbow = (-0.4 / 0.3 * shoulder.cos()).acos() - shoulder;
    let above = [0.3, shoulder, elbow, 0.4, 0.7, -0.9];
    approach(Subject::new(Elbow, "../robots/elbow.yaml"), above, 1);
    // The Stanford arm's, where its slide points up.
    let up = [0.3, FRAC_PI_2, 0.2, 0.4, 0.7, -0.9];
    approach(Subject::new(Stanford, "../robots/stanford.yaml"), up, 1);
}

/// With its wrist over the base the first joint is free, but not everywhere is the elbow in reach.
#[test]
fn wrist_over_the_base() {
    let robot = Subject::new(WristOverBase, "robots/table/wrist_over_base.yaml");
    let mut random = Random::new(19);
    let mut over = Vec::new();
    while over.len() < 400 {
        let mut q: [f64; 6] = std::array::from_fn(|_| random.angle());
        let (sine, cosine) = (q[1] + q[2]).sin_cos();
        let reach = 0.35 * q[1].cos() + 0.22 * cosine + 0.07 * sine;
        if reach.abs() < 0.07 {
            q[3] = (-reach / 0.07).acos() - q[1] - q[2];
            over.push(q);
        }
    }
    let targets: Vec<_> = over.iter().map(|q| robot.chain.fk(q)).collect();
    let mut all = vec![Solutions::new(); targets.len()];
    WristOverBase.ik_batch(&targets, &mut all);
    for ((q, target), batched) in over.iter().zip(&targets).zip(&all) {
        let answers = robot.ik(target);
        assert!(!answers.is_empty(), "{q:?}");
        assert_eq!(answers.len(), batched.len(), "{q:?}");
        for answer in &answers {
            let miss = robot.miss(&answer.q, target);
            assert!(miss <= SOUND, "{answer:?} misses that of {q:?} by {miss:e}");
            assert!(answer.singular, "{answer:?} of {q:?}");
        }
    }
}
