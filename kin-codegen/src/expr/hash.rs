//! Hashing of nodes, which is a fifth of what a macro does in a build without
//! optimizations if it is left to the standard library's hasher.

use std::hash::{BuildHasherDefault, Hasher};

/// A hash map of nodes. They come from a robot file of the user's own, not from an
/// attacker.
pub type NodeMap<K, V> = std::collections::HashMap<K, V, BuildHasherDefault<Multiplicative>>;

/// Multiplicative hashing (Knuth, *The Art of Computer Programming*, volume 3,
/// section 6.4), word by word; the high bits, which are mixed best, come to lie low.
#[derive(Clone, Copy, Default)]
pub struct Multiplicative(u64);

/// 2⁶⁴ over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl Hasher for Multiplicative {
    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(GOLDEN).rotate_left(29);
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn write_u8(&mut self, x: u8) {
        self.write_u64(u64::from(x));
    }

    fn write_u16(&mut self, x: u16) {
        self.write_u64(u64::from(x));
    }

    fn write_u32(&mut self, x: u32) {
        self.write_u64(u64::from(x));
    }

    fn write_usize(&mut self, x: usize) {
        self.write_u64(x as u64);
    }

    fn write_isize(&mut self, x: isize) {
        self.write_u64(x as u64);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}
