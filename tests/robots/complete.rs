//! The answers are those that the numerical search finds, one to one.

use crate::subject::Subject;
use kinematics::{ChainSolution, Kinematics, Solution};

for_every_robot!(random_targets_have_all_answers);
for_every_robot!(structured_targets_have_all_regular_answers);

/// Below this conditioning the search is no longer sure to find a solution.
const REGULAR: f64 = 1e-4;
/// The search accepts what is this close to the target, relative to the arm's
/// size; conditioning magnifies it.
const SEARCH: f64 = 1e-11;

pub fn random_targets_have_all_answers<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(60) {
        let target = robot.chain.fk(&q);
        let (answers, found) = (robot.ik(&target), robot.search(&target));
        assert_eq!(
            answers.len(),
            found.len(),
            "{q:?}: {answers:#?}, {found:#?}"
        );
        for solution in &found {
            assert_matched(robot, solution, &answers, &q);
        }
    }
}

/// The target of right angles is often singular in one branch and regular in
/// others: those are all there.
pub fn structured_targets_have_all_regular_answers<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for q in robot.structured() {
        let target = robot.chain.fk(&q);
        let answers = robot.ik(&target);
        let found = robot.search(&target);
        let regular = |solution: &&ChainSolution| robot.conditioning(&solution.q) > REGULAR;
        for solution in found.iter().filter(regular) {
            assert_matched(robot, solution, &answers, &q);
        }
    }
}

/// Exactly one answer is this solution.
pub fn assert_matched<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    solution: &ChainSolution,
    answers: &[Solution<N>],
    target: &impl std::fmt::Debug,
) {
    let tolerance = SEARCH / robot.conditioning(&solution.q);
    let same = |answer: &&Solution<N>| robot.apart(&answer.q, &solution.q) < tolerance;
    let count = answers.iter().filter(same).count();
    assert_eq!(count, 1, "{solution:?} of {target:?} among {answers:#?}");
}
