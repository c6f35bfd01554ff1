//! The robots of this repository.

use kin_codegen::{Ik, Target};
use kinematics::RobotOptions;

/// A robot file, and how it is compiled.
pub struct Asked {
    pub path: &'static str,
    pub options: RobotOptions,
}

const BY_DEFAULT: &[&str] = &[
    "robots/elbow.yaml",
    "robots/iiwa14.yaml",
    "robots/inverse_elbow.yaml",
    "robots/irb6640.yaml",
    "robots/kr6_r900.yaml",
    "robots/panda.yaml",
    "robots/planar_2r.yaml",
    "robots/planar_3r.yaml",
    "robots/puma560.yaml",
    "robots/scara.yaml",
    "robots/stanford.yaml",
    "robots/tx60.yaml",
    "robots/ur10e.yaml",
    "robots/ur5e.urdf",
    "tests/robots/redundant/rail.yaml",
    "tests/robots/table/concurrent_345.yaml",
    "tests/robots/table/parallel_123.yaml",
    "tests/robots/table/parallel_234.yaml",
    "tests/robots/table/slide_of_rrp.yaml",
    "tests/robots/table/slides_of_prp.yaml",
    "tests/robots/table/three_slides.yaml",
    "tests/robots/table/wrist_alone.yaml",
    "tests/robots/targets/antenna.yaml",
    "tests/robots/targets/crank.yaml",
    "tests/robots/targets/cylindrical.yaml",
    "tests/robots/targets/gimbal.yaml",
    "tests/robots/targets/palletizer.yaml",
    "tests/robots/targets/polar.yaml",
];

/// For what of a target counts.
const AIMED: &[(&str, Target)] = &[
    ("robots/planar_3r.yaml", Target::Planar),
    ("robots/iiwa14.yaml", Target::PositionAxis),
    ("robots/scara.yaml", Target::PositionYaw),
    ("robots/ur5e.urdf", Target::PositionAxis),
    ("tests/robots/targets/antenna.yaml", Target::Direction),
    ("tests/robots/targets/gimbal.yaml", Target::Orientation),
    ("tests/robots/targets/polar.yaml", Target::Position),
    ("tests/robots/targets/welder.yaml", Target::PositionAxis),
];

/// Without inverse kinematics; one has joints that follow others, with frames on their links.
const FORWARD_ALONE: &[&str] = &[
    "robots/sawyer.yaml",
    "robots/xarm6.yaml",
    "tests/frames/cell.urdf",
];

/// All of them.
pub fn all() -> Vec<Asked> {
    let by_default = BY_DEFAULT.iter().map(|&path| Asked {
        path,
        options: RobotOptions::default(),
    });
    let aimed = AIMED.iter().map(|&(path, target)| Asked {
        path,
        options: RobotOptions {
            target: Some(target),
            ..RobotOptions::default()
        },
    });
    let seven = Asked {
        path: "robots/iiwa14.yaml",
        options: RobotOptions {
            free: vec!["joint_a3".into()],
            ..RobotOptions::default()
        },
    };
    let forward_alone = FORWARD_ALONE.iter().map(|&path| Asked {
        path,
        options: RobotOptions {
            ik: Ik::None,
            ..RobotOptions::default()
        },
    });
    let all = by_default.chain(aimed).chain([seven]);
    all.chain(forward_alone).collect()
}
