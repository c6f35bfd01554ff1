//! The same robots as C, by the C compiler of the machine with several flags, beside Rust.

use kin_codegen::{Compiled, Options, Source, compile, generate_c};
use kinematics::{Kinematics, ParallelKinematics};
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
kinematics::kinematics!("../robots/delta.yaml");
kinematics::kinematics!("../robots/five_bar.yaml");
kinematics::kinematics!("../robots/four_bar.yaml");
kinematics::kinematics!("../robots/slider_crank.yaml");
kinematics::kinematics!("../robots/stewart.yaml");

const ROUNDS: usize = 41;

/// For any processor, which takes AVX2 where that is, and for this one.
const FLAGS: [&str; 3] = ["-O2", "-O3", "-O3 -march=native -ffp-contract=off"];

const TIMES: &str = include_str!("../c/times.c");
const MECHANISM_TIMES: &str = include_str!("../c/mechanism_times.c");

fn main() {
    println!("| medians, ns | pose | all solutions |\n|---|---|---|");
    robot("UR5e", "ur5e.urdf", &Ur5e);
    robot("KR 6 R900", "kr6_r900.yaml", &Kr6R900);
    robot("xArm 6", "xarm6.yaml", &Xarm6);
    println!(
        "\n| medians, ns | postures | assemblies | nearby | Jacobian |\n|---|---|---|---|---|"
    );
    mechanism("delta", "delta.yaml", &Delta, |driven| {
        Delta.fk(driven).len()
    });
    mechanism("five bars", "five_bar.yaml", &FiveBar, |driven| {
        FiveBar.fk(driven).len()
    });
    mechanism("four bars", "four_bar.yaml", &FourBar, |driven| {
        FourBar.fk(driven).len()
    });
    mechanism(
        "slider crank",
        "slider_crank.yaml",
        &SliderCrank,
        |driven| SliderCrank.fk(driven).len(),
    );
    mechanism("Stewart", "stewart.yaml", &Stewart, |_| 0);
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
        let numbers = in_c(file, TIMES, flags, &input);
        let [forward, inverse, in_c] = numbers.try_into().expect("three numbers");
        // Of a polynomial, two solutions that have nearly met may be one.
        let others = (in_c - found as f64).abs();
        assert!(others <= 1e-4 * found as f64, "other solutions");
        println!("| {name}, C, `{flags}` | {forward:.0} | {inverse:.0} |");
    }
}

/// Closed configurations of a mechanism.
fn closed<const N: usize>(file: &str) -> Vec<[f64; N]> {
    let compiled = compile(&source(file), &Options::default()).expect("a mechanism");
    let Compiled::Mechanism(mechanism) = compiled else {
        panic!("{file} is an arm")
    };
    let samples = mechanism.freedom.samples.iter().take(512);
    samples
        .map(|q| q.as_slice().try_into().expect("all joints"))
        .collect()
}

fn mechanism<const N: usize, const M: usize, const K: usize>(
    name: &str,
    file: &str,
    robot: &impl ParallelKinematics<N, M, K>,
    // Where there is no closed form, calling it does not compile.
    fk: impl Fn(&[f64; M]) -> usize,
) {
    let all = closed::<N>(file);
    let mut input = format!("{}\n", all.len());
    for x in all.iter().flatten() {
        let _ = writeln!(input, "{x:e}");
    }
    let poses: Vec<_> = all.iter().map(|q| robot.platform(q)).collect();
    let driven: Vec<[f64; M]> = all.iter().map(|q| robot.actuated(q)).collect();
    let moved = |driven: &[f64; M]| {
        std::array::from_fn::<_, M, _>(|a| driven[a] + 0.01 * (a % 3) as f64 - 0.01)
    };
    let moved: Vec<[f64; M]> = driven.iter().map(moved).collect();
    let tasks: [&dyn Fn(usize) -> usize; 4] = [
        &|i| black_box(robot.ik(black_box(&poses[i]))).len(),
        &|i| fk(black_box(&driven[i])),
        &|i| usize::from(black_box(robot.fk_near(black_box(&moved[i]), &all[i])).is_some()),
        &|i| usize::from(black_box(robot.forward_jacobian(black_box(&all[i]))).is_some()),
    ];
    let said = |language: &str, times: [f64; 4]| {
        let [postures, assemblies, nearby, jacobian] = times;
        println!(
            "| {name}, {language} | {postures:.0} | {assemblies:.0} | {nearby:.0} | {jacobian:.0} |"
        );
    };
    let found = tasks.map(|task| (0..all.len()).map(task).sum::<usize>());
    said(
        "Rust",
        tasks.map(|task| {
            median(all.len(), || {
                (0..all.len()).for_each(|i| {
                    black_box(task(i));
                });
            })
        }),
    );
    for flags in FLAGS {
        let numbers = in_c(file, MECHANISM_TIMES, flags, &input);
        let times = std::array::from_fn(|task| numbers[2 * task]);
        let in_c: [f64; 4] = std::array::from_fn(|task| numbers[2 * task + 1]);
        // Next to singularities, rounding decides whether two have met.
        let same = (found.iter().zip(in_c)).all(|(a, b)| (b - *a as f64).abs() <= 0.01 * b);
        assert!(same, "{found:?} in Rust, {in_c:?} in C");
        said(&format!("C, `{flags}`"), times);
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

fn source(file: &str) -> Source {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    Source::read(file, &robots).expect("a robot of this repository")
}

/// What a program says that times a robot.
fn in_c(file: &str, times: &str, flags: &str, input: &str) -> Vec<f64> {
    let c = generate_c(&source(file), &Options::default()).expect("a closed form");
    let folder = std::env::temp_dir().join(format!("kinematics-c-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let upper = format!("{}_", c.name.to_ascii_uppercase());
    let times = times
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
    std::fs::remove_dir_all(&folder).expect("the folder");
    let numbers = text.split_whitespace().map(|x| x.parse());
    numbers.collect::<Result<_, _>>().expect("numbers")
}
