//! Values of another kind, or none.

kinematics::kinematics!("robots/planar.yaml", name = "Arm");
kinematics::kinematics!("robots/planar.yaml", name = 3);
kinematics::kinematics!("robots/planar.yaml", base = base_link);
kinematics::kinematics!("robots/planar.yaml", tip = 6);
kinematics::kinematics!("robots/planar.yaml", tool = 0.1);
kinematics::kinematics!("robots/planar.yaml", tool = [0, 0, 0.1]);
kinematics::kinematics!("robots/planar.yaml", tool = [0, 0, "0.1", 0, 0, 0]);
kinematics::kinematics!("robots/planar.yaml", tool = [0, 0, 0.1, 0, 45, 0]);
kinematics::kinematics!("robots/planar.yaml", ik = "none");
kinematics::kinematics!("robots/planar.yaml", ik = nonne);
kinematics::kinematics!("robots/planar.yaml", target = velocity);
kinematics::kinematics!("robots/planar.yaml", debug = yes);
kinematics::kinematics!("robots/planar.yaml", debug);
kinematics::kinematics!("robots/planar.yaml", tip =);

fn main() {}
