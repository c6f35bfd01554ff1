//! Beside the C++ that IKFast generates, of which the sources of ikfast-pybind on PyPI have some:
//!
//! ```sh
//! pip download --no-deps --no-binary :all: ikfast-pybind==0.1.2 && tar xzf ikfast_pybind-0.1.2.tar.gz
//! cargo run --release --bin ikfast -- ikfast_pybind-0.1.2/src
//! ```
//!
//! Either solves for the targets that its own forward kinematics makes of the same configurations.

use kinematics::{Kinematics, Pose, Solutions};
use kinematics_benches::inputs::configurations;
use kinematics_benches::redundant::seven;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::hint::black_box;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

kinematics::kinematics!("../robots/kr6_r900.yaml");
kinematics::kinematics!("../robots/panda.yaml");

const ROUNDS: usize = 41;
/// Solutions that are as near are the same, radians: next to a singular configuration rounding
/// takes half of their digits.
const SAME: f64 = 1e-5;

const FLAGS: [&str; 2] = ["-O2", "-O3 -march=native"];

fn main() {
    let folder: PathBuf = std::env::args_os()
        .nth(1)
        .expect("the folder `src` of ikfast-pybind")
        .into();
    println!("| medians, ns | pose | all solutions | the same sets |\n|---|---|---|---|");
    let solver = "kuka_kr6_r900/ikfast0x1000004a.Transform6D.0_1_2_3_4_5.cpp";
    let ik = |pose: &Pose, _: &[f64; 6]| Kr6R900.ik(pose);
    beside(
        "KR 6 R900",
        &folder.join(solver),
        &configurations(),
        &Kr6R900,
        ik,
    );
    let solver = "franka_panda/ikfast0x10000049.Transform6D.0_1_2_3_4_5_f6.cpp";
    let q: Vec<[f64; 7]> = seven().into_iter().map(|(q, _)| q).collect();
    let ik = |pose: &Pose, q: &[f64; 7]| Panda.ik_at(pose, q[6]);
    beside("Panda, q7 given", &folder.join(solver), &q, &Panda, ik);
}

fn beside<const N: usize>(
    name: &str,
    solver: &Path,
    all: &[[f64; N]],
    robot: &impl Kinematics<N>,
    ik: impl Fn(&Pose, &[f64; N]) -> Solutions<N>,
) {
    let poses: Vec<Pose> = all.iter().map(|q| robot.fk(q)).collect();
    let forward = median(all.len(), || {
        for q in all {
            black_box(robot.fk(black_box(q)));
        }
    });
    let inverse = median(all.len(), || {
        for (pose, q) in poses.iter().zip(all) {
            black_box(ik(black_box(pose), q));
        }
    });
    println!("| **{name}** | {forward:.0} | {inverse:.0} | |");
    let mut input = String::new();
    for x in all.iter().flatten() {
        let _ = writeln!(input, "{x:e}");
    }
    for flags in FLAGS {
        let output = by_ikfast(solver, flags, &input);
        let mut numbers = output
            .split_whitespace()
            .map(|x| x.parse::<f64>().expect("a number"));
        let mut next = || numbers.next().expect("one more number");
        let [theirs_forward, theirs_inverse] = [next(), next()];
        let mut same = 0;
        for (pose, q) in poses.iter().zip(all) {
            let ours = ik(pose, q);
            let theirs: Vec<[f64; N]> = (0..next() as usize)
                .map(|_| std::array::from_fn(|_| next()))
                .collect();
            let is_ours = |q: &[f64; N]| ours.iter().any(|it| is_same(&it.q, q));
            let is_theirs = |q: &[f64; N]| theirs.iter().any(|it| is_same(it, q));
            let all_are = theirs.iter().all(is_ours) && ours.iter().all(|it| is_theirs(&it.q));
            same += usize::from(all_are);
        }
        let ratios = [theirs_forward / forward, theirs_inverse / inverse];
        println!(
            "| IKFast, `{flags}` | {theirs_forward:.0}, {:.1}x | {theirs_inverse:.0}, {:.1}x | {same} of {} |",
            ratios[0],
            ratios[1],
            all.len()
        );
    }
}

/// Joint by joint, modulo full turns.
fn is_same<const N: usize>(a: &[f64; N], b: &[f64; N]) -> bool {
    let apart = |(a, b): (&f64, &f64)| ((a - b + PI).rem_euclid(TAU) - PI).abs();
    a.iter().zip(b).map(apart).all(|apart| apart < SAME)
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

/// What the program of `ikfast.cpp` writes.
fn by_ikfast(solver: &Path, flags: &str, input: &str) -> String {
    let solver = solver.canonicalize().expect("ikfast-pybind 0.1.2");
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/src/c/ikfast.cpp");
    let program = std::env::temp_dir().join(format!("kinematics-ikfast-{}", std::process::id()));
    let compiled = Command::new("c++")
        .args(["-std=c++11", "-w"])
        .args(flags.split(' '))
        .arg(format!("-DSOLVER=\"{}\"", solver.display()))
        .arg("-o")
        .args([program.as_os_str(), source.as_ref()])
        .status();
    assert!(compiled.is_ok_and(|status| status.success()), "c++ {flags}");
    let mut child = Command::new(&program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program");
    let mut stdin = child.stdin.take().expect("its input");
    stdin.write_all(input.as_bytes()).expect("it reads");
    drop(stdin);
    let output = child.wait_with_output().expect("its output");
    std::fs::remove_file(&program).expect("the program");
    String::from_utf8(output.stdout).expect("numbers")
}
