//! Resolved-rate control: the tip follows a line by joint rates alone, past a
//! wrist singularity and on when a joint has come to its limit, with damped
//! least squares.

use kinematics::{Jacobian, JointLimit, Pose, Twist};

kinematics::kinematics!("robots/kr6_r900.yaml");

/// Seconds.
const STEP: f64 = 0.004;
/// How fast an error is corrected, per second.
const GAIN: f64 = 20.0;
/// Below this the least singular value is damped.
const CLOSE: f64 = 0.05;
const MOST_DAMPING: f64 = 0.04;
/// A fence leaves the first joint this much, radians.
const FENCE: f64 = 0.15;

fn main() {
    let arm = Kr6R900;
    // Close to q5 = 0, where the axes of joints 4 and 6 fall into one.
    let mut q = [0.0, -1.1, 1.45, 0.1, -0.3, 0.0];
    let start = arm.fk(&q);
    let speed = [0.0, 0.06, 0.12];
    println!("time   drift    turned   sigma_min  fastest joint  held");
    for k in 0..=600 {
        let time = f64::from(k) * STEP;
        let target = Pose {
            translation: std::array::from_fn(|i| start.translation[i] + speed[i] * time),
            ..start
        };
        let pose = arm.fk(&q);
        let jacobian = arm.geometric_jacobian(&q);
        let sigma = jacobian.manipulability().sigma_min;
        let wanted = Twist {
            linear: speed,
            angular: [0.0; 3],
        } + error(&target, &pose) * GAIN;
        let (rates, held) = within_limits(&jacobian, &wanted, damping(sigma), &q);
        if k % 50 == 0 {
            println!(
                "{time:4.1} s {:6.3} mm {:6.4} rad  {sigma:7.4}  {:6.3} rad/s    {held:?}",
                1e3 * pose.translation_distance(&target),
                pose.rotation_distance(&target),
                rates.iter().fold(0.0, |a: f64, x| a.max(x.abs())),
            );
        }
        q = std::array::from_fn(|i| q[i] + STEP * rates[i]);
    }
}

/// The way from a pose to the target: of the origin, and the turn, base axes.
fn error(target: &Pose, pose: &Pose) -> Twist {
    let between = *target * pose.inverse();
    Twist {
        linear: std::array::from_fn(|i| target.translation[i] - pose.translation[i]),
        angular: between.log().angular,
    }
}

/// None far from a singularity, so that nothing drifts there.
fn damping(sigma: f64) -> f64 {
    MOST_DAMPING * (1.0 - (sigma / CLOSE).powi(2)).max(0.0).sqrt()
}

/// Joints that would leave their limits are held, and the others make up for
/// them as far as they can.
fn within_limits(
    jacobian: &Jacobian<6>,
    wanted: &Twist,
    damping: f64,
    q: &[f64; 6],
) -> ([f64; 6], Vec<&'static str>) {
    let mut limits = Kr6R900::LIMITS;
    limits[0] = JointLimit::Revolute {
        lower: -FENCE,
        upper: FENCE,
    };
    let mut free = *jacobian;
    let mut held = Vec::new();
    loop {
        let rates = free.damped_rates(wanted, damping);
        let leaves = |i: usize| {
            let next = q[i] + STEP * rates[i];
            next < limits[i].lower() || next > limits[i].upper()
        };
        let out = (0..6).find(|&i| leaves(i));
        let Some(joint) = out else {
            return (rates, held);
        };
        held.push(Kr6R900::JOINT_NAMES[joint]);
        free.rows.iter_mut().for_each(|row| row[joint] = 0.0);
    }
}
