//! Instructions per call, which are the same on every run: `valgrind` counts them
//! (3.19 or later; its processor has AVX2). Fails if what the target is like changes
//! what is executed, by more than the rare correction of a branch: a jump that depends
//! on data.

use kinematics::__private::dispatch::{Instructions, use_at_most};
use kinematics::{Kinematics, Pose};
use kinematics_benches::inputs::{configurations, targets};
use std::hint::black_box;
use std::process::{Command, ExitCode};

kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/kr6_r900.yaml");
kinematics::kinematics!("../robots/irb6640.yaml");

const CALLS: usize = 512;
const ROBOTS: [&str; 3] = ["UR5e", "KR 6 R900", "IRB 6640"];
const KINDS: [&str; 5] = ["fk", "fk_jacobian", "regular", "unreachable", "singular"];
/// Of the instructions: what `ik` may take more or less for targets out of reach.
const JUMPS: f64 = 0.01;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let [robot, kind] = &words[..] {
        use_at_most(Instructions::Avx2);
        match robot.as_str() {
            "UR5e" => run(&Ur5e, kind),
            "KR 6 R900" => run(&Kr6R900, kind),
            _ => run(&Irb6640, kind),
        }
        return ExitCode::SUCCESS;
    }
    println!("Instructions per call, of {CALLS} (AVX2):\n");
    println!("| | fk | fk_jacobian | ik, regular | out of reach | singular wrist |");
    println!("|---|---|---|---|---|---|");
    let mut same = true;
    for robot in ROBOTS {
        let counts = KINDS.map(|kind| counted(robot, kind) / CALLS as f64);
        println!(
            "| {robot} | {} |",
            counts.map(|n| format!("{n:.0}")).join(" | ")
        );
        same &= (counts[3] / counts[2] - 1.0).abs() < JUMPS;
    }
    if same {
        return ExitCode::SUCCESS;
    }
    eprintln!("targets out of reach take another number of instructions");
    ExitCode::FAILURE
}

/// Instructions that `measured` and what it calls take.
fn counted(robot: &str, kind: &str) -> f64 {
    let own = std::env::current_exe().expect("this program has a path");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .args(["--collect-atstart=no", "--toggle-collect=*measured*"])
        .arg(own)
        .args([robot, kind])
        .output()
        .expect("valgrind is installed");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let line = said
        .lines()
        .find_map(|line| line.split("Collected :").nth(1));
    line.and_then(|count| count.trim().parse().ok())
        .unwrap_or_else(|| panic!("{said}"))
}

fn run<K: Kinematics<6>>(robot: &K, kind: &str) {
    let q = &configurations()[..CALLS];
    let mut all = targets(robot);
    all.truncate(CALLS);
    let targets: Vec<Pose> = match kind {
        "unreachable" => {
            let away = Pose::from_translation([0.0, 0.0, 10.0]);
            all.iter().map(|target| away * *target).collect()
        }
        "singular" => {
            let straight = |q: &[f64; 6]| robot.fk(&[q[0], q[1], q[2], q[3], 0.0, q[5]]);
            q.iter().map(straight).collect()
        }
        _ => all,
    };
    match kind {
        "fk" => measured_on(q, |q| robot.fk(q)),
        "fk_jacobian" => measured_on(q, |q| robot.fk_jacobian(q)),
        _ => measured_on(&targets, |target| robot.ik(target)),
    }
}

#[inline(never)]
fn measured_on<I, O>(inputs: &[I], solve: impl Fn(&I) -> O) {
    for input in inputs {
        black_box(solve(black_box(input)));
    }
}
