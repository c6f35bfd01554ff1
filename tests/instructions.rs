//! Wider instructions change how long it takes, and of closed forms nothing else; of arms
//! without one, the last digits. What forbids unsafe code compiles with generated robots all
//! the same.

#![forbid(unsafe_code)]
// Nothing is dispatched where the program is compiled for wide instructions, and
// on other architectures.
#![cfg(all(target_arch = "x86_64", not(target_feature = "avx2")))]

mod random;

use kinematics::__private::dispatch::{Instructions, use_at_most};
use kinematics::__private::univariate::reproducibly;
use kinematics::{Kinematics, Pose, Solution, Solutions};
use random::Random;
use std::sync::Mutex;

kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/kr6_r900.yaml");
kinematics::kinematics!("../robots/stanford.yaml");
kinematics::kinematics!("../robots/scara.yaml", target = position_yaw);
kinematics::kinematics!("../robots/xarm6.yaml");
kinematics::kinematics!("robots/noisy/calibrated.yaml");

/// What a robot says of targets: regular ones, singular ones, and some out of
/// reach; all numbers with all bits.
fn answers<K: Kinematics<N>, const N: usize>(robot: &K) -> Vec<Option<Vec<u64>>> {
    let mut random = Random::new(11);
    let mut said = forward(robot);
    let mut targets = Vec::new();
    for k in 0..400 {
        let mut q: [f64; N] = std::array::from_fn(|_| random.angle());
        let seed: [f64; N] = std::array::from_fn(|_| random.angle());
        if k % 4 == 0 {
            // The wrist, or the elbow, is singular.
            q[k % N] = random.right_angle();
        }
        let mut target = robot.fk(&q);
        if k % 10 == 0 {
            target.translation[k % 3] += 0.6;
        }
        said.extend(of(robot, &target, &seed));
        targets.push(target);
    }
    let mut found = vec![Solutions::new(); targets.len()];
    robot.ik_batch(&targets, &mut found);
    said.extend(found.iter().flatten().map(bits));
    said
}

/// Poses and Jacobians one by one, which a batch has as well.
fn forward<K: Kinematics<N>, const N: usize>(robot: &K) -> Vec<Option<Vec<u64>>> {
    let mut random = Random::new(12);
    let q: [[f64; N]; 43] = std::array::from_fn(|_| std::array::from_fn(|_| random.angle()));
    let mut poses = [Pose::IDENTITY; 43];
    robot.fk_batch(&q, &mut poses);
    let mut both = q.map(|_| robot.fk_jacobian(&[0.0; N]));
    robot.fk_jacobian_batch(&q, &mut both);
    assert_eq!(poses, q.map(|q| robot.fk(&q)));
    assert_eq!(both, q.map(|q| robot.fk_jacobian(&q)));
    let entries = poses.iter().chain(both.iter().map(|(pose, _)| pose));
    let entries =
        entries.flat_map(|pose| pose.rotation.as_flattened().iter().chain(&pose.translation));
    let rows = both
        .iter()
        .flat_map(|(_, jacobian)| jacobian.rows.as_flattened());
    vec![Some(entries.chain(rows).map(|x| x.to_bits()).collect())]
}

fn of<K: Kinematics<N>, const N: usize>(
    robot: &K,
    target: &Pose,
    seed: &[f64; N],
) -> Vec<Option<Vec<u64>>> {
    let mut said: Vec<_> = robot.ik_seeded(target, seed).iter().map(bits).collect();
    said.extend([
        robot.ik_nearest(target, seed).as_ref().and_then(bits),
        robot.ik_approximate(target).as_ref().and_then(bits),
    ]);
    said
}

fn bits<const N: usize>(solution: &Solution<N>) -> Option<Vec<u64>> {
    let numbers = solution.q.iter().chain([&solution.residual]);
    let flags = [u64::from(solution.branch), u64::from(solution.singular)];
    Some(numbers.map(|x| x.to_bits()).chain(flags).collect())
}

/// What is chosen is chosen for the whole program.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

#[test]
fn all_instructions_give_the_same_bits() {
    let _alone = ONE_AT_A_TIME.lock();
    let widest = Instructions::of_this_processor();
    let all = || {
        [
            answers(&Ur5e),
            answers(&Kr6R900),
            answers(&Stanford),
            answers(&Scara),
        ]
    };
    let [sse2, avx2, avx512] =
        [Instructions::Sse2, Instructions::Avx2, Instructions::Avx512].map(|instructions| {
            assert_eq!(use_at_most(instructions), instructions.min(widest));
            all()
        });
    for (narrow, wide) in sse2.iter().zip(&avx2).chain(sse2.iter().zip(&avx512)) {
        let solutions = narrow.iter().flatten().count();
        assert!(solutions > 800, "{solutions} solutions tell little");
        assert!(narrow == wide, "the results depend on the instructions");
    }
}

/// By target, what comes in any order.
fn solutions<K: Kinematics<6>>(robot: &K) -> Vec<Solutions<6>> {
    let mut random = Random::new(13);
    let mut target = |k: usize| {
        let mut q: [f64; 6] = std::array::from_fn(|_| random.angle());
        if k.is_multiple_of(4) {
            q[k % 6] = random.right_angle();
        }
        let mut target = robot.fk(&q);
        if k.is_multiple_of(10) {
            target.translation[k % 3] += 0.6;
        }
        target
    };
    (0..400).map(|k| robot.ik(&target(k))).collect()
}

#[test]
fn fused_additions_change_the_last_digits_of_arms_without_a_closed_form() {
    let _alone = ONE_AT_A_TIME.lock();
    let widest = Instructions::of_this_processor();
    let all = || [solutions(&Xarm6), solutions(&Calibrated)];
    let [sse2, avx2, avx512] =
        [Instructions::Sse2, Instructions::Avx2, Instructions::Avx512].map(|instructions| {
            assert_eq!(use_at_most(instructions), instructions.min(widest));
            all()
        });
    for (narrow, wide) in sse2.iter().zip(&avx2).chain(sse2.iter().zip(&avx512)) {
        for (k, (narrow, wide)) in narrow.iter().zip(wide).enumerate() {
            let [a, b] = [narrow, wide].map(|all| all.iter().filter(|x| !x.singular));
            assert_eq!(a.clone().count(), b.clone().count(), "target {k}");
            for solution in a {
                let same = b.clone().any(|other| {
                    let mut turns = solution.q.iter().zip(&other.q);
                    turns.all(|(x, y)| (x - y).sin().abs() < 1e-8)
                });
                assert!(same, "target {k}: {solution:?}");
            }
        }
    }
}

/// All numbers of all solutions.
fn all_bits(found: &[Solutions<6>]) -> Vec<Option<Vec<u64>>> {
    found.iter().flatten().map(bits).collect()
}

#[test]
fn what_is_reproducible_has_the_bits_of_the_narrowest_instructions() {
    let _alone = ONE_AT_A_TIME.lock();
    let all = || [solutions(&Xarm6), solutions(&Calibrated)].map(|found| all_bits(&found));
    use_at_most(Instructions::Sse2);
    let narrow = all();
    let widest = use_at_most(Instructions::Avx512);
    assert!(reproducibly(all) == narrow);
    // Otherwise this shows nothing.
    assert!(widest == Instructions::Sse2 || all() != narrow);
}
