//! A batch is single calls, to the last bit.

use crate::random::Random;
use crate::subject::Subject;
use kinematics::{Kinematics, Multithreaded, Pose, Solutions, WithBase, WithTool};

for_every_robot!(forward_batches);
for_every_robot!(inverse_batches);
for_every_noisy_robot!(noisy_inverse_batches);

/// More than two blocks of lanes, and every rest.
const LENGTHS: std::ops::Range<usize> = 0..26;

pub fn forward_batches<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for length in LENGTHS {
        forward_batch(&robot.arm, &robot.random(length).collect::<Vec<_>>());
    }
}

fn forward_batch<K: Kinematics<N>, const N: usize>(arm: &K, q: &[[f64; N]]) {
    let mut poses = vec![Pose::IDENTITY; q.len()];
    arm.fk_batch(q, &mut poses);
    let mut both = vec![arm.fk_jacobian(&[0.0; N]); q.len()];
    arm.fk_jacobian_batch(q, &mut both);
    for (q, (pose, both)) in q.iter().zip(poses.iter().zip(&both)) {
        assert_eq!(*pose, arm.fk(q), "{q:?}");
        assert_eq!(*both, arm.fk_jacobian(q), "{q:?}");
    }
}

pub fn inverse_batches<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let regular = robot.random(40);
    let targets: Vec<Pose> = (regular.chain(robot.structured()))
        .map(|q| robot.arm.fk(&q))
        .collect();
    let away = Pose::from_translation([0.0, 0.0, 3.0 * robot.size]);
    let far = targets.iter().step_by(5).map(|target| away * *target);
    let nothing = Pose::from_translation([f64::NAN; 3]);
    let all: Vec<Pose> = targets
        .iter()
        .copied()
        .chain(far)
        .chain([nothing])
        .collect();
    // In an order that mixes them.
    let all: Vec<Pose> = (0..all.len()).map(|i| all[i * 37 % all.len()]).collect();
    inverse_batch(&robot.arm, &all);
    for length in LENGTHS {
        inverse_batch(&robot.arm, &all[..length.min(all.len())]);
    }
}

pub fn noisy_inverse_batches<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let targets: Vec<Pose> = robot.random(10).map(|q| robot.arm.fk(&q)).collect();
    inverse_batch(&robot.arm, &targets);
}

fn inverse_batch<K: Kinematics<N>, const N: usize>(arm: &K, targets: &[Pose]) {
    // What was there before is forgotten.
    let before = targets
        .first()
        .map_or(Solutions::new(), |target| arm.ik(target));
    let mut found = vec![before; targets.len()];
    arm.ik_batch(targets, &mut found);
    for (target, found) in targets.iter().zip(&found) {
        assert_eq!(*found, arm.ik(target), "{target:?}");
    }
}

#[test]
fn tools_and_bases_come_with_batches() {
    let tool = Pose::from_rpy([1.3, 0.2, -0.4], [0.1, 0.0, 0.2]);
    let robot = WithTool {
        robot: crate::zoo::Ur5e,
        tool,
    };
    let base = Pose::from_rpy([0.3, -0.7, 1.1], [1.0, 2.0, 3.0]);
    let placed = WithBase { robot, base };
    let mut random = Random::new(5);
    let q: Vec<[f64; 6]> = (0..147)
        .map(|_| std::array::from_fn(|_| random.angle()))
        .collect();
    let targets: Vec<Pose> = q.iter().map(|q| placed.fk(q)).collect();
    forward_batch(&robot, &q);
    forward_batch(&placed, &q);
    inverse_batch(&robot, &targets);
    inverse_batch(&placed, &targets);
}

#[test]
fn threads_share_the_work_and_change_nothing() {
    use crate::zoo::Ur5e;
    let mut random = Random::new(6);
    let q: Vec<[f64; 6]> = (0..1001)
        .map(|_| std::array::from_fn(|_| random.angle()))
        .collect();
    let mut poses = vec![Pose::IDENTITY; q.len()];
    Ur5e.par_fk_batch(&q, &mut poses);
    let mut both = vec![Ur5e.fk_jacobian(&[0.0; 6]); q.len()];
    Ur5e.par_fk_jacobian_batch(&q, &mut both);
    let mut found = vec![Solutions::new(); q.len()];
    Ur5e.par_ik_batch(&poses, &mut found);
    for (i, q) in q.iter().enumerate() {
        assert_eq!(poses[i], Ur5e.fk(q));
        assert_eq!(both[i], Ur5e.fk_jacobian(q));
        assert_eq!(found[i], Ur5e.ik(&poses[i]));
    }
}

#[test]
#[should_panic(expected = "a place for each result")]
fn threads_want_as_many_places() {
    crate::zoo::Ur5e.par_fk_batch(&[[0.0; 6]; 9], &mut [Pose::IDENTITY; 8]);
}

#[test]
#[should_panic(expected = "a result for each configuration")]
fn too_few_places_panic() {
    crate::zoo::Ur5e.fk_batch(&[[0.0; 6]; 9], &mut [Pose::IDENTITY; 8]);
}

#[test]
#[should_panic(expected = "a place for the solutions of each target")]
fn too_many_places_panic() {
    crate::zoo::Ur5e.ik_batch(&[Pose::IDENTITY; 8], &mut [Solutions::new(); 9]);
}
