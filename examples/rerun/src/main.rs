//! For the Rerun viewer: all solutions of an arm whose tool goes around a circle, the one that moves
//! the joints least, and the joints' values. `rerun ur5e.rrd` shows what this writes.

use kinematics::Pose;
use rerun::{Clear, LineStrips3D, RecordingStream, RecordingStreamBuilder, Scalars};
use std::error::Error;
use std::f64::consts::TAU;

kinematics::kinematics!("../../robots/ur5e.urdf");

const STEPS: i64 = 200;
const GREY: [u8; 3] = [150, 150, 150];
const ORANGE: [u8; 3] = [240, 140, 20];

fn main() -> Result<(), Box<dyn Error>> {
    let recording = RecordingStreamBuilder::new("kinematics").save("ur5e.rrd")?;
    let mut q = [0.3, -1.2, 1.5, -1.9, -1.6, 0.4];
    let start = Ur5e.fk(&q);
    for step in 0..=STEPS {
        recording.set_time_sequence("step", step);
        let target = on_circle(&start, step as f64 / STEPS as f64);
        let solutions = Ur5e.ik(&target);
        for branch in 0..Ur5e::BRANCHES {
            let path = format!("branches/{branch}");
            match solutions.iter().find(|it| it.branch as usize == branch) {
                Some(solution) => draw(&recording, &path, &solution.q, GREY, 0.004)?,
                None => recording.log(path, &Clear::flat())?,
            }
        }
        let nearest = Ur5e.ik_nearest(&target, &q).ok_or("out of reach")?;
        q = nearest.q;
        draw(&recording, "nearest", &q, ORANGE, 0.012)?;
        for (name, value) in Ur5e::JOINT_NAMES.iter().zip(q) {
            recording.log(format!("joints/{name}"), &Scalars::single(value))?;
        }
    }
    recording.flush_blocking()?;
    Ok(())
}

/// The arm as a line through its joints, from the base to the tip.
fn draw(
    recording: &RecordingStream,
    path: &str,
    q: &[f64; 6],
    color: [u8; 3],
    radius: f32,
) -> Result<(), Box<dyn Error>> {
    let links = Ur5e.fk_links(q);
    let tip = Ur5e.fk(q);
    let frames = [&Pose::IDENTITY].into_iter().chain(&links).chain([&tip]);
    let points = frames.map(|frame| frame.translation.map(|x| x as f32));
    let line = LineStrips3D::new([points.collect::<Vec<_>>()]);
    recording.log(path, &line.with_colors([color]).with_radii([radius]))?;
    Ok(())
}

/// Once around, 0.2 m across, through the start.
fn on_circle(start: &Pose, turn: f64) -> Pose {
    let mut target = *start;
    let (sin, cos) = (TAU * turn).sin_cos();
    target.translation[1] += 0.1 * sin;
    target.translation[2] += 0.1 * (1.0 - cos);
    target
}
