//! Two parameters: eight joints for whole poses, and seven where the tool may turn.

use crate::random::Random;
use kinematics::{Parameter, kinematics};
use std::f64::consts::PI;

kinematics!(
    "robots/redundant/gantry_iiwa.yaml",
    free = ["slide", "joint_a3"]
);
kinematics!(
    "../robots/panda.yaml",
    name = PandaTool,
    target = position_axis
);

fn apart<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let each = a.iter().zip(b).map(|(a, b)| {
        let d = (a - b).abs() % (2.0 * PI);
        d.min(2.0 * PI - d)
    });
    each.fold(0.0, f64::max)
}

#[test]
fn a_slide_and_the_elbow() {
    assert_eq!(
        GantryIiwa::PARAMETERS,
        [Parameter::Joint(0), Parameter::Joint(3)]
    );
    let mut random = Random::new(8);
    for _ in 0..200 {
        let q: [f64; 8] = std::array::from_fn(|i| match i {
            0 => random.between(-2.0, 2.0),
            _ => random.angle(),
        });
        let given = GantryIiwa.redundancy(&q);
        assert_eq!(given, [q[0], q[3]]);
        let target = GantryIiwa.fk(&q);
        let answers = GantryIiwa.ik_at(&target, &given);
        assert_eq!(answers.len(), GantryIiwa::BRANCHES_AT);
        assert!(
            answers.iter().any(|answer| apart(&answer.q, &q) < 1e-7),
            "{q:?}"
        );
        for answer in &answers {
            assert_eq!([answer.q[0], answer.q[3]], given);
            let found = GantryIiwa.fk(&answer.q);
            assert!(found.translation_distance(&target) < 1e-9, "{answer:?}");
            assert!(found.rotation_distance(&target) < 1e-9, "{answer:?}");
        }
    }
}

#[test]
fn the_last_joint_and_the_turn_of_the_tool() {
    assert_eq!(
        PandaTool::PARAMETERS,
        [Parameter::Joint(6), Parameter::Turn]
    );
    let mut random = Random::new(9);
    for _ in 0..200 {
        let q: [f64; 7] = std::array::from_fn(|_| random.angle());
        // The target has its x axis elsewhere: what counts is the axis of the tool.
        let target = PandaTool.fk(&q).turned(random.angle());
        let given = PandaTool.redundancy(&target, &q);
        let answers = PandaTool.ik_at(&target, &given);
        assert!(
            answers.iter().any(|answer| apart(&answer.q, &q) < 1e-7),
            "{q:?}"
        );
        let other = PandaTool.ik_at(&target, &[q[6], given[1] + 0.3]);
        for answer in &other {
            let found = PandaTool.fk(&answer.q);
            assert!(found.translation_distance(&target) < 1e-9, "{answer:?}");
            assert!((target.turn_to(&found) - given[1] - 0.3).sin().abs() < 1e-9);
        }
    }
}
