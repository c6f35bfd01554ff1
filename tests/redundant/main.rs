//! Arms with a joint more than their targets have coordinates, compiled by the macro,
//! against the numerical search on the arm that is left when the parameter is held.

#[path = "../random.rs"]
mod random;
mod subject;

mod answers;
mod best;
mod chosen;
mod feasible;
mod follow;
mod interfaces;
mod self_motions;
mod several;

use kinematics::kinematics;

kinematics!("../robots/iiwa14.yaml");
kinematics!(
    "../robots/iiwa14.yaml",
    name = IiwaByElbow,
    free = "joint_a3"
);
kinematics!("../robots/panda.yaml");
kinematics!(
    "../robots/panda.yaml",
    name = PandaByShoulder,
    free = "joint1"
);
kinematics!("../robots/sawyer.yaml");
kinematics!(
    "../robots/sawyer.yaml",
    name = SawyerByFlange,
    free = "right_j6"
);
kinematics!("robots/redundant/rail.yaml", free = "rail");
kinematics!("robots/redundant/stray_iiwa.yaml");
kinematics!("../robots/ur5e.urdf", target = position_axis);
kinematics!("../robots/kr6_r900.yaml", target = position_axis);
kinematics!("../robots/xarm6.yaml", target = position_axis);
kinematics!(
    "../robots/ur5e.urdf",
    name = Ur5eByWrist,
    target = position_axis,
    free = "wrist_3_joint"
);
