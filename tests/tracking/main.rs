//! Lines and circles through singularities: the answers follow.

mod elbow;
mod follow;
mod noisy;
mod path;
mod shoulder;
mod wrist;

kinematics::kinematics!("../robots/elbow.yaml");
kinematics::kinematics!("../robots/puma560.yaml");
kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("robots/noisy/calibrated.yaml");
