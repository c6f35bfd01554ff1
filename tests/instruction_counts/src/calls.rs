//! What is counted: calls of each kind, of each robot.

use kinematics::{Kinematics, Pose};
use std::f64::consts::{FRAC_PI_2, PI};
use std::hint::black_box;

// What macros would leave, so that none is built in release.
include!("../../golden/ur5e.rs");
include!("../../golden/kr6_r900.rs");
include!("../../golden/xarm6.rs");
include!("../../golden/calibrated.rs");

/// With an exact closed form, of which nothing that is executed depends on the target.
pub const EXACT: [&str; 2] = ["ur5e", "kr6_r900"];

/// With an elimination, alone and beside the branches of a design.
pub const ELIMINATED: [&str; 2] = ["xarm6", "calibrated"];

/// The kinds of calls, in the order in which they are made.
pub const KINDS: [&str; 8] = [
    "fk",
    "fk_jacobian",
    "ik, regular",
    "ik, out of reach",
    "ik, singular wrist",
    "ik_nearest, regular",
    "ik_nearest, out of reach",
    "ik_nearest, singular wrist",
];

/// The same of eliminations.
pub const KINDS_OF_ELIMINATIONS: [&str; 4] = [
    "ik, regular",
    "ik, out of reach",
    "ik, near round",
    "ik, round",
];

/// How many calls there are of each kind.
pub const CALLS: usize = 64;

/// Calls what `robot` has: each kind in turn.
pub fn make(robot: &str) {
    match robot {
        "ur5e" => all(&Ur5e),
        "kr6_r900" => all(&Kr6R900),
        "xarm6" => eliminations(&Xarm6),
        "calibrated" => eliminations(&Calibrated),
        _ => panic!("no robot is called {robot}"),
    }
}

fn all<K: Kinematics<6>>(robot: &K) {
    let configurations: Vec<[f64; 6]> = (0..CALLS).map(configuration).collect();
    let regular: Vec<Pose> = configurations.iter().map(|q| robot.fk(q)).collect();
    let away = Pose::from_translation([0.0, 0.0, 10.0]);
    let out_of_reach: Vec<Pose> = regular.iter().map(|target| away * *target).collect();
    let straight = |q: &[f64; 6]| robot.fk(&[q[0], q[1], q[2], q[3], 0.0, q[5]]);
    let singular: Vec<Pose> = configurations.iter().map(straight).collect();
    let seed = [0.1, -1.0, 1.0, 0.2, 0.8, -0.3];

    // The first call asks the processor what instructions it has.
    black_box(robot.ik(&regular[0]));
    each(&configurations, |q| robot.fk(q));
    each(&configurations, |q| robot.fk_jacobian(q));
    for targets in [&regular, &out_of_reach, &singular] {
        each(targets, |target| robot.ik(target));
    }
    for targets in [&regular, &out_of_reach, &singular] {
        each(targets, |target| robot.ik_nearest(target, &seed));
    }
}

/// Of round targets solutions meet, or share the value of the joint that is kept, so that more than one
/// elimination is asked; near them joints are off by 1e-6 to 1e-1.
fn eliminations<K: Kinematics<6>>(robot: &K) {
    let configurations: Vec<[f64; 6]> = (0..CALLS).map(configuration).collect();
    let regular: Vec<Pose> = configurations.iter().map(|q| robot.fk(q)).collect();
    let away = Pose::from_translation([0.0, 0.0, 10.0]);
    let out_of_reach: Vec<Pose> = regular.iter().map(|target| away * *target).collect();
    let to_quarters = |q: f64| (q / FRAC_PI_2).round() * FRAC_PI_2;
    let near_round = (0..CALLS).map(|call| {
        let mut q = configurations[call];
        let off = 10_f64.powi(-1 - (call % 6) as i32);
        for joint in [call % 6, (call + 1 + call / 6) % 6] {
            q[joint] = to_quarters(q[joint]) + off;
        }
        robot.fk(&q)
    });
    let near_round: Vec<Pose> = near_round.collect();
    let round = configurations.iter().map(|q| robot.fk(&q.map(to_quarters)));
    let round: Vec<Pose> = round.collect();

    // The first call asks the processor what instructions it has.
    black_box(robot.ik(&regular[0]));
    for targets in [&regular, &out_of_reach, &near_round, &round] {
        each(targets, |target| robot.ik(target));
    }
}

/// Angles from the whole turn; of every eighth configuration all of them large, so that
/// nothing that is executed hangs on their size.
fn configuration(call: usize) -> [f64; 6] {
    let turns = if call % 8 == 7 { 1000.0 * PI } else { 0.0 };
    std::array::from_fn(|joint| {
        // Multiples of an irrational number, modulo 1, fill the unit interval evenly.
        let share = ((6 * call + joint + 1) as f64 * 0.754_877_666_246_692_7).fract();
        turns + (4.0 * share - 2.0) * FRAC_PI_2
    })
}

fn each<I, O>(inputs: &[I], solve: impl Fn(&I) -> O) {
    for input in inputs {
        start_counting();
        one_counted_call(input, &solve);
    }
}

/// Where valgrind sets its count to zero.
#[inline(never)]
fn start_counting() {
    black_box(());
}

/// Behind which valgrind writes its count down.
#[inline(never)]
fn one_counted_call<I, O>(input: &I, solve: impl Fn(&I) -> O) {
    black_box(solve(black_box(input)));
}
