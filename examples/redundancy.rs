//! A seven-joint arm keeps its tool at rest and moves the rest of itself: which
//! of its postures it can go to, and to the best of them by a secondary task.

use std::f64::consts::PI;

use kinematics::{SelfMotionOptions, Stop, centering_gradient, self_motion, self_motions};

kinematics::kinematics!("tests/chapter3/arms/seven.yaml", ik = none);

fn main() {
    let arm = Seven;
    let start = [1.6, 0.9, -1.5, 1.2, 0.7, -0.8, 0.2];

    let motion = self_motion(&arm, &start, &SelfMotionOptions::default()).expect("one motion");
    println!(
        "the elbow swivels {}, through {} postures on the way",
        if motion.is_closed() {
            "all around"
        } else {
            "to and fro"
        },
        motion.path.len()
    );
    let options = SelfMotionOptions {
        limits: Some(Seven::LIMITS),
        ..Default::default()
    };
    let motion = self_motion(&arm, &start, &options).expect("one motion");
    for stop in motion.stops.iter().flatten() {
        if let Stop::Limit { joint } = stop {
            println!("within limits, to that of {}", Seven::JOINT_NAMES[*joint]);
        }
    }

    // The shoulder flipped: the same pose and the same place of the elbow.
    let [q1, q2, q3, q4, q5, q6, q7] = start;
    let flipped = [q1 - PI, -q2, q3 + PI, q4, q5, q6, q7];
    let found = self_motions(
        &arm,
        &[start, flipped, motion.path[3]],
        &SelfMotionOptions::default(),
    )
    .expect("one motion each");
    println!(
        "components of start, flipped, neighbour: {:?}",
        found.component_of
    );

    let pose = arm.fk(&start);
    let mut q = start;
    println!("\naway from singularities, and from limits with a tenth of the weight:");
    println!("step  manipulability  elbow        drift");
    for step in 0..=200 {
        if step % 25 == 0 {
            println!(
                "{step:4}  {:.4}          {:5.2?}  {:.1e} m",
                arm.manipulability(&q).volume,
                elbow(&q),
                arm.fk(&q).translation_distance(&pose),
            );
        }
        let upwards = arm.manipulability_gradient(&q);
        let outwards = centering_gradient(&Seven::LIMITS, &q);
        let wish = std::array::from_fn(|i| upwards[i] - 0.1 * outwards[i]);
        let rates = arm.null_space_projection(&q, &wish);
        q = std::array::from_fn(|i| q[i] + 0.3 * rates[i]);
        // Steps are finite, so the tool is brought back.
        let back = (pose * arm.fk(&q).inverse()).log();
        let correction = arm.spatial_jacobian(&q).least_squares_rates(&back);
        q = std::array::from_fn(|i| q[i] + correction[i]);
    }
}

fn elbow(q: &[f64; 7]) -> [f64; 3] {
    Seven.fk_links(q)[3].translation
}
