//! An arm with a joint given between those that are solved for, whose plan has steps that degenerate where
//! the arm does not.

use crate::cached::cached;
use crate::random::Random;
use crate::subject::Subject;
use kin_codegen::Target;
use kinematics::{Parameter, RedundantKinematics, RobotOptions, kinematics};
use std::f64::consts::FRAC_PI_2;

kinematics!("robots/redundant/telescope.yaml");

const PATH: &str = "robots/redundant/telescope.yaml";
/// How far from where they degenerate.
const OFF: [f64; 9] = [0.0, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3];
/// How far the file's digits are past a half turn.
const TILT: f64 = 7.346410206832132e-6;
/// Radians or metres by which what was found may be off, by its conditioning.
const ROUNDING: f64 = 1e-12;
/// Of the arm's size.
const SOUND: f64 = 1e-9;

/// With the roll of the wrist along its yaw, and by its tilts beside that.
fn beside() -> impl Iterator<Item = [f64; 6]> {
    let mut random = Random::new(0x7e1e);
    let offs = OFF.into_iter().flat_map(|off| [off, -off]);
    offs.flat_map(move |off| [(); 12].map(|()| off))
        .map(move |off| {
            let mut slide = |to| random.between(0.0, to);
            let [lift, outer, inner] = [slide(1.1), slide(0.26), slide(0.26)];
            let [yaw, roll] = [random.angle(), random.angle()];
            let up = [-FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2 - TILT, FRAC_PI_2 - TILT][random.below(4)];
            [lift, outer, inner, yaw, up + off, roll]
        })
}

#[test]
fn nothing_is_lost_where_steps_degenerate() {
    assert!(matches!(Telescope::PARAMETER, Parameter::Joint(1 | 2)));
    let robot = Subject::new(Telescope, PATH, Target::Pose);
    let loaded = cached(PATH, &RobotOptions::default());
    let mut regular = 0;
    for q in beside() {
        let target = robot.chain.fk(&q);
        let parameter = robot.arm.parameter_of(&target, &q);
        let conditioning = robot.conditioning(&q);
        let compiled = Telescope.ik_at(&target, parameter);
        let loaded = loaded.ik_at(&target, &[parameter]);
        let compiled: Vec<&[f64]> = compiled.iter().map(|it| &it.q[..]).collect();
        let loaded: Vec<&[f64]> = loaded.iter().map(|it| it.q).collect();
        for found in [compiled, loaded] {
            for answer in &found {
                let miss = robot.miss(answer.first_chunk().unwrap(), &target, parameter);
                assert!(miss < SOUND * robot.size, "{q:?}: {miss:e}");
            }
            let apart = found.iter().map(|found| robot.apart(found, &q));
            let nearest = apart.fold(f64::INFINITY, f64::min);
            assert!(
                conditioning < 1e-6 || nearest < ROUNDING / conditioning,
                "{q:?} is {nearest:e} from what was found, conditioning {conditioning:e}"
            );
        }
        regular += usize::from(conditioning > 1e-5);
    }
    assert!(regular > 100, "{regular}");
}
