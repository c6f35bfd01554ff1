//! Random configurations.

use kin_codegen::model::Model;
use kin_codegen::random::Random;
use kin_runtime::__private::math::wrap;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI};

/// Which configurations are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Draw {
    /// Evenly from everywhere.
    #[default]
    Anywhere,
    /// With one joint, on average, next to a multiple of a quarter turn, where
    /// the singular configurations of many arms are: by 10⁻¹² to 0.1 radians,
    /// evenly by magnitude. Of these half are sums with the one or two
    /// joints before, or differences.
    Aligned,
}

/// How far the coordinates of a configuration go.
pub(super) struct Ranges {
    ranges: Vec<[f64; 2]>,
    /// Whether a full turn changes nothing.
    repeats: Vec<bool>,
}

impl Ranges {
    pub(super) fn new(model: &Model, size: f64) -> Self {
        let range = |i: usize| match model.variables[i].travel() {
            // From above, so that the end that is left out is −π.
            _ if model.repeats(i) => [PI, -PI],
            Some(limits) => limits,
            None if model.turns(i) => [PI, -PI],
            None => [-size, size],
        };
        let variables = 0..model.variables.len();
        Self {
            ranges: variables.clone().map(range).collect(),
            repeats: variables.map(|i| model.repeats(i)).collect(),
        }
    }

    /// The configuration of a number: random, but always the same for a seed.
    pub(super) fn draw(&self, draw: Draw, seed: u64, number: usize) -> Vec<f64> {
        let mut random = Random(scrambled(scrambled(seed) ^ number as u64) | 1);
        let mut q: Vec<f64> = (self.ranges.iter())
            .map(|&[from, to]| random.between(from, to))
            .collect();
        if draw == Draw::Aligned {
            let joints = q.len() as f64;
            let turning: Vec<usize> = (0..q.len()).filter(|&i| self.repeats[i]).collect();
            for (place, &i) in turning.iter().enumerate() {
                if random.between(0.0, joints) < 1.0 {
                    // Of parallel axes the sum is what is aligned.
                    let (before, count) = (&turning[..place], random.below(4).saturating_sub(1));
                    let before = &before[place.saturating_sub(count)..];
                    let sum: f64 = before.iter().map(|&k| sign(&mut random) * q[k]).sum();
                    q[i] = wrap(aligned(&mut random) - sum);
                }
            }
        }
        q
    }
}

/// An angle next to 0, ±π/2 or π.
fn aligned(random: &mut Random) -> f64 {
    let quarters = random.between(-2.0, 2.0).ceil();
    let off = 10.0_f64.powf(random.between(-12.0, -1.0));
    wrap(quarters * FRAC_PI_2 + sign(random) * off)
}

fn sign(random: &mut Random) -> f64 {
    random.between(-1.0, 1.0).signum()
}

/// Numbers in a row become unrelated ones: the mixing of SplitMix64 (Steele,
/// Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
fn scrambled(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
