//! Configurations to try an arm on: random and structured ones.

use super::Model;
use crate::random::Random;
use kin_runtime::__private::math::wrap;
use std::f64::consts::{FRAC_PI_2, PI};

/// Random configurations, the first of all.
pub const RANDOM: usize = 48;
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

/// Some configurations of which each joint is anywhere, and equally far apart in two that follow
/// each other: so of three one is always nearer to an angle, and one to the opposite.
pub fn spread(model: &Model, count: usize, random: &mut Random) -> Vec<Vec<f64>> {
    let n = model.variables.len();
    let first: Vec<f64> = (0..n).map(|_| random.between(-PI, PI)).collect();
    // Half a turn leaves the lengths of many vectors as they are.
    let apart = 2.0 * PI / count.max(3) as f64;
    // Of neighbours one goes the other way round.
    let way = |i: usize| if i.is_multiple_of(2) { apart } else { -apart };
    let at = |i: usize, k: usize| wrap(first[i] + k as f64 * way(i));
    let configuration = |k| (0..n).map(|i| place(model, i, at(i, k))).collect();
    (0..count).map(configuration).collect()
}

/// Where a joint is at an angle: a quarter turn of a sliding one is a quarter of its travel.
pub fn place(model: &Model, i: usize, angle: f64) -> f64 {
    if model.turns(i) {
        return angle;
    }
    let [from, to] = model.variables[i].travel().unwrap_or(ANYWHERE);
    from + (to - from) * (angle + PI) / (2.0 * PI)
}
