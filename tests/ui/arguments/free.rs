//! Joints that stay free, in words that name none.

kinematics::kinematics!("robots/planar.yaml", free = elbow);
kinematics::kinematics!("robots/planar.yaml", free = []);
kinematics::kinematics!("robots/planar.yaml", free = ["elbow", 3]);
kinematics::kinematics!("robots/planar.yaml", free = "elbow");

fn main() {}
