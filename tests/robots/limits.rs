//! Answers and the travel of the joints.

use crate::measure::largest;
use crate::subject::Subject;
use kinematics::{JointLimit, Kinematics};
use std::f64::consts::PI;

for_every_robot!(windings_stay_inside_and_reach_the_target);
for_every_robot!(a_configuration_inside_comes_back_as_it_was);
for_every_robot!(within_keeps_what_fits);

/// Configurations anywhere between the stops, which may be turns apart, and
/// within half a turn or metre where there are none.
fn inside<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) -> impl Iterator<Item = [f64; N]> {
    let place = |i: usize, value: f64| {
        // A slide is already where it may be.
        if !robot.turns(i) {
            return value;
        }
        let limit = K::LIMITS[i];
        let or = |bound: f64, otherwise| if bound.is_finite() { bound } else { otherwise };
        let (lower, upper) = (or(limit.lower(), -3.0), or(limit.upper(), 3.0));
        lower + (upper - lower) * (value + PI) / (2.0 * PI)
    };
    let configurations = robot.random(100);
    let placed = configurations.map(move |q| std::array::from_fn(|i| place(i, q[i])));
    placed.filter(|q| robot.conditioning(q) > 1e-3)
}

fn fits(limit: &JointLimit, q: f64) -> bool {
    limit.lower() <= q && q <= limit.upper()
}

pub fn windings_stay_inside_and_reach_the_target<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for q in inside(robot).take(20) {
        let target = robot.chain.fk(&q);
        for winding in robot.arm.ik(&target).with_full_turns(&K::LIMITS) {
            let mut joints = K::LIMITS.iter().zip(winding.q);
            assert!(joints.all(|(limit, q)| fits(limit, q)), "{winding:?}");
            assert!(robot.miss(&winding.q, &target) < 1e-9, "{winding:?}");
        }
    }
}

/// Not a turn away.
pub fn a_configuration_inside_comes_back_as_it_was<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    for q in inside(robot) {
        let answers = robot.arm.ik(&robot.chain.fk(&q));
        let same = |other: [f64; N]| largest((0..N).map(|i| other[i] - q[i])) < 1e-8;
        let mut windings = answers.with_full_turns(&K::LIMITS);
        let continuous = K::LIMITS.contains(&JointLimit::Continuous);
        assert!(
            continuous || windings.any(|winding| same(winding.q)),
            "{q:?}"
        );
        let nearest = answers.nearest(&q, &K::LIMITS).unwrap();
        assert!(same(nearest.q), "{nearest:?} is not {q:?}");
    }
}

fn within_keeps_what_fits<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in inside(robot) {
        let answers = robot.arm.ik(&robot.chain.fk(&q));
        let kept = answers.within_limits(&K::LIMITS);
        assert!(!kept.is_empty() && kept.len() <= answers.len(), "{q:?}");
        for answer in &kept {
            let mut joints = K::LIMITS.iter().zip(answer.q);
            assert!(joints.all(|(limit, q)| fits(limit, q)), "{answer:?}");
        }
        let fitting = |branch| {
            answers
                .with_full_turns(&K::LIMITS)
                .any(|winding| winding.branch == branch)
        };
        let expected = answers
            .iter()
            .filter(|answer| fitting(answer.branch))
            .count();
        assert_eq!(kept.len(), expected, "{q:?}");
    }
}
