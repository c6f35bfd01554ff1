//! Targets out of reach have no answers, however near they are.

use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{Kinematics, Pose};

for_every_robot!(far_targets_have_no_answers);
for_every_robot!(orientations_out_of_reach_have_no_answers);

pub fn far_targets_have_no_answers<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    for q in robot.random(50) {
        let pose = robot.chain.fk(&q);
        for axis in 0..3 {
            // Beyond the travel of any sliding joint, sideways or along it.
            for way in [-100.0, 100.0] {
                let mut target = pose;
                target.translation[axis] += way * robot.size;
                if robot.miss(&q, &target) < 1.0 {
                    // Where it is moved to does not count.
                    continue;
                }
                let answers = robot.ik(&target);
                let along_a_slide = (0..N).any(|i| !robot.turns(i));
                assert!(answers.is_empty() || along_a_slide, "{answers:?}");
                for answer in &answers {
                    assert!(robot.miss(&answer.q, &target) < 1e-9, "{answer:?}");
                }
            }
        }
    }
}

/// An arm with fewer than six joints cannot turn its tool at will.
fn orientations_out_of_reach_have_no_answers<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
) {
    if N == 6 || robot.counts == Target::Position {
        return;
    }
    for q in robot.random(50) {
        let tilt = Pose::from_axis_angle([1.0, 0.0, 0.0], 1e-6, [0.0; 3]);
        let target = robot.chain.fk(&q) * tilt;
        assert!(robot.ik(&target).is_empty(), "{q:?}");
    }
}
