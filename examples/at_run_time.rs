//! What it takes to read robots while the program runs, and to ask one of them what the same arm
//! compiled into the program is asked: the same answers.

use std::time::Instant;

use kinematics::{LoadError, Pose, Robot, RobotOptions, RobotSource, Solutions};
use std::f64::consts::{PI, TAU};
use std::path::Path;

kinematics::kinematics!("robots/ur5e.urdf");

/// Configurations, spread over the whole turn of every joint.
const COUNT: usize = 1024;
/// The fastest of so many rounds counts.
const ROUNDS: usize = 20;

fn main() -> Result<(), LoadError> {
    println!("read           searched for   from a cache");
    for file in [
        "ur5e.urdf",
        "kr6_r900.yaml",
        "puma560.yaml",
        "xarm6.yaml",
        "iiwa14.yaml",
        "panda.yaml",
    ] {
        let [searched, cached] = read(file)?;
        println!("{file:14} {searched:9.2} ms   {cached:9.2} ms");
    }
    let arm = Robot::from_urdf(concat!(env!("CARGO_MANIFEST_DIR"), "/robots/ur5e.urdf"))?;
    println!("{} from {} to {}", arm.name(), arm.base(), arm.tip());

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

/// Milliseconds to read a robot, without and with a folder of what was found before.
fn read(file: &str) -> Result<[f64; 2], LoadError> {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("robots");
    let source = RobotSource::read(file, &robots)?;
    let options = RobotOptions::default();
    let folder = std::env::temp_dir().join("robots_at_run_time");
    Robot::load_cached(&source, &options, &folder)?;
    let joints = |arm: Result<Robot, LoadError>| arm.map_or(0.0, |arm| arm.joints() as f64);
    let searched = fastest(&[()], |()| joints(Robot::load(&source, &options)));
    let cached = fastest(&[()], |()| {
        joints(Robot::load_cached(&source, &options, &folder))
    });
    Ok([searched, cached].map(|time| 1e-6 * time))
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
