//! Random configurations.

use crate::model::Model;
use crate::verify::configurations::Random;
use std::f64::consts::PI;

/// How far the coordinates of a configuration go.
pub(super) struct Ranges(Vec<[f64; 2]>);

impl Ranges {
    pub(super) fn new(model: &Model, size: f64) -> Self {
        let finite = |limits: &[f64; 2]| limits.iter().all(|x| x.is_finite());
        let range = |i: usize| match model.variables[i].limits.filter(finite) {
            // From above, so that the end that is left out is −π.
            _ if model.turns(i) => [PI, -PI],
            Some(limits) => limits,
            None => [-size, size],
        };
        Self((0..model.variables.len()).map(range).collect())
    }

    /// The configuration of a number: random, but always the same for a seed.
    pub(super) fn draw(&self, seed: u64, number: usize) -> Vec<f64> {
        let mut random = Random(scrambled(scrambled(seed) ^ number as u64) | 1);
        let value = |&[from, to]: &[f64; 2]| random.between(from, to);
        self.0.iter().map(value).collect()
    }
}

/// Numbers in a row become unrelated ones: the mixing of SplitMix64 (Steele,
/// Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
fn scrambled(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
