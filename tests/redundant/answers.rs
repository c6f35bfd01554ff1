//! What `ik_at` answers: the configuration that made the target, all others that the
//! search finds, nothing that does not reach the target.

use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{Parameter, RedundantKinematics};
use std::f64::consts::TAU;

for_every_robot! {
    configurations_come_back
    the_search_finds_no_more
    structured_targets_have_all_regular_answers
    what_is_no_number_has_no_answer
}

/// Below this conditioning a configuration may be one of a family.
const SINGULAR: f64 = 1e-6;
/// The same of an arm off its design: of two solutions that are so near one may be taken for both.
const TAKEN_FOR_ONE: f64 = 1e-5;
/// Below this conditioning the search is no longer sure to find a solution.
const REGULAR: f64 = 1e-4;
/// Rounding in the target, which conditioning magnifies.
const ROUNDING: f64 = 1e-12;
/// The search accepts what is this close to the target, by its conditioning.
const SEARCH: f64 = 1e-10;
/// Of the arm's size.
const SOUND: f64 = 1e-9;

fn configurations_come_back<K: RedundantKinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(500).chain(robot.structured()) {
        let conditioning = robot.conditioning(&q);
        let target = robot.chain.fk(&q);
        let parameter = robot.arm.parameter_of(&target, &q);
        let answers = robot.arm.ik_at(&target, parameter);
        for answer in &answers {
            let miss = robot.miss(&answer.q, &target, parameter);
            assert!(
                miss < SOUND * robot.size,
                "{answer:?} of {q:?} misses by {miss:e}"
            );
        }
        let is_refined =
            robot.path.contains("stray") && matches!(K::PARAMETER, Parameter::Joint(2 | 6));
        if conditioning < if is_refined { TAKEN_FOR_ONE } else { SINGULAR } {
            continue;
        }
        let nearest = answers.iter().map(|answer| robot.apart(&answer.q, &q));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!(
            nearest < ROUNDING / conditioning,
            "{q:?} is {nearest:e} from the nearest of {answers:#?}"
        );
    }
}

fn the_search_finds_no_more<K: RedundantKinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let mut solutions = 0;
    for q in robot.random(8) {
        let target = robot.chain.fk(&q);
        let own = robot.arm.parameter_of(&target, &q);
        for parameter in robot.parameters(3).chain([own]) {
            let answers = robot.arm.ik_at(&target, parameter);
            let found = robot.search(&target, parameter);
            if found
                .iter()
                .any(|found| robot.conditioning(&found.q) < REGULAR)
            {
                continue;
            }
            let told = format!("{parameter} at {q:?}: {answers:#?}, {found:#?}");
            assert_eq!(answers.len(), found.len(), "{told}");
            for found in &found {
                let tolerance = SEARCH / robot.conditioning(&found.q);
                let same = answers
                    .iter()
                    .filter(|a| robot.apart(&a.q, &found.q) < tolerance);
                assert_eq!(same.count(), 1, "{told}");
            }
            solutions += found.len();
        }
    }
    assert!(solutions > 30, "{solutions} solutions show nothing");
}

fn structured_targets_have_all_regular_answers<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for q in robot.structured().step_by(8) {
        let target = robot.chain.fk(&q);
        let parameter = robot.arm.parameter_of(&target, &q);
        let answers = robot.arm.ik_at(&target, parameter);
        for found in robot.search(&target, parameter) {
            let conditioning = robot.conditioning(&found.q);
            let tolerance = SEARCH / conditioning;
            let same = answers
                .iter()
                .filter(|a| robot.apart(&a.q, &found.q) < tolerance);
            assert!(
                conditioning < REGULAR || same.count() == 1,
                "{found:?} of {q:?} among {answers:#?}"
            );
        }
    }
}

fn what_is_no_number_has_no_answer<K: RedundantKinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    let [q] = robot.random(1).collect::<Vec<_>>()[..] else {
        unreachable!()
    };
    let target = robot.chain.fk(&q);
    for parameter in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(robot.arm.ik_at(&target, parameter).is_empty());
    }
    let mut broken = target;
    broken.translation[1] = f64::NAN;
    let parameter = robot.arm.parameter_of(&target, &q);
    assert!(robot.arm.ik_at(&broken, parameter).is_empty());
    // A full turn of the parameter changes nothing, unless it slides.
    let slides =
        |joint: usize| !matches!(K::LIMITS[joint], kinematics::JointLimit::Prismatic { .. });
    let turns = match K::PARAMETER {
        Parameter::Joint(joint) => slides(joint),
        Parameter::Turn | Parameter::Swivel(_) => true,
    };
    if turns {
        let wound = robot.arm.ik_at(&target, parameter + TAU);
        let same = |a: &[f64; N]| robot.apart(a, &q) < 1e-9;
        assert!(wound.iter().any(|answer| same(&answer.q)), "{wound:#?}");
    }
}
