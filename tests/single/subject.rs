//! A robot in both precisions.

use crate::random::Random;
use kin_codegen::arm::CompiledArm;
use kin_codegen::{Options, Scalar, Source, compile};
use kinematics::{Chain, Kinematics, Pose, single};
use std::path::Path;

pub struct Subject<S, D> {
    pub single: S,
    pub double: D,
    /// As it was certified in `f32`.
    pub compiled: CompiledArm,
    /// What is solved for, by the reference.
    pub chain: Chain,
}

impl<S, D> Subject<S, D> {
    pub fn new(single: S, double: D, file: &str) -> Self {
        let source = Source::read(file, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
        let options = Options {
            scalar: Scalar::F32,
            ..Options::default()
        };
        let compiled = compile(&source, &options).unwrap();
        let compiled = compiled.arm().unwrap().clone();
        Self {
            single,
            double,
            chain: compiled.model.chain(),
            compiled,
        }
    }

    pub fn size(&self) -> f64 {
        self.compiled.linkage.size
    }

    /// How far from singular, 0 to 1.
    pub fn conditioning(&self, q: &[f64]) -> f64 {
        let target = self.compiled.target();
        self.compiled.linkage.conditioning(&self.chain, q, target)
    }
}

/// Random configurations, and round ones with some noise: all joints at 0, ±π/2 or π, off by up
/// to 1e-6 to 0.1.
pub fn configurations<const N: usize>() -> impl Iterator<Item = [f64; N]> {
    let mut random = Random::new(0x51_4e61);
    let anywhere: Vec<[f64; N]> = (0..600)
        .map(|_| std::array::from_fn(|_| random.angle()))
        .collect();
    let round = (0..600).map(move |k| {
        let off = [0.0, 1e-6, 1e-4, 1e-2, 0.1][k % 5];
        std::array::from_fn(|_| random.right_angle() + off * random.between(-1.0, 1.0))
    });
    anywhere.into_iter().chain(round)
}

/// What both precisions are asked: the pose of a configuration, rounded.
pub fn target<const N: usize>(double: &impl Kinematics<N>, q: &[f64; N]) -> (Pose, single::Pose) {
    let pose = double.fk(q);
    (pose, single::Pose::from(pose))
}

/// The difference of two values of a joint that may be full turns apart.
pub fn apart(a: f64, b: f64, turns: bool) -> f64 {
    use std::f64::consts::TAU;
    let apart = (a - b).abs();
    let wrapped = (apart - TAU * (apart / TAU).round()).abs();
    if turns { wrapped } else { apart }
}
