//! Names that a robot's type cannot have, and paths that lead to no crate.

kinematics::kinematics!("robots/planar.yaml", name = f64);
kinematics::kinematics!("robots/planar.yaml", name = kinematics);
kinematics::kinematics!("robots/planar.yaml", name = r#type);
kinematics::kinematics!("robots/planar.yaml", name = Self);
kinematics::kinematics!("robots/planar.yaml", name = Pose);
kinematics::kinematics!("robots/planar.yaml", name = _);
kinematics::kinematics!("robots/planar.yaml", crate = self::robotics);
kinematics::kinematics!("robots/planar.yaml", crate = Vec::<f64>);
kinematics::kinematics!("robots/planar.yaml", crate = 3);

fn main() {}
