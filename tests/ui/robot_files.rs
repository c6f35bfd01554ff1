//! Files that cannot be used, and chains that cannot be found in them.

kinematics::kinematics!("robots/broken.urdf");
kinematics::kinematics!("robots/two_arms.urdf");
kinematics::kinematics!("robots/two_arms.urdf", tip = "left_hnad");

fn main() {}
