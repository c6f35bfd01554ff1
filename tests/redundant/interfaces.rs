//! The option `free` through the three interfaces.

use kin_codegen::build::Config;
use kin_codegen::{Options, Source, generate};
use std::fs;
use std::path::Path;

const ROBOT: &str = "robots/redundant/gantry_iiwa.yaml";

#[test]
fn all_give_the_same_code() {
    let options = Options {
        name: Some("Hall".into()),
        free: vec!["slide".into(), "joint_a7".into()],
        ..Options::default()
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let source = Source::read(ROBOT, root).unwrap();
    let code = generate(&source, &options).unwrap().code();
    assert!(code.contains("--free slide --free joint_a7"), "{code}");

    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hall.rs");
    let config = Config::new(ROBOT)
        .name("Hall")
        .free("slide")
        .free("joint_a7");
    config.file(&file).generate().unwrap();
    assert_eq!(fs::read_to_string(file).unwrap(), code);

    let robot = root.join(ROBOT);
    let command = ["kin", "generate", robot.to_str().unwrap(), "--name", "Hall"];
    let free = ["--free", "slide", "--free", "joint_a7"];
    let done = kin_cli::run([&command[..], &free].concat());
    assert_eq!((done.stderr.as_str(), &done.stdout), ("", &code));
}
