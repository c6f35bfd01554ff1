//! The robots: all of `robots/`, some whose files are noisy, some of rare
//! structure, and some of whose targets only a part counts. A property is a function of one robot; it
//! becomes a test for each of them.

/// Compiles robots, and defines a macro `$for_every!(property)` that makes the
/// generic function `property(&Subject<_, N>)` one test for each of them. What
/// of their targets counts can be said behind an arrow.
macro_rules! robots {
    ($files:ident $for_every:ident: $($test:ident $name:ident $path:literal $(=> $target:ident)?)*) => {
        $(kinematics::kinematics!($path, name = $name $(, target = $target)?);)*

        /// Where they are described.
        pub const $files: &[&str] = &[$($path),*];

        macro_rules! $for_every {
            ($property:ident) => {
                mod $property {
                    use crate::{subject::Subject, zoo};
                    $(#[test]
                    fn $test() {
                        let robot = Subject::new(zoo::$name, $path);
                        super::$property(&robot$(.counting(stringify!($target)))?);
                    })*
                }
            };
        }
    };
}

robots! {
    EXACT for_every_robot:
    elbow Elbow "../robots/elbow.yaml"
    inverse_elbow InverseElbow "../robots/inverse_elbow.yaml"
    irb6640 Irb6640 "../robots/irb6640.yaml"
    kr6_r900 Kr6R900 "../robots/kr6_r900.yaml"
    planar_2r Planar2r "../robots/planar_2r.yaml"
    planar_3r Planar3r "../robots/planar_3r.yaml"
    puma560 Puma560 "../robots/puma560.yaml"
    scara Scara "../robots/scara.yaml"
    stanford Stanford "../robots/stanford.yaml"
    tx60 Tx60 "../robots/tx60.yaml"
    ur10e Ur10e "../robots/ur10e.yaml"
    ur5e Ur5e "../robots/ur5e.urdf"
    xarm6 Xarm6 "../robots/xarm6.yaml"
}

robots! {
    NOISY for_every_noisy_robot:
    calibrated Calibrated "robots/noisy/calibrated.yaml"
    rounded_right_angles RoundedRightAngles "robots/noisy/rounded_right_angles.yaml"
    stray_offset StrayOffset "robots/noisy/stray_offset.yaml"
    ten_digits TenDigits "robots/noisy/ten_digits.yaml"
    truncated_pi TruncatedPi "robots/noisy/truncated_pi.yaml"
}

robots! {
    TABLE for_every_table_row:
    concurrent_345 Concurrent345 "robots/table/concurrent_345.yaml"
    nearly_parallel NearlyParallel "robots/table/nearly_parallel.yaml"
    one_slide OneSlide "robots/table/one_slide.yaml"
    parallel_123 Parallel123 "robots/table/parallel_123.yaml"
    parallel_234 Parallel234 "robots/table/parallel_234.yaml"
    slide_of_rrp SlideOfRrp "robots/table/slide_of_rrp.yaml"
    slides_of_prp SlidesOfPrp "robots/table/slides_of_prp.yaml"
    three_slides ThreeSlides "robots/table/three_slides.yaml"
    wrist_alone WristAlone "robots/table/wrist_alone.yaml"
    wrist_over_base WristOverBase "robots/table/wrist_over_base.yaml"
}

robots! {
    AIMED for_every_aimed_robot:
    shoulder Shoulder "robots/targets/shoulder.yaml" => position
    desk_arm DeskArm "robots/targets/desk_arm.yaml" => position_axis
    welder Welder "robots/targets/welder.yaml" => position_axis
    welder_pose WelderPose "robots/targets/welder.yaml" => pose
    sprayer_pose SprayerPose "robots/targets/sprayer.yaml" => pose
    polar Polar "robots/targets/polar.yaml"
    skew_tool SkewTool "robots/targets/skew_tool.yaml" => position_axis
    bent_2r Bent2r "robots/targets/bent_2r.yaml"
    five_joints FiveJoints "robots/targets/five_joints.yaml"
    five_skew FiveSkew "robots/targets/five_skew.yaml"
    five_skew_axis FiveSkewAxis "robots/targets/five_skew.yaml" => position_axis
    antenna Antenna "robots/targets/antenna.yaml" => direction
    gimbal Gimbal "robots/targets/gimbal.yaml" => orientation
    scara_yaw ScaraYaw "../robots/scara.yaml" => position_yaw
    planar PlanarTarget "../robots/planar_3r.yaml" => planar
    rounded_scara RoundedScara "robots/targets/rounded_scara.yaml" => position_yaw
    rounded_planar RoundedPlanar "robots/targets/rounded_planar.yaml" => planar
    cylindrical Cylindrical "robots/targets/cylindrical.yaml"
    gantry Gantry "robots/targets/gantry.yaml"
    palletizer Palletizer "robots/targets/palletizer.yaml"
    arm_2r_pose Arm2rPose "robots/targets/arm_2r.yaml" => pose
    crank Crank "robots/targets/crank.yaml"
    crank_pose CrankPose "robots/targets/crank.yaml" => pose
    slide Slide "robots/targets/slide.yaml"
    slide_pose SlidePose "robots/targets/slide.yaml" => pose
}

/// Arms that take a parameter beside a target.
const REDUNDANT: [&str; 3] = [
    "../robots/iiwa14.yaml",
    "../robots/panda.yaml",
    "../robots/sawyer.yaml",
];

/// The files of a folder, by their paths in the project.
fn files(folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<String> = entries
        .map(|entry| format!("{folder}/{}", entry.unwrap().file_name().display()))
        .filter(|file| file.ends_with(".yaml") || file.ends_with(".urdf"))
        .filter(|file| !is_mechanism(file))
        .collect();
    files.sort();
    files
}

/// Mechanisms are no arms; `chapter3` tests them.
fn is_mechanism(file: &str) -> bool {
    let text = std::fs::read_to_string(file).unwrap();
    text.lines().any(|line| line.starts_with("mechanism:"))
}

#[test]
fn no_robot_is_left_out() {
    let mut exact = files("../robots");
    // Those with a joint too many are in `tests/redundant`.
    exact.retain(|file| !REDUNDANT.contains(&file.as_str()));
    assert_eq!(exact, EXACT);
    assert_eq!(files("robots/noisy"), NOISY);
    assert_eq!(files("robots/table"), TABLE);
    let aimed = files("robots/targets");
    assert!(aimed.iter().all(|file| AIMED.contains(&file.as_str())));
}
