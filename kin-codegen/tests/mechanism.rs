//! What is read of mechanisms, and told of them.

use kin_codegen::mechanism::{Aim, CompiledMechanism, ForwardMethod, Mechanism};
use kin_codegen::spec::{ArmSpec, MechanismSpec, Spec};
use kin_codegen::{Compiled, Ik, Options, Source, Target, compile, generate};
use kin_runtime::Pose;
use nalgebra::Vector3;
use std::fmt::Write as _;
use std::path::Path;

fn robot(file: &str) -> Source {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    Source::read(file, &robots).unwrap()
}

fn compiled(source: &Source) -> CompiledMechanism {
    match compile(source, &Options::default()) {
        Ok(Compiled::Mechanism(mechanism)) => *mechanism,
        other => panic!("a mechanism, not {other:?}"),
    }
}

fn urdf(text: String) -> Source {
    Source {
        path: "linkage.urdf".into(),
        text,
    }
}

/// A planar 3-RRR of symmetric legs in a URDF: the first leg carries the
/// platform, the second ends at it in a loop joint, the third hangs on the
/// platform and ends at the base.
fn three_legs() -> String {
    let corner = |radius: f64, k: usize| {
        let angle = k as f64 * 2.0 * std::f64::consts::FRAC_PI_3;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let knee = |k: usize| {
        let ([a, b], [c, d]) = (corner(1.0, k), corner(0.3, k));
        // Out of line, so that home is regular.
        [0.5 * (a + c) - 0.4 * (b - d), 0.5 * (b + d) + 0.4 * (a - c)]
    };
    let joint = |name: &str, parent: &str, child: &str, [x, y]: [f64; 2]| {
        format!(
            "<link name=\"{child}\"/><joint name=\"{name}\" type=\"continuous\">\
             <parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <origin xyz=\"{x} {y} 0\"/><axis xyz=\"0 0 1\"/></joint>\n"
        )
    };
    let from = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a - c, b - d];
    let (feet, heads) = (
        [0, 1, 2].map(|k| corner(1.0, k)),
        [0, 1, 2].map(|k| corner(0.3, k)),
    );
    let knees = [0, 1, 2].map(knee);
    let mut text = String::from("<robot name=\"three\">\n<link name=\"base\"/>\n");
    text += &joint("a1", "base", "upper1", feet[0]);
    text += &joint("b1", "upper1", "lower1", from(knees[0], feet[0]));
    text += &joint("c1", "lower1", "platform", from(heads[0], knees[0]));
    text += &joint("a2", "base", "upper2", feet[1]);
    text += &joint("b2", "upper2", "lower2", from(knees[1], feet[1]));
    text += &joint("c3", "platform", "lower3", from(heads[2], heads[0]));
    text += &joint("b3", "lower3", "upper3", from(knees[2], heads[2]));
    let link = |number: usize, name: &str, [x, y]: [f64; 2]| {
        format!("<link{number} link=\"{name}\" xyz=\"{x} {y} 0\"/>")
    };
    for (name, one, two) in [
        (
            "c2",
            link(1, "lower2", from(heads[1], knees[1])),
            link(2, "platform", from(heads[1], heads[0])),
        ),
        (
            "a3",
            link(1, "upper3", from(feet[2], knees[2])),
            link(2, "base", feet[2]),
        ),
    ] {
        text += &format!(
            "<loop_joint name=\"{name}\" type=\"revolute\">{one}{two}\
             <axis xyz=\"0 0 1\"/></loop_joint>\n"
        );
    }
    for k in 1..=3 {
        text += &format!("<transmission name=\"t{k}\"><joint name=\"a{k}\"/></transmission>\n");
    }
    text + "</robot>\n"
}

#[test]
fn chains_are_found_in_a_tree_with_loop_joints_whichever_way_they_hang() {
    let source = urdf(three_legs());
    let spec = MechanismSpec::parse(&source).unwrap();
    let mechanism = Mechanism::new(&spec, None, None).unwrap();
    assert_eq!(
        (mechanism.base.as_str(), mechanism.platform.as_str()),
        ("base", "platform")
    );
    let names = |k: usize| -> Vec<String> {
        let joints = &mechanism.legs[k].model.joints;
        joints.iter().map(|joint| joint.name.clone()).collect()
    };
    assert_eq!(names(0), ["a1", "b1", "c1"]);
    assert_eq!(names(1), ["a2", "b2", "c2"]);
    // From base to platform, although the tree runs the other way.
    assert_eq!(names(2), ["a3", "b3", "c3"]);
    assert_eq!(mechanism.actuated(), [0, 3, 6]);
    let generic = mechanism.generic();
    assert_eq!((generic.gruebler(3), generic.mobility()), (3, 3));
    let q = generic.fk_near(&[0.1, -0.1, 0.2], &[0.0; 9]).unwrap();
    assert!(generic.gap(&q) < 1e-12);
}

/// The third leg is passed against its joints: its values are those of the
/// joints as written, and a positive one turns the parent back.
/// As those of other joints; and without transmissions the remedy is one.
#[test]
fn limits_of_a_loop_joint_are_read() {
    let limited = three_legs().replacen(
        "<axis xyz=\"0 0 1\"/></loop_joint>",
        "<axis xyz=\"0 0 1\"/><limit lower=\"-0.5\" upper=\"0.75\" velocity=\"2\"/></loop_joint>",
        1,
    );
    let spec = MechanismSpec::parse(&urdf(limited.clone())).unwrap();
    let mechanism = Mechanism::new(&spec, None, None).unwrap();
    let mut variables = mechanism.legs.iter().flat_map(|leg| &leg.model.variables);
    let closing = variables.find(|it| it.name == "c2").unwrap();
    assert_eq!(closing.limits, Some([-0.5, 0.75]));
    assert_eq!(closing.rating.velocity, Some(2.0));

    let continuous = limited.replace("type=\"revolute\"", "type=\"continuous\"");
    let spec = MechanismSpec::parse(&urdf(continuous)).unwrap();
    let mechanism = Mechanism::new(&spec, None, None).unwrap();
    let mut variables = mechanism.legs.iter().flat_map(|leg| &leg.model.variables);
    let closing = variables.find(|it| it.name == "c2").unwrap();
    assert_eq!(closing.limits, None);
    assert_eq!(closing.rating.velocity, Some(2.0));

    let idle = limited.split("<transmission").next().unwrap().to_owned() + "</robot>";
    let refused = compile(&urdf(idle), &Options::default()).unwrap_err();
    let said = "help: name 3 joints in a transmission: <transmission";
    assert!(refused.to_string().contains(said), "{refused}");
    let degrees = limited
        .replace("\"0.75\"", "\"90\"")
        .replace("lower=\"-0.5\"", "lower=\"-90\"");
    let refused = compile(&urdf(degrees), &Options::default()).unwrap_err();
    let said = "joint `c2` has the limits -90..90 rad: this looks like degrees";
    assert!(refused.to_string().contains(said), "{refused}");
}

#[test]
fn limits_of_chains_in_another_unit_are_told_once() {
    let source = robot("five_bar.yaml");
    let limited = |unit: &str| Source {
        text: source
            .text
            .replace("angle: deg", &format!("angle: {unit}"))
            .replace("point:", "limits: [-1.57, 1.57], point:"),
        ..source.clone()
    };
    assert_eq!(compiled(&limited("rad")).warnings, []);
    let warnings = compiled(&limited("deg")).warnings;
    let [warning] = &warnings[..] else {
        panic!("{warnings:?}");
    };
    let said = "no joint turns farther than 1.57 degrees from zero";
    assert!(warning.reason.starts_with(said), "{warning:?}");
}

#[test]
fn a_joint_passed_backwards_keeps_its_value() {
    let spec = MechanismSpec::parse(&urdf(three_legs())).unwrap();
    let mechanism = Mechanism::new(&spec, None, None).unwrap();
    assert_eq!(mechanism.legs[0].model.joints[0].axis, [0.0, 0.0, 1.0]);
    assert_eq!(mechanism.legs[2].model.joints[0].axis, [0.0, 0.0, -1.0]);
}

#[test]
fn a_planar_three_legged_platform_is_compiled() {
    let compiled = compiled(&urdf(three_legs()));
    let inverse = compiled.inverse.unwrap();
    assert_eq!(inverse.aim, Aim::Pose);
    assert!(inverse.legs.iter().all(|leg| leg.branches() == 2));
    assert!(matches!(compiled.forward, ForwardMethod::Newton));
}

/// RSSR: a spherical loop joint is three revolutes, and the coupler's spin
/// about itself is idle.
#[test]
fn a_spherical_loop_joint_is_three_revolutes() {
    let text = "<robot name=\"rssr\">
<link name=\"base\"/><link name=\"crank\"/><link name=\"rocker\"/><link name=\"rod\"/>
<link name=\"u\"/><link name=\"v\"/>
<joint name=\"a\" type=\"continuous\"><parent link=\"base\"/><child link=\"crank\"/>
<axis xyz=\"0 0 1\"/></joint>
<joint name=\"b\" type=\"continuous\"><parent link=\"base\"/><child link=\"rocker\"/>
<origin xyz=\"2 0 0\"/><axis xyz=\"1 0 0\"/></joint>
<joint name=\"z\" type=\"continuous\"><parent link=\"crank\"/><child link=\"u\"/>
<origin xyz=\"0 0.5 0\"/><axis xyz=\"0 0 1\"/></joint>
<joint name=\"y\" type=\"continuous\"><parent link=\"u\"/><child link=\"v\"/>
<axis xyz=\"0 1 0\"/></joint>
<joint name=\"x\" type=\"continuous\"><parent link=\"v\"/><child link=\"rod\"/>
<axis xyz=\"1 0 0\"/></joint>
<loop_joint name=\"ball\" type=\"spherical\"><link1 link=\"rod\" xyz=\"2 0.5 0.4\"/>
<link2 link=\"rocker\" xyz=\"0 1 0.4\"/></loop_joint>
<transmission name=\"t\"><joint name=\"a\"/></transmission>
</robot>";
    let source = urdf(text.into());
    let spec = MechanismSpec::parse(&source).unwrap();
    let mechanism = Mechanism::new(&spec, None, Some("rocker")).unwrap();
    assert_eq!(mechanism.joints(), 8);
    let generic = mechanism.generic();
    // The rod turns about itself.
    let q = &generic.neighbours()[0];
    assert_eq!((generic.gruebler(6), generic.mobility()), (2, 2));
    assert_eq!(generic.platform_freedom(q), 1);
}

#[test]
fn one_arm_is_no_mechanism_and_the_other_way_round() {
    for arm in ["ur5e.urdf", "scara.yaml"] {
        assert!(matches!(Spec::parse(&robot(arm)), Ok(Spec::Arm(_))));
        let refused = MechanismSpec::parse(&robot(arm)).unwrap_err().to_string();
        assert!(refused.contains("describes an arm"), "{refused}");
    }
    let refused = ArmSpec::parse(&robot("delta.yaml"))
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("describes a parallel mechanism"),
        "{refused}"
    );
}

#[test]
fn what_the_platform_is_asked_for_follows_from_its_freedoms() {
    let aim = |file: &str| compiled(&robot(file)).inverse.unwrap().aim;
    assert_eq!(aim("stewart.yaml"), Aim::Pose);
    assert_eq!(aim("delta.yaml"), Aim::Translation);
    assert_eq!(aim("slider_crank.yaml"), Aim::Translation);
    assert_eq!(aim("five_bar.yaml"), Aim::Lead(0));
}

/// Three chains of an arm and a rod between universal joints, 120 degrees apart: turned by a motor, or
/// on rails that leave the middle.
fn delta(base: f64, platform: f64, arm: Option<(f64, f64)>, rod: f64) -> Source {
    let (out, down) = match arm {
        Some((length, turned)) => (base + length * turned.cos(), length * turned.sin()),
        None => (base, 0.0),
    };
    let below = down + (rod * rod - (out - platform).powi(2)).sqrt();
    let chain = |k: usize| {
        let (s, c) = (k as f64 * std::f64::consts::FRAC_PI_3 * 2.0).sin_cos();
        let at = |[x, z]: [f64; 2]| format!("[{}, {}, {z}]", x * c, x * s);
        let across = format!("[{}, {c}, 0]", -s);
        let (knee, end) = (at([out, -down]), at([platform, -below]));
        let rest = at([below - down, platform - out]);
        let motor = match arm {
            Some(_) => format!("axis: {across}, point: {}", at([base, 0.0])),
            None => format!("axis: [{c}, {s}, 0], type: prismatic"),
        };
        format!(
            "  - name: chain{k}
    screws:
    - {{name: a{k}, {motor}, actuated: true}}
    - {{name: b{k}, axis: {across}, point: {knee}}}
    - {{name: c{k}, axis: {rest}, point: {knee}}}
    - {{name: d{k}, axis: {rest}, point: {end}}}
    - {{name: e{k}, axis: {across}, point: {end}}}
"
        )
    };
    let chains = [0, 1, 2].map(chain).concat();
    let text = format!(
        "robot: delta
units: {{angle: rad, length: m}}
mechanism:
  home: {{xyz: [0, 0, {}]}}
  chains:
{chains}",
        -below
    );
    Source {
        path: "delta.yaml".into(),
        text,
    }
}

/// Not by its measures: near home, and beyond singularities of the actuators, the chains close in modes
/// in which the platform turns.
#[test]
fn the_platform_of_a_delta_does_not_turn() {
    let rails = [0.5, 0.7].map(|rod| (0.4, 0.1, None, rod));
    let motors = [
        (0.1003, 0.1468, Some((0.1895, 0.6917)), 0.3735),
        (0.11, 0.12, Some((0.18, 0.3)), 0.53),
        (0.25, 0.15, Some((0.15, 0.9)), 0.35),
        (0.3, 0.03, Some((0.25, 0.0)), 0.7),
    ];
    for (base, platform, arm, rod) in rails.into_iter().chain(motors) {
        let found = compiled(&delta(base, platform, arm, rod));
        let aim = found.inverse.unwrap().aim;
        assert_eq!(aim, Aim::Translation, "{base} {platform} {arm:?} {rod}");
        assert!(matches!(found.forward, ForwardMethod::Spheres(_)));
    }
}

/// A straight leg holds the platform the more, and says nothing of how it moves from there.
#[test]
fn home_may_have_singular_chains() {
    let slider_crank = "
robot: dead_centre
units: {angle: rad, length: m}
mechanism:
  home: {xyz: [3, 0, 0]}
  chains:
    - name: crank
      screws:
        - {name: crank, axis: [0, 0, 1], point: [0, 0, 0], actuated: true}
        - {name: crank_pin, axis: [0, 0, 1], point: [1, 0, 0]}
        - {name: wrist_pin, axis: [0, 0, 1], point: [3, 0, 0]}
    - name: guide
      screws:
        - {name: slide, type: prismatic, axis: [1, 0, 0]}
";
    let legs = [
        [[1.0, 0.1], [0.6, 0.17], [0.2, 0.24]],
        [[-0.6, 0.8], [-0.7, 0.25], [-0.3, 0.04]],
        [[-0.4, -0.9], [0.13, -0.7], [0.1, -0.3]],
    ];
    let mut three_legs =
        "robot: three_legs\nunits: {angle: rad, length: m}\nmechanism:\n  home: {xyz: [0, 0, 0]}\n  chains:\n".to_owned();
    for (k, points) in legs.iter().enumerate() {
        let _ = write!(three_legs, "    - name: leg{k}\n      screws:\n");
        for (joint, [x, y]) in points.iter().enumerate() {
            let actuated = joint == 0;
            let _ = writeln!(
                three_legs,
                "        - {{name: j{k}{joint}, axis: [0, 0, 1], point: [{x}, {y}, 0], \
                 actuated: {actuated}}}"
            );
        }
    }
    for (text, freedom) in [(slider_crank, 1), (&three_legs, 3)] {
        let path = "singular_home.yaml".into();
        let text = text.into();
        let found = compiled(&Source { path, text });
        assert_eq!(found.freedom.platform, freedom);
        assert!(found.inverse.is_some());
    }
}

/// A text with its numbers rounded to eight digits behind the point.
fn rounded(text: &str) -> String {
    let part = |part: &str| match part.parse::<f64>() {
        Ok(x) if part.contains('.') => format!("{x:.8}"),
        _ => part.to_owned(),
    };
    let ends = |c: char| "[], \n".contains(c);
    text.split_inclusive(ends)
        .map(|word| {
            let number = word.trim_end_matches(ends);
            part(number) + &word[number.len()..]
        })
        .collect()
}

/// Of parallel axes in a text, one is rounded in each loop.
fn with_rounded_ends(text: &str) -> String {
    let is_end = |line: &str| line.contains("name: e");
    let line = |line: &str| {
        if is_end(line) {
            rounded(line)
        } else {
            line.into()
        }
    };
    text.split_inclusive('\n').map(line).collect()
}

#[test]
fn loops_that_rounding_opens_are_read_as_closed_and_told() {
    let is_told = |found: &CompiledMechanism, what: &str| {
        let told: Vec<&str> = found.warnings.iter().map(|it| &*it.reason).collect();
        assert!(
            matches!(told[..], [one] if one.contains(what) && one.contains("are read as exactly so")),
            "{told:?}"
        );
    };
    let exact = delta(0.11, 0.12, Some((0.18, 0.3)), 0.53);
    assert!(compiled(&exact).warnings.is_empty());
    let text = with_rounded_ends(&exact.text);
    let found = compiled(&Source { text, ..exact });
    assert_eq!(found.inverse.as_ref().unwrap().aim, Aim::Translation);
    is_told(&found, "as it is written the platform turns, by");

    // Four axes along (1, 2, 3), which has no end as a fraction of its length.
    let unit = 14_f64.sqrt().recip();
    let along = |tilt: f64| format!("axis: [{}, {}, {}]", unit, 2.0 * unit, 3.0 * unit + tilt);
    let point = |x: f64, y: f64| {
        // Along (2, -1, 0) / √5 and across both.
        let (a, b) = (5_f64.sqrt().recip(), 70_f64.sqrt().recip());
        let at = [2.0 * a * x + 3.0 * b * y, 6.0 * b * y - a * x, -5.0 * b * y];
        format!("point: [{}, {}, {}]", at[0], at[1], at[2])
    };
    let tilted = |by: f64| {
        let axis = along(0.0);
        let text = format!(
            "robot: tilted\nunits: {{angle: rad, length: m}}\nmechanism:\n  home: {{xyz: [0, 0, 0]}}\n  \
             chains:\n  - name: left\n    screws:\n    - {{name: crank, {axis}, {}, actuated: true}}\n    \
             - {{name: coupler, {axis}, {}}}\n  - name: right\n    screws:\n    \
             - {{name: rocker, {axis}, {}}}\n    - {{name: end, {}, {}}}\n",
            point(0.0, 0.0),
            point(0.2, 0.5),
            point(1.3, 0.1),
            along(by),
            point(1.1, 0.9)
        );
        let path = "tilted.yaml".into();
        Source { path, text }
    };
    let exact = tilted(0.0);
    let found = compiled(&exact);
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    assert_eq!(found.freedom.platform, 1);
    let text = with_rounded_ends(&exact.text);
    let found = compiled(&Source { text, ..exact });
    assert_eq!(found.freedom.platform, 1);
    is_told(&found, "the loops do not close as they are written");
    // What is no rounding is refused as it is.
    let Err(refused) = compile(&tilted(0.02), &Options::default()) else {
        panic!("it moves");
    };
    let refused = refused.to_string();
    assert!(refused.contains("is immobile"), "{refused}");
    assert!(
        refused.contains("check axes and points; a joint may be missing"),
        "{refused}"
    );
}

/// The loop of a Bennett linkage closes by its lengths, which no relation between axes stands for.
#[test]
fn a_motion_that_rounding_takes_is_told_where_it_cannot_be_mended() {
    // Opposite sides are equal; an axis is square to the links at its corner.
    let (sin, cos) = 1.1_f64.sin_cos();
    let corners: [Vector3<f64>; 4] = [
        [1.0, 0.0, 0.3].into(),
        [0.7 * cos, 0.7 * sin, -0.3].into(),
        [-1.0, 0.0, 0.3].into(),
        [-0.7 * cos, -0.7 * sin, -0.3].into(),
    ];
    let screw = |i: usize, digits: usize| {
        let at = corners[i];
        let [before, after] = [i + 3, i + 1].map(|i| corners[i % 4] - at);
        let list =
            |v: Vector3<f64>| format!("[{:.digits$}, {:.digits$}, {:.digits$}]", v.x, v.y, v.z);
        let axis = list(before.cross(&after).normalize());
        format!("axis: {axis}, point: {}", list(at))
    };
    let bennett = |digits: usize| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| screw(i, digits));
        let text = format!(
            "robot: bennett\nunits: {{angle: rad, length: m}}\nmechanism:\n  home: {{xyz: [0, 0, 0]}}\n  \
             chains:\n  - name: left\n    screws:\n    - {{name: crank, {a}, actuated: true}}\n    \
             - {{name: coupler, {b}}}\n  - name: right\n    screws:\n    - {{name: rocker, {d}}}\n    \
             - {{name: end, {c}}}\n",
        );
        let path = "bennett.yaml".into();
        Source { path, text }
    };
    assert_eq!(compiled(&bennett(17)).freedom.platform, 1);
    let Err(refused) = compile(&bennett(7), &Options::default()) else {
        panic!("it moves");
    };
    let refused = refused.to_string();
    assert!(refused.contains("is immobile"), "{refused}");
    assert!(
        refused.contains("give axes and points with all digits, twelve behind the point"),
        "{refused}"
    );
}

/// Four bars that four digits leave apart: by less than rounding of twelve digits nothing is told, by
/// more than a file means they are refused.
#[test]
fn chains_that_end_apart_are_told() {
    let linkage = |apart: f64| {
        let end = 2.0 + apart;
        let text = format!(
            "robot: linkage\nunits: {{angle: deg, length: m}}\nmechanism:\n  chains:\n    - name: \
             left\n      joints:\n        - {{name: a, axis: [0, 0, 1], actuated: true}}\n        - \
             {{name: b, xyz: [0, 1, 0], axis: [0, 0, 1]}}\n      tip: {{xyz: [1, 0, 0]}}\n    - name: \
             right\n      base: {{xyz: [3, 0, 0]}}\n      joints:\n        - {{name: c, axis: [0, 0, \
             1]}}\n        - {{name: d, xyz: [0, 1, 0], axis: [0, 0, 1]}}\n      tip: {{xyz: [-{end}, \
             0, 0]}}\n"
        );
        let path = "linkage.yaml".into();
        Source { path, text }
    };
    let told = |apart: f64| -> Vec<(String, String)> {
        let found = compiled(&linkage(apart)).warnings.into_iter();
        found.map(|it| (it.reason, it.remedy)).collect()
    };
    assert_eq!(told(1e-8), []);
    let reason = "with all joint values 0 the chain `right` ends 0.000030 m and 0.0000° away from where \
                  `left` does: it holds the platform where it ends";
    let remedy = "give axes and points with all digits, twelve behind the point";
    assert_eq!(told(3e-5), [(reason.to_owned(), remedy.to_owned())]);
    let refused = compile(&linkage(3e-3), &Options::default()).unwrap_err();
    let reason = "they hold no platform together";
    assert!(refused.to_string().contains(reason), "{refused}");
}

/// Of a parallelogram it does, where the cranks are on different sides.
#[test]
fn every_assembly_of_a_parallelogram_is_a_target() {
    let text = "
robot: parallelogram
units: {angle: rad, length: m}
mechanism:
  home: {xyz: [1.6, 0.8, 0]}
  chains:
    - name: left
      screws:
        - {name: crank, axis: [0, 0, 1], point: [0, 0, 0], actuated: true}
        - {name: coupler, axis: [0, 0, 1], point: [0.6, 0.8, 0]}
    - name: right
      screws:
        - {name: follower, axis: [0, 0, 1], point: [3, 0, 0]}
        - {name: end, axis: [0, 0, 1], point: [3.6, 0.8, 0]}
";
    let parallelogram = compiled(&Source {
        path: "parallelogram.yaml".into(),
        text: text.into(),
    });
    for turned in [1.0, -1.7, 2.5] {
        let (y, x) = (0.8_f64.atan2(0.6) + turned).sin_cos();
        // The coupler's ends are 3 m apart, and the second is 1 m from the follower's axis at (3, 0):
        // along x, or as much on the other side of the line from the first to that axis.
        let twice = 2.0 * (-y).atan2(3.0 - x);
        for angle in [0.0, twice] {
            let tip = [x + angle.cos(), y + angle.sin(), 0.0];
            let target = Pose::from_axis_angle([0.0, 0.0, 1.0], angle, tip);
            let placed = parallelogram.solutions(&target);
            let there = placed
                .iter()
                .find(|it| it.pose.translation_distance(&target) < 1e-9);
            let there = there.unwrap_or_else(|| panic!("{turned} {angle}"));
            assert!(there.pose.rotation_distance(&target) < 1e-9);
            let cranks = &there.solutions[0];
            let is_same = |q: &Vec<f64>| (q[0] - turned).abs() < 1e-9;
            assert!(cranks.iter().any(is_same), "{turned} {angle}: {cranks:?}");
        }
    }
}

#[test]
fn options_of_arms_are_refused() {
    let with_target = Options {
        target: Some(Target::Position),
        ..Options::default()
    };
    let with_tool = Options {
        tool: Some([0.0; 6]),
        ..Options::default()
    };
    for (options, option) in [(with_target, "target"), (with_tool, "tool")] {
        let refused = compile(&robot("delta.yaml"), &options).unwrap_err();
        let said = format!("the option `{option}` has no meaning");
        assert!(refused.to_string().contains(&said), "{refused}");
    }
}

#[test]
fn without_inverse_kinematics_a_loop_still_has_its_assembly_modes() {
    let options = Options {
        ik: Ik::None,
        ..Options::default()
    };
    let generated = generate(&robot("five_bar.yaml"), &options).unwrap();
    let Compiled::Mechanism(compiled) = &generated.robot else {
        panic!("a mechanism");
    };
    assert!(compiled.inverse.is_none());
    assert!(matches!(compiled.forward, ForwardMethod::Loop(_)));
    let code = generated.code();
    assert!(code.contains("fn fk(") && !code.contains("fn ik_seeded(&self, target"));
}

/// The letters `<loop_joint` in a comment or a name close no loop.
#[test]
fn the_parsed_tree_decides_what_a_file_describes() {
    let ur5e = robot("ur5e.urdf");
    let text = ur5e
        .text
        .replace("<link name", "<!-- no <loop_joint here -->\n<link name");
    let source = Source { text, ..ur5e };
    assert!(matches!(Spec::parse(&source), Ok(Spec::Arm(_))));
    assert!(
        compile(&source, &Options::default())
            .unwrap()
            .arm()
            .is_some()
    );
    let scara = robot("scara.yaml");
    let text = format!("{}# mechanism:\n", scara.text);
    assert!(matches!(
        Spec::parse(&Source { text, ..scara }),
        Ok(Spec::Arm(_))
    ));
}
