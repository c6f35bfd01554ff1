//! What it costs to compile a robot: time, size of the code, operations, and
//! the build of a crate with one arm.

use kin_codegen::{Compiled, Options, Source, generate};
use kinematics_benches::contest::median;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

fn main() {
    println!(
        "{:16} {:>10} {:>10}  {:>9}  {:>9}",
        "", "generate", "code", "fk", "fk + J"
    );
    for robot in robots() {
        report(&robot);
    }
    build_of_a_crate();
}

fn robots() -> Vec<PathBuf> {
    let files = std::fs::read_dir(Path::new(ROOT).join("robots")).expect("robots/ is there");
    let is_arm = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).expect("readable");
        !text.contains("\nmechanism:")
    };
    let files = files.map(|file| file.expect("readable").path());
    let mut files: Vec<PathBuf> = files.filter(is_arm).collect();
    files.sort();
    files
}

fn report(robot: &Path) {
    let text = std::fs::read_to_string(robot).expect("readable");
    let name = robot
        .file_name()
        .expect("a file")
        .to_string_lossy()
        .into_owned();
    let source = Source {
        path: name.clone(),
        text,
    };
    let mut times = Vec::new();
    for _ in 0..11 {
        let start = Instant::now();
        let generated = generate(&source, &Options::default());
        times.push(start.elapsed().as_secs_f64() * 1e3);
        assert!(
            generated.is_ok(),
            "{name}: {}",
            generated.expect_err("checked")
        );
    }
    let generated = generate(&source, &Options::default()).expect("just done");
    let Compiled::Arm(compiled) = &generated.robot else {
        return;
    };
    let forward = compiled.forward();
    let (fk, both) = (forward.tip_cost(), forward.tip_and_jacobian_cost());
    println!(
        "{name:16} {:7.1} ms {:7.1} kB  {:4}/{:4}  {:4}/{:4}",
        median(times),
        generated.code().len() as f64 / 1e3,
        fk.multiplications,
        fk.additions,
        both.multiplications,
        both.additions
    );
}

/// Builds a crate with one arm, then again with only that crate changed.
fn build_of_a_crate() {
    let folder = std::env::temp_dir().join(format!("kinematics-build-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("src")).expect("a temporary folder");
    let root = std::fs::canonicalize(ROOT).expect("the project's root");
    let manifest = format!(
        "[package]\nname = \"user\"\nversion = \"0.1.0\"\nedition = \"2024\"\n[workspace]\n\
         [dependencies]\nkinematics = {{ path = {root:?} }}\n"
    );
    let main = format!(
        "kinematics::kinematics!({:?});\n\
         fn main() {{ println!(\"{{:?}}\", Ur5e.ik(&Ur5e.fk(&[0.1; 6]))); }}\n",
        root.join("robots/ur5e.urdf")
    );
    std::fs::write(folder.join("Cargo.toml"), manifest).expect("written");
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("copied");
    std::fs::write(folder.join("src/main.rs"), &main).expect("written");
    println!("\na crate with a UR5e, dependencies already built");
    for profile in ["dev", "release"] {
        build(&folder, profile);
        std::fs::write(folder.join("src/main.rs"), format!("// again\n{main}")).expect("written");
        let seconds = build(&folder, profile);
        std::fs::write(folder.join("src/main.rs"), &main).expect("written");
        println!("  {profile:8} {seconds:5.2} s");
    }
    std::fs::remove_dir_all(&folder).expect("removed");
}

fn build(folder: &Path, profile: &str) -> f64 {
    let start = Instant::now();
    let status = Command::new("cargo")
        .args([
            "build",
            "--quiet",
            "--profile",
            profile,
            "--target-dir",
            "target",
        ])
        .current_dir(folder)
        .status()
        .expect("cargo runs");
    assert!(status.success(), "the crate does not build");
    start.elapsed().as_secs_f64()
}
