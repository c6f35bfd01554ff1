//! Configurations to try an arm on: random and structured ones.

use super::Model;
use crate::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

/// Random configurations.
const RANDOM: usize = 48;
/// Configurations with every joint at a multiple of π/2.
const ALIGNED: usize = 40;
/// How far a slide goes that nothing stops, metres.
const ANYWHERE: [f64; 2] = [-0.5, 0.5];

/// Seeded random ones over the whole turn, home, all joints at ±π/2 and π,
/// each joint alone at 0, ±π/2 and π, and mixtures of these.
pub fn configurations(model: &Model) -> Vec<Vec<f64>> {
    let n = model.variables.len();
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let place = |i: usize, angle: f64| place(model, i, angle);
    let special = [0.0, FRAC_PI_2, -FRAC_PI_2, PI];
    let mut all: Vec<Vec<f64>> = Vec::new();
    for _ in 0..RANDOM {
        all.push(anywhere(model, &mut random));
    }
    for angle in special {
        all.push((0..n).map(|i| place(i, angle)).collect());
    }
    for i in 0..n {
        for angle in special {
            let mut q = anywhere(model, &mut random);
            q[i] = place(i, angle);
            all.push(q);
        }
    }
    for _ in 0..ALIGNED {
        all.push((0..n).map(|i| place(i, special[random.below(4)])).collect());
    }
    all
}

/// A random configuration, anywhere on the turns and travels of the joints.
pub fn anywhere(model: &Model, random: &mut Random) -> Vec<f64> {
    let n = model.variables.len();
    (0..n)
        .map(|i| place(model, i, random.between(-PI, PI)))
        .collect()
}

/// Where a joint is at an angle: a quarter turn of a sliding one is a quarter of its travel.
fn place(model: &Model, i: usize, angle: f64) -> f64 {
    if model.turns(i) {
        return angle;
    }
    let [from, to] = model.variables[i].travel().unwrap_or(ANYWHERE);
    from + (to - from) * (angle + PI) / (2.0 * PI)
}
