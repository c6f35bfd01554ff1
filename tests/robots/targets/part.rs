//! What of a target does not count is not read.

use crate::measure::angle_between;
use crate::random::Random;
use crate::subject::Subject;
use crate::zoo::{PlanarTarget, RoundedScara, ScaraYaw};
use kin_codegen::Target;
use kinematics::{Kinematics, Pose, Solution};
use std::f64::consts::PI;

for_every_aimed_robot!(the_rest_of_a_target_is_not_read);

/// The entries that do not count, nine of the rotation and three of the
/// translation, are not even numbers.
fn the_rest_of_a_target_is_not_read<K: Kinematics<N>, const N: usize>(robot: &Subject<K, N>) {
    let rest: &[usize] = match robot.counts {
        Target::Position => &[0, 1, 2, 3, 4, 5, 6, 7, 8],
        Target::PositionAxis => &[0, 1, 3, 4, 6, 7],
        Target::Direction => &[0, 1, 3, 4, 6, 7, 9, 10, 11],
        Target::Orientation => &[9, 10, 11],
        Target::Pose | Target::PositionYaw | Target::Planar => &[],
    };
    for q in robot.random(50).chain(robot.structured()) {
        let target = robot.chain.fk(&q);
        let mut without = target;
        let rotation = without.rotation.iter_mut().flatten();
        let entries = rotation.chain(&mut without.translation).enumerate();
        let unread = entries.filter(|(i, _)| rest.contains(i));
        unread.for_each(|(_, entry)| *entry = f64::NAN);
        assert_eq!(robot.ik(&without), robot.ik(&target), "{q:?}");
    }
}

/// Answers to the target of `q` when it is tilted and lifted.
fn assert_moved_target_is_the_same<K: Kinematics<N>, const N: usize>(
    robot: &Subject<K, N>,
    lifts: [f64; 3],
) {
    let mut random = Random::new(5);
    for q in robot.random(50) {
        let target = robot.chain.fk(&q);
        let answers = robot.ik(&target);
        for lift in lifts {
            let level = random.angle();
            let tilt = random.between(-0.9 * PI, 0.9 * PI);
            // About an axis across the tip's own: that keeps the yaw.
            let across = [level.cos(), level.sin(), 0.0];
            let mut moved = target * Pose::from_axis_angle(across, tilt, [0.0; 3]);
            moved.translation[2] += lift;
            let same = |(a, b): (&Solution<N>, &Solution<N>)| robot.apart(&a.q, &b.q) < 1e-10;
            let others = robot.ik(&moved);
            assert_eq!(others.len(), answers.len(), "{q:?} tilted by {tilt}");
            assert!(
                others.iter().zip(&answers).all(same),
                "{q:?}, {tilt}, {lift}"
            );
        }
    }
}

#[test]
fn tilt_does_not_matter_to_a_scara() {
    let scara = Subject::new(ScaraYaw, "../robots/scara.yaml").counting("position_yaw");
    assert_moved_target_is_the_same(&scara, [0.0; 3]);
}

#[test]
fn tilt_and_height_do_not_matter_in_a_plane() {
    let planar = Subject::new(PlanarTarget, "../robots/planar_3r.yaml").counting("planar");
    assert_moved_target_is_the_same(&planar, [-0.4, 1e-3, 20.0]);
}

/// What is asked of an arm whose file rounds half turns is upright to the last bit.
#[test]
fn upright_targets_are_reached_by_a_rounded_scara() {
    let scara = Subject::new(RoundedScara, "robots/targets/rounded_scara.yaml");
    let scara = scara.counting("position_yaw");
    let mut random = Random::new(7);
    for q in scara.random(200) {
        let turn = random.angle();
        let (sine, cosine) = turn.sin_cos();
        let target = Pose {
            rotation: [[cosine, sine, 0.0], [sine, -cosine, 0.0], [0.0, 0.0, -1.0]],
            translation: scara.chain.fk(&q).translation,
        };
        let answers = scara.ik(&target);
        assert_eq!(answers.len(), 2, "{q:?}, {turn}");
        for answer in answers {
            let found = scara.chain.fk(&answer.q);
            assert!(found.translation_distance(&target) < 1e-9, "{answer:?}");
            let [x, y, _] = found.rotate([1.0, 0.0, 0.0]);
            assert!(angle_between(y.atan2(x), turn) < 1e-9, "{answer:?}");
        }
    }
}
