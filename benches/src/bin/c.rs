//! The same robots as C, by the C compiler of the machine with several flags, beside Rust.

use kin_codegen::{Options, Source, generate_c};
use kinematics::Kinematics;
use kinematics_benches::inputs::{configurations, targets};
use std::fmt::Write as _;
use std::hint::black_box;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/kr6_r900.yaml");
kinematics::kinematics!("../robots/xarm6.yaml");

const ROUNDS: usize = 41;

/// For any processor, which takes AVX2 where that is, and for this one.
const FLAGS: [&str; 3] = ["-O2", "-O3", "-O3 -march=native -ffp-contract=off"];

fn main() {
    println!("| medians, ns | pose | all solutions |\n|---|---|---|");
    robot("UR5e", "ur5e.urdf", &Ur5e);
    robot("KR 6 R900", "kr6_r900.yaml", &Kr6R900);
    robot("xArm 6", "xarm6.yaml", &Xarm6);
}

fn robot(name: &str, file: &str, robot: &impl Kinematics<6>) {
    let (q, poses) = (configurations(), targets(robot));
    let found: usize = poses.iter().map(|pose| robot.ik(pose).len()).sum();
    let forward = median(q.len(), || {
        for q in &q {
            black_box(robot.fk(black_box(q)));
        }
    });
    let inverse = median(q.len(), || {
        for pose in &poses {
            black_box(robot.ik(black_box(pose)));
        }
    });
    println!("| {name}, Rust | {forward:.0} | {inverse:.0} |");
    let mut input = String::new();
    for x in q.iter().flatten() {
        let _ = writeln!(input, "{x:e}");
    }
    for flags in FLAGS {
        let [forward, inverse, in_c] = in_c(file, flags, &input);
        // Of a polynomial, two solutions that have nearly met may be one.
        let others = (in_c - found as f64).abs();
        assert!(others <= 1e-4 * found as f64, "other solutions");
        println!("| {name}, C, `{flags}` | {forward:.0} | {inverse:.0} |");
    }
}

fn median(count: usize, mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_nanos() as f64 / count as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[ROUNDS / 2]
}

/// Nanoseconds for a pose and for all solutions, and how many these are.
fn in_c(file: &str, flags: &str, input: &str) -> [f64; 3] {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    let source = Source::read(file, &robots).expect("a robot of this repository");
    let c = generate_c(&source, &Options::default()).expect("a closed form");
    let folder = std::env::temp_dir().join(format!("kinematics-c-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let upper = format!("{}_", c.name.to_ascii_uppercase());
    let times = include_str!("../c/times.c")
        .replace("kin_.h", &format!("{}.h", c.name))
        .replace("KIN_", &upper)
        .replace("kin_", &format!("{}_", c.name));
    let path = |name: &str| folder.join(name);
    let [header, code] = ["h", "c"].map(|ending| path(&format!("{}.{ending}", c.name)));
    for (file, text) in [
        (&header, &c.header),
        (&code, &c.source),
        (&path("times.c"), &times),
    ] {
        std::fs::write(file, text).expect("a file in the folder");
    }
    let compiled = Command::new("cc")
        .arg("-std=c99")
        .args(flags.split(' '))
        .arg("-o")
        .args([path("times"), path("times.c"), code])
        .arg("-lm")
        .status();
    assert!(compiled.is_ok_and(|status| status.success()), "cc {flags}");
    let mut child = Command::new(path("times"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program");
    let mut stdin = child.stdin.take().expect("its input");
    stdin.write_all(input.as_bytes()).expect("it reads");
    drop(stdin);
    let output = child.wait_with_output().expect("its output");
    let text = String::from_utf8(output.stdout).expect("numbers");
    let numbers: Vec<f64> = text
        .split_whitespace()
        .filter_map(|x| x.parse().ok())
        .collect();
    std::fs::remove_dir_all(&folder).expect("the folder");
    numbers.try_into().expect("three numbers")
}
