//! Arms off their design, and configurations next to where the design is singular.

use kin_codegen::geometry::size;
use kin_codegen::model::Model;
use kin_codegen::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

/// The design with every axis turned by up to `noise` radians and shifted by up to as
/// much of the arm's size.
pub fn measured(design: &Model, noise: f64, random: &mut Random) -> Model {
    let mut model = design.clone();
    let length = size(design);
    for joint in &mut model.joints {
        let mut side = || [0; 3].map(|_| noise * random.between(-1.0, 1.0));
        let (turn, shift) = (side(), side());
        let axis = joint.axis;
        let turned = [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            axis[i] + turn[j] * axis[k] - turn[k] * axis[j]
        });
        let norm = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
        joint.axis = turned.map(|x| x / norm);
        for (x, shift) in joint.point.iter_mut().zip(shift) {
            *x += length * shift;
        }
    }
    model
}

/// Of so many joints, anywhere, or with a joint or two as near to a round value as 1e-6.
pub fn configuration(joints: usize, k: usize, random: &mut Random) -> Vec<f64> {
    let mut q: Vec<f64> = (0..joints).map(|_| random.between(-PI, PI)).collect();
    for _ in 0..k % 3 {
        let round = random.below(4) as f64 * FRAC_PI_2;
        q[random.below(joints as u64)] = round + 10_f64.powf(random.between(-6.0, -1.0));
    }
    q
}
