//! A robot generated with `ik = none` has no inverse kinematics.

use kinematics::{Kinematics, Pose};

kinematics::kinematics!("robots/planar.yaml", ik = none);

fn solutions<const N: usize>(robot: &impl Kinematics<N>, target: &Pose) -> usize {
    robot.ik(target).len()
}

fn main() {
    solutions(&Planar, &Pose::IDENTITY);
}
