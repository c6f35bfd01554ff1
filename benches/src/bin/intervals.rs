//! Intervals of a parameter: `feasible`, `feasible_within` and `ik_best` of arms whose
//! intervals are found in each of the ways that `docs/redundancy.md` describes.
//! `cargo run --release --bin intervals`, with how many targets of each kind as an argument.
//!
//! First the answers are compared with `ik_at`: at 16 values of the parameter there have to
//! be as many intervals as solutions; at how many of the targets there are not is a column.

use kinematics::{Criterion, FeasibleInterval, Parameter, Pose, RedundantKinematics};
use kinematics_benches::inputs::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::hint::black_box;
use std::time::Instant;

kinematics::kinematics!("../robots/panda.yaml");
kinematics::kinematics!("../robots/panda.yaml", name = PandaByWrist, free = "joint6");
kinematics::kinematics!("../robots/iiwa14.yaml", free = "joint_a7");
kinematics::kinematics!(
    "../tests/robots/redundant/stray_iiwa.yaml",
    free = "joint_a7"
);
kinematics::kinematics!("../robots/ur5e.urdf", target = position_axis);
kinematics::kinematics!("../robots/sawyer.yaml");
kinematics::kinematics!("../tests/robots/redundant/gen3.yaml");
kinematics::kinematics!("../tests/robots/redundant/xarm7.yaml");
kinematics::kinematics!(
    "../tests/robots/redundant/torch.yaml",
    target = position_axis
);

/// Values of the parameter at which intervals are compared with solutions.
const VALUES: usize = 16;

/// All joints anywhere, or all at quarter turns.
fn configuration<const N: usize>(round: bool, random: &mut Random) -> [f64; N] {
    std::array::from_fn(|_| match round {
        true => (4.0 * random.unit()).floor() * FRAC_PI_2,
        false => PI * (2.0 * random.unit() - 1.0),
    })
}

/// How many intervals hold a value, which one that winds several times does as often.
fn holding<const N: usize>(intervals: &[FeasibleInterval<N>], value: f64) -> usize {
    let turns = || (-1..=16).map(|turn| value + TAU * f64::from(turn));
    let within = |i: &FeasibleInterval<N>| turns().filter(|x| (i.from..i.to).contains(x)).count();
    intervals.iter().map(within).sum()
}

/// Whether there are as many intervals as solutions at evenly spread values.
fn agree<K: RedundantKinematics<N>, const N: usize>(robot: &K, target: &Pose) -> bool {
    let intervals = robot.feasible(target);
    (0..VALUES).all(|i| {
        let value = TAU * ((i as f64 + 0.5) / VALUES as f64 - 0.5);
        holding(&intervals, value) == robot.ik_at(target, value).len()
    })
}

/// The median, 99th percentile and worst time in microseconds.
fn times(targets: &[Pose], call: impl Fn(&Pose)) -> [f64; 3] {
    let time = |target: &Pose| {
        let start = Instant::now();
        call(black_box(target));
        start.elapsed().as_nanos() as f64 / 1000.0
    };
    let mut micros: Vec<f64> = targets
        .iter()
        .map(|target| time(target).min(time(target)))
        .collect();
    micros.sort_by(f64::total_cmp);
    [0.5, 0.99, 1.0].map(|share| micros[((micros.len() - 1) as f64 * share) as usize])
}

fn row<K: RedundantKinematics<N>, const N: usize>(name: &str, robot: &K, count: usize) {
    assert!(
        !matches!(K::PARAMETER, Parameter::Joint(joint) if !K::LIMITS[joint].is_revolute()),
        "values are compared around the turn"
    );
    for (round, word) in [(false, "random"), (true, "round")] {
        let mut random = Random::default();
        let targets: Vec<Pose> = (0..count)
            .map(|_| robot.fk(&configuration(round, &mut random)))
            .collect();
        let off = targets
            .iter()
            .filter(|target| !agree(robot, target))
            .count();
        let columns = [
            times(&targets, |target| drop(black_box(robot.feasible(target)))),
            times(&targets, |target| {
                drop(black_box(robot.feasible_within(target, &K::LIMITS)));
            }),
            times(&targets, |target| {
                black_box(robot.ik_best(target, &Criterion::FarthestFromLimits));
            }),
        ];
        let cell =
            |[median, most, worst]: [f64; 3]| format!("{median:.0} | {most:.0} | {worst:.0}");
        println!(
            "| {name} | {word} | {off} | {} |",
            columns.map(cell).join(" | ")
        );
    }
}

fn main() {
    let count = std::env::args().nth(1);
    let count = count.map_or(200, |count| count.parse().expect("a number of targets"));
    println!(
        "| arm | targets | off | feasible p50 µs | p99 | worst | within p50 | p99 | worst | best p50 | p99 | worst |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    row("Panda", &Panda, count);
    row("iiwa, last joint", &Iiwa14, count);
    row("UR5e, tool may turn", &Ur5e, count);
    row("Panda, joint 6", &PandaByWrist, count);
    row("Sawyer", &Sawyer, count);
    row("Gen3, off its design", &Gen3, count);
    row("iiwa, off its design", &StrayIiwa, count);
    row("xArm 7", &Xarm7, count);
    row("xArm 6 with a torch that may turn", &Torch, count);
}
