//! Writes all robots' code, and a program that runs the examples in it: `$OUT_DIR/examples.rs`.

use kin_codegen::{Ik, Options, Source, Target, generate};
use std::path::{Path, PathBuf};
use std::{env, fs};

const ROOT: &str = "../..";
const FOLDERS: [&str; 5] = [
    "robots",
    "tests/robots/table",
    "tests/robots/targets",
    "tests/robots/noisy",
    "tests/robots/redundant",
];

/// Robots' code, and what runs their examples.
#[derive(Default)]
struct Program {
    modules: String,
    main: String,
}

impl Program {
    fn add(&mut self, name: &str, robot: &str, options: &Options) {
        let source = Source::read(robot, Path::new(ROOT)).unwrap();
        let code = generate(&source, options).unwrap().code();
        let example = example(&code);
        assert!(!example.is_empty(), "{robot}");
        self.modules += &format!("/// {robot}\npub mod {name} {{\n{code}}}\n\n");
        self.main += &format!("    {{\n    use {name}::*;\n{example}    }}\n");
    }
}

/// The example of the type's documentation.
fn example(code: &str) -> String {
    let lines = code.lines().map(str::trim_start);
    let lines = lines.skip_while(|line| !line.starts_with("///"));
    let documentation = lines.map_while(|line| line.strip_prefix("///"));
    let inside = documentation
        .map(str::trim)
        .skip_while(|line| *line != "```ignore")
        .skip(1);
    let example = inside.take_while(|line| *line != "```");
    example.map(|line| format!("    {line}\n")).collect()
}

fn robots(folder: &str) -> Vec<String> {
    let files = fs::read_dir(Path::new(ROOT).join(folder)).unwrap();
    let files = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    let robots = files.filter(|file| file.ends_with(".yaml") || file.ends_with(".urdf"));
    let mut robots: Vec<String> = robots.map(|file| format!("{folder}/{file}")).collect();
    robots.sort();
    robots
}

fn main() {
    let mut program = Program::default();
    for folder in FOLDERS {
        println!("cargo::rerun-if-changed={ROOT}/{folder}");
        for robot in robots(folder) {
            let name = robot.replace(['/', '.'], "_");
            program.add(&name, &robot, &Options::default());
        }
    }
    let forward_alone = Options {
        ik: Ik::None,
        ..Options::default()
    };
    program.add("forward_alone", "robots/ur5e.urdf", &forward_alone);
    let whole_pose = Options {
        target: Some(Target::Pose),
        ..Options::default()
    };
    program.add("whole_pose", "tests/robots/targets/crank.yaml", &whole_pose);
    let Program { modules, main } = program;
    let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap());
    let text = format!("{modules}fn main() {{\n{main}}}\n");
    fs::write(folder.join("examples.rs"), text).unwrap();
}
