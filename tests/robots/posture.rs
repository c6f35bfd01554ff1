//! Postures by name: of configurations and of solutions, and asked for.

use crate::subject::Subject;
use kin_codegen::random::Random;
use kinematics::{Kinematics, Robot, RobotOptions, RobotSource};
use std::f64::consts::{FRAC_PI_2, PI};

for_every_robot!(a_configuration_has_the_posture_of_its_solution);
for_every_robot!(an_answer_is_asked_for_by_posture);
for_every_robot!(postures_are_told_apart);

pub fn a_configuration_has_the_posture_of_its_solution<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for q in robot.random(100) {
        for solution in robot.ik(&robot.chain.fk(&q)) {
            if robot.conditioning(&solution.q) < 1e-3 {
                continue;
            }
            let posture = robot.arm.posture(&solution.q);
            let branch = posture.map(|posture| posture.branch);
            let named = !K::POSTURES.is_empty();
            assert_eq!(branch, named.then_some(solution.branch), "{solution:?}");
        }
    }
}

fn an_answer_is_asked_for_by_posture<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(50) {
        let solutions = robot.arm.ik(&robot.chain.fk(&q));
        let mut found = 0;
        for posture in K::POSTURES {
            let Some(solution) = solutions.in_posture(posture) else {
                continue;
            };
            found += 1;
            assert_eq!(solution.branch, posture.branch);
        }
        assert!(K::POSTURES.is_empty() || found == solutions.len());
    }
}

fn postures_are_told_apart<K: Kinematics<N>, const N: usize>(_: &Subject<K, N>) {
    for (branch, posture) in K::POSTURES.iter().enumerate() {
        assert_eq!(posture.branch as usize, branch);
        assert_eq!(posture.parts.len(), posture.words.len());
        let same = |other: &&kinematics::Posture| other.words == posture.words;
        assert_eq!(K::POSTURES.iter().filter(same).count(), 1, "{posture}");
    }
    assert!(K::POSTURES.is_empty() || K::POSTURES.len() == K::BRANCHES);
}

/// Arms by their Denavit-Hartenberg parameters (θ, d, a, α; metres and quarter turns): FANUC LR Mate
/// 200iD, whose third axis a half turn brings round; ABB IRB 120; Han's Elfin 5, upright with all
/// joints at zero.
const ARMS: [[[f64; 4]; 6]; 3] = [
    [
        [0.0, 0.0, 0.075, -1.0],
        [-1.0, 0.0, 0.3, 2.0],
        [0.0, 0.0, 0.075, -1.0],
        [0.0, -0.32, 0.0, 1.0],
        [0.0, 0.0, 0.0, -1.0],
        [0.0, -0.08, 0.0, 2.0],
    ],
    [
        [0.0, 0.29, 0.0, -1.0],
        [-1.0, 0.0, 0.27, 0.0],
        [0.0, 0.0, 0.07, -1.0],
        [0.0, 0.302, 0.0, 1.0],
        [0.0, 0.0, 0.0, -1.0],
        [2.0, 0.072, 0.0, 0.0],
    ],
    [
        [0.0, 0.22, 0.0, 1.0],
        [1.0, 0.0, 0.38, 2.0],
        [1.0, 0.0, 0.0, 1.0],
        [0.0, 0.42, 0.0, -1.0],
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.1555, 0.0, 0.0],
    ],
];

/// A file with right angles of few digits means the same arm, and its postures are called the same.
#[test]
fn digits_do_not_change_what_a_posture_is_called() {
    for arm in ARMS {
        let of_digits = |digits: usize| {
            let angle = |quarters: f64| format!("{:.digits$}", quarters * FRAC_PI_2);
            let joint = |(i, [theta, d, a, alpha]): (usize, &[f64; 4])| {
                let (theta, alpha) = (angle(*theta), angle(*alpha));
                format!("- {{name: j{i}, theta: {theta}, d: {d}, a: {a}, alpha: {alpha}}}\n")
            };
            let joints: String = arm.iter().enumerate().map(joint).collect();
            let source = RobotSource {
                path: "arm.yaml".into(),
                text: format!("robot: arm\nunits: {{angle: rad, length: m}}\ndh:\n{joints}"),
            };
            Robot::load(&source, &RobotOptions::default()).unwrap()
        };
        let exact = of_digits(17);
        assert_eq!(exact.postures()[0].parts, ["shoulder", "elbow", "wrist"]);
        for digits in [4, 5, 7, 9] {
            let rounded = of_digits(digits);
            let mut random = Random(0x9057);
            let mut told = 0;
            for _ in 0..100 {
                let q: [f64; 6] = std::array::from_fn(|_| random.between(-PI, PI));
                let Some(posture) = rounded.posture(&q) else {
                    continue;
                };
                told += 1;
                let meant = exact.posture(&q).unwrap();
                assert_eq!(
                    (&posture.parts, &posture.words),
                    (&meant.parts, &meant.words),
                    "{digits} digits at {q:?}"
                );
            }
            assert!(told > 95, "{digits}: {told}");
        }
    }
}
