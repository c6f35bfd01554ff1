//! A controller with a joint to spare: a Panda follows a line, asked once a millisecond,
//! and keeps its joints away from their limits on the way. Nothing is allocated.

use std::time::Instant;

use kinematics::{Follow, Pose, RedundantKinematics};

kinematics::kinematics!("robots/panda.yaml");

fn main() {
    let arm = Panda;
    let mut q = [0.9, -0.6, -1.0, -2.2, 0.4, 1.9, 1.4];
    let start = arm.fk(&q);
    // The last joint turns by 0.5 rad/s at most beyond what the line takes, and no joint
    // faster than it may.
    let mut how = Follow::new(&Panda::LIMITS, 0.5e-3);
    how.step = Panda::VELOCITY_LIMITS.map(|limit| limit.min(2.5) * 1e-3);

    println!("time   parameter   how near to limits");
    let clock = Instant::now();
    for millisecond in 1..=4000 {
        let target = along_line(&start, f64::from(millisecond) / 4000.0);
        let Some(step) = arm.ik_follow(&target, &q, &how) else {
            println!("{millisecond} ms: out of reach or of limits");
            return;
        };
        if step.jumps {
            println!("{millisecond} ms: the branch ends here");
            return;
        }
        q = step.solution.q;
        if millisecond % 500 == 0 {
            let crowding = how.crowding(&q);
            let parameter = step.parameter;
            println!("{millisecond:4} ms {parameter:8.3} rad {crowding:8.3}");
        }
    }
    let cycle = clock.elapsed().as_secs_f64() / 4000.0;
    println!("{:.1} µs each", 1e6 * cycle);
}

/// 0.25 m to the side, at rest at both ends.
fn along_line(start: &Pose, time: f64) -> Pose {
    let mut target = *start;
    target.translation[1] += 0.25 * time * time * (3.0 - 2.0 * time);
    target
}
