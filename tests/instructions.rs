//! Wider instructions change how long it takes, and fused operations the last digits. What
//! forbids unsafe code compiles with generated robots all the same.

#![forbid(unsafe_code)]
// Nothing is dispatched where the program is compiled for wide instructions, and
// on other architectures.
#![cfg(all(target_arch = "x86_64", not(target_feature = "avx2")))]

mod random;

use kinematics::__private::dispatch::{Instructions, use_at_most};
use kinematics::__private::reproducible::reproducibly;
use kinematics::{Kinematics, Pose, Robot, Solution, Solutions};
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

/// What is said with each of these instructions, as far as the processor has them.
fn with<T, const K: usize>(instructions: [Instructions; K], say: impl Fn() -> T) -> [T; K] {
    let _alone = ONE_AT_A_TIME.lock();
    let widest = Instructions::of_this_processor();
    let said = instructions.map(|instructions| {
        assert_eq!(use_at_most(instructions), instructions.min(widest));
        say()
    });
    use_at_most(Instructions::Avx512);
    said
}

#[test]
fn all_instructions_that_fuse_give_the_same_bits() {
    let [avx2, avx512] = with([Instructions::Avx2, Instructions::Avx512], || {
        [
            answers(&Ur5e),
            answers(&Kr6R900),
            answers(&Stanford),
            answers(&Scara),
        ]
    });
    for (narrow, wide) in avx2.iter().zip(&avx512) {
        let solutions = narrow.iter().flatten().count();
        assert!(solutions > 800, "{solutions} solutions tell little");
        assert!(narrow == wide, "the results depend on the instructions");
    }
}

/// Regular targets, singular ones, and some out of reach; those of random configurations first.
fn targets<K: Kinematics<N>, const N: usize>(robot: &K) -> Vec<Pose> {
    let mut random = Random::new(13);
    let mut target = |k: usize| {
        let mut q: [f64; N] = std::array::from_fn(|_| random.angle());
        if k.is_multiple_of(4) {
            q[k % N] = random.right_angle();
        }
        let mut target = robot.fk(&q);
        if k.is_multiple_of(10) {
            target.translation[k % 3] += 0.6;
        }
        target
    };
    (0..400).map(&mut target).collect()
}

/// By target, what comes in any order.
fn solutions<K: Kinematics<N>, const N: usize>(robot: &K, targets: &[Pose]) -> Vec<Solutions<N>> {
    targets.iter().map(|target| robot.ik(target)).collect()
}

fn fused_operations_change_the_last_digits<K: Kinematics<N>, const N: usize>(robot: &K) {
    let targets = targets(robot);
    let all = [Instructions::Sse2, Instructions::Avx2, Instructions::Avx512];
    let [sse2, avx2, avx512] = with(all, || solutions(robot, &targets));
    for (narrow, wide) in sse2.iter().zip(&avx2).chain(sse2.iter().zip(&avx512)) {
        let [a, b] = [narrow, wide].map(|all| all.iter().filter(|x| !x.singular));
        assert_eq!(a.clone().count(), b.clone().count());
        for solution in a {
            let same = b.clone().any(|other| {
                let mut turns = solution.q.iter().zip(&other.q);
                turns.all(|(x, y)| (x - y).sin().abs() < 1e-8)
            });
            assert!(same, "{solution:?}");
        }
    }
    if Instructions::of_this_processor() > Instructions::Sse2 {
        assert!(sse2 != avx2, "nothing was fused");
    }

    let mut random = Random::new(14);
    let q: Vec<[f64; N]> = (0..100)
        .map(|_| std::array::from_fn(|_| random.angle()))
        .collect();
    let forward = || q.iter().map(|q| robot.fk_jacobian(q)).collect::<Vec<_>>();
    let [sse2, avx2] = with([Instructions::Sse2, Instructions::Avx2], forward);
    for ((pose, jacobian), (other, other_jacobian)) in sse2.iter().zip(&avx2) {
        assert!(pose.rotation_distance(other) < 2e-15);
        assert!(pose.translation_distance(other) < 2e-15);
        let rows = jacobian.rows.as_flattened().iter();
        let mut entries = rows.zip(other_jacobian.rows.as_flattened());
        assert!(entries.all(|(a, b)| (a - b).abs() < 2e-15));
    }
}

#[test]
fn fused_operations_change_the_last_digits_of_closed_forms() {
    fused_operations_change_the_last_digits(&Ur5e);
    fused_operations_change_the_last_digits(&Kr6R900);
    fused_operations_change_the_last_digits(&Stanford);
    fused_operations_change_the_last_digits(&Scara);
}

#[test]
fn fused_operations_change_the_last_digits_of_arms_without_a_closed_form() {
    fused_operations_change_the_last_digits(&Xarm6);
    fused_operations_change_the_last_digits(&Calibrated);
}

#[test]
fn what_is_reproducible_has_the_bits_of_the_narrowest_instructions() {
    let robots = [
        "../robots/ur5e.urdf",
        "../robots/xarm6.yaml",
        "robots/noisy/calibrated.yaml",
    ];
    let robots = robots.map(|path| match path.ends_with("urdf") {
        true => Robot::from_urdf(path).unwrap(),
        false => Robot::from_yaml(path).unwrap(),
    });
    let targets = [targets(&Ur5e), targets(&Xarm6), targets(&Calibrated)];
    let all = || {
        let solved = robots.iter().zip(&targets).map(|(robot, targets)| {
            let of = |target| robot.ik(target);
            targets.iter().map(of).collect::<Vec<_>>()
        });
        solved.collect::<Vec<_>>()
    };
    let [narrow] = with([Instructions::Sse2], all);
    let [reproducible] = with([Instructions::Avx512], || reproducibly(all));
    assert!(reproducible == narrow);
    let [wide] = with([Instructions::Avx512], all);
    // Otherwise this shows nothing.
    let widest = Instructions::of_this_processor();
    for (narrow, wide) in narrow.iter().zip(&wide) {
        assert!(widest == Instructions::Sse2 || wide != narrow);
    }
}
