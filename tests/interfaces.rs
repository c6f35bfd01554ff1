//! One generator, three interfaces: the macro, build scripts and `kin generate`
//! take the same options and give the same code, header included.

use kin_codegen::build::{Config, generate_all};
use kin_codegen::{Ik, Options, Scalar, Source, Target, generate};
use std::fs;
use std::path::{Path, PathBuf};

const ROBOT: &str = "../robots/ur5e.urdf";
const PLANAR: &str = "../robots/planar_2r.yaml";

/// With `debug = true` the macro leaves its code where it can be read.
mod macros {
    kinematics::kinematics!("../robots/ur5e.urdf", debug = true);
    kinematics::kinematics!(
        "../robots/ur5e.urdf",
        debug = true,
        name = Shoulder,
        base = "shoulder_link",
        tip = "forearm_link",
        ik = none,
        strict = true,
        crate = ::kinematics,
    );
    kinematics::kinematics!(
        "../robots/planar_2r.yaml",
        debug = true,
        name = Elbow,
        target = position,
        scalar = f32,
    );
}

fn library(robot: &str, options: &Options) -> String {
    let source = Source::read(robot, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    generate(&source, options).unwrap().code()
}

/// What the macro wrote for the type; the newest, if its invocation changed.
fn macro_file(name: &str) -> String {
    let folder = temporary("kinematics/interfaces");
    let of_type = |path: &PathBuf| {
        let file = path.file_name().unwrap().to_string_lossy().into_owned();
        file.starts_with(&format!("{name}-")) && file.ends_with(".rs")
    };
    let files = fs::read_dir(folder).unwrap();
    let newest = files
        .map(|file| file.unwrap().path())
        .filter(of_type)
        .max_by_key(|path| path.metadata().unwrap().modified().unwrap());
    fs::read_to_string(newest.unwrap()).unwrap()
}

fn build_script(config: Config, name: &str) -> String {
    let file = config.file(temporary(name)).generate().unwrap();
    fs::read_to_string(file).unwrap()
}

fn command_line(robot: &str, options: &[&str]) -> String {
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join(robot);
    let command = ["kin", "generate", robot.to_str().unwrap()];
    let done = kin_cli::run([&command, options].concat());
    assert_eq!(done.stderr, "");
    done.stdout
}

fn temporary(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

#[test]
fn without_options() {
    let code = library(ROBOT, &Options::default());
    assert_eq!(macro_file("Ur5e"), code);
    assert_eq!(build_script(Config::new(ROBOT), "ur5e.rs"), code);
    assert_eq!(command_line(ROBOT, &[]), code);
    assert_eq!(macros::Ur5e::BRANCHES, 8);
}

#[test]
fn forward_alone_of_part_of_the_arm() {
    let code = library(
        ROBOT,
        &Options {
            name: Some("Shoulder".into()),
            base: Some("shoulder_link".into()),
            tip: Some("forearm_link".into()),
            ik: Ik::None,
            strict: true,
            krate: Some("::kinematics".into()),
            ..Options::default()
        },
    );
    let header = "// Options: name = Shoulder, base = \"shoulder_link\", tip = \"forearm_link\", \
                  ik = none,\n// strict = true, crate = ::kinematics.\n";
    assert!(code.contains(header), "{code}");
    assert_eq!(macro_file("Shoulder"), code);
    let config = Config::new(ROBOT)
        .name("Shoulder")
        .base("shoulder_link")
        .tip("forearm_link")
        .ik(Ik::None)
        .strict(true)
        .krate("::kinematics");
    assert_eq!(build_script(config, "shoulder.rs"), code);
    let options = "--name Shoulder --base shoulder_link --tip forearm_link --ik none --strict \
                   --crate ::kinematics";
    let options: Vec<&str> = options.split(' ').collect();
    assert_eq!(command_line(ROBOT, &options), code);
    // The header's own command.
    let mut commands = code
        .lines()
        .filter_map(|line| line.split_once(" by: kin generate "));
    let (_, command) = commands.next().unwrap();
    let words: Vec<&str> = command.split(' ').collect();
    assert!(ROBOT.ends_with(words[0]), "{command}");
    assert_eq!(command_line(ROBOT, &words[1..]), code);
    assert_eq!(macros::Shoulder::BRANCHES, 0);
}

#[test]
fn targets_of_position_in_single_precision() {
    let options = Options {
        name: Some("Elbow".into()),
        target: Some(Target::Position),
        scalar: Scalar::F32,
        ..Options::default()
    };
    let code = library(PLANAR, &options);
    assert_eq!(macro_file("Elbow"), code);
    let config = Config::new(PLANAR)
        .name("Elbow")
        .target(Target::Position)
        .scalar(Scalar::F32);
    assert_eq!(build_script(config, "elbow.rs"), code);
    let options = "--name Elbow --target position --scalar f32"
        .split(' ')
        .collect::<Vec<_>>();
    assert_eq!(command_line(PLANAR, &options), code);
    assert!(code.contains("target = position, scalar = f32"), "{code}");
    assert_eq!(macros::Elbow::BRANCHES, 2);
}

#[test]
fn several_robots_of_a_build_script_are_those_of_one() {
    let half = |name: &str, tip: &str| Config::new(ROBOT).name(name).tip(tip).ik(Ik::None);
    let both = [half("Upper", "forearm_link"), Config::new(PLANAR)];
    let file = generate_all(temporary("both.rs"), &both).unwrap();
    let [upper, planar] = both.map(|one| build_script(one, "one.rs"));
    assert_eq!(
        fs::read_to_string(file).unwrap(),
        format!("{upper}\n{planar}\n")
    );

    let twins = [half("Arm", "forearm_link"), half("Arm", "tool0")];
    let file = temporary("twins.rs");
    let error = generate_all(&file, &twins).unwrap_err().to_string();
    assert!(error.contains("two robots have the name `Arm`"), "{error}");
    let error = generate_all(&file, &[]).unwrap_err().to_string();
    assert!(error.contains("give a `Config` for each"), "{error}");
    let outside = generate_all("../both.rs", &[Config::new(PLANAR)]);
    let error = outside.unwrap_err().to_string();
    assert!(
        error.contains("../both.rs is outside of $OUT_DIR"),
        "{error}"
    );
    let folder = temporary("");
    let error = generate_all(&folder, &[Config::new(PLANAR)]).unwrap_err();
    assert!(error.to_string().contains("choose another file"), "{error}");
    let wrong = [half("A", "left"), half("B", "right"), Config::new(PLANAR)];
    let error = generate_all(&file, &wrong).unwrap_err().to_string();
    assert!(
        error.contains("`left`") && error.contains("`right`"),
        "{error}"
    );
    assert!(!file.exists());
}
