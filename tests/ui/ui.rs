//! Programs that must not compile, and what the compiler says about each.
//! `BLESS=1 cargo test --package kinematics-ui --test ui` writes the messages anew, for review.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[test]
fn programs_that_must_not_compile_say_why() {
    let compiler = Compiler::new();
    let programs = [".", "arguments"].into_iter().flat_map(programs);
    let mut differ = Vec::new();
    for program in programs {
        let output = compiler.run(&program);
        assert!(!output.status.success(), "{program} compiles");
        let said = about(&program, &String::from_utf8(output.stderr).unwrap());
        let expected = Path::new(&program).with_extension("stderr");
        if env::var_os("BLESS").is_some() {
            fs::write(&expected, &said).unwrap();
        } else if fs::read_to_string(&expected).unwrap_or_default() != said {
            differ.push(format!("{program}:\n{said}"));
        }
    }
    assert!(differ.is_empty(), "{}", differ.join("\n"));
}

#[test]
fn robots_stand_beside_each_other_and_among_names_of_their_own() {
    let compiler = Compiler::new();
    let Output { status, stderr, .. } = compiler.run("neighbours.rs");
    assert!(status.success(), "{}", String::from_utf8_lossy(&stderr));
    let built = Path::new(env!("CARGO_TARGET_TMPDIR")).join("neighbours");
    let status = Command::new(built).status();
    assert!(status.unwrap().success());
}

/// The programs of a folder that must not compile: those whose names are of two words, below.
fn programs(folder: &str) -> Vec<String> {
    let files = fs::read_dir(folder).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    let is_one = |name: &String| name.ends_with(".rs") && (folder != "." || name.contains('_'));
    let paths = names.filter(is_one).map(|name| match folder {
        "." => name,
        _ => format!("{folder}/{name}"),
    });
    let mut paths: Vec<String> = paths.collect();
    paths.sort();
    paths
}

/// What is said about a program: without what is shown of other files, and how many errors there
/// are.
fn about(program: &str, said: &str) -> String {
    let mut about = String::new();
    let mut is_shown = true;
    for line in said.lines() {
        let start = line.trim_start();
        let place = start.strip_prefix("--> ").or(start.strip_prefix("::: "));
        let is_next = start.is_empty() || start.starts_with("= ") || starts_with_letter(line);
        is_shown = match place {
            Some(place) => place.starts_with(program),
            None => is_shown || is_next,
        };
        if is_shown {
            about += line.trim_end();
            about += "\n";
        }
    }
    let is_counted = |said: &&str| !COUNTS.iter().any(|count| said.starts_with(count));
    let said: Vec<&str> = about.trim_end().split("\n\n").filter(is_counted).collect();
    said.join("\n\n") + "\n"
}

/// How what is said at the end begins.
const COUNTS: [&str; 3] = [
    "error: aborting",
    "For more information",
    "Some errors have",
];

fn starts_with_letter(line: &str) -> bool {
    line.starts_with(|c: char| c.is_alphabetic())
}

/// The compiler, and what programs are compiled with.
struct Compiler {
    /// `target/debug`, say.
    built: PathBuf,
}

impl Compiler {
    /// Builds `kinematics` without features, beside what this test was built with: its macros as
    /// they are built already, which the other package asks for.
    fn new() -> Self {
        let own = env::current_exe().unwrap();
        let built = own.ancestors().nth(2).unwrap().to_owned();
        let profile = match built.file_name().unwrap().to_str().unwrap() {
            "debug" => "dev",
            name => name,
        };
        let status = Command::new(env!("CARGO"))
            .current_dir("../..")
            .args([
                "build",
                "--package",
                "kinematics",
                "--package",
                "kinematics-ui",
            ])
            .arg("--no-default-features")
            .args(["--profile", profile, "--target-dir"])
            .arg(built.parent().unwrap())
            .status();
        assert!(status.unwrap().success());
        Self { built }
    }

    /// Compiles a program of this folder to the end: some errors are found when code is written.
    fn run(&self, program: &str) -> Output {
        let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let kinematics = self.built.join("libkinematics.rlib");
        let dependencies = self.built.join("deps");
        Command::new(rustc)
            .args([program, "--edition", "2024", "--color", "never"])
            .args(["--diagnostic-width", "140", "--extern"])
            .arg(format!("kinematics={}", kinematics.display()))
            .arg(format!("-Ldependency={}", dependencies.display()))
            .args(["--out-dir", env!("CARGO_TARGET_TMPDIR")])
            .output()
            .unwrap()
    }
}
