//! What a planner asks: follow a line, each step by the posture that is within
//! limits and nearest to the one before.

use kinematics::Pose;

kinematics::kinematics!("robots/kr6_r900.yaml");

fn main() {
    let arm = Kr6R900;
    let mut q = [0.0, -1.2, 1.6, 0.0, 0.6, 0.0];
    let start = arm.fk(&q);
    println!("moving the tool 0.4 m sideways");
    for step in 0..=8 {
        let target = shifted(&start, 0.05 * f64::from(step));
        let Some(next) = arm.ik_nearest(&target, &q) else {
            println!("step {step}: out of reach or of limits");
            return;
        };
        let warning = if next.singular { ", singular" } else { "" };
        println!(
            "step {step}: {:7.4?} branch {}{warning}",
            next.q, next.branch
        );
        q = next.q;
    }
}

fn shifted(pose: &Pose, y: f64) -> Pose {
    let mut moved = *pose;
    moved.translation[1] += y;
    moved
}
