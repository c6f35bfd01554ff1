//! The arms of this chapter, compiled.

use super::random::Random;
use kinematics::Kinematics;

kinematics::kinematics!("../robots/elbow.yaml");
kinematics::kinematics!("../robots/inverse_elbow.yaml");
kinematics::kinematics!("../robots/planar_2r.yaml");
kinematics::kinematics!("../robots/planar_3r.yaml");
kinematics::kinematics!("../robots/scara.yaml");
kinematics::kinematics!("../robots/stanford.yaml");
kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("chapter3/arms/palletizer.yaml", ik = none);
kinematics::kinematics!("chapter3/arms/seven.yaml", ik = none);

/// The book's l0, l1 and l2.
pub const L0: f64 = 0.5;
pub const L1: f64 = 0.4;
pub const L2: f64 = 0.3;

/// Runs a generic check on every arm.
macro_rules! for_every_arm {
    ($check:ident) => {{
        use crate::chapter3::arms::*;
        $check(&Elbow);
        $check(&InverseElbow);
        $check(&Planar2r);
        $check(&Planar3r);
        $check(&Scara);
        $check(&Stanford);
        $check(&Ur5e);
        $check(&Palletizer);
        $check(&Seven);
    }};
}
pub(crate) use for_every_arm;

/// Random configurations, and those in which all joints or a mixture of them
/// stand at multiples of a right angle, where arms are singular.
pub fn configurations<const N: usize>(_: &impl Kinematics<N>) -> Vec<[f64; N]> {
    let mut random = Random::new(N as u64);
    let mut all = vec![[0.0; N], [std::f64::consts::FRAC_PI_2; N]];
    all.extend((0..20).map(|_| std::array::from_fn(|_| random.right_angle())));
    all.extend((0..40).map(|_| std::array::from_fn(|_| random.angle())));
    all
}
