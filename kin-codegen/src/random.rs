//! Random numbers that repeat, on every machine and in every version: the code
//! that is generated tells what was seen with them.

/// Marsaglia and Vigna's xorshift64*, from a seed that is not 0.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// Between two numbers, `high` excluded.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// Below `n`.
    pub fn below(&mut self, n: u64) -> usize {
        (self.bits() % n) as usize
    }
}
