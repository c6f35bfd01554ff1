//! Inputs and results of a UR5e for programs in other languages: a line with the
//! nanoseconds that `fk` and `ik` take here, then for each input six angles, the pose
//! row by row, and how many solutions it has.

use kinematics_benches::contest::median;
use kinematics_benches::inputs::{configurations, targets};
use std::hint::black_box;
use std::time::Instant;

kinematics::kinematics!("../robots/ur5e.urdf");

fn main() {
    let (all, targets) = (configurations(), targets(&Ur5e));
    let fk = time(&all, |q| Ur5e.fk(q));
    let ik = time(&targets, |target| Ur5e.ik(target));
    println!("{fk} {ik}");
    for (q, pose) in all.iter().zip(&targets) {
        let rows = pose.rotation.iter().zip(pose.translation);
        let rows = rows.flat_map(|(row, p)| [row[0], row[1], row[2], p]);
        let numbers: Vec<String> = q
            .iter()
            .copied()
            .chain(rows)
            .map(|x| x.to_string())
            .collect();
        println!("{} {}", numbers.join(" "), Ur5e.ik(pose).len());
    }
}

fn time<I, O>(inputs: &[I], solve: impl Fn(&I) -> O) -> f64 {
    let round = |_| {
        let start = Instant::now();
        for input in inputs {
            black_box(solve(black_box(input)));
        }
        start.elapsed().as_nanos() as f64 / inputs.len() as f64
    };
    median((0..41).map(round).collect())
}
