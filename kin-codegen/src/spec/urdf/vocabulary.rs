//! The words of URDF: those that carry kinematics, and those that robots in
//! the field carry besides.

use crate::spec::JointType;

/// Children of `<robot>` that are read.
pub(super) const STRUCTURE: [&str; 2] = ["link", "joint"];

/// Children of `<link>`: what a link weighs and looks like, and what
/// simulators attach to it. None moves a frame.
pub(super) const IN_LINK: [&str; 16] = [
    "visual",
    "collision",
    "inertial",
    "sensor",
    "material",
    "gazebo",
    "contact",
    "self_collision_checking",
    "collision_checking",
    "velocity_decay",
    "kinematic",
    "gravity",
    "audio_source",
    "force_torque",
    "mujoco",
    "verbose",
];

/// Children of `<joint>` that are read.
pub(super) const KINEMATIC: [&str; 6] = ["origin", "parent", "child", "axis", "limit", "mimic"];

/// Children of `<joint>` about its drive.
pub(super) const IN_JOINT: [&str; 9] = [
    "dynamics",
    "calibration",
    "safety_controller",
    "hardwareInterface",
    "gazebo",
    "sensor",
    "mujoco",
    "transmission",
    "joint_properties",
];

/// The joint types of the URDF specification.
pub(super) const JOINT_TYPES: [&str; 7] = [
    "revolute",
    "continuous",
    "prismatic",
    "fixed",
    "floating",
    "planar",
    "spherical",
];

/// The format that an XML file with this root is in, where it is one that
/// robots come in.
pub(super) fn other_format(root: &str) -> Option<&'static str> {
    Some(match root {
        "sdf" | "gazebo" => "SDF, the format of Gazebo",
        "mujoco" => "MJCF, the format of MuJoCo",
        "COLLADA" => "COLLADA, a format of meshes",
        "launch" => "a ROS launch file",
        "html" => "a web page",
        _ => return None,
    })
}

/// What a robot has in SRDF, which says what MoveIt does with a URDF, and in no URDF.
pub(super) const OF_SRDF: [&str; 4] = [
    "group",
    "group_state",
    "virtual_joint",
    "disable_collisions",
];

/// The motion that a joint type stands for.
pub(super) fn joint_type(word: &str) -> Option<JointType> {
    Some(match word {
        "revolute" | "continuous" => JointType::Revolute,
        "prismatic" => JointType::Prismatic,
        "fixed" => JointType::Fixed,
        "floating" => JointType::Floating,
        "planar" => JointType::Planar,
        "spherical" => JointType::Spherical,
        _ => return None,
    })
}

/// The attributes of an element that say something about kinematics.
pub(super) fn attributes(element: &str) -> &'static [&'static str] {
    match element {
        "origin" => &["xyz", "rpy", "quat_xyzw"],
        "parent" | "child" => &["link"],
        "axis" => &["xyz"],
        "limit" => &["lower", "upper"],
        "mimic" => &["joint", "multiplier", "offset"],
        "joint" | "loop_joint" => &["name", "type"],
        "link1" => &["link", "xyz", "rpy"],
        "link2" => &["link", "xyz"],
        "link" => &["name"],
        _ => &[],
    }
}

/// The attribute that one of another format, or of the first URDF files, stands for.
pub(super) fn other_word(element: &str, attribute: &str) -> Option<&'static str> {
    match (element, attribute) {
        ("limit", "min") => Some("lower"),
        ("limit", "max") => Some("upper"),
        _ => None,
    }
}

/// Elements to which simulators and older URDF dialects add attributes that
/// say nothing about geometry; only misspellings are refused there.
pub(super) fn tolerates_attributes(element: &str) -> bool {
    matches!(element, "limit" | "joint" | "link")
}
