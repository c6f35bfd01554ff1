//! What a planner asks for: a million configurations or targets at once, beside one
//! after the other.

use kinematics::{Jacobian, Kinematics, Pose, Solutions};
use kinematics_benches::inputs::Random;
use kinematics_benches::peers;
use rs_opw_kinematics::kinematic_traits::Kinematics as _;
use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/kr6_r900.yaml");

const ALL: usize = 1_000_000;
/// What is asked for in one call where it is to stay in the cache.
const PART: usize = 512;
const ROUNDS: usize = 11;

fn main() {
    println!("ns each, of {PART} in one call: the fastest, the median, and what 99 % take at");
    println!("most; and of {ALL}: poses and Jacobians in one call, solutions in calls of {PART}");
    println!("with the same place for them\n");
    println!("| | least | p50 | p99 | a million |\n|---|---|---|---|---|");
    forward("UR5e", &Ur5e);
    inverse("UR5e", &Ur5e);
    forward("KR 6 R900", &Kr6R900);
    inverse("KR 6 R900", &Kr6R900);
    let opw = peers::kr6_in_opw();
    let mut poses = vec![opw.forward(&[0.0; 6]); ALL];
    report("KR 6 R900, forward, rs-opw-kinematics", |range| {
        let q = &configurations()[range.clone()];
        for (q, pose) in q.iter().zip(&mut poses[range]) {
            *pose = opw.forward(q);
        }
    });
}

fn forward(name: &str, robot: &impl Kinematics<6>) {
    let all = configurations();
    let mut poses = vec![Pose::IDENTITY; ALL];
    robot.fk_batch(all, &mut poses);
    assert!(all.iter().zip(&poses).all(|(q, pose)| robot.fk(q) == *pose));
    report(&format!("{name}, forward, one by one"), |range| {
        for (q, pose) in all[range.clone()].iter().zip(&mut poses[range]) {
            *pose = robot.fk(q);
        }
    });
    report(&format!("{name}, forward, `fk_batch`"), |range| {
        robot.fk_batch(&all[range.clone()], &mut poses[range]);
    });

    let mut both = vec![
        (
            Pose::IDENTITY,
            Jacobian {
                rows: [[0.0; 6]; 6]
            }
        );
        ALL
    ];
    robot.fk_jacobian_batch(all, &mut both);
    assert!(
        all.iter()
            .zip(&both)
            .all(|(q, both)| robot.fk_jacobian(q) == *both)
    );
    report(&format!("{name}, with Jacobian, one by one"), |range| {
        for (q, both) in all[range.clone()].iter().zip(&mut both[range]) {
            *both = robot.fk_jacobian(q);
        }
    });
    report(
        &format!("{name}, with Jacobian, `fk_jacobian_batch`"),
        |range| {
            robot.fk_jacobian_batch(&all[range.clone()], &mut both[range]);
        },
    );
}

fn inverse(name: &str, robot: &impl Kinematics<6>) {
    let mut targets = vec![Pose::IDENTITY; ALL];
    robot.fk_batch(configurations(), &mut targets);
    let mut solutions = vec![Solutions::new(); PART];
    for part in targets.chunks_exact(PART).take(20) {
        robot.ik_batch(part, &mut solutions);
        assert!(
            part.iter()
                .zip(&solutions)
                .all(|(target, found)| robot.ik(target) == *found)
        );
    }
    report(&format!("{name}, all solutions, one by one"), |range| {
        for part in targets[range].chunks(PART) {
            for (target, found) in part.iter().zip(&mut solutions) {
                *found = robot.ik(target);
            }
        }
    });
    report(&format!("{name}, all solutions, `ik_batch`"), |range| {
        for part in targets[range].chunks(PART) {
            robot.ik_batch(part, &mut solutions[..part.len()]);
        }
    });
}

/// Times what `work` does of a range of all inputs.
fn report(what: &str, mut work: impl FnMut(std::ops::Range<usize>)) {
    let parts = (0..ALL / PART).map(|i| i * PART..(i + 1) * PART);
    // The inputs of a call are in the cache, as they are for who has just made them.
    let mut times: Vec<f64> = parts
        .map(|part| {
            work(part.clone());
            nanoseconds(PART, || work(part))
        })
        .collect();
    times.sort_by(f64::total_cmp);
    let [p50, p99] = [50, 99].map(|percent| times[times.len() * percent / 100]);
    let mut all: Vec<f64> = (0..ROUNDS)
        .map(|_| nanoseconds(ALL, || work(0..ALL)))
        .collect();
    all.sort_by(f64::total_cmp);
    let (least, million) = (times[0], all[ROUNDS / 2]);
    println!("| {what} | {least:.1} | {p50:.1} | {p99:.1} | {million:.1} |");
}

fn nanoseconds(count: usize, work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_nanos() as f64 / count as f64
}

/// Drawn from the whole turn of every joint.
fn configurations() -> &'static [[f64; 6]] {
    static ALL_OF_THEM: std::sync::LazyLock<Vec<[f64; 6]>> = std::sync::LazyLock::new(|| {
        let mut random = Random::default();
        let mut angle = || (random.unit() * 2.0 - 1.0) * PI;
        (0..ALL).map(|_| std::array::from_fn(|_| angle())).collect()
    });
    &ALL_OF_THEM
}
