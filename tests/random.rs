//! A seeded generator, so that a failure repeats.

use std::f64::consts::{FRAC_PI_2, PI};

/// SplitMix64 (G. Steele, D. Lea, C. Flood, 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    pub fn angle(&mut self) -> f64 {
        self.between(-PI, PI)
    }

    /// 0, ±π/2 or π.
    #[allow(dead_code, reason = "not every program of tests draws right angles")]
    pub fn right_angle(&mut self) -> f64 {
        [0.0, FRAC_PI_2, -FRAC_PI_2, PI][(self.next() >> 62) as usize]
    }

    /// A number below `end`.
    #[allow(dead_code, reason = "not every program of tests draws numbers")]
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    /// Uniform in the cube from −1 to 1.
    #[allow(dead_code, reason = "not every program of tests draws vectors")]
    pub fn unit_cube<const D: usize>(&mut self) -> [f64; D] {
        std::array::from_fn(|_| self.between(-1.0, 1.0))
    }
}
