//! Postures by name: of configurations and of solutions, and asked for.

use crate::subject::Subject;
use kinematics::Kinematics;

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
