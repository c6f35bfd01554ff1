//! Every URDF of the project, read a second time by `urdf-rs`: what it read,
//! handed to the compiler, is the robot that the compiler reads in the file,
//! to the last bit of every number.
//!
//! `KIN_ROBOTS` can name one more folder of robot files.

use kin_codegen::spec::{ArmSpec, Diagnostics, Joint, JointType, Limits, Source};
use std::fs;
use std::path::{Path, PathBuf};

/// A file to be refused, and mechanisms, whose loops `urdf-rs` does not read.
const NO_ARMS: [&str; 3] = [
    "ui/robots/broken.urdf",
    "linkages/four_bar.urdf",
    "frames/rated.urdf",
];

/// The URDFs below some folders.
fn files(mut folders: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "urdf") {
                files.push(path);
            }
        }
    }
    files
}

/// What a joint does, without its place in the file. A range of 0 is none to
/// `urdf-rs`.
fn kinematics(spec: &ArmSpec, joint: &Joint) -> impl PartialEq + std::fmt::Debug {
    let link = |link: usize| spec.links[link].name.clone();
    let limits = match joint.limits {
        Limits::Range { lower, upper, .. } if [lower, upper] != [0.0; 2] => Some([lower, upper]),
        _ => None,
    };
    let mimic = joint
        .mimic
        .map(|mimic| (mimic.joint, mimic.multiplier, mimic.offset));
    let ends = (link(joint.parent), link(joint.child));
    let frame = (joint.origin, joint.axis, joint.mount);
    (joint.name.clone(), joint.kind, ends, frame, limits, mimic)
}

fn names(spec: &ArmSpec) -> Vec<&str> {
    spec.links.iter().map(|link| link.name.as_str()).collect()
}

fn parse(path: &str, text: &str) -> Result<ArmSpec, Diagnostics> {
    let (path, text) = (path.into(), text.into());
    ArmSpec::parse(&Source { path, text })
}

/// Reads a text twice.
fn compare(path: &str, text: &str) {
    let ours = parse(path, text).unwrap_or_else(|error| panic!("{error}"));
    let theirs = urdf_rs::read_from_string(text).unwrap_or_else(|error| panic!("{path}: {error}"));
    let theirs = ArmSpec::parse(&Source::from(&theirs)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(names(&ours), names(&theirs), "{path}");
    assert_eq!(ours.joints.len(), theirs.joints.len(), "{path}");
    for (a, b) in ours.joints.iter().zip(&theirs.joints) {
        let (a, b) = (kinematics(&ours, a), kinematics(&theirs, b));
        assert!(a == b, "{path}: {a:?} is {b:?} to urdf-rs");
    }
}

#[test]
fn both_readers_see_the_same_robots() {
    let root = Path::new("..");
    let mut folders = vec![root.join("robots"), root.join("tests")];
    let more = std::env::var_os("KIN_ROBOTS").map(|folder| root.join(folder));
    folders.extend(more.filter(|folder| folder.is_dir()));
    let mut compared = 0;
    for file in files(folders) {
        if NO_ARMS.iter().any(|name| file.ends_with(name)) {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        compare(&file.display().to_string(), &text);
        compared += 1;
    }
    assert!(compared >= 2);
}

/// The rarer words of URDF, and the rarer ways of writing XML and numbers.
const RARE: &str = r#"<robot name="r" xmlns:x="u"><link name="a"/><x:y/>
<joint name="&#106;" type="prismatic"><parent link='a'/><child link="&lt;b&amp;c&gt;"/><axis xyz="&#49;	.5
-2."/><origin xyz=" 1e-3 +2 -3E+2 "/><limit lower="-.5" upper="1" effort="7" velocity="1e1"/></joint>
<link name="é f"/><link name="&lt;b&amp;c>"/><!-- é --><joint type="revolute" name="k ">
<origin rpy="0.1 -0.2 1.5708"/><limit upper="1" effort="1" velocity="1"/><mimic joint="j" multiplier="-2" offset=".5"/>
<parent link="&lt;b&amp;c>"/><child link="é f"/></joint><link name='"'/><link name="e"/>
<joint name="free" type="continuous"><parent link="é f"/><child link="e"/><axis xyz="0 0 -3"/></joint>
<joint name="stiff" type="fixed"><parent link="e"/><child link="&quot;"/><mimic joint="j"/></joint></robot>"#;

#[test]
fn both_readers_see_the_same_rare_words() {
    compare("rare.urdf", RARE);
}

/// What is put into the text, at every place.
const WORDS: [&str; 15] = [
    "\n", "\t", " ", "&#9;", "&amp;", "-", ".", "1e", "'", "/>", "é", "0", "nan", "<!-- -->", "a",
];

/// Nothing that both readers take is two robots.
#[test]
fn both_readers_see_the_same_after_any_edit() {
    let mut compared = 0;
    for (at, _) in RARE.char_indices() {
        for word in WORDS {
            let text = format!("{}{word}{}", &RARE[..at], &RARE[at..]);
            // A joint with faults is no part of any chain.
            let sound = |spec: ArmSpec| spec.joints.iter().all(|joint| joint.faults.is_empty());
            let ours = parse("edited.urdf", &text);
            if ours.is_ok_and(sound) && urdf_rs::read_from_string(&text).is_ok() {
                compare("edited.urdf", &text);
                compared += 1;
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// With quaternions, which `urdf-rs` reads as angles: equal but for rounding.
#[test]
fn quaternions_are_the_same_rotations() {
    let text = r#"<robot name="r" version="1.1"><link name="a"/><link name="b"/>
        <joint name="j" type="fixed"><parent link="a"/><child link="b"/>
        <origin quat_xyzw="0.5 -0.1 0.7 0.5"/></joint></robot>"#;
    let source = Source {
        path: "q.urdf".into(),
        text: text.into(),
    };
    let ours = ArmSpec::parse(&source).unwrap().joints[0].origin;
    let theirs = Source::from(&urdf_rs::read_from_string(text).unwrap());
    let theirs = ArmSpec::parse(&theirs).unwrap().joints[0].origin;
    let pairs = ours
        .rotation
        .iter()
        .flatten()
        .zip(theirs.rotation.iter().flatten());
    for (a, b) in pairs {
        assert!((a - b).abs() < 1e-15, "{ours:?} is {theirs:?}");
    }
}

/// In URDF 1.2 a joint may turn without bounds and be no `continuous` one.
#[test]
fn infinite_bounds_are_none() {
    let text = r#"<robot name="r" version="1.2"><link name="a"/><link name="b"/>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/>
        <limit effort="1" velocity="1"/></joint></robot>"#;
    let robot = urdf_rs::read_from_string(text).unwrap();
    let joint = &ArmSpec::parse(&Source::from(&robot)).unwrap().joints[0];
    assert_eq!(
        (joint.kind, joint.limits),
        (JointType::Revolute, Limits::Unlimited)
    );
}

/// A joint without bounds must not become one that stands still.
#[test]
fn missing_bounds_stay_missing() {
    let text = r#"<robot name="r"><link name="a"/><link name="b"/>
        <joint name="j" type="prismatic"><parent link="a"/><child link="b"/></joint></robot>"#;
    let robot = urdf_rs::read_from_string(text).unwrap();
    let joint = &ArmSpec::parse(&Source::from(&robot)).unwrap().joints[0];
    assert_eq!(joint.limits, Limits::Missing);
}
