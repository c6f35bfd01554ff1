//! Arms with a joint more than their targets have coordinates, compiled by the macro,
//! against the numerical search on the arm that is left when the parameter is held.

/// A property of all robots, one test for each.
macro_rules! for_every_robot {
    ($($property:ident)*) => { $(
        mod $property {
            use super::*;
            for_every_robot! { $property:
                iiwa14 Iiwa14 "../robots/iiwa14.yaml" Pose,
                iiwa_by_flange IiwaByFlange "../robots/iiwa14.yaml" Pose,
                iiwa_by_elbow IiwaByElbow "../robots/iiwa14.yaml" Pose,
                panda Panda "../robots/panda.yaml" Pose,
                panda_by_shoulder PandaByShoulder "../robots/panda.yaml" Pose,
                panda_by_wrist PandaByWrist "../robots/panda.yaml" Pose,
                sawyer Sawyer "../robots/sawyer.yaml" Pose,
                sawyer_by_flange SawyerByFlange "../robots/sawyer.yaml" Pose,
                sawyer_by_wrist SawyerByWrist "../robots/sawyer.yaml" Pose,
                sawyer_by_middle SawyerByMiddle "../robots/sawyer.yaml" Pose,
                rail Rail "robots/redundant/rail.yaml" Pose,
                stray_iiwa StrayIiwa "robots/redundant/stray_iiwa.yaml" Pose,
                stray_iiwa_by_flange StrayIiwaByFlange "robots/redundant/stray_iiwa.yaml" Pose,
                stray_iiwa_by_elbow StrayIiwaByElbow "robots/redundant/stray_iiwa.yaml" Pose,
                stray_iiwa_by_wrist StrayIiwaByWrist "robots/redundant/stray_iiwa.yaml" Pose,
                ur5e Ur5e "../robots/ur5e.urdf" Pose,
                kr6_r900 Kr6R900 "../robots/kr6_r900.yaml" Pose,
                xarm6 Xarm6 "../robots/xarm6.yaml" Pose,
                torch Torch "robots/redundant/torch.yaml" Pose,
                ur5e_by_wrist Ur5eByWrist "../robots/ur5e.urdf" PositionAxis,
            }
        }
    )* };
    ($property:ident: $($test:ident $robot:ident $path:literal $counts:ident,)*) => { $(
        #[test]
        fn $test() {
            super::$property(&Subject::new(crate::$robot, $path, Target::$counts));
        }
    )* };
}

#[path = "../cached.rs"]
mod cached;
#[path = "../random.rs"]
mod random;
mod subject;

mod answers;
mod at_run_time;
mod best;
mod chosen;
mod degenerate;
mod feasible;
mod follow;
mod interfaces;
mod nearest;
mod placed;
mod rotated;
mod self_motions;
mod several;
mod slides;
mod swivel;

use kinematics::kinematics;

kinematics!("../robots/iiwa14.yaml");
kinematics!(
    "../robots/iiwa14.yaml",
    name = IiwaByFlange,
    free = "joint_a7"
);
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
kinematics!("../robots/panda.yaml", name = PandaByWrist, free = "joint6");
kinematics!("../robots/sawyer.yaml");
kinematics!(
    "../robots/sawyer.yaml",
    name = SawyerByFlange,
    free = "right_j6"
);
kinematics!(
    "../robots/sawyer.yaml",
    name = SawyerByWrist,
    free = "right_j4"
);
kinematics!(
    "../robots/sawyer.yaml",
    name = SawyerByMiddle,
    free = "right_j3"
);
kinematics!("robots/redundant/rail.yaml", free = "rail");
kinematics!("robots/redundant/stray_iiwa.yaml", free = "swivel");
kinematics!(
    "robots/redundant/stray_iiwa.yaml",
    name = StrayIiwaByFlange,
    free = "joint_a7"
);
kinematics!(
    "robots/redundant/stray_iiwa.yaml",
    name = StrayIiwaByElbow,
    free = "joint_a3"
);
kinematics!(
    "robots/redundant/stray_iiwa.yaml",
    name = StrayIiwaByWrist,
    free = "joint_a5"
);
kinematics!("../robots/ur5e.urdf", target = position_axis);
kinematics!("../robots/kr6_r900.yaml", target = position_axis);
kinematics!("../robots/xarm6.yaml", target = position_axis);
kinematics!("robots/redundant/torch.yaml", target = position_axis);
kinematics!(
    "../robots/ur5e.urdf",
    name = Ur5eByWrist,
    target = position_axis,
    free = "wrist_3_joint"
);
