//! The same arm read while the program runs and compiled into it: the same answers, and what
//! each takes.

use std::time::Instant;

use kinematics::{Pose, Robot, Solutions};
use std::f64::consts::{PI, TAU};

kinematics::kinematics!("robots/ur5e.urdf");

/// Configurations, spread over the whole turn of every joint.
const COUNT: usize = 1024;
/// The fastest of so many rounds counts.
const ROUNDS: usize = 20;

fn main() -> Result<(), kinematics::LoadError> {
    let clock = Instant::now();
    let arm = Robot::from_urdf(concat!(env!("CARGO_MANIFEST_DIR"), "/robots/ur5e.urdf"))?;
    let read = clock.elapsed().as_secs_f64();
    println!("{} from {} to {}", arm.name(), arm.base(), arm.tip());
    println!("read in {:.1} ms", 1e3 * read);

    let angle = |i: usize| (i as f64 * 2.399_963).rem_euclid(TAU) - PI;
    let all: Vec<[f64; 6]> = (0..COUNT)
        .map(|k| std::array::from_fn(|i| angle(7 * k + i * i + 1)))
        .collect();
    let poses: Vec<Pose> = all.iter().map(|q| Ur5e.fk(q)).collect();
    for (q, pose) in all.iter().zip(&poses) {
        assert_eq!(arm.fk(q), *pose);
        let (here, there) = (Ur5e.ik(pose), arm.ik(pose));
        assert!(here.iter().zip(there.iter()).all(|(a, b)| a.q == b.q));
    }
    println!("              at run time   compiled in");
    let [here, there] = [
        fastest(&all, |q| arm.fk(q).translation[0]),
        fastest(&all, |q| Ur5e.fk(q).translation[0]),
    ];
    println!("pose          {here:8.0} ns   {there:8.0} ns");
    let [here, there] = [
        fastest(&poses, |pose| arm.ik(pose).len() as f64),
        fastest(&poses, |pose| Ur5e.ik(pose).len() as f64),
    ];
    println!("all solutions {here:8.0} ns   {there:8.0} ns");
    println!("many at once");
    let (flat, count) = (all.concat(), COUNT as f64);
    let mut filled = vec![Pose::IDENTITY; COUNT];
    let mut answers = vec![Solutions::new(); COUNT];
    let [here, there] = [
        fastest(&[()], |()| arm.fk_batch(&flat).len() as f64) / count,
        fastest(&[()], |()| {
            Ur5e.fk_batch(&all, &mut filled);
            filled[0].translation[0]
        }) / count,
    ];
    println!("pose          {here:8.0} ns   {there:8.0} ns");
    let [here, there] = [
        fastest(&[()], |()| arm.ik_batch(&poses).len() as f64) / count,
        fastest(&[()], |()| {
            Ur5e.ik_batch(&poses, &mut answers);
            answers.len() as f64
        }) / count,
    ];
    println!("all solutions {here:8.0} ns   {there:8.0} ns");
    Ok(())
}

/// Nanoseconds for one of some inputs.
fn fastest<T>(inputs: &[T], mut run: impl FnMut(&T) -> f64) -> f64 {
    let round = |_| {
        let clock = Instant::now();
        let sum: f64 = inputs.iter().map(&mut run).sum();
        std::hint::black_box(sum);
        1e9 * clock.elapsed().as_secs_f64() / inputs.len() as f64
    };
    (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min)
}
