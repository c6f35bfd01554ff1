//! Arms of six joints by how neighbouring axes lie.

use kin_codegen::random::Random;
use kin_runtime::__private::univariate::Frames;
use kin_runtime::{Chain, Pose, Twist};
use std::f64::consts::PI;

/// How an axis lies to the one before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Neighbour {
    Parallel,
    Intersecting,
    General,
}

use Neighbour::{General, Intersecting, Parallel};

/// All of the 3⁵ patterns.
pub fn patterns() -> impl Iterator<Item = [Neighbour; 5]> {
    (0..243_usize)
        .map(|i| [0, 1, 2, 3, 4].map(|k| [General, Parallel, Intersecting][i / 3_usize.pow(k) % 3]))
}

/// From one joint's frame to the next: Denavit and Hartenberg's d, a and α.
fn link(d: f64, a: f64, alpha: f64) -> Pose {
    Pose::from_axis_angle([1.0, 0.0, 0.0], alpha, [a, 0.0, d])
}

/// An arm with this pattern and random dimensions, whose joints all turn.
pub fn random_arm(pattern: &[Neighbour; 5], random: &mut Random) -> Frames {
    let mut side = || random.between(0.2, 0.7) * if random.below(2) == 0 { 1.0 } else { -1.0 };
    let (base, tip) = (link(side(), side(), side()), link(side(), side(), side()));
    let fixed = std::array::from_fn(|i| match i {
        0 => base,
        6 => tip,
        _ => match pattern[i - 1] {
            Parallel => link(side(), side(), 0.0),
            Intersecting => link(side(), 0.0, 2.0 * side()),
            General => link(side(), side(), 2.0 * side()),
        },
    });
    Frames {
        fixed,
        prismatic: 0,
    }
}

/// Which joints slide, one or two, as bits.
pub fn slides() -> Vec<u64> {
    (1..64).filter(|mask: &u64| mask.count_ones() < 3).collect()
}

/// Right angles, upper arm and forearm in one plane, and a wrist whose last axis
/// passes the point where the two before it meet.
pub fn cobot() -> Frames {
    let quarter = std::f64::consts::FRAC_PI_2;
    let fixed = [
        link(0.25, 0.0, 0.0),
        link(0.0, 0.0, -quarter),
        link(0.0, 0.71, PI),
        link(0.0, 0.0, -quarter),
        link(-0.69, 0.0, quarter),
        link(0.19, 0.0, -quarter),
        link(-0.21, 0.0, PI),
    ];
    Frames {
        fixed,
        prismatic: 0,
    }
}

/// The same arm as a product of exponentials.
pub fn chain(frames: &Frames) -> Chain {
    let mut pose = frames.fixed[0];
    let mut twists = Vec::new();
    for (joint, fixed) in frames.fixed[1..].iter().enumerate() {
        let axis = [0, 1, 2].map(|i| pose.rotation[i][2]);
        twists.push(match frames.slides(joint) {
            true => Twist::prismatic(axis),
            false => Twist::revolute(axis, pose.translation),
        });
        pose = pose * *fixed;
    }
    Chain::new(twists, pose)
}

pub fn anywhere(random: &mut Random) -> [f64; 6] {
    std::array::from_fn(|_| random.between(-PI, PI))
}

/// The determinant of the Jacobian, lengths as in `frames`.
pub fn determinant(frames: &Frames, q: &[f64; 6]) -> f64 {
    let columns = chain(frames).geometric_jacobian(q);
    let entry = |i: usize, j: usize| {
        let column = columns[j].to_array();
        column[i]
    };
    nalgebra::SMatrix::<f64, 6, 6>::from_fn(entry).determinant()
}

/// The least singular value of the Jacobian, lengths as in `frames`.
pub fn least_singular_value(frames: &Frames, q: &[f64; 6]) -> f64 {
    let columns = chain(frames).geometric_jacobian(q);
    let matrix = nalgebra::SMatrix::<f64, 6, 6>::from_fn(|i, j| columns[j].to_array()[i]);
    matrix.singular_values().min()
}

/// A configuration at a distance from a singular one, radians.
pub fn near_singular(frames: &Frames, distance: f64, random: &mut Random) -> [f64; 6] {
    loop {
        let (from, way) = (anywhere(random), anywhere(random));
        let at = |t: f64| -> [f64; 6] { std::array::from_fn(|i| from[i] + t * way[i] / PI) };
        let sign = |t: f64| determinant(frames, &at(t)) > 0.0;
        let Some(step) = (1..40).find(|&i| sign(0.05 * f64::from(i)) != sign(0.0)) else {
            continue;
        };
        let (mut low, mut high) = (0.05 * f64::from(step - 1), 0.05 * f64::from(step));
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if sign(middle) == sign(0.0) {
                &mut low
            } else {
                &mut high
            }) = middle;
        }
        return at(low + distance);
    }
}

/// How far the poses of two configurations are apart, radians and units of length.
pub fn miss(frames: &Frames, q: &[f64; 6], target: &Pose) -> f64 {
    let pose = frames.forward(q);
    pose.translation_distance(target)
        .hypot(pose.rotation_distance(target))
}
