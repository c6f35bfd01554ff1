//! The path comes first, in quotes.

kinematics::kinematics!();
kinematics::kinematics!(arm.urdf);
kinematics::kinematics!(name = Arm);
kinematics::kinematics!(b"robots/planar.yaml");

fn main() {}
