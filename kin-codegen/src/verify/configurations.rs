//! The configurations that a plan must survive.

use crate::model::Model;
use std::f64::consts::{FRAC_PI_2, PI};

/// Random configurations.
const RANDOM: usize = 48;
/// Configurations with every joint at a multiple of π/2.
const ALIGNED: usize = 40;

/// Seeded random ones over the whole turn, home, all joints at ±π/2 and π,
/// each joint alone at 0, ±π/2 and π, and mixtures of these.
pub fn configurations(model: &Model) -> Vec<Vec<f64>> {
    let n = model.variables.len();
    let travel = slide_travel(model);
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    // A quarter turn of a sliding joint is a quarter of its travel.
    let place = |i: usize, angle: f64| {
        if model.turns(i) {
            angle
        } else {
            travel[i][0] + (travel[i][1] - travel[i][0]) * (angle + PI) / (2.0 * PI)
        }
    };
    let special = [0.0, FRAC_PI_2, -FRAC_PI_2, PI];
    let mut all: Vec<Vec<f64>> = Vec::new();
    let anywhere = |random: &mut Random| -> Vec<f64> {
        (0..n).map(|i| place(i, random.between(-PI, PI))).collect()
    };
    for _ in 0..RANDOM {
        all.push(anywhere(&mut random));
    }
    for angle in special {
        all.push((0..n).map(|i| place(i, angle)).collect());
    }
    for i in 0..n {
        for angle in special {
            let mut q = anywhere(&mut random);
            q[i] = place(i, angle);
            all.push(q);
        }
    }
    for _ in 0..ALIGNED {
        all.push((0..n).map(|i| place(i, special[random.below(4)])).collect());
    }
    all
}

/// How far each coordinate slides: within its limits, or a metre about zero.
fn slide_travel(model: &Model) -> Vec<[f64; 2]> {
    let finite = |limits: [f64; 2]| limits.iter().all(|x| x.is_finite());
    model
        .variables
        .iter()
        .map(|variable| {
            variable
                .limits
                .filter(|l| finite(*l))
                .unwrap_or([-0.5, 0.5])
        })
        .collect()
}

/// A small generator (xorshift64*), so that certificates repeat.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    fn below(&mut self, n: u64) -> usize {
        (self.next() % n) as usize
    }
}
