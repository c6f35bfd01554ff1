//! Commas between options, and an end where there is one.

kinematics::kinematics!("robots/planar.yaml" name = Arm);
kinematics::kinematics!("robots/planar.yaml", name = Arm ik = none);
kinematics::kinematics!("robots/planar.yaml", "robots/planar.yaml");
kinematics::kinematics!("robots/planar.yaml", name = arm::Arm);

fn main() {}
