//! Feasible intervals and traced self-motions tell the same story: a trace turns back in
//! the parameter where an interval ends, and nowhere else.

use crate::random::Random;
use kinematics::{Parameter, RedundantKinematics, SelfMotionOptions, self_motions};
use std::f64::consts::{PI, TAU};

/// How well extrema are told by a parabola through three points of a trace.
const TRACED: f64 = 2e-4;

fn tell_the_same<K: RedundantKinematics<7>>(arm: &K) {
    let Parameter::Joint(joint) = K::PARAMETER else {
        panic!("a joint is given")
    };
    let mut random = Random::new(3);
    let options = SelfMotionOptions {
        step: 0.02,
        ..SelfMotionOptions::default()
    };
    let mut compared = 0;
    for _ in 0..6 {
        let q: [f64; 7] = std::array::from_fn(|_| random.angle());
        let target = arm.fk(&q);
        let intervals = arm.feasible(&target);
        let starts: Vec<[f64; 7]> = intervals.iter().map(|interval| interval.middle).collect();
        let motions = self_motions(arm, &starts, &options).unwrap();
        let turns: Vec<f64> = motions
            .components
            .iter()
            .filter(|motion| motion.is_closed())
            .flat_map(|motion| turning_points(&motion.path, joint))
            .collect();
        let open = || intervals.iter().filter(|interval| !interval.is_closed);
        let ends: Vec<f64> = open()
            .flat_map(|interval| [interval.from, interval.to])
            .collect();
        let apart = |a: f64, b: f64| {
            let d = (a - b).rem_euclid(TAU);
            d.min(TAU - d)
        };
        let near = |all: &[f64], x: f64| all.iter().any(|&y| apart(x, y) < TRACED);
        if motions.components.iter().any(|motion| !motion.is_closed()) {
            continue;
        }
        assert!(
            turns.iter().all(|&turn| near(&ends, turn)),
            "{turns:?} {ends:?}"
        );
        assert!(
            ends.iter().all(|&end| near(&turns, end)),
            "{turns:?} {ends:?}"
        );
        // Two intervals end in every turn.
        assert_eq!(ends.len(), 2 * turns.len(), "{turns:?} {ends:?}");
        for motion in &motions.components {
            for q in motion.path.iter().step_by(7) {
                let holds =
                    |interval: &kinematics::FeasibleInterval<7>| interval.contains(q[joint]);
                assert!(
                    intervals.iter().any(holds) || near(&ends, q[joint]),
                    "{q:?}"
                );
            }
        }
        compared += 1;
    }
    assert!(compared >= 3, "{compared}");
}

/// The extrema of a joint along a closed path.
fn turning_points(path: &[[f64; 7]], joint: usize) -> Vec<f64> {
    let n = path.len() - 1;
    let value = |i: usize| path[i % n][joint];
    let wrapped = |x: f64| (x + PI).rem_euclid(TAU) - PI;
    let mut found = Vec::new();
    for i in 0..n {
        let here = value(i + 1);
        let [a, c] = [value(i), value(i + 2)].map(|x| wrapped(x - here));
        if a * c > 0.0 {
            // By unequal steps.
            let length = |i: usize, j: usize| -> f64 {
                let square = |k: usize| wrapped(path[i % n][k] - path[j % n][k]).powi(2);
                (0..7).map(square).sum::<f64>().sqrt()
            };
            let (h, k) = (length(i, i + 1), length(i + 1, i + 2));
            let bend = (a / h + c / k) / (h + k);
            let slope = c / k - bend * k;
            found.push(here - slope * slope / (4.0 * bend));
        }
    }
    found
}

#[test]
fn of_an_iiwa() {
    tell_the_same(&crate::IiwaByFlange);
}

#[test]
fn of_a_panda() {
    tell_the_same(&crate::Panda);
}

#[test]
fn of_a_sawyer() {
    tell_the_same(&crate::Sawyer);
}

/// Stops on both sides leave no way to go: the motion is its start alone.
#[test]
fn what_cannot_move_is_one_component() {
    let q = [0.0, -1.7628, -2.8973, -3.0718, 2.8973, -0.0175, 0.785];
    let options = SelfMotionOptions {
        limits: Some(crate::Panda::LIMITS),
        ..SelfMotionOptions::default()
    };
    let motions = self_motions(&crate::Panda, &[q, q], &options).unwrap();
    assert_eq!(motions.component_of, [0, 0]);
    let [alone] = &motions.components[..] else {
        panic!("{motions:?}")
    };
    assert!(alone.contains(&crate::Panda, &q) && !alone.is_closed());
    let mut other = q;
    other[0] += 1e-3;
    assert!(!alone.contains(&crate::Panda, &other));
}
