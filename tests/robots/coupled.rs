//! Arms whose joints mimic each other, against the product of exponentials of all joints that their
//! files have.

use crate::cached::cached;
use crate::random::Random;
use kin_codegen::geometry::{natural_target, size};
use kin_codegen::model::Model;
use kin_codegen::spec::{ArmSpec, Source};
use kinematics::{JointLimit, Kinematics, Pose, RobotOptions, Target};
use std::f64::consts::TAU;

kinematics::kinematics!("robots/coupled/finger.yaml");
kinematics::kinematics!("robots/coupled/palletizer.yaml", name = LevelPalletizer);
kinematics::kinematics!("robots/coupled/parallelogram.yaml");
kinematics::kinematics!("robots/coupled/rack.yaml");
kinematics::kinematics!("robots/coupled/remote_centre.yaml");
kinematics::kinematics!("robots/coupled/telescope.yaml");

struct Subject<K, const N: usize> {
    arm: K,
    path: &'static str,
    model: Model,
    counts: Target,
}

impl<K: Kinematics<N>, const N: usize> Subject<K, N> {
    fn new(arm: K, path: &'static str) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        let source = Source {
            path: path.into(),
            text,
        };
        let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
        Self {
            arm,
            path,
            counts: natural_target(&model),
            model,
        }
    }

    fn fk(&self, q: &[f64; N]) -> Pose {
        let joints = self.model.joints.iter();
        let values = joints.map(|joint| joint.multiplier * q[joint.variable] + joint.offset);
        self.model.chain().fk(&values.collect::<Vec<_>>())
    }

    /// Inside the limits.
    fn random(&self, count: usize) -> Vec<[f64; N]> {
        let mut random = Random::new(N as u64);
        let mut place = |i: usize| {
            let [lower, upper] = self.model.variables[i].limits.unwrap();
            lower + (upper - lower) * (random.angle() / TAU + 0.5)
        };
        let mut one = || std::array::from_fn(&mut place);
        (0..count).map(|_| one()).collect()
    }

    fn miss(&self, q: &[f64; N], target: &Pose) -> f64 {
        let size = size(&self.model);
        self.counts.distance(&self.fk(q), target, size) / size
    }

    /// How many of 200 targets have several solutions.
    fn is_right(&self) -> usize {
        let loaded = cached(self.path, &RobotOptions::default());
        let mut several = 0;
        for q in self.random(200) {
            let pose = self.arm.fk(&q);
            let apart = Target::Pose.distance(&pose, &self.fk(&q), 1.0);
            assert!(apart < 1e-13, "{q:?}: {apart:e}");
            let solutions = self.arm.ik(&pose);
            several += usize::from(solutions.len() > 1);
            for solution in solutions.iter() {
                let miss = self.miss(&solution.q, &pose);
                assert!(miss < 1e-9, "{q:?}: {miss:e}");
            }
            let back = self.arm.ik_nearest(&pose, &q).unwrap();
            for i in 0..N {
                assert!((back.q[i] - q[i]).abs() < 1e-6, "{q:?}: {:?}", back.q);
            }
            let at_run_time = loaded.ik(&pose);
            assert_eq!(at_run_time.len(), solutions.len(), "{q:?}");
            for (ours, theirs) in solutions.iter().zip(at_run_time.iter()) {
                assert_eq!(ours.q[..], theirs.q[..], "{q:?}");
            }
        }
        several
    }
}

#[test]
fn a_finger() {
    Subject::new(Finger, "robots/coupled/finger.yaml").is_right();
}

#[test]
fn a_palletizer_whose_tool_is_level() {
    let subject = Subject::new(LevelPalletizer, "robots/coupled/palletizer.yaml");
    assert!(subject.is_right() > 100);
    // It cannot tilt its tool.
    let tilt = Pose::from_rpy([1e-4, 0.0, 0.0], [0.0; 3]);
    let level = subject.arm.fk(&[0.3, 0.2, 0.4, 0.5]);
    assert!(!subject.arm.ik(&level).is_empty());
    assert!(subject.arm.ik(&(level * tilt)).is_empty());
}

#[test]
fn a_parallelogram() {
    let several = Subject::new(Parallelogram, "robots/coupled/parallelogram.yaml").is_right();
    assert_eq!(several, 200);
}

#[test]
fn a_remote_centre() {
    let several = Subject::new(RemoteCentre, "robots/coupled/remote_centre.yaml").is_right();
    assert!(several > 100);
}

#[test]
fn a_telescope() {
    let several = Subject::new(Telescope, "robots/coupled/telescope.yaml").is_right();
    assert!(several > 100);
}

/// A full turn of the pinion moves the rack, and is another configuration.
#[test]
fn a_rack_and_its_pinion() {
    let subject = Subject::new(Rack, "robots/coupled/rack.yaml");
    subject.is_right();
    assert_eq!(Rack::LIMITS[1], JointLimit::prismatic(-9.0, 9.0));
    let solutions = Rack.ik(&Rack.fk(&[0.4, 8.0, 0.3]));
    assert!((solutions[0].q[1] - 8.0).abs() < 1e-9, "{solutions:?}");
    assert!(
        Rack.ik_nearest(&Rack.fk(&[0.4, 8.0, 0.3]), &[0.4, 8.0 - TAU, 0.3])
            .is_some_and(|it| it.q[1] > 7.9)
    );
}
