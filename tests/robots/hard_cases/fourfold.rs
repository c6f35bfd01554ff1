//! Four roots of a quartic that meet: what rounding leaves of each is its fourth root.

use crate::measure;
use crate::random::Random;
use kin_codegen::Target;
use kinematics::Robot;
use std::f64::consts::FRAC_PI_2;

#[test]
fn solutions_next_to_a_fourfold_root_are_all_there() {
    let robot = Robot::from_yaml("robots/fourfold.yaml").unwrap();
    let mut random = Random::new(41);
    let mut regular = 0;
    for off in [
        [0.0, 0.0],
        [1e-6, 1e-4],
        [1e-6, 1e-3],
        [1e-5, 1e-4],
        [1e-4, 1e-4],
        [1e-3, 1e-3],
    ] {
        for _ in 0..200 {
            let side = |random: &mut Random, off: f64| off.copysign(random.angle());
            let mut q = [0.0; 5].map(|_| random.angle());
            q[1] = side(&mut random, off[0]);
            q[2] = side(&mut random, off[1]) - FRAC_PI_2;
            let columns = robot.geometric_jacobian(&q);
            let least = *measure::singular_values(&columns, Target::Pose, 1.0)
                .last()
                .unwrap();
            if least < 0.02 {
                continue;
            }
            regular += 1;
            let answers = robot.ik(&robot.fk(&q));
            let apart = |answer: &[f64]| {
                let off = answer
                    .iter()
                    .zip(&q)
                    .map(|(a, b)| measure::angle_between(*a, *b));
                measure::largest(off)
            };
            let same = answers.iter().filter(|answer| apart(answer.q) < 1e-6);
            assert_eq!(same.count(), 1, "{off:?} {q:?}, {least:e}: {answers:#?}");
        }
    }
    assert!(regular > 1000, "{regular}");
}
