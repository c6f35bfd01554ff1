//! The slowest calls: inverse kinematics of arms without a closed form of their own,
//! one call at a time. `cargo run --release --bin tail`, with how many targets of each
//! kind as an argument, and as a second one the instructions to use at most: `sse2`, `avx2`.
//!
//! A target is solved three times, and the fastest counts, so that what else the machine
//! does is not taken for the solver's; the configuration that made it must be among the
//! solutions.

use kinematics::{Kinematics, Pose, Solutions};
use kinematics_benches::inputs::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::hint::black_box;
use std::time::Instant;

kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/xarm6.yaml");
kinematics::kinematics!("../tests/robots/crx10ial.yaml");
kinematics::kinematics!("../tests/robots/noisy/calibrated.yaml");
kinematics::kinematics!("../tests/robots/noisy/truncated_pi.yaml");

/// Where targets come from.
#[derive(Clone, Copy)]
enum Kind {
    /// Joints anywhere.
    Random,
    /// One or two joints as near to a quarter turn as 1e-6.
    Near,
    /// All joints at quarter turns.
    Round,
    /// Joints anywhere, but for the tool, which is turned to point straight down.
    Down,
}

fn configuration(kind: Kind, k: usize, random: &mut Random) -> [f64; 6] {
    let quarter = |random: &mut Random| (4.0 * random.unit()).floor() * FRAC_PI_2;
    let mut q = std::array::from_fn(|_| PI * (2.0 * random.unit() - 1.0));
    match kind {
        Kind::Random | Kind::Down => {}
        Kind::Near => {
            for _ in 0..1 + k % 2 {
                let joint = (6.0 * random.unit()) as usize;
                let off = 10_f64.powf(-6.0 + 5.0 * random.unit());
                q[joint] = quarter(random) + off;
            }
        }
        Kind::Round => q = std::array::from_fn(|_| quarter(random)),
    }
    q
}

/// Where a configuration puts the tip, turned so that the last axis points down.
fn down<K: Kinematics<6>>(robot: &K, q: &[f64; 6]) -> Pose {
    let [x, y, z] = robot.spatial_jacobian(q).column(5).angular;
    let turn = Pose::from_axis_angle([-y, x, 0.0], x.hypot(y).atan2(-z), [0.0; 3]);
    let pose = robot.fk(q);
    Pose {
        rotation: (turn * pose).rotation,
        ..pose
    }
}

fn times<K: Kinematics<6>>(
    name: &str,
    robot: &K,
    count: usize,
    ik: impl Fn(&Pose) -> Solutions<6>,
) {
    for (kind, word) in [
        (Kind::Random, "random"),
        (Kind::Near, "near round"),
        (Kind::Round, "round"),
        (Kind::Down, "tool straight down"),
    ] {
        let mut random = Random::default();
        let (mut micros, mut lost, mut found) = (Vec::new(), 0, 0);
        for k in 0..count {
            let mut q = configuration(kind, k, &mut random);
            let mut target = robot.fk(&q);
            if matches!(kind, Kind::Down) {
                while {
                    target = down(robot, &q);
                    ik(&target).is_empty()
                } {
                    q = configuration(kind, k, &mut random);
                }
            }
            let time = || {
                let start = Instant::now();
                black_box(ik(black_box(&target)));
                start.elapsed().as_nanos() as f64 / 1000.0
            };
            micros.push((0..3).map(|_| time()).fold(f64::INFINITY, f64::min));
            let solutions = ik(&target);
            found += solutions.len();
            let apart = |a: f64, b: f64| (a - b).rem_euclid(TAU).min((b - a).rem_euclid(TAU));
            let same = |found: &[f64; 6]| found.iter().zip(&q).all(|(a, b)| apart(*a, *b) < 1e-4);
            lost += usize::from(!solutions.iter().any(|solution| same(&solution.q)));
        }
        micros.sort_by(f64::total_cmp);
        let at = |share: f64| micros[((count - 1) as f64 * share) as usize];
        println!(
            "| {name} | {word} | {:.2} | {} | {:.1} | {:.1} | {:.1} | {:.1} |",
            found as f64 / count as f64,
            // A round target may have a family of solutions, of which some are given; of one that is turned
            // no configuration is known.
            if matches!(kind, Kind::Round | Kind::Down) {
                "-".into()
            } else {
                lost.to_string()
            },
            at(0.5),
            at(0.99),
            at(0.999),
            at(1.0)
        );
    }
}

/// In a program that is itself compiled for AVX2 nothing is chosen.
#[cfg(all(target_arch = "x86_64", not(target_feature = "avx2")))]
fn use_at_most(instructions: &str) {
    use kinematics::__private::dispatch::{Instructions, use_at_most};
    let wanted = match instructions {
        "sse2" => Instructions::Sse2,
        "avx2" => Instructions::Avx2,
        _ => panic!("{instructions} is neither sse2 nor avx2"),
    };
    println!("{:?} at most\n", use_at_most(wanted));
}

#[cfg(not(all(target_arch = "x86_64", not(target_feature = "avx2"))))]
fn use_at_most(_: &str) {
    panic!("the instructions of this program were chosen when it was compiled");
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let count = arguments.next();
    let count = count.map_or(20_000, |count| count.parse().expect("a number of targets"));
    if let Some(instructions) = arguments.next() {
        use_at_most(&instructions);
    }
    println!("| arm | targets | solutions | lost | p50 µs | p99 | p99.9 | worst |");
    println!("|---|---|---|---|---|---|---|---|");
    times("UR5e, exact", &Ur5e, count, |p| Ur5e.ik(p));
    times("calibrated, 5e-4", &Calibrated, count, |p| Calibrated.ik(p));
    times("rounded to 3.141", &TruncatedPi, count, |p| {
        TruncatedPi.ik(p)
    });
    times("xArm 6, no closed form", &Xarm6, count, |p| Xarm6.ik(p));
    times("CRX-10iA/L, no closed form", &Crx10ial, count, |p| {
        Crx10ial.ik(p)
    });
}
