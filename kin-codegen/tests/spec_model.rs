//! What chains are made of: which joints, in which order, moved by what.

use kin_codegen::model::{JointKind, Model};
use kin_codegen::spec::{ArmSpec, Diagnostics, Source};
use kin_runtime::{Pose, Target};
use std::f64::consts::FRAC_PI_2;

fn model(
    path: &str,
    text: &str,
    base: Option<&str>,
    tip: Option<&str>,
) -> Result<Model, Diagnostics> {
    let spec = ArmSpec::parse(&Source {
        path: path.into(),
        text: text.into(),
    })?;
    Model::new(&spec, base, tip)
}

fn urdf(links: &str, joints: &str) -> String {
    let links: String = links
        .split(' ')
        .map(|link| format!("<link name=\"{link}\"/>\n"))
        .collect();
    format!("<robot name=\"arm\">\n{links}{joints}</robot>\n")
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, rest: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{rest}</joint>\n"
    )
}

const LIMIT: &str = r#"<limit lower="-1" upper="1" effort="0" velocity="0"/>"#;

fn accept(text: &str) -> Model {
    model("arm.urdf", text, None, None).unwrap_or_else(|e| panic!("{e}"))
}

/// Two quarter turns that do not commute, one of them on a fixed joint.
#[test]
fn fixed_joints_fold_in_their_order() {
    let text = urdf(
        "base a b tool",
        &[
            joint(
                "j1",
                "continuous",
                "base",
                "a",
                r#"<origin xyz="0 0 1"/><axis xyz="0 0 1"/>"#,
            ),
            joint(
                "f",
                "fixed",
                "a",
                "b",
                r#"<origin xyz="1 0 0" rpy="1.5707963267948966 0 1.5707963267948966"/>"#,
            ),
            joint(
                "j2",
                "continuous",
                "b",
                "tool",
                r#"<origin xyz="0 0 2"/><axis xyz="0 1 0"/>"#,
            ),
        ]
        .concat(),
    );
    let model = accept(&text);
    assert_eq!(model.joints.len(), 2);
    // Rz(90) Rx(90) takes z to x and y to z.
    assert_eq!(model.joints[1].point, [3.0, 0.0, 1.0]);
    assert_eq!(model.joints[1].axis, [0.0, 0.0, 1.0]);
    assert_eq!(
        model.home.rotation,
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    );
    assert_eq!(model.home, model.joints[1].frame);
    assert_eq!(model.variables[0].limits, None);
}

#[test]
#[allow(clippy::approx_constant)] // The rounding is the point.
fn a_rounded_right_angle_is_not_snapped() {
    let rest = r#"<origin xyz="0 0 1" rpy="1.5708 0 0"/><axis xyz="0 0 2"/>"#;
    let model = accept(&urdf(
        "base tool",
        &joint("j", "continuous", "base", "tool", rest),
    ));
    assert_eq!(
        model.joints[0].axis,
        [0.0, -1.5708_f64.sin(), 1.5708_f64.cos()]
    );
}

#[test]
fn quaternion_origins_are_read_in_version_1_1() {
    let rest =
        r#"<origin quat_xyzw="0.7071067811865476 0 0 0.7071067811865476"/><axis xyz="0 0 1"/>"#;
    let text = urdf("base tool", &joint("j", "continuous", "base", "tool", rest));
    let model = accept(&text.replace("<robot ", "<robot version=\"1.1\" "));
    assert_eq!(model.joints[0].axis, [0.0, -1.0, 0.0]);
    assert!(
        FRAC_PI_2.cos() != 0.0,
        "the axis is exact although cos(pi/2) is not"
    );
}

#[test]
fn the_axis_is_x_by_default() {
    let model = accept(&urdf(
        "base tool",
        &joint("j", "prismatic", "base", "tool", LIMIT),
    ));
    assert_eq!(model.joints[0].axis, [1.0, 0.0, 0.0]);
    assert_eq!(model.joints[0].kind, JointKind::Prismatic);
    assert_eq!(model.variables[0].limits, Some([-1.0, 1.0]));
}

#[test]
fn a_continuous_joint_has_no_limits_even_if_the_file_gives_some() {
    let model = accept(&urdf(
        "base tool",
        &joint("j", "continuous", "base", "tool", LIMIT),
    ));
    assert_eq!(model.variables[0].limits, None);
}

#[test]
fn a_bound_that_is_left_out_is_zero_before_version_1_2() {
    let limit = r#"<limit upper="1.5"/>"#;
    let text = urdf("base tool", &joint("j", "revolute", "base", "tool", limit));
    for version in ["", "version=\"1.0\" ", "version=\"1.1\" "] {
        let model = accept(&text.replace("<robot ", &format!("<robot {version}")));
        assert_eq!(model.variables[0].limits, Some([0.0, 1.5]), "{version}");
    }
    // A joint without stops needs none.
    let limit = r#"<limit velocity="2"/>"#;
    let text = urdf(
        "base tool",
        &joint("j", "continuous", "base", "tool", limit),
    );
    let model = accept(&text.replace("<robot ", "<robot version=\"1.2\" "));
    assert_eq!(model.variables[0].limits, None);
}

fn three(mimic1: &str, mimic2: &str, mimic3: &str) -> String {
    let rest = |mimic: &str| format!("<axis xyz=\"0 0 1\"/>{LIMIT}{mimic}");
    urdf(
        "base a b tool",
        &[
            joint("j1", "revolute", "base", "a", &rest(mimic1)),
            joint("j2", "revolute", "a", "b", &rest(mimic2)),
            joint("j3", "revolute", "b", "tool", &rest(mimic3)),
        ]
        .concat(),
    )
}

#[test]
fn mimics_share_a_coordinate() {
    let text = three(
        "",
        r#"<mimic joint="j1" multiplier="-2" offset="0.5"/>"#,
        r#"<mimic joint="j2" multiplier="0.5" offset="0.1"/>"#,
    );
    let model = accept(&text);
    assert_eq!(model.variables.len(), 1);
    assert_eq!(model.variables[0].name, "j1");
    let drives: Vec<_> = model
        .joints
        .iter()
        .map(|j| (j.variable, j.multiplier, j.offset))
        .collect();
    assert_eq!(drives, [(0, 1.0, 0.0), (0, -2.0, 0.5), (0, -1.0, 0.35)]);
}

#[test]
fn a_mimic_can_follow_a_later_joint() {
    let model = accept(&three(r#"<mimic joint="j3"/>"#, "", ""));
    let names: Vec<_> = model.variables.iter().map(|v| v.name.as_str()).collect();
    assert_eq!(names, ["j2", "j3"]);
    assert_eq!(model.joints[0].variable, 1);
}

#[test]
fn limits_of_mimics_narrow_the_coordinate() {
    let model = accept(&three(
        "",
        r#"<mimic joint="j1" multiplier="-2" offset="0.5"/>"#,
        "",
    ));
    // -1 <= -2 q + 0.5 <= 1
    assert_eq!(model.variables[0].limits, Some([-0.25, 0.75]));
}

#[test]
fn what_is_off_the_chain_may_float() {
    let arm = joint(
        "j",
        "revolute",
        "base",
        "tool",
        &format!("<axis xyz=\"0 0 1\"/>{LIMIT}"),
    );
    let hand = joint("f", "floating", "tool", "ball", "")
        + &joint("p", "planar", "tool", "puck", "<axis xyz=\"0 0 1\"/>")
        + &joint("s", "revolute", "tool", "sloppy", "");
    let text = urdf("base tool ball puck sloppy", &(arm + &hand));
    let model =
        model("arm.urdf", &text, Some("base"), Some("tool")).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(model.joints.len(), 1);
}

/// What files in the field carry, and what says nothing about kinematics.
#[test]
fn the_baggage_of_real_files_is_accepted() {
    let text = r#"<?xml version="1.0" encoding="utf-8"?>
<!-- written by hand -->
<robot name="arm" version="1.0" xmlns:xacro="http://www.ros.org/wiki/xacro" xmlns:drake="http://drake.mit.edu">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <mujoco><compiler meshdir="meshes" inertia="${whatever}"/></mujoco>
  <link name="base">
    <inertial><mass value="one"/></inertial>
    <visual><geometry><mesh filename="package://arm/base.stl" scale="0.001 0.001 0.001"/></geometry></visual>
    <visual/>
    <collision><geometry><capsule radius="1"/></geometry></collision>
    <self_collision_checking><origin xyz="0 0 0"/></self_collision_checking>
    <drake:anything/>
  </link>
  <link name="tool" type="laser"/>
  <joint name="j" type="revolute">
    <origin xyz=" 0  0
      1 " rpy="0 0 0"/>
    <parent link="base"/>
    <child link="tool"/>
    <axis xyz="+0 0. 1e0"/>
    <limit lower="-1" upper="1" effort="inf" k_velocity="3"/>
    <dynamics damping="x"/>
    <calibration rising="0"/>
    <safety_controller k_velocity="1"/>
  </joint>
  <transmission name="t"><joint name="j"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint></transmission>
  <gazebo reference="base"><mu1>0.2</mu1></gazebo>
  <gazebo><plugin filename="lib.so" name="p"><robotNamespace>/arm</robotNamespace></plugin></gazebo>
  <ros2_control name="arm" type="system"><joint name="j"><command_interface name="position"/></joint></ros2_control>
  <sensor name="camera"/>
  <drake:collision_filter_group name="g"/>
  <disable_collisions link1="base" link2="tool"/>
</robot>"#;
    assert_eq!(accept(text).joints[0].point, [0.0, 0.0, 1.0]);
}

#[test]
fn a_default_namespace_is_no_obstacle() {
    let text = urdf(
        "base tool",
        &joint("j", "continuous", "base", "tool", r#"<axis xyz="0 0 1"/>"#),
    );
    accept(&text.replace("<robot ", "<robot xmlns=\"http://drake.mit.edu\" "));
}

#[test]
fn byte_order_marks_and_carriage_returns_are_no_obstacle() {
    let text = urdf(
        "base tool",
        &joint("j", "continuous", "base", "tool", r#"<axis xyz="0 0 1"/>"#),
    );
    accept(&format!("\u{feff}{}", text.replace('\n', "\r\n")));
}

/// Both readers of URDF must see the same in what XML allows.
#[test]
fn entities_and_odd_names_are_read_alike() {
    let rest = "<origin xyz='&#48;.5 0\t1'/><axis xyz='0 0 &#x31;'/>";
    let text = urdf(
        "base &lt;tool&gt;",
        &joint("j &amp; k é", "continuous", "base", "&lt;tool&gt;", rest),
    );
    let model = accept(&text);
    assert_eq!(model.joints[0].name, "j & k é");
    assert_eq!(model.joints[0].point, [0.5, 0.0, 1.0]);
    assert_eq!(model.tip, "<tool>");
    let blank = accept(&text.replace("\"base\"", "\" base \""));
    assert_eq!(blank.base, " base ");
}

#[test]
fn a_fixed_joint_may_have_a_zero_axis() {
    let moving = joint("j", "continuous", "base", "a", "");
    let fixed = joint(
        "f",
        "fixed",
        "a",
        "tool",
        r#"<axis xyz="0 0 0"/><limit lower="0" upper="0" effort="0" velocity="0"/>"#,
    );
    assert_eq!(
        accept(&urdf("base a tool", &(moving + &fixed)))
            .joints
            .len(),
        1
    );
}

#[test]
fn the_robot_is_named_after_its_file_if_it_has_no_name() {
    let text = urdf("base tool", &joint("j", "continuous", "base", "tool", ""))
        .replace(" name=\"arm\"", "");
    assert_eq!(
        model("my_arm.urdf", &text, None, None).map(|m| m.name),
        Ok("my_arm".into()).map_err(|e: Diagnostics| e)
    );
}

fn yaml(text: &str) -> Model {
    model("arm.yaml", text, None, None).unwrap_or_else(|e| panic!("{e}"))
}

/// One arm in all four conventions.
#[test]
fn the_four_ways_describe_the_same_arm() {
    let head = "robot: arm\nunits: {angle: deg, length: mm}\n";
    let screws = "screws:\n  - {name: a, axis: [0, 0, 2], point: [0, 0, 7]}\n  - {name: b, axis: [0, -1, 0], point: [0, 0, 400]}\nhome: {xyz: [300, 0, 400], rpy: [90, 0, 0]}\n";
    let dh = "dh:\n  - {name: a, theta: 0, d: 400, a: 0, alpha: 90}\n  - {name: b, theta: 0, d: 0, a: 300, alpha: 0}\ntip: tip\n";
    let mdh = "mdh:\n  - {name: a, theta: 0, d: 400, a: 0, alpha: 0}\n  - {name: b, d: 0, a: 0, alpha: 90}\ntip: {link: tip, xyz: [300, 0, 0]}\n";
    let joints = "joints:\n  - {name: a, axis: [0, 0, 1]}\n  - {name: b, xyz: [0, 0, 400], rpy: [90, 0, 0], axis: [0, 0, 1]}\ntip: {link: tip, xyz: [300, 0, 0]}\n";
    for convention in [screws, dh, mdh, joints] {
        let model = yaml(&format!("{head}{convention}"));
        assert_eq!(
            (model.base.as_str(), model.tip.as_str()),
            ("base", "tip"),
            "{convention}"
        );
        assert_eq!(model.home.translation, [0.3, 0.0, 0.4], "{convention}");
        assert_eq!(
            model.home.rotation,
            [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
            "{convention}"
        );
        assert_eq!(model.joints[0].axis, [0.0, 0.0, 1.0], "{convention}");
        assert_eq!(model.joints[1].axis, [0.0, -1.0, 0.0], "{convention}");
        assert_eq!(model.joints[1].point, [0.0, 0.0, 0.4], "{convention}");
    }
}

/// The arm stands on a table, turned by 90 degrees.
#[test]
fn the_base_pose_carries_the_whole_chain() {
    let head = "robot: arm\nunits: {angle: rad, length: m}\nbase: {link: table, xyz: [0, 0, 1], rpy: [0, 0, pi/2]}\n";
    let screws = "screws:\n  - {name: a, axis: [0, 0, 1], point: [0, 0, 0]}\n  - {name: b, axis: [1, 0, 0], point: [2, 0, 0]}\nhome: {xyz: [3, 0, 0]}\n";
    let joints = "joints:\n  - {name: a, axis: [0, 0, 1]}\n  - {name: b, xyz: [2, 0, 0], axis: [1, 0, 0]}\ntip: {link: tip, xyz: [1, 0, 0]}\n";
    for convention in [screws, joints] {
        let model = yaml(&format!("{head}{convention}"));
        assert_eq!(model.base, "table");
        assert_eq!(model.joints[1].axis, [0.0, 1.0, 0.0], "{convention}");
        assert_eq!(model.joints[1].point, [0.0, 2.0, 1.0], "{convention}");
        assert_eq!(model.home.translation, [0.0, 3.0, 1.0], "{convention}");
    }
}

#[test]
fn link_frames_of_screws_are_the_base_frame_at_home() {
    let model = yaml(
        "robot: arm\nunits: {angle: rad, length: m}\nscrews:\n  - {name: a, axis: [0, 0, 1], point: [0.1, 0.7, 0.3]}\nhome: {xyz: [1, 0, 0]}\n",
    );
    assert_eq!(model.joints[0].frame, Pose::IDENTITY);
}

#[test]
fn orientations_have_three_notations() {
    let head =
        "robot: arm\nunits: {angle: rad, length: m}\njoints:\n  - {name: a, axis: [0, 0, 1]}\n";
    let tips = [
        "rpy: [0, 0, pi/2]",
        "quat_xyzw: [0, 0, 0.70710678, 0.70710678]",
        "matrix: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]",
    ];
    for tip in tips {
        let model = yaml(&format!("{head}tip: {{link: tool, {tip}}}\n"));
        assert_eq!(
            model.home.rotation,
            [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            "{tip}"
        );
    }
}

#[test]
fn prismatic_parameters_and_limits_are_lengths() {
    let model = yaml(
        "robot: arm\nunits: {angle: deg, length: mm}\ndh:\n  - {name: lift, type: prismatic, theta: 90, d: 100, a: 50, alpha: 0, limits: [-100, 200]}\n",
    );
    assert_eq!(model.joints[0].kind, JointKind::Prismatic);
    assert_eq!(model.variables[0].limits, Some([-0.1, 0.2]));
    assert_eq!(model.home.translation, [0.0, 0.05, 0.1]);
}

#[test]
fn mimics_between_kinds_have_the_units_of_the_file() {
    let model = yaml(
        "robot: arm\nunits: {angle: deg, length: mm}\njoints:\n  - {name: screw, axis: [0, 0, 1]}\n  - {name: nut, type: prismatic, axis: [0, 0, 1], mimic: {joint: screw, multiplier: 0.01, offset: 5}}\n",
    );
    // 0.01 mm per degree.
    let nut = &model.joints[1];
    assert!((nut.multiplier - 1e-5_f64.to_degrees()).abs() < 1e-18);
    assert_eq!(nut.offset, 0.005);
}

#[test]
fn yaml_joints_can_branch() {
    let text = "robot: arm\nunits: {angle: rad, length: m}\njoints:\n  - {name: a, axis: [0, 0, 1]}\n  - {name: b, axis: [0, 1, 0]}\n  - {name: camera, type: fixed, parent: a_link, xyz: [0, 0, 1]}\n";
    // The camera hangs on the way.
    let arm = model("arm.yaml", text, None, None).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((arm.tip.as_str(), arm.joints.len()), ("b_link", 2));
    let camera = model("arm.yaml", text, None, Some("camera_link"));
    let camera = camera.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(camera.joints.len(), 1);
}

/// Joints on another branch that those of the chain mimic: `left` and, if it is there, `middle`
/// of the chain to `right`.
fn led_from_aside(middle: &str) -> Model {
    let text = urdf(
        "base a left right tool",
        &[
            joint("turn", "continuous", "base", "a", ""),
            joint("left", "prismatic", "a", "left", r#"<limit lower="0" upper="0.04" velocity="0.5"/>"#),
            joint(
                "right",
                "prismatic",
                "a",
                "right",
                r#"<limit lower="-1" upper="1" velocity="2"/><mimic joint="left" multiplier="-2" offset="0.01"/>"#,
            ),
            joint("tool", "prismatic", "right", "tool", middle),
        ]
        .concat(),
    );
    model("arm.urdf", &text, None, Some("tool")).unwrap()
}

/// What alone follows a joint on another branch is a coordinate itself, and the limits of that one
/// hold.
#[test]
fn a_joint_may_mimic_one_off_the_chain() {
    let model = led_from_aside(LIMIT);
    let names: Vec<&str> = model.variables.iter().map(|v| v.name.as_str()).collect();
    assert_eq!(names, ["turn", "right", "tool"]);
    let [lower, upper] = model.variables[1].limits.unwrap();
    assert!((lower + 0.07).abs() < 1e-15 && upper == 0.01);
    assert_eq!(model.variables[1].rating.velocity, Some(1.0));
    assert!(!model.is_coupled());
}

#[test]
fn a_joint_off_the_chain_can_lead_several() {
    let model = led_from_aside(r#"<limit lower="-1" upper="1"/><mimic joint="left"/>"#);
    let names: Vec<&str> = model.variables.iter().map(|v| v.name.as_str()).collect();
    assert_eq!(names, ["turn", "left"]);
    assert_eq!(model.variables[1].limits, Some([0.0, 0.04]));
    let right = &model.joints[1];
    assert_eq!(
        (right.variable, right.multiplier, right.offset),
        (1, -2.0, 0.01)
    );
    assert!(model.is_coupled());
}

#[test]
fn a_strut_is_no_arm() {
    let text = urdf(
        "base a b tool0 strut",
        &[
            joint("j1", "continuous", "base", "a", ""),
            joint("j2", "continuous", "a", "b", ""),
            joint("j3", "continuous", "b", "tool0", ""),
            joint(
                "s",
                "continuous",
                "a",
                "strut",
                r#"<mimic joint="j2" multiplier="-0.5"/>"#,
            ),
        ]
        .concat(),
    );
    let model = accept(&text);
    assert_eq!((model.tip.as_str(), model.joints.len()), ("tool0", 3));
    assert!(model.warnings.is_empty());
}

/// Of links that the same joint moves, the field's names in their order.
#[test]
fn the_tip_has_a_name() {
    let hung = |names: &[&str]| {
        let links = ["base", "a", "b", "c", "flange_of_arm"].iter().chain(names);
        let links: Vec<&str> = links.copied().collect();
        let mut joints = [
            joint("j1", "continuous", "base", "a", ""),
            joint("j2", "continuous", "a", "b", ""),
            joint("j3", "continuous", "b", "c", ""),
            joint("j4", "continuous", "c", "flange_of_arm", ""),
        ]
        .concat();
        for name in names {
            joints += &joint(&format!("to_{name}"), "fixed", "flange_of_arm", name, "");
        }
        accept(&urdf(&links.join(" "), &joints))
    };
    for (names, tip, warnings) in [
        (
            &["camera", "robot_flange", "robot_tool0"][..],
            "robot_tool0",
            0,
        ),
        (&["ee_link", "robot-tcp"], "robot-tcp", 0),
        (&["camera", "l_end_effector"], "l_end_effector", 0),
        (&["whatever"], "whatever", 0),
        // Not behind a prefix, but inside of a word.
        (&["wheel", "steel"], "flange_of_arm", 1),
        (&[], "flange_of_arm", 0),
        // What hangs beside the tip is none, unless it alone has the name of one.
        (&["camera_optical_frame"], "flange_of_arm", 0),
        (&["link3_collision"], "flange_of_arm", 0),
        (&["ledge"], "ledge", 0),
        (&["plate", "camera_link"], "plate", 0),
        (&["camera_tcp", "gripper_tcp"], "gripper_tcp", 0),
        (&["camera_tcp", "robot_ee"], "robot_ee", 0),
        (&["camera_tcp"], "camera_tcp", 0),
        (&["camera1_link"], "flange_of_arm", 0),
        (&["plate", "camera2"], "plate", 0),
        // The same name twice.
        (&["x_tool0", "tool0"], "tool0", 0),
        (&["left_tcp", "right_tcp"], "left_tcp", 1),
    ] {
        let model = hung(names);
        assert_eq!(
            (model.tip.as_str(), model.warnings.len()),
            (tip, warnings),
            "{names:?}"
        );
    }
}

/// A camera that hangs on what would be the tip leaves it that.
#[test]
fn what_carries_a_camera_is_a_leaf() {
    let joints = [
        joint("j1", "continuous", "base", "a", ""),
        joint("j2", "continuous", "a", "b", ""),
        joint("j3", "continuous", "b", "c", ""),
        joint("j4", "continuous", "c", "d", ""),
        joint("bolts", "fixed", "d", "plate", ""),
        joint("eye", "fixed", "plate", "camera1_link", ""),
    ];
    let arm = accept(&urdf("base a b c d plate camera1_link", &joints.concat()));
    assert_eq!((arm.tip.as_str(), arm.warnings.len()), ("plate", 0));
}

/// A head carries a camera as its tool, and what a file calls the tip is it.
#[test]
fn a_camera_may_be_the_tip() {
    let joints = [
        joint("pan", "continuous", "base", "a", ""),
        joint("tilt", "continuous", "a", "b", ""),
        joint("eye", "fixed", "b", "camera", ""),
    ];
    let head = accept(&urdf("base a b camera", &joints.concat()));
    assert_eq!((head.tip.as_str(), head.warnings.len()), ("camera", 0));
    let rows = "  - {name: a, axis: [0, 0, 1]}\n  - {name: b, xyz: [1, 0, 0], axis: [0, 1, 0]}\n  \
                - {name: c, xyz: [1, 0, 0], axis: [0, 1, 0]}\n  - {name: d, axis: [1, 0, 0]}\n";
    let text = format!(
        "robot: arm\nunits: {{angle: deg, length: m}}\njoints:\n{rows}tip: {{link: camera, xyz: [0, 0, \
         0.1]}}\n"
    );
    assert_eq!(yaml(&text).tip, "camera");
}

/// The fixed jaw of a gripper is often all that a wrist moves.
#[test]
fn a_wrist_may_carry_a_jaw() {
    let tip = |line: &[(&str, &str)]| {
        let links: Vec<&str> = line.iter().map(|(_, link)| *link).collect();
        let parents = ["base"].iter().chain(&links);
        let joints: String = line
            .iter()
            .zip(parents)
            .map(|((name, child), parent)| joint(name, "continuous", parent, child, ""))
            .collect();
        accept(&urdf(&format!("base {}", links.join(" ")), &joints)).tip
    };
    let arm = [("pan", "a"), ("lift", "b"), ("elbow", "c")];
    for (behind, expected) in [
        (
            &[("wrist_roll", "Fixed_Jaw"), ("gripper", "Moving_Jaw")][..],
            "Fixed_Jaw",
        ),
        (&[("5", "claw_base"), ("6", "claw")], "claw_base"),
        (&[("gripper_rotate", "d"), ("jaw", "e")], "d"),
        (
            &[("finger_roll", "finger_link"), ("gripper", "e")],
            "finger_link",
        ),
        // A gripper that is driven in two steps.
        (&[("wrist", "d"), ("gripper_drive", "e"), ("jaw", "f")], "d"),
        (&[("wrist", "d"), ("last", "finger")], "d"),
        // The last joint turns what a gripper hangs on, or the tool.
        (&[("wrist", "d"), ("gripper_roll", "palm")], "palm"),
        (&[("wrist", "d"), ("wrist_to_gripper", "e")], "e"),
        (&[("wrist", "d"), ("gripper_yaw", "ee_link")], "ee_link"),
        (&[("wrist", "d"), ("gripper", "tool0")], "tool0"),
        (&[("gripperTilt", "d"), ("gripperTurn", "e")], "e"),
        (&[("wrist", "d"), ("gripper", "e")], "d"),
        (&[("wrist", "d"), ("thumb_yaw", "e")], "d"),
        (&[("wrist", "d"), ("finger_roll", "e")], "d"),
        // A jaw that does not move hangs on a wrist, not on a finger.
        (
            &[("wrist_flex", "d"), ("wrist_roll", "jaw_link")],
            "jaw_link",
        ),
        (
            &[("wrist_flex", "d"), ("roll", "finger_base")],
            "finger_base",
        ),
        (&[("wrist_flex", "d"), ("thumb_roll", "finger_base")], "d"),
        (&[("wrist_flex", "d"), ("5", "jaw_link")], "d"),
    ] {
        assert_eq!(tip(&[&arm, behind].concat()), expected, "{behind:?}");
    }
    let finger = [
        ("finger_base", "a"),
        ("finger_middle", "b"),
        ("finger_tip", "finger"),
    ];
    assert_eq!(tip(&finger), "finger");
    // All of a finger, also of two joints, and of four that are called otherwise.
    assert_eq!(tip(&finger[1..]), "finger");
    let four = [
        ("0", "pip"),
        ("1", "mcp"),
        ("2", "dip"),
        ("3", "Finger_Tip_2"),
    ];
    assert_eq!(tip(&four), "Finger_Tip_2");
    let jaw = [&arm[..], &[("wrist", "d"), ("5", "fingertip")]].concat();
    assert_eq!(tip(&jaw), "d");
}

/// Two jaws that slide by themselves hang on a joint of the arm, whatever it is called; one that drives
/// them, or of a finger, is none.
#[test]
fn what_jaws_slide_on_is_no_finger() {
    let slide = |name: &str, parent: &str, child: &str, mimic: &str| {
        let inner = format!(r#"<limit lower="0" upper="0.04"/>{mimic}"#);
        joint(name, "prismatic", parent, child, &inner)
    };
    let tip_of = |name: &str, kind: &str, behind: String| {
        let arm = [
            joint("elbow", "continuous", "base", "a", ""),
            joint("wrist", "continuous", "a", "b", ""),
            joint(name, kind, "b", "claw_base", ""),
        ]
        .concat();
        accept(&urdf("base a b claw_base l r", &(arm + &behind))).tip
    };
    let tip = |kind: &str, behind: String| tip_of("claw_base_joint", kind, behind);
    let jaws = |mimic: &str| {
        slide("claw_left", "claw_base", "l", mimic) + &slide("claw_right", "claw_base", "r", mimic)
    };
    assert_eq!(tip("continuous", jaws("")), "claw_base");
    assert_eq!(
        tip("continuous", jaws(r#"<mimic joint="claw_base_joint"/>"#)),
        "b"
    );
    let fingers = joint("claw_left", "continuous", "claw_base", "l", "")
        + &joint("claw_right", "continuous", "claw_base", "r", "");
    assert_eq!(tip("continuous", fingers.clone()), "b");
    // Behind a joint that is not called one they turn.
    assert_eq!(tip_of("joint_3", "continuous", fingers), "claw_base");
    let one = joint("claw_left", "continuous", "claw_base", "l", "");
    let driven = one
        + &joint(
            "claw_right",
            "continuous",
            "claw_base",
            "r",
            r#"<mimic joint="claw_left"/>"#,
        );
    assert_eq!(tip_of("joint_3", "continuous", driven), "claw_base");
}

/// A hoist may carry a gripper and have its name; no finger goes so far.
#[test]
fn a_long_slide_is_no_finger() {
    let tip = |upper: f64| {
        let limit = |upper: f64| format!(r#"<limit lower="0" upper="{upper}"/>"#);
        let joints = [
            joint("slew", "continuous", "base", "jib", ""),
            joint("trolley", "prismatic", "jib", "carriage", &limit(1.2)),
            joint(
                "to_gripper",
                "prismatic",
                "carriage",
                "gripper",
                &limit(upper),
            ),
        ];
        accept(&urdf("base jib carriage gripper", &joints.concat())).tip
    };
    assert_eq!(tip(1.2), "gripper");
    assert_eq!(tip(0.1), "carriage");
}

/// A gripper on a flange beside which a tool hangs: either may be meant, and the warning names both.
#[test]
fn a_tool_before_the_fingers_is_named() {
    let limbs = limbs(&[("base", "arm", 6)]);
    let more = [
        joint("tool", "fixed", "arm6", "tool0", ""),
        joint("grip", "fixed", "arm6", "hand", ""),
        joint("open_l", "prismatic", "hand", "l", LIMIT),
        joint("open_r", "prismatic", "hand", "r", LIMIT),
    ];
    let links = ["tool0", "hand", "l", "r"].map(|link| format!("<link name=\"{link}\"/>"));
    let more = links.concat() + &more.concat() + "</robot>";
    let read = accept(&limbs.replace("</robot>", &more));
    assert_eq!((read.tip.as_str(), read.joints.len()), ("hand", 6));
    let remedy = "name the tip if you mean another one, such as `tool0` (tip)";
    assert!(
        read.warnings.iter().any(|it| it.remedy == remedy),
        "{:?}",
        read.warnings
    );
}

/// A link that is named as a gripper is a jaw by limits that open to one side; a wrist may carry it.
#[test]
fn a_gripper_that_opens_is_a_jaw() {
    let tip = |name: &str, limit: &str, hanging: &str| {
        let names = ["pan", "lift", "elbow", "wrist"];
        let links = ["base", "a", "b", "c", "d"];
        let mut joints: String = (0..4)
            .map(|i| joint(names[i], "continuous", links[i], links[i + 1], ""))
            .collect();
        joints += &joint(name, "revolute", "d", "gripper_link", limit);
        joints += hanging;
        accept(&urdf("base a b c d gripper_link tcp", &joints)).tip
    };
    let limit = |lower: f64, upper: f64| format!(r#"<limit lower="{lower}" upper="{upper}"/>"#);
    let aside = joint("fix", "fixed", "base", "tcp", "");
    for (lower, upper) in [(-1.75, 0.0), (0.0, 1.2), (-0.1, 2.0)] {
        assert_eq!(tip("joint_5", &limit(lower, upper), &aside), "d");
        assert_eq!(
            tip("wrist_roll", &limit(lower, upper), &aside),
            "gripper_link"
        );
        let tool = joint("fix", "fixed", "gripper_link", "tcp", "");
        assert_eq!(tip("joint_5", &limit(lower, upper), &tool), "tcp");
    }
    for (lower, upper) in [(-1.75, 1.75), (0.0, 3.0), (-0.1, 0.1), (0.5, 1.5)] {
        assert_eq!(tip("joint_5", &limit(lower, upper), &aside), "gripper_link");
    }
}

/// What hangs between the jaws is called in many ways.
#[test]
fn a_frame_between_jaws_is_the_tip() {
    let limbs = limbs(&[("base", "arm", 6)]);
    let read = |frame: &str| {
        let more = [
            joint("open_l", "prismatic", "arm6", "l", LIMIT),
            joint("open_r", "prismatic", "arm6", "r", LIMIT),
            joint("between", "fixed", "arm6", frame, ""),
        ];
        let links = [frame, "l", "r"].map(|link| format!("<link name=\"{link}\"/>"));
        let more = links.concat() + &more.concat() + "</robot>";
        accept(&limbs.replace("</robot>", &more))
    };
    for frame in ["tool_tip_link", "left_gripper_center", "grasping_point"] {
        assert_eq!(read(frame).tip, frame);
    }
    let other = read("gripper_middle");
    let remedy = "name the tip if you mean another one, such as `gripper_middle` (tip)";
    assert_eq!(
        (other.tip.as_str(), &*other.warnings[0].remedy),
        ("arm6", remedy)
    );
}

/// Fingers on an arm of fewer joints than those that carry a hand elsewhere were told as two arms,
/// the same in every word.
#[test]
fn an_arm_that_is_found_twice_is_one() {
    let stroke = r#"<limit lower="0" upper="0.04"/>"#;
    let grip = |parents: [&str; 2]| {
        [
            joint("j1", "continuous", "base", "a", ""),
            joint("j2", "continuous", "a", "palm", ""),
            joint("mount", "fixed", "palm", "plate", ""),
            joint("open_l", "prismatic", parents[0], "l", stroke),
            joint("open_r", "prismatic", parents[1], "r", stroke),
        ]
        .concat()
    };
    for (parents, carrier) in [
        (["palm", "palm"], "palm"),
        (["plate", "plate"], "plate"),
        (["plate", "palm"], "palm"),
    ] {
        let model = accept(&urdf("base a palm plate l r", &grip(parents)));
        assert_eq!((model.tip.as_str(), model.joints.len()), (carrier, 2));
        let warned = &model.warnings[0].reason;
        assert!(
            warned.contains(
                "the joints `open_l`, `open_r` look like those of a gripper and are left out"
            ),
            "{warned}"
        );
    }
    // Beside another arm it is listed once.
    let beside = grip(["palm", "palm"]) + &joint("pan", "continuous", "base", "camera", "");
    let refused = model(
        "arm.urdf",
        &urdf("base a palm plate l r camera", &beside),
        None,
        None,
    );
    let said = refused.unwrap_err().to_string();
    assert!(
        said.contains("2 chains of joints begin at `base`"),
        "{said}"
    );
    assert_eq!(said.matches("tip `palm`").count(), 1, "{said}");
}

/// A robot of limbs: the link that each begins at, what it is called, and its joints.
fn limbs(limbs: &[(&str, &str, usize)]) -> String {
    let mut links = vec!["base".to_owned()];
    let mut joints = String::new();
    for (base, limb, count) in limbs {
        let mut parent = (*base).to_owned();
        for i in 1..=*count {
            let child = format!("{limb}{i}");
            joints += &joint(&format!("to_{child}"), "continuous", &parent, &child, "");
            links.push(child.clone());
            parent = child;
        }
    }
    urdf(&links.join(" "), &joints)
}

/// Wheels in front of it in the file once hid the arm behind "and 1 more".
#[test]
fn one_arm_on_a_mobile_robot_is_the_arm() {
    let robot = limbs(&[
        ("base", "caster", 2),
        ("base", "torso", 1),
        ("torso1", "head", 2),
        ("torso1", "arm", 5),
        ("base", "wheel", 1),
    ]);
    let model = accept(&robot);
    assert_eq!((model.tip.as_str(), model.joints.len()), ("arm5", 6));
    let [warning] = &model.warnings[..] else {
        panic!("{:?}", model.warnings)
    };
    assert_eq!(
        warning.reason,
        "the arm is taken from `base` to `arm5`, the longest chain: those to `head2`, `caster2`, \
         `wheel1` are passed over"
    );
    assert_eq!(
        warning.remedy,
        "name the end of another one if you mean it (tip), and where it begins (base)"
    );
}

#[test]
fn a_short_arm_beside_wheels_is_the_arm() {
    let robot = |joints| {
        limbs(&[
            ("base", "left_wheel_", 1),
            ("base", "caster_", 3),
            ("base", "arm", joints),
            ("base", "RightWheel", 1),
        ])
    };
    for joints in [3, 4] {
        let model = accept(&robot(joints));
        assert_eq!(model.tip, format!("arm{joints}"));
        let reason = &model.warnings[0].reason;
        assert!(reason.ends_with("are passed over"), "{reason}");
    }
    // Not a wheel of the most joints.
    let all = limbs(&[("base", "wheel", 3), ("base", "caster", 1)]);
    let said = model("arm.urdf", &all, None, None).unwrap_err();
    assert!(
        said.to_string().contains("2 chains of joints begin"),
        "{said}"
    );
}

/// What carries both, a simulator's base and a torso, once made an arm of a head.
#[test]
fn a_head_on_what_carries_the_arm_is_no_arm() {
    let carrying = |head| {
        limbs(&[
            ("base", "torso", 4),
            ("torso4", "head", head),
            ("torso4", "arm", 7),
        ])
    };
    let read = accept(&carrying(2));
    assert_eq!((read.tip.as_str(), read.joints.len()), ("arm7", 11));
    assert!(read.warnings[0].reason.contains("to `head2` is passed"));
    // Three joints of its own carry a point anywhere.
    let said = model("arm.urdf", &carrying(3), None, None);
    let said = said.unwrap_err().to_string();
    assert!(said.contains("2 chains of joints begin"), "{said}");
}

/// A drawer is as long as it slides, whatever its frames are.
#[test]
fn what_slides_far_is_not_short() {
    let sliding = |upper: &str| {
        let limit = format!("<origin xyz=\"0.0056 0 0\"/><limit lower=\"0\" upper=\"{upper}\"/>");
        accept(&urdf("a b", &joint("slide", "prismatic", "a", "b", &limit)))
    };
    assert!(sliding("0.1").warnings.is_empty());
    let short = sliding("0.001");
    assert!(short.warnings[0].reason.contains("5.6000 mm long"));
}

/// What is listed of several chains is what each would have for its tip alone.
#[test]
fn the_tips_of_legs_are_their_feet() {
    let legs = limbs(&[("base", "left", 3), ("base", "right", 3)]);
    let foot = |side: &str| {
        joint(
            side,
            "fixed",
            &format!("{side}3"),
            &format!("{side}_foot"),
            "",
        )
    };
    let feet = format!(
        "<link name=\"left_foot\"/><link name=\"right_foot\"/>{}{}</robot>",
        foot("left"),
        foot("right")
    );
    let legs = legs.replace("</robot>", &feet);
    let said = model("arm.urdf", &legs, None, None)
        .unwrap_err()
        .to_string();
    assert!(said.contains("tip `left_foot`: 3 moving"), "{said}");
    assert!(said.contains("tip `right_foot`: 3 moving"), "{said}");
}

/// A simulator's robots stand on a joint that goes anywhere: no chain has it, and the arm begins
/// behind it. Where little is left then, what floats may be the arm.
#[test]
fn an_arm_may_stand_on_what_goes_anywhere() {
    for kind in ["planar", "floating"] {
        let on = |robot: String| {
            let drive = joint("drive", kind, "ground", "cart", "");
            let robot = robot.replace("\"base\"", "\"cart\"");
            robot.replace(
                "</robot>",
                &format!("<link name=\"ground\"/>{drive}</robot>"),
            )
        };
        let arm = accept(&on(limbs(&[("base", "arm", 6), ("base", "wheel", 1)])));
        assert_eq!((arm.base.as_str(), arm.tip.as_str()), ("cart", "arm6"));
        let reason = &arm.warnings[0].reason;
        let said = "the base is `cart`: joint `drive`, which ";
        assert!(reason.starts_with(said), "{reason}");
        let few = on(limbs(&[("base", "arm", 2)]));
        let said = model("arm.urdf", &few, None, None).unwrap_err().to_string();
        assert!(
            said.contains("begin the chain behind it (base = \"cart\")"),
            "{said}"
        );
    }
}

/// A thumb of five joints beside fingers of four once made each finger an arm.
#[test]
fn a_hand_may_have_a_long_thumb() {
    let robot = limbs(&[
        ("base", "arm", 6),
        ("arm6", "index", 4),
        ("arm6", "middle", 4),
        ("arm6", "thumb", 5),
    ]);
    let read = accept(&robot);
    assert_eq!((read.tip.as_str(), read.joints.len()), ("arm6", 6));
    assert!(read.warnings[0].reason.contains("left out"));
    // As the hand of a TIAGo has, of which a file tells every joint that a tendon moves.
    let fingers = ["index", "middle", "ring", "little", "thumb"];
    let robot: Vec<_> = [("base", "arm", 8)]
        .into_iter()
        .chain(fingers.map(|finger| ("arm8", finger, 7)))
        .collect();
    assert_eq!(accept(&limbs(&robot)).tip, "arm8");
    for (robot, chains) in [
        // Two limbs are no hand, nor are those of a torso shorter than they are.
        (
            limbs(&[
                ("base", "arm", 6),
                ("arm6", "left", 5),
                ("arm6", "right", 5),
            ]),
            2,
        ),
        (
            limbs(&[
                ("base", "torso", 4),
                ("torso4", "left", 5),
                ("torso4", "right", 5),
                ("torso4", "head", 2),
            ]),
            3,
        ),
    ] {
        let said = model("arm.urdf", &robot, None, None)
            .unwrap_err()
            .to_string();
        assert!(
            said.contains(&format!("{chains} chains of joints")),
            "{said}"
        );
    }
}

#[test]
fn what_may_be_another_arm_is_not_passed_over() {
    for (robot, first) in [
        (limbs(&[("base", "arm", 6), ("base", "other", 6)]), "arm6"),
        (limbs(&[("base", "leg", 3), ("base", "arm", 6)]), "arm6"),
        (limbs(&[("base", "arm", 6), ("arm2", "other", 2)]), "arm6"),
        (limbs(&[("base", "head", 1), ("base", "arm", 4)]), "arm4"),
        (limbs(&[("base", "wheel", 1), ("base", "arm", 2)]), "arm2"),
        // A hand.
        (
            limbs(&[("base", "finger", 2), ("base", "thumb", 5)]),
            "thumb5",
        ),
    ] {
        let said = model("arm.urdf", &robot, None, None)
            .unwrap_err()
            .to_string();
        let listed = said.lines().nth(1).unwrap();
        assert!(said.contains("2 chains of joints begin at"), "{said}");
        assert!(listed.contains(&format!("tip `{first}`")), "{said}");
    }
}

/// The last slide of a SCARA or a gantry is often as short as that of a finger.
#[test]
fn a_short_slide_may_be_the_arms() {
    let turn = |rpy: &str| format!(r#"<origin xyz="0.2 0 0" rpy="{rpy}"/><axis xyz="0 0 1"/>"#);
    let slide = |axis: &str, upper: f64| {
        format!(r#"<axis xyz="{axis}"/><limit lower="0" upper="{upper}" effort="1" velocity="1"/>"#)
    };
    let tip = |joints: &[(&str, String)], rest: &str| {
        let mut links = "base l1".to_owned();
        let mut text = joint("j1", "continuous", "base", "l1", &turn("0 0 0"));
        for (i, (kind, rest)) in (2..).zip(joints) {
            let [parent, child] = [i - 1, i].map(|i| format!("l{i}"));
            text += &joint(&format!("j{i}"), kind, &parent, &child, rest);
            links += &format!(" {child}");
        }
        for link in ["tool0", "left", "right"] {
            if rest.contains(&format!("\"{link}\"")) {
                links += &format!(" {link}");
            }
        }
        let model = accept(&urdf(&links, &(text + rest)));
        (model.tip, model.joints.len())
    };
    let flat = ("continuous", turn("0 0 1"));
    let tilted = ("continuous", turn("1.5708 0 0"));
    let quill = ("prismatic", slide("0 0 -1", 0.1));
    let across = ("prismatic", slide("1 0 0", 0.1));
    let tool = joint("hold", "fixed", "l3", "tool0", "");
    // By the link that it moves.
    let line = [tilted.clone(), quill.clone()];
    assert_eq!(tip(&line, &tool), ("tool0".into(), 3));
    assert_eq!(tip(&line, ""), ("l2".into(), 2));
    // By the axes before it.
    assert_eq!(
        tip(&[flat.clone(), quill.clone()], ""),
        ("l3".into(), 3),
        "a SCARA"
    );
    assert_eq!(tip(&[flat.clone(), across], ""), ("l2".into(), 2));
    let about_x = "1.5708 0 0";
    let turned = format!(r#"<origin rpy="{about_x}"/>"#) + &slide("0 1 0", 0.1);
    let line = [flat.clone(), flat.clone(), ("prismatic", turned)];
    assert_eq!(tip(&line, ""), ("l4".into(), 4), "in a turned frame");
    assert_eq!(
        tip(std::slice::from_ref(&quill), ""),
        ("l1".into(), 1),
        "one joint has no parallel"
    );
    // With a gripper behind it.
    let grip = ["left", "right"]
        .map(|side| joint(side, "prismatic", "l3", side, &slide("0 1 0", 0.02)))
        .concat();
    assert_eq!(tip(&[flat, quill], &grip), ("l3".into(), 3));
}

#[test]
fn of_very_many_ends_some_are_listed() {
    let names: Vec<String> = (0..150).map(|i| format!("leg{i}")).collect();
    let joints = names
        .iter()
        .map(|name| joint(&format!("to_{name}"), "continuous", "base", name, ""));
    let text = urdf(
        &format!("base {}", names.join(" ")),
        &joints.collect::<String>(),
    );
    let said = model("arm.urdf", &text, None, None)
        .unwrap_err()
        .to_string();
    assert!(
        said.contains("100 or more chains of joints begin at `base`"),
        "{said}"
    );
    assert!(said.contains("and more"), "{said}");
}

/// A rating of 0 says that nobody knew. Of joints that move together, the
/// slowest sets the pace.
#[test]
fn a_coordinate_is_as_fast_as_all_that_follows_it() {
    let rated = |velocity: &str, effort: &str, mimic: &str| {
        format!(
            r#"<axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="{velocity}" effort="{effort}"/>{mimic}"#
        )
    };
    let ratings = |first: &str, second: &str| {
        let mimic = r#"<mimic joint="j1" multiplier="-2" offset="0.5"/>"#;
        let joints = [
            joint("j1", "revolute", "base", "a", &rated(first, "7", "")),
            joint("j2", "revolute", "a", "b", &rated(second, "90", mimic)),
            joint("j3", "revolute", "b", "tool", &rated("0", "0", "")),
        ];
        let model = accept(&urdf("base a b tool", &joints.concat()));
        let rating = |i: usize| {
            (
                model.variables[i].rating.velocity,
                model.variables[i].rating.effort,
            )
        };
        assert_eq!(rating(1), (None, None));
        rating(0)
    };
    assert_eq!(ratings("3", "4"), (Some(2.0), Some(7.0)));
    assert_eq!(ratings("1.5", "4"), (Some(1.5), Some(7.0)));
    assert_eq!(ratings("0", "4"), (Some(2.0), Some(7.0)));
    assert_eq!(ratings("3", "0"), (Some(3.0), Some(7.0)));
}

#[test]
fn yaml_ratings_have_the_units_of_the_file() {
    let model = yaml(
        "robot: arm\nunits: {angle: deg, length: mm}\njoints:\n  - {name: turn, axis: [0, 0, 1], velocity: 90, effort: 28}\n  - {name: slide, type: prismatic, axis: [0, 0, 1], velocity: 250, effort: 400}\n  - {name: unrated, axis: [0, 1, 0]}\n",
    );
    let ratings: Vec<_> = model
        .variables
        .iter()
        .map(|variable| [variable.rating.velocity, variable.rating.effort])
        .collect();
    assert_eq!(
        ratings,
        [
            [Some(FRAC_PI_2), Some(28.0)],
            [Some(0.25), Some(400.0)],
            [None, None]
        ]
    );
}

/// A camera is placed by fixed joints in YAML as in URDF. Behind a joint that
/// cannot be read nothing is known, although the arm does not need it.
#[test]
fn fixed_links_are_frames_of_the_link_that_carries_them() {
    let frames = |model: &Model| -> Vec<(String, Option<usize>, [f64; 3])> {
        let frames = model.frames.iter();
        frames
            .map(|frame| (frame.name.clone(), frame.joint, frame.pose.translation))
            .collect()
    };
    let text = "robot: arm\nunits: {angle: deg, length: mm}\njoints:\n  - {name: a, axis: [0, 0, 1]}\n  - {name: b, axis: [0, 1, 0]}\n  - {name: mount, type: fixed, parent: a_link, xyz: [0, 0, 50], rpy: [0, 90, 0]}\n  - {name: camera, type: fixed, xyz: [25, 0, 0]}\n  - {name: lamp, type: fixed, parent: base, xyz: [0, 500, 0]}\n";
    assert_eq!(
        frames(&yaml(text)),
        [
            ("mount_link".into(), Some(0), [0.0, 0.0, 0.05]),
            ("camera_link".into(), Some(0), [0.0, 0.0, 0.025]),
            ("lamp_link".into(), None, [0.0, 0.5, 0.0]),
        ]
    );
    let text = |origin: &str| {
        let joints = [
            joint("j1", "continuous", "base", "a", ""),
            joint("j2", "continuous", "a", "tool0", ""),
            joint(
                "j3",
                "fixed",
                "a",
                "camera",
                &format!("<origin xyz=\"{origin}\"/>"),
            ),
            joint("j4", "fixed", "camera", "lens", ""),
        ];
        urdf("base a tool0 camera lens", &joints.concat())
    };
    assert_eq!(frames(&accept(&text("0 0 0.1"))).len(), 2);
    assert_eq!(frames(&accept(&text("0 0 O.1"))), []);
}

/// Two arms on a torso, of joints that turn, slide and mimic, with links that hang on them.
fn two_arms() -> ArmSpec {
    let arm = |side: &str, y: f64| {
        let name = |part: &str| format!("{side}_{part}");
        let joint = |part: &str, kind: &str, above: &str, rest: &str| {
            let above = if above == "torso" {
                above.into()
            } else {
                name(above)
            };
            joint(&format!("{side}_{part}_j"), kind, &above, &name(part), rest)
        };
        [
            joint(
                "shoulder",
                "revolute",
                "torso",
                &format!(
                    r#"<origin xyz="0.1 {y} 0.4" rpy="0.3 -0.2 {y}"/><axis xyz="1 2 2"/>{LIMIT}"#
                ),
            ),
            joint(
                "slide",
                "prismatic",
                "shoulder",
                &format!(
                    r#"<origin xyz="0.2 0.3 0" rpy="1 0.5 0.7"/><axis xyz="0 {y} 1"/>{LIMIT}"#
                ),
            ),
            joint(
                "sensor",
                "fixed",
                "slide",
                r#"<origin xyz="0 0.1 0" rpy="0 0.4 0"/>"#,
            ),
            joint(
                "wrist",
                "continuous",
                "sensor",
                &format!(
                    r#"<origin xyz="0.2 0 {y}" rpy="0 1 -0.7"/><axis xyz="0 1 0"/><mimic joint="{side}_shoulder_j" multiplier="{y}" offset="0.25"/>"#
                ),
            ),
            joint(
                "tool",
                "fixed",
                "wrist",
                r#"<origin xyz="0 0 0.1" rpy="0.2 0 0.9"/>"#,
            ),
            joint(
                "camera",
                "fixed",
                "shoulder",
                r#"<origin xyz="0 0 0.3" rpy="0.2 0.7 0.9"/>"#,
            ),
        ]
        .concat()
    };
    let links = ["shoulder", "slide", "sensor", "wrist", "tool", "camera"];
    let links = ["left", "right"].map(|side| links.map(|part| format!("{side}_{part}")));
    let links = links.concat().join(" ");
    let joints = [arm("left", 0.5), arm("right", -0.75)].concat();
    ArmSpec::parse(&Source {
        path: "two_arms.urdf".into(),
        text: urdf(&format!("torso {links}"), &joints),
    })
    .unwrap_or_else(|e| panic!("{e}"))
}

/// Where a link is in the torso's frame.
fn in_torso(spec: &ArmSpec, link: &str, [shoulder, slide]: [f64; 2]) -> Pose {
    if link == "torso" {
        return Pose::IDENTITY;
    }
    let model = Model::new(spec, None, Some(link)).unwrap_or_else(|e| panic!("{e}"));
    let q = &[shoulder, slide][..model.variables.len()];
    model.chain().fk(&model.joint_values(q))
}

/// What is passed upwards turns and slides as the file has it: a hand in the frame of the other
/// is what the two are in that of the torso.
#[test]
fn the_base_may_be_any_link() {
    let spec = two_arms();
    let (left, right) = ([0.4, -0.3], [-0.8, 0.6]);
    let from = |base: &str, tip: &str| {
        Model::new(&spec, Some(base), Some(tip)).unwrap_or_else(|e| panic!("{e}"))
    };
    let near = |a: &Pose, b: &Pose| Target::Pose.distance(a, b, 1.0) < 1e-14;

    let hands = from("left_tool", "right_tool");
    let names: Vec<&str> = hands.variables.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "left_slide_j",
            "left_shoulder_j",
            "right_shoulder_j",
            "right_slide_j"
        ]
    );
    let q = hands.joint_values(&[left[1], left[0], right[0], right[1]]);
    let base = in_torso(&spec, "left_tool", left).inverse();
    assert!(near(
        &hands.chain().fk(&q),
        &(base * in_torso(&spec, "right_tool", right))
    ));
    let links = hands.chain().fk_links(&q);
    for (joint, link) in hands.joints.iter().zip(&links) {
        let (side, _) = joint.link.split_once('_').unwrap_or(("left", ""));
        let own = if side == "left" { left } else { right };
        let there = base * in_torso(&spec, &joint.link, own);
        assert!(near(link, &there), "{}", joint.link);
    }
    for frame in &hands.frames {
        let own = if frame.name.starts_with("left") {
            left
        } else {
            right
        };
        let carrier = frame.joint.map_or(Pose::IDENTITY, |joint| links[joint]);
        let there = base * in_torso(&spec, &frame.name, own);
        assert!(near(&(carrier * frame.pose), &there), "{}", frame.name);
    }
    let frames: Vec<&str> = hands.frames.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(
        frames,
        [
            "left_slide",
            "left_sensor",
            "left_wrist",
            "left_camera",
            "right_sensor",
            "right_wrist",
            "right_tool",
            "right_camera"
        ]
    );

    let up = from("left_tool", "torso");
    let q = up.joint_values(&[left[1], left[0]]);
    assert!(near(&up.chain().fk(&q), &base));
    assert_eq!((up.base.as_str(), up.tip.as_str()), ("left_tool", "torso"));
    assert_eq!(up.joints.last().map(|it| it.link.as_str()), Some("torso"));
}
