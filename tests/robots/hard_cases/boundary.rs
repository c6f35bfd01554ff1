//! At the edge of the workspace two answers meet; beyond it there is none, and
//! the nearest configuration is not handed out as one.

use crate::zoo::{Elbow, Planar2r};
use kinematics::Pose;

/// A target for the 2R arm with links of 0.4 m and 0.3 m.
fn at(distance: f64) -> Pose {
    Pose::from_translation([0.6 * distance, 0.8 * distance, 0.0])
}

#[test]
fn a_step_inside_both_answers_are_there() {
    for step in [1e-9, 1e-6, 1e-3] {
        for distance in [0.7 - step, 0.1 + step] {
            let answers = Planar2r.ik(&at(distance));
            assert_eq!(answers.len(), 2, "{distance}: {answers:?}");
        }
    }
}

#[test]
fn at_the_edge_there_is_one_flagged_answer() {
    for distance in [0.7, 0.1] {
        let answers = Planar2r.ik(&at(distance));
        assert_eq!(answers.len(), 1, "{answers:?}");
        assert!(answers[0].singular);
    }
}

#[test]
fn a_step_outside_there_is_none() {
    for step in [1e-8, 1e-6, 1e-3] {
        for distance in [0.7 + step, 0.1 - step] {
            assert!(Planar2r.ik(&at(distance)).is_empty(), "{distance}");
        }
    }
}

#[test]
fn an_arm_in_space_stretched_too_far() {
    let stretched = Elbow.fk(&[0.3, -0.4, 0.0, 0.7, 0.2, -0.5]);
    assert!(Elbow.ik(&stretched).iter().any(|answer| answer.singular));
    for factor in [1.0 + 1e-7, 1.0 + 1e-4] {
        let mut target = stretched;
        // From the shoulder, half a metre up.
        target.translation[0] *= factor;
        target.translation[1] *= factor;
        target.translation[2] = 0.5 + (target.translation[2] - 0.5) * factor;
        assert!(Elbow.ik(&target).is_empty(), "{factor}");
    }
}

#[test]
fn out_of_reach_there_is_no_nearest_answer() {
    let answers = Planar2r.ik(&at(3.0));
    assert_eq!(answers.nearest(&[0.0; 2], &Planar2r::LIMITS), None);
    assert_eq!(answers.with_full_turns(&Planar2r::LIMITS).count(), 0);
    assert!(answers.within_limits(&Planar2r::LIMITS).is_empty());
}
