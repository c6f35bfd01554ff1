//! Which joint stays free, what is said of that, and of options that cannot be followed.

use kin_cli::explain::explain;
use kin_codegen::certificate::recovered;
use kin_codegen::random::Random;
use kin_codegen::redundancy::costs_as_much;
use kin_codegen::solver::Certified;
use kin_codegen::{Options, Source, Target, compile};
use kinematics::Parameter;
use std::f64::consts::PI;
use std::path::Path;

fn source(path: &str) -> Source {
    Source::read(path, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn free(joints: &[&str]) -> Options {
    Options {
        free: joints.iter().map(|&joint| joint.into()).collect(),
        ..Options::default()
    }
}

#[test]
fn the_cheapest_plan_decides_and_is_told() {
    let arm = compile(&source("../robots/panda.yaml"), &Options::default()).unwrap();
    let arm = arm.arm().unwrap().clone();
    let redundancy = arm.redundancy.unwrap();
    assert_eq!(redundancy.joints, [6]);
    let weights = redundancy.weighed.iter().filter_map(|it| it.weight);
    let weights: Vec<usize> = weights.collect();
    let least = weights.iter().copied().min();
    let is_dearer = |weight: &&usize| !costs_as_much(Some(**weight), least);
    let dearer: Vec<&usize> = weights.iter().filter(is_dearer).collect();
    assert!(dearer.len() > 1 && dearer.is_sorted(), "{weights:?}");
    assert!(costs_as_much(Some(weights[0]), least), "{weights:?}");
    let code = kin_codegen::generate(&source("../robots/panda.yaml"), &Options::default());
    let code = code.unwrap().code();
    assert!(
        code.contains("the value of q7 (`joint7`), radians"),
        "{code}"
    );
    let told = explain(&source("../robots/panda.yaml"), &Options::default()).unwrap();
    assert!(
        told.to_string().contains("Given beside a target: q7"),
        "{told}"
    );
}

/// A left arm and its mirror image, with a waist: their plans differ by a sign here and there, and
/// their costs by little.
#[test]
fn mirror_images_are_given_the_same_joints() {
    let given = |side: i8| {
        let text = format!(
            "robot: arm
units: {{angle: deg, length: mm}}
joints:
  - {{name: waist, axis: [0, 0, 1]}}
  - {{name: shoulder_pitch, xyz: [0, {y}, 230], rpy: [{tilt}, 0, 0], axis: [0, 1, 0]}}
  - {{name: shoulder_roll, axis: [{side}, 0, 0]}}
  - {{name: shoulder_yaw, axis: [0, 0, {side}]}}
  - {{name: elbow, xyz: [10, 0, -300], axis: [0, 1, 0]}}
  - {{name: wrist_yaw, xyz: [-10, 0, -340], axis: [0, 0, {side}]}}
  - {{name: wrist_pitch, axis: [0, 1, 0]}}
  - {{name: wrist_roll, axis: [{side}, 0, 0]}}
tip: {{xyz: [0, 0, -100]}}
",
            y = 210 * i32::from(side),
            tilt = 15 * i32::from(side),
        );
        let path = "arm.yaml".into();
        let arm = compile(&Source { path, text }, &Options::default()).unwrap();
        arm.arm().unwrap().redundancy.clone().unwrap().joints
    };
    assert_eq!(given(1), given(-1));
}

/// A rail is, though other joints would leave a cheaper plan; and where it moves within the plane of the
/// arm, one that solves for it leaves it at zero, out of the elbow's reach.
#[test]
fn what_carries_an_arm_is_given() {
    let told = explain(&source("robots/redundant/rail.yaml"), &Options::default()).unwrap();
    let told = told.to_string();
    for sentence in [
        "Given beside a target: q1 (`rail`). That has what carries the arm among it; operations",
        "every configuration was recovered",
    ] {
        assert!(told.contains(sentence), "{told}");
    }
}

#[test]
fn constants_tell_what_is_given() {
    let swivel = kinematics::Swivel {
        shoulder: [0.0, 0.0, 0.36],
        link: 2,
        elbow: [0.0, 0.0, 0.42],
        wrist: [0.0, 0.0, -0.126],
        reference: [0.0, 0.0, 1.0],
    };
    assert_eq!(crate::Iiwa14::PARAMETERS, [Parameter::Swivel(swivel)]);
    assert_eq!(crate::IiwaByFlange::PARAMETERS, [Parameter::Joint(6)]);
    assert_eq!(crate::IiwaByElbow::PARAMETERS, [Parameter::Joint(2)]);
    assert_eq!(crate::Rail::PARAMETERS, [Parameter::Joint(0)]);
    assert_eq!(crate::Ur5e::PARAMETERS, [Parameter::Turn]);
    assert_eq!((crate::Panda::BRANCHES_AT, crate::Panda::BRANCHES), (8, 0));
}

fn refused(path: &str, options: &Options) -> String {
    compile(&source(path), options).unwrap_err().to_string()
}

#[track_caller]
fn assert_refused(path: &str, options: &Options, reason: &str, remedy: &str) {
    let said = refused(path, options);
    assert!(said.contains(reason) && said.contains(remedy), "{said}");
}

#[test]
fn options_that_cannot_be_followed_have_a_remedy() {
    let panda = "../robots/panda.yaml";
    assert_refused(
        panda,
        &free(&["jiont7"]),
        "there is no joint `jiont7` to stay free",
        "did you mean `joint7`?",
    );
    assert_refused(
        "robots/redundant/gantry_iiwa.yaml",
        &free(&["slide, joint_a3"]),
        "there is no joint `slide, joint_a3` to stay free",
        "name each by itself: `free = [\"slide\", \"joint_a3\"]`, or `--free` once for each",
    );
    assert_refused(
        "../robots/ur5e.urdf",
        &Options {
            target: Some(Target::PositionAxis),
            ..free(&["wrist_3_tool0"])
        },
        "the joint `wrist_3_tool0` is fixed, and cannot stay free",
        "wrist_3_joint",
    );
    assert_refused(
        "../robots/ur5e.urdf",
        &Options {
            target: Some(Target::PositionAxis),
            ..free(&["turn"])
        },
        "there is no joint `turn` to stay free",
        "leave it out: with `target = position_axis` the turn of the tool is given unless `free` \
         names a joint in its place",
    );
    assert_refused(
        panda,
        &free(&["swivel"]),
        "the first three and the last three meet in a point each; from `base` to `joint7_link` \
         this is spherical shoulder at 1, 2, 3",
        "name a joint in `free`, or leave it out",
    );
    assert_refused(
        "../robots/iiwa14.yaml",
        &free(&["swivel", "joint_a7"]),
        "names 2 joints, and 7 joints have 1 more",
        "name 1 joint at most",
    );
    assert_refused(
        panda,
        &free(&["joint7", "joint7"]),
        "names the joint `joint7` twice",
        "once",
    );
    assert_refused(
        "../robots/ur5e.urdf",
        &free(&["elbow_joint"]),
        "6 joints have 0 more than the 6 coordinates of whole poses",
        "leave out `free`, or choose a `target` of fewer coordinates",
    );
    assert_refused(
        panda,
        &free(&["joint1", "joint7"]),
        "names 2 joints, and 7 joints have 1 more",
        "name 1 joint at most",
    );
    assert_refused(
        panda,
        &Options {
            tip: Some("joint6_link".into()),
            target: Some(Target::PositionAxis),
            ..free(&["joint7"])
        },
        "the joint `joint7` is not between `base` and `joint6_link`",
        "joint1",
    );
    assert_refused(
        panda,
        &Options {
            ik: kin_codegen::Ik::None,
            ..free(&["joint7"])
        },
        "without inverse kinematics no joint stays free",
        "leave out one of the two: `free`, or `ik = none`",
    );
    assert_refused(
        "../robots/delta.yaml",
        &free(&["joint7"]),
        "the option `free` has no meaning",
        "leave it out",
    );
}

#[test]
fn a_joint_that_mimics_cannot_stay_free() {
    let text = "
robot: coupled
units: {angle: deg, length: m}
joints:
  - {name: one, axis: [0, 0, 1], limits: [-90, 90]}
  - {name: two, xyz: [1, 0, 0], axis: [0, 0, 1], mimic: {joint: one}}
  - {name: three, xyz: [1, 0, 0], axis: [0, 0, 1], limits: [-90, 90]}
tip: tip
";
    let source = Source {
        path: "coupled.yaml".into(),
        text: text.into(),
    };
    let options = Options {
        target: Some(Target::Direction),
        ..free(&["two"])
    };
    let said = compile(&source, &options).unwrap_err().to_string();
    assert!(
        said.contains("the joint `two` mimics `one`, and cannot stay free"),
        "{said}"
    );
}

#[test]
fn joints_that_mimic_are_named() {
    let text = "
robot: finger
units: {angle: deg, length: m}
joints:
  - {name: one, axis: [0, 0, 1], limits: [-90, 90]}
  - {name: two, xyz: [1, 0, 0], axis: [0, 0, 1], mimic: {joint: one}}
  - {name: three, xyz: [1, 0, 0], axis: [0, 0, 1], mimic: {joint: one}}
  - {name: four, xyz: [1, 0, 0], axis: [0, 1, 0], limits: [-90, 90]}
  - {name: five, xyz: [1, 0, 0], axis: [1, 0, 0], limits: [-90, 90]}
  - {name: six, xyz: [1, 0, 0], axis: [0, 1, 0], limits: [-90, 90]}
  - {name: seven, xyz: [1, 0, 0], axis: [1, 0, 0], limits: [-90, 90]}
tip: tip
";
    let source = Source {
        path: "finger.yaml".into(),
        text: text.into(),
    };
    let said = compile(&source, &Options::default())
        .unwrap_err()
        .to_string();
    let reason = "joint `two` mimics `one`, and 1 more mimic others, which couples their angles";
    assert!(said.contains(reason), "{said}");
    assert!(
        said.contains("in front of the joints that mimic others"),
        "{said}"
    );
}

/// An arm off its design has no swivel angle unless it is asked for: with a joint given that leaves
/// the others an exact closed form, or stands at an end, it is solved in bounded time.
#[test]
fn an_arm_off_its_design_is_given_a_joint() {
    let compiled = compile(
        &source("robots/redundant/stray_iiwa.yaml"),
        &Options::default(),
    );
    let arm = compiled.unwrap().arm().unwrap().clone();
    assert_eq!(arm.redundancy.as_ref().unwrap().joints, [4]);
    assert!(arm.form().unwrap().is_exact());
    let told = |robot, joint| {
        let explained = explain(&source(robot), &free(&[joint])).unwrap();
        let inverse = explained.arm().unwrap().inverse.unwrap();
        inverse.idealization.unwrap().refinement
    };
    for joint in ["joint_a7", "joint_a3"] {
        let refinement = told("robots/redundant/stray_iiwa.yaml", joint);
        assert!(
            refinement.contains("the roots of a polynomial of degree"),
            "{refinement}"
        );
    }
}

/// The elimination of others does not depend on the value of an inner joint, or is moved by it: of
/// the middle one.
#[test]
fn an_inner_joint_without_a_closed_form_is_given_to_an_elimination() {
    for joint in 1..6 {
        let options = free(&[&format!("right_j{joint}")]);
        let solved = compile(&source("../robots/sawyer.yaml"), &options);
        assert!(solved.is_ok(), "{joint}");
    }
}

#[test]
fn an_inner_joint_without_a_closed_form_is_refused() {
    // Two links beside the middle one are a pair of Bennett's linkage.
    let text = "robot: dual\nunits: {angle: deg, length: mm}\ndh:\n  \
        - {name: a, d: 166, a: 30, alpha: -90, limits: [-180, 180]}\n  \
        - {name: b, d: 0, a: 30, alpha: 90, limits: [-180, 180]}\n  \
        - {name: c, d: 251.5, a: 40.5, alpha: -90, limits: [-180, 180]}\n  \
        - {name: d, d: 0, a: 40.5, alpha: -90, limits: [-180, 180]}\n  \
        - {name: e, d: 265, a: 27, alpha: -90, limits: [-180, 180]}\n  \
        - {name: f, d: 0, a: 27, alpha: 90, limits: [-180, 180]}\n  \
        - {name: g, d: 36, a: 0, alpha: 0, limits: [-180, 180]}\n";
    let dual = Source {
        path: "dual.yaml".into(),
        text: text.into(),
    };
    let said = compile(&dual, &free(&["d"])).unwrap_err().to_string();
    assert!(
        said.contains("with `d` free, no sequence of the subproblems"),
        "{said}"
    );
    let remedy = "let other joints stay free by `free`, those at an end of the chain first";
    assert!(said.contains(remedy), "{said}");
    // Of a tool's position and axis two are given, of which one may be its turn.
    let along = |joints: &[&str]| Options {
        target: Some(Target::PositionAxis),
        ..free(joints)
    };
    let text = text.replace("d: 36, a: 0, alpha: 0,", "d: 36, a: 20, alpha: 40,");
    let tilted = Source { text, ..dual };
    let said = compile(&tilted, &along(&["a", "b"]))
        .unwrap_err()
        .to_string();
    let remedy =
        "name one joint less by `free`: the turn of the tool about its axis is given in its place";
    assert!(said.contains(remedy), "{said}");
    let followed = compile(&tilted, &along(&["a"])).unwrap();
    let followed = followed.arm().unwrap().redundancy.as_ref().unwrap();
    assert_eq!(followed.parameters(), 2);
    // Turning the elbow of an SRS arm changes how far it reaches.
    assert_refused(
        "../robots/iiwa14.yaml",
        &free(&["joint_a4"]),
        "with `joint_a4` free, they move the tip in 5 independent ways at most",
        "`ik = none`",
    );
}

/// Whatever is given, three slides turn nothing.
#[test]
fn a_target_that_no_joint_changes_is_refused_as_such() {
    let slides = "robot: gantry\nunits: {angle: rad, length: m}\nscrews:\n  \
        - {name: x, type: prismatic, axis: [1, 0, 0]}\n  \
        - {name: y, type: prismatic, axis: [0, 1, 0]}\n  \
        - {name: z, type: prismatic, axis: [0, 0, 1]}\nhome: {xyz: [0, 0, 0]}\n";
    let source = Source {
        path: "gantry.yaml".into(),
        text: slides.into(),
    };
    let options = Options {
        target: Some(Target::Orientation),
        ..Options::default()
    };
    let said = compile(&source, &options).unwrap_err().to_string();
    let remedy = "choose another `target`: no joint of this chain changes what counts of this one";
    assert!(said.contains(remedy), "{said}");
}

/// An iiwa as programs write it that print twelve digits.
#[test]
fn right_angles_of_twelve_digits_are_right() {
    let origins = [
        ("0 0 0", 0.1575),
        ("1.57079632679 0 3.14159265359", 0.2025),
        ("1.57079632679 0 3.14159265359", 0.2045),
        ("1.57079632679 0 0", 0.2155),
        ("-1.57079632679 3.14159265359 0", 0.1845),
        ("1.57079632679 0 0", 0.2155),
        ("-1.57079632679 3.14159265359 0", 0.081),
    ];
    let mut text = "<robot name=\"iiwa\"><link name=\"link0\"/>".to_owned();
    for (i, (rpy, length)) in origins.into_iter().enumerate() {
        let xyz = match i {
            2 | 4 | 6 => format!("0 {length} 0"),
            _ => format!("0 0 {length}"),
        };
        text += &format!(
            "<link name=\"link{n}\"/><joint name=\"joint{n}\" type=\"continuous\">\
             <origin rpy=\"{rpy}\" xyz=\"{xyz}\"/><axis xyz=\"0 0 1\"/>\
             <parent link=\"link{i}\"/><child link=\"link{n}\"/></joint>",
            n = i + 1
        );
    }
    let source = Source {
        path: "iiwa.urdf".into(),
        text: text + "</robot>",
    };
    let compiled = compile(&source, &Options::default()).unwrap();
    let arm = compiled.arm().unwrap();
    assert!(arm.redundancy.as_ref().unwrap().swivel.is_some());
    assert!(arm.form().unwrap().is_exact());
}

fn given(path: &str, text: String) -> Vec<usize> {
    let source = Source {
        path: path.into(),
        text,
    };
    let compiled = compile(&source, &Options::default()).unwrap();
    compiled.arm().unwrap().redundancy.clone().unwrap().joints
}

/// Seven of ten joints, those at the tip, are an arm of its own: of them one is given, and all
/// that carry it.
#[test]
fn of_a_long_chain_what_carries_the_arm_is_given() {
    let mut text = "robot: mobile\nunits: {angle: deg, length: m}\njoints:\n".to_owned();
    text += "  - {name: x, type: prismatic, axis: [1, 0, 0], limits: [-9, 9]}\n";
    text += "  - {name: y, type: prismatic, axis: [0, 1, 0], limits: [-9, 9]}\n";
    text += "  - {name: yaw, axis: [0, 0, 1]}\n";
    let arm = [
        ("[0.2, 0, 0.4]", "[0, 0, 1]"),
        ("[0, 0, 0.3]", "[0, 1, 0]"),
        ("[0, 0, 0]", "[0, 0, 1]"),
        ("[0.1, 0, 0.3]", "[0, 1, 0]"),
        ("[-0.1, 0, 0.4]", "[0, 0, 1]"),
        ("[0, 0, 0]", "[0, 1, 0]"),
        ("[0.1, 0, 0]", "[0, 0, 1]"),
    ];
    for (i, (xyz, axis)) in arm.into_iter().enumerate() {
        text += &format!("  - {{name: j{i}, xyz: {xyz}, axis: {axis}}}\n");
    }
    text += "tip: hand\n";
    let joints = given("mobile.yaml", text);
    assert_eq!((&joints[..3], joints.len()), (&[0, 1, 2][..], 4));
    assert!(joints[3] > 2, "{joints:?}");
}

/// A head on a mobile base: yaw and pan turn about parallel lines, and the base slides.
#[test]
fn of_a_chain_that_is_singular_everywhere_a_joint_is_given() {
    let text = "robot: head
units: {angle: deg, length: m}
joints:
  - {name: x, type: prismatic, axis: [1, 0, 0], limits: [-9, 9]}
  - {name: y, type: prismatic, axis: [0, 1, 0], limits: [-9, 9]}
  - {name: yaw, axis: [0, 0, 1]}
  - {name: lift, type: prismatic, axis: [0, 0, 1], limits: [0, 0.4]}
  - {name: pan, xyz: [0.1, 0, 1], axis: [0, 0, 1]}
  - {name: tilt, xyz: [0.1, 0, 0.1], axis: [0, 1, 0], limits: [-90, 90]}
tip: camera
";
    let source = Source {
        path: "head.yaml".into(),
        text: text.into(),
    };
    let solved = |options: &Options| {
        let compiled = compile(&source, options).unwrap();
        let arm = compiled.arm().unwrap();
        assert_eq!(arm.inverse.as_ref().unwrap().certificate.lost, 0);
        arm.redundancy.clone().unwrap().joints
    };
    let chosen = solved(&Options::default());
    assert!(
        chosen.len() == 1 && [0, 1, 2, 4].contains(&chosen[0]),
        "{chosen:?}"
    );
    assert_eq!(solved(&free(&["yaw"])), [2]);
    let said = compile(&source, &free(&["yaw", "pan"]))
        .unwrap_err()
        .to_string();
    let reason = "6 joints have 1 more than the 5 independent ways in which they move the tip";
    assert!(said.contains(reason), "{said}");
}

/// Four tubes that slide in one another between a lift and a wrist: all but one are given, however
/// many joints there are beside them.
#[test]
fn of_a_telescope_all_tubes_but_one_are_given() {
    let chain = |wrist: &[&str]| {
        let mut text = "robot: telescope\nunits: {angle: rad, length: m}\njoints:\n".to_owned();
        text += "  - {name: lift, type: prismatic, axis: [0, 0, 1], limits: [0, 1.1]}\n";
        for (tube, x) in [0.2, -0.01, -0.01, -0.01].into_iter().enumerate() {
            text += &format!(
                "  - {{name: tube{tube}, type: prismatic, xyz: [{x}, 0, 0], axis: [1, 0, 0], \
                 limits: [0, 0.13]}}\n"
            );
        }
        for (joint, axis) in wrist.iter().enumerate() {
            text += &format!("  - {{name: wrist{joint}, xyz: [0.02, 0, -0.03], axis: {axis}}}\n");
        }
        text + "tip: {link: hand, xyz: [0.1, 0, 0]}\n"
    };
    let wrist = ["[0, 0, 1]", "[0, 1, 0]", "[1, 0, 0]", "[0, 0, 1]"];
    for count in [1, 3, 4] {
        let joints = given("telescope.yaml", chain(&wrist[..count]));
        assert_eq!(joints, [1, 2, 3], "{count} wrist joints");
    }
}

/// Two neighbours that turn about one line are a slip in a table more often than meant; who means
/// them says so.
#[test]
fn a_joint_that_repeats_the_turn_of_another_is_asked_for() {
    let text = "robot: twice
units: {angle: deg, length: m}
joints:
  - {name: trunk, axis: [0, 0, 1]}
  - {name: neck, xyz: [0, 0, 0.4], axis: [0, 0, 1]}
  - {name: nod, xyz: [0.1, 0, 0.1], axis: [0, 1, 0]}
  - {name: roll, xyz: [0.1, 0, 0], axis: [1, 0, 0]}
tip: {link: eye, xyz: [0.1, 0.2, 0.1]}
";
    let source = Source {
        path: "twice.yaml".into(),
        text: text.into(),
    };
    let said = compile(&source, &Options::default())
        .unwrap_err()
        .to_string();
    for part in [
        "joints `trunk` and `neck` turn about one line",
        "or stay free (`free`)",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let compiled = compile(&source, &free(&["trunk"])).unwrap();
    assert_eq!(
        compiled.arm().unwrap().redundancy.as_ref().unwrap().joints,
        [0]
    );
}

/// What repeats another joint for one target does not for another: three parallel joints choose two
/// coordinates of positions, and one of orientations.
#[test]
fn as_many_joints_are_given_as_repeat_others_for_the_target() {
    let arm = |axes: &[&str]| {
        let mut text = "robot: arm\nunits: {angle: rad, length: m}\njoints:\n".to_owned();
        for (i, axis) in axes.iter().enumerate() {
            text += &format!("  - {{name: j{i}, xyz: [0.3, 0, 0], axis: {axis}}}\n");
        }
        Source {
            path: "arm.yaml".into(),
            text: text + "tip: {link: tool, xyz: [0.2, 0, 0]}\n",
        }
    };
    let aimed = |target: Target| Options {
        target: Some(target),
        ..Options::default()
    };
    let planar = arm(&["[0, 0, 1]"; 3]);
    for (target, count) in [
        (Target::Pose, 0),
        (Target::Position, 1),
        (Target::Orientation, 2),
    ] {
        let compiled = compile(&planar, &aimed(target)).unwrap();
        let arm = compiled.arm().unwrap();
        let given = arm.redundancy.as_ref().map_or(0, |it| it.joints.len());
        assert_eq!(given, count, "{target:?}");
        assert_eq!(arm.inverse.as_ref().unwrap().certificate.lost, 0);
    }
    // The tool of parallel joints does not turn about its own axis beside them.
    let upright = compile(&arm(&["[0, 1, 0]"; 3]), &aimed(Target::PositionAxis)).unwrap();
    assert!(upright.arm().unwrap().redundancy.is_none());
    let said = |source: &Source, target: Target| {
        let refused = compile(source, &aimed(target)).err().unwrap();
        refused.to_string()
    };
    for axes in [&["[1, 0, 0]"][..], &["[1, 0, 0]"; 4]] {
        let turning = said(&arm(axes), Target::Position);
        let reason = "they change positions of the tip in 0 independent ways at most";
        assert!(turning.contains(reason), "{turning}");
    }
    let turning = said(&arm(&["[1, 0, 0]"]), Target::Position);
    assert!(turning.contains("for the 1 joint from"), "{turning}");
    // Of three that turn about one line one is left.
    let [x, y, z] = ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"];
    let twice = [z, y, y, x, x, x];
    let compiled = compile(&arm(&twice), &aimed(Target::PositionAxis)).unwrap();
    let arm = compiled.arm().unwrap();
    assert_eq!(arm.redundancy.as_ref().unwrap().joints, [3, 4]);
    // With the tip on axis 1 the first step tells nothing, and with the third joint straight the
    // second has a double root: what is lost or flagged there is told, and nothing is lost elsewhere.
    let Certified { form, certificate } = arm.inverse.as_ref().unwrap();
    assert!((1..certificate.configurations / 30).contains(&certificate.lost));
    let mut random = Random(0x3a11);
    for _ in 0..300 {
        let q: Vec<f64> = (0..6).map(|_| random.between(-PI, PI)).collect();
        let (given, solved) = form.split(&q);
        let solutions = form.solutions_at(&arm.model.chain().fk(&q), &given);
        let held = arm.model.locked(&[3, 4], &given);
        assert_eq!(recovered(&held, &solved, &solutions, 1e-3), Ok(()));
    }
}

/// No row of a snake has a plan: that at the tip has a polynomial.
#[test]
fn a_snake_is_solved_at_its_end() {
    let mut text = "robot: snake\nunits: {angle: deg, length: m}\ndh:\n".to_owned();
    for i in 0..11 {
        let alpha = if i % 2 == 0 { 70 } else { -50 };
        text += &format!("  - {{name: j{i}, theta: 0, d: 0.05, a: 0.1, alpha: {alpha}}}\n");
    }
    assert_eq!(given("snake.yaml", text)[..4], [0, 1, 2, 3]);
}
