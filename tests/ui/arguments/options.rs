//! Options that there are not, or twice.

kinematics::kinematics!("robots/planar.yaml", basse = "base_link");
kinematics::kinematics!("robots/planar.yaml", precision = 3);
kinematics::kinematics!("robots/planar.yaml", ik = none, ik = none);
kinematics::kinematics!("robots/planar.yaml", ik = none, tip = "elbow", ik = none);

fn main() {}
